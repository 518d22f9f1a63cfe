(* The hold certificate: what position alone drives, springs, relaxing modes and springs that slip, is passive with the
   damping  beta T  over holds of lengths up to T, for any motion and any lengths; whatever sticks or slides. In a loop
   that is late by n samples it is passive with  beta (1 + 2n) T.

   An element has a state, stores an energy, and answers with a force that the motor holds while the tool moves on by w;
   then the state follows. It obeys the hold inequality when the energy rises by no more than the work of the held force
   and  beta w^2. A late force is off by what has changed meanwhile. An element follows when the squares of all changes D
   of its force come to no more than 4 beta^2 times those of the tool's displacements. That is said without the square,
   t D <= beta (t^2 + w^2)  for every t, so that elements add up; what relaxes may be ahead for a step, and remembers it. *)
Require Import Reals List Lra Lia Sums.
Import ListNotations.
Local Open Scope R_scope.

Record element := {
  state : Type;
  occurs : state -> Prop;              (* the states that there can be *)
  energy : state -> R;
  memory : state -> R;
  force : state -> R;
  next : state -> R -> state;
  beta : R
}.
Definition holds (e : element) : Prop :=
  0 <= beta e /\ (forall s, 0 <= energy e s /\ 0 <= memory e s) /\
  forall s w, occurs e s -> occurs e (next e s w) /\
    energy e (next e s w) - energy e s <= force e s * w + beta e * (w * w).
Definition follows (e : element) : Prop :=
  forall s w t, occurs e s ->
    memory e (next e s w) - memory e s <= beta e * (w * w + t * t) - t * (force e (next e s w) - force e s).

(* ---------- the elements; the state of each is its force ---------- *)
(* A Maxwell element as it is emitted: a of its force is left after a sample. Of a spring it is all. *)
Definition relaxing (a c : R) : element :=
  {| state := R; occurs _ := True; energy F := F * F / (2 * c); memory F := (1 - a) / (2 * c) * (F * F);
     force F := F; next F w := a * F + c * w; beta := c / (1 + a) |}.
Definition spring (k : R) : element := relaxing 1 k.
Lemma relaxing_holds : forall a c, 0 <= a <= 1 -> 0 < c -> holds (relaxing a c).
Proof.
  intros a c A C.
  assert (I1 : 0 < / (2 * c * (1 + a))) by (apply Rinv_0_lt_compat; repeat apply Rmult_lt_0_compat; lra).
  assert (I2 : 0 < / (2 * c)) by (apply Rinv_0_lt_compat; lra).
  split; [|split]; cbn.
  - apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra].
  - intros F. split.
    + apply Rmult_le_pos; [apply Rle_0_sqr | lra].
    + apply Rmult_le_pos; [apply Rmult_le_pos; lra | apply Rle_0_sqr].
  - intros F w _. split; [exact I|].
    assert (H : F * w + c / (1 + a) * (w * w) - ((a * F + c * w) * (a * F + c * w) / (2 * c) - F * F / (2 * c))
                = (1 - a) / (2 * c * (1 + a)) * (((1 + a) * F + c * w) * ((1 + a) * F + c * w))).
    { field. split; lra. }
    assert (0 <= (1 - a) / (2 * c * (1 + a)) * (((1 + a) * F + c * w) * ((1 + a) * F + c * w))).
    { apply Rmult_le_pos; [|apply Rle_0_sqr]. apply Rmult_le_pos; lra. }
    lra.
Qed.
Lemma relaxing_follows : forall a c, 0 <= a <= 1 -> 0 < c -> follows (relaxing a c).
Proof.
  intros a c A C F w t _. cbn. set (d := t - (1 + a) / (2 * c) * (a * F + c * w - F)).
  assert (E : c / (1 + a) * (w * w + t * t) - t * (a * F + c * w - F)
              - ((1 - a) / (2 * c) * ((a * F + c * w) * (a * F + c * w)) - (1 - a) / (2 * c) * (F * F))
              = c / (1 + a) * (d * d)
                + (1 - a) * (1 - a) / (4 * c * (1 + a)) * (((1 + a) * F + c * w) * ((1 + a) * F + c * w))).
  { unfold d. field. split; lra. }
  assert (B : 0 <= c / (1 + a)) by (apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra]).
  assert (K : 0 <= (1 - a) * (1 - a) / (4 * c * (1 + a))).
  { apply Rmult_le_pos; [apply Rle_0_sqr | left; apply Rinv_0_lt_compat; repeat apply Rmult_lt_0_compat; lra]. }
  pose proof (Rmult_le_pos _ _ B (Rle_0_sqr d)) as P. unfold Rsqr in P.
  pose proof (Rmult_le_pos _ _ K (Rle_0_sqr ((1 + a) * F + c * w))) as Q. unfold Rsqr in Q. lra.
Qed.

(* What the law answers to the last displacement alone, of any sign: what rounding leaves beside the modes. *)
Definition at_once (r : R) : element :=
  {| state := R; occurs _ := True; energy v := Rabs r / 2 * (v * v); memory v := Rabs r / 2 * (v * v);
     force v := r * v; next _ w := w; beta := Rabs r |}.
Lemma product_bounded : forall r x y, - (Rabs r / 2 * (x * x + y * y)) <= r * x * y.
Proof.
  intros r x y. pose proof (Rle_0_sqr (x + y)) as P. pose proof (Rle_0_sqr (x - y)) as M. unfold Rsqr in P, M.
  unfold Rabs. destruct (Rcase_abs r) as [N|N].
  - pose proof (Rmult_le_pos (- r) _ ltac:(lra) M). lra.
  - pose proof (Rmult_le_pos r _ ltac:(lra) P). lra.
Qed.
Lemma at_once_holds : forall r, holds (at_once r).
Proof.
  intros r. pose proof (Rabs_pos r) as A. split; [exact A | split]; cbn.
  - intros v. pose proof (Rle_0_sqr v) as S. unfold Rsqr in S. pose proof (Rmult_le_pos _ _ A S). lra.
  - intros v w _. split; [exact I|]. pose proof (product_bounded r v w). lra.
Qed.
Lemma at_once_follows : forall r, follows (at_once r).
Proof.
  intros r v w t _. cbn. pose proof (product_bounded r v t). pose proof (product_bounded (- r) w t) as P.
  rewrite Rabs_Ropp in P. lra.
Qed.

(* ---------- what slips ---------- *)
(* First everything moves as if all slips stuck; then those that are loaded beyond their yield force slide. In a loop
   that is not late nothing more is asked of sliding than that it lowers what is stored. *)
Definition sliding (e : element) (slide : state e -> state e) : element :=
  {| state := state e; occurs := occurs e; energy := energy e; memory := memory e; force := force e;
     next s w := slide (next e s w); beta := beta e |}.
Lemma sliding_holds : forall e slide, holds e ->
  (forall s, occurs e s -> occurs e (slide s) /\ energy e (slide s) <= energy e s) -> holds (sliding e slide).
Proof.
  intros e slide (B & N & H) L. split; [exact B | split; [exact N|]]. intros s w O. cbn in *.
  destruct (H s w O) as [O2 V]. destruct (L _ O2) as [O3 W]. split; [exact O3 | lra].
Qed.

(* A network that springs alone, of the stiffnesses Ks, join to the tool: their inner ends move by ys while the tool
   moves by w. What is behind them, slips that meet at inner nodes for instance, takes in what it stores more at least,
   and the work of the changes of its forces is not negative, but for what it remembers. *)
Fixpoint total (v : list R) : R := match v with a :: v' => a + total v' | [] => 0 end.
Fixpoint product (v x : list R) : R := match v, x with a :: v', y :: x' => a * y + product v' x' | _, _ => 0 end.
Fixpoint stretched (Ks Fs : list R) (w : R) (ys : list R) : list R :=
  match Ks, Fs, ys with K :: Ks', F :: Fs', y :: ys' => F + K * (w - y) :: stretched Ks' Fs' w ys' | _, _, _ => [] end.
Fixpoint in_springs (Ks Fs : list R) : R :=
  match Ks, Fs with K :: Ks', F :: Fs' => F * F / (2 * K) + in_springs Ks' Fs' | _, _ => 0 end.
Record network := {
  inside : Type;
  consistent : inside -> list R -> Prop;   (* with the forces of the springs *)
  stored : inside -> R;
  remembered : inside -> R;
  advance : inside -> list R -> R -> inside * list R   (* of the forces before and w: what is inside, and ys *)
}.
Definition takes_in (n : network) (Ks : list R) : Prop :=
  Forall (fun K => 0 < K) Ks /\ (forall i, 0 <= stored n i /\ 0 <= remembered n i) /\
  forall i Fs w, length Fs = length Ks -> consistent n i Fs ->
    let (i2, ys) := advance n i Fs w in
    let Fs2 := stretched Ks Fs w ys in
    length ys = length Ks /\ consistent n i2 Fs2 /\
    stored n i2 - stored n i <= product Fs2 ys /\
    remembered n i2 - remembered n i <= product Fs2 ys - product Fs ys.
Definition behind (n : network) (Ks : list R) : element :=
  {| state := inside n * list R;
     occurs s := length (snd s) = length Ks /\ consistent n (fst s) (snd s);
     energy s := stored n (fst s) + in_springs Ks (snd s);
     memory s := remembered n (fst s);
     force s := total (snd s);
     next s w := let (i, ys) := advance n (fst s) (snd s) w in (i, stretched Ks (snd s) w ys);
     beta := total Ks / 2 |}.
Lemma in_springs_positive : forall Ks Fs, Forall (fun K => 0 < K) Ks -> 0 <= in_springs Ks Fs.
Proof.
  induction Ks as [|K Ks IH]; intros [|F Fs] P; cbn; try lra. inversion P; subst.
  apply Rplus_le_le_0_compat; [|apply IH; assumption].
  apply Rmult_le_pos; [apply Rle_0_sqr | left; apply Rinv_0_lt_compat; lra].
Qed.
Lemma total_positive : forall Ks, Forall (fun K => 0 < K) Ks -> 0 <= total Ks.
Proof. induction 1; cbn; lra. Qed.
Lemma stretched_length : forall Ks Fs w ys, length Fs = length Ks -> length ys = length Ks ->
  length (stretched Ks Fs w ys) = length Ks.
Proof. induction Ks as [|K Ks IH]; intros [|F Fs] w [|y ys] L M; cbn in *; try discriminate; auto. Qed.
Lemma springs_work : forall Ks Fs w ys, Forall (fun K => 0 < K) Ks -> length Fs = length Ks -> length ys = length Ks ->
  in_springs Ks (stretched Ks Fs w ys) - in_springs Ks Fs + product (stretched Ks Fs w ys) ys
  <= total Fs * w + total Ks / 2 * (w * w).
Proof.
  induction Ks as [|K Ks IH]; intros [|F Fs] w [|y ys] P L M; cbn in *; try discriminate; try lra.
  inversion P; subst. specialize (IH Fs w ys ltac:(assumption) ltac:(lia) ltac:(lia)).
  set (G := F + K * (w - y)).
  assert (E : F * w + K / 2 * (w * w) - (G * G / (2 * K) - F * F / (2 * K) + G * y) = K / 2 * (y * y))
    by (unfold G; field; lra).
  pose proof (Rle_0_sqr y) as Y. unfold Rsqr in Y.
  assert (0 <= K / 2 * (y * y)) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma springs_follow : forall Ks Fs w ys t, Forall (fun K => 0 < K) Ks ->
  length Fs = length Ks -> length ys = length Ks ->
  product (stretched Ks Fs w ys) ys - product Fs ys
  <= total Ks / 2 * (w * w + t * t) - t * (total (stretched Ks Fs w ys) - total Fs).
Proof.
  induction Ks as [|K Ks IH]; intros [|F Fs] w [|y ys] t P L M; cbn in *; try discriminate; try lra.
  inversion P; subst. specialize (IH Fs w ys t ltac:(assumption) ltac:(lia) ltac:(lia)).
  assert (E : K / 2 * (w * w + t * t) - t * (K * (w - y)) - K * (w - y) * y
              = K / 4 * ((w - t) * (w - t)) + K * ((y - (w - t) / 2) * (y - (w - t) / 2))) by field.
  pose proof (Rle_0_sqr (w - t)) as U. pose proof (Rle_0_sqr (y - (w - t) / 2)) as V. unfold Rsqr in U, V.
  assert (0 <= K / 4 * ((w - t) * (w - t))) by (apply Rmult_le_pos; lra).
  assert (0 <= K * ((y - (w - t) / 2) * (y - (w - t) / 2))) by (apply Rmult_le_pos; lra). lra.
Qed.
Lemma behind_holds : forall n Ks, takes_in n Ks -> holds (behind n Ks).
Proof.
  intros n Ks (P & N & A). split; [|split]; cbn.
  - pose proof (total_positive Ks P). lra.
  - intros [i Fs]. destruct (N i). pose proof (in_springs_positive Ks Fs P). cbn. lra.
  - intros [i Fs] w [L C]. cbn in *. specialize (A i Fs w L C). destruct (advance n i Fs w) as [i2 ys]. cbn.
    destruct A as (M & C2 & V & _). pose proof (springs_work Ks Fs w ys P L M).
    split; [split; [apply stretched_length; assumption | exact C2] | lra].
Qed.
Lemma behind_follows : forall n Ks, takes_in n Ks -> follows (behind n Ks).
Proof.
  intros n Ks (P & N & A) [i Fs] w t [L C]. cbn in *. specialize (A i Fs w L C). destruct (advance n i Fs w) as [i2 ys].
  cbn. destruct A as (M & _ & _ & V). pose proof (springs_follow Ks Fs w ys t P L M). lra.
Qed.

(* What is behind the springs, element by element, by a step of backward Euler: the displacement d takes the force p of
   an element to q. A damper has c = B over the sample period. *)
Inductive part := spring_inside (K : R) | damper_inside (c : R) | slip_inside (Y : R).
Definition may_be (e : part) (p : R) : Prop := match e with slip_inside Y => - Y <= p <= Y | _ => True end.
Definition obeys (e : part) (p d q : R) : Prop :=
  match e with
  | spring_inside K => 0 < K /\ q = p + K * d
  | damper_inside c => 0 < c /\ q = c * d
  | slip_inside Y => - Y <= q <= Y /\ (0 < d -> q = Y) /\ (d < 0 -> q = - Y)
  end.
Definition stored_in (e : part) (p : R) : R := match e with spring_inside K => p * p / (2 * K) | _ => 0 end.
Definition remembered_in (e : part) (p : R) : R := match e with damper_inside c => p * p / (2 * c) | _ => 0 end.
Lemma part_takes_in : forall e p d q, may_be e p -> obeys e p d q ->
  may_be e q /\ stored_in e q - stored_in e p <= q * d /\ remembered_in e q - remembered_in e p <= q * d - p * d.
Proof.
  intros [K|c|Y] p d q M O; cbn in *.
  - destruct O as [P ->]. pose proof (Rmult_le_pos _ _ (Rlt_le _ _ P) (Rle_0_sqr d)) as S. unfold Rsqr in S.
    assert (E : (p + K * d) * (p + K * d) / (2 * K) - p * p / (2 * K) = p * d + K * (d * d) / 2) by (field; lra).
    repeat split; lra.
  - destruct O as [P ->]. pose proof (Rmult_le_pos _ _ (Rlt_le _ _ P) (Rle_0_sqr d)) as S. unfold Rsqr in S.
    assert (I2 : 0 < / (2 * c)) by (apply Rinv_0_lt_compat; lra).
    pose proof (Rmult_le_pos _ _ (Rle_0_sqr (c * d - p)) (Rlt_le _ _ I2)) as T. unfold Rsqr in T.
    assert (E : c * d * d - p * d - (c * d * (c * d) / (2 * c) - p * p / (2 * c))
                = (c * d - p) * (c * d - p) * / (2 * c)) by (field; lra).
    repeat split; lra.
  - destruct O as (B & U & L). destruct (Rtotal_order d 0) as [D|[->|D]].
    + rewrite (L D) in *. repeat split; nra.
    + repeat split; lra.
    + rewrite (U D) in *. repeat split; nra.
Qed.

(* Nodes are numbered; an element ends at nodes or at the ground. Forces ps of the elements and Fs of the springs balance
   when they do the same work on any displacements z of the nodes. *)
Definition at_node (z : nat -> R) (node : option nat) : R := match node with Some i => z i | None => 0 end.
Definition element_between := (part * (option nat * option nat))%type.
Definition stretch (z : nat -> R) (e : element_between) : R := at_node z (fst (snd e)) - at_node z (snd (snd e)).
Definition balance (es : list element_between) (ends : list (option nat)) (ps Fs : list R) : Prop :=
  forall z, product Fs (map (at_node z) ends) = product ps (map (stretch z) es).
Fixpoint each (P : part -> R -> Prop) (es : list element_between) (ps : list R) : Prop :=
  match es, ps with e :: es', p :: ps' => P (fst e) p /\ each P es' ps' | [], [] => True | _, _ => False end.
Fixpoint step_each (z : nat -> R) (es : list element_between) (ps qs : list R) : Prop :=
  match es, ps, qs with
  | e :: es', p :: ps', q :: qs' => obeys (fst e) p (stretch z e) q /\ step_each z es' ps' qs'
  | [], [], [] => True
  | _, _, _ => False
  end.
Fixpoint of_each (f : part -> R -> R) (es : list element_between) (ps : list R) : R :=
  match es, ps with e :: es', p :: ps' => f (fst e) p + of_each f es' ps' | _, _ => 0 end.
(* However the step is solved: with the ends of the springs, and what finds the forces and displacements after it. *)
Definition elements_inside (es : list element_between) (ends : list (option nat))
  (solve : list R -> list R -> R -> list R * (nat -> R)) : network :=
  {| inside := list R;
     consistent ps Fs := each may_be es ps /\ balance es ends ps Fs;
     stored := of_each stored_in es; remembered := of_each remembered_in es;
     advance ps Fs w := let (qs, z) := solve ps Fs w in (qs, map (at_node z) ends) |}.
Definition solves (es : list element_between) (ends : list (option nat)) (Ks : list R) solve : Prop :=
  forall ps Fs w, length Fs = length Ks -> each may_be es ps -> balance es ends ps Fs ->
    let (qs, z) := solve ps Fs w : list R * (nat -> R) in
    step_each z es ps qs /\ balance es ends qs (stretched Ks Fs w (map (at_node z) ends)).
Lemma step_each_takes_in : forall z es ps qs, each may_be es ps -> step_each z es ps qs -> each may_be es qs /\
  of_each stored_in es qs - of_each stored_in es ps <= product qs (map (stretch z) es) /\
  of_each remembered_in es qs - of_each remembered_in es ps
    <= product qs (map (stretch z) es) - product ps (map (stretch z) es).
Proof.
  induction es as [|e es IH]; intros [|p ps] [|q qs] M S; cbn in *; try contradiction; [repeat split; lra|].
  destruct M as [M1 M]. destruct S as [S1 S]. destruct (part_takes_in _ _ _ _ M1 S1) as (A & B & C).
  destruct (IH ps qs M S) as (D & E & F). repeat split; try assumption; lra.
Qed.
Lemma of_each_positive : forall f es ps, (forall e p, In e es -> 0 <= f (fst e) p) -> 0 <= of_each f es ps.
Proof.
  induction es as [|e es IH]; intros [|p ps] H; cbn; try lra.
  apply Rplus_le_le_0_compat; [apply H; left; reflexivity | apply IH; intros; apply H; right; assumption].
Qed.
Definition positive_part (e : part) : Prop :=
  match e with spring_inside K => 0 < K | damper_inside c => 0 < c | slip_inside Y => 0 <= Y end.
Theorem elements_take_in : forall es ends Ks solve, Forall (fun K => 0 < K) Ks -> length ends = length Ks ->
  Forall (fun e => positive_part (fst e)) es -> solves es ends Ks solve -> takes_in (elements_inside es ends solve) Ks.
Proof.
  intros es ends Ks solve PK L PE S. split; [exact PK | split].
  - rewrite Forall_forall in PE. intros ps. cbn.
    split; apply of_each_positive; intros e p I; specialize (PE e I); destruct (fst e) as [K|c|Y]; cbn in *; try lra;
      (apply Rmult_le_pos; [apply Rle_0_sqr | left; apply Rinv_0_lt_compat; lra]).
  - intros ps Fs w LF [M B]. cbn in *. specialize (S ps Fs w LF M B). destruct (solve ps Fs w) as [qs z].
    destruct S as [S B2]. destruct (step_each_takes_in z es ps qs M S) as (M2 & V & W).
    rewrite (B z), (B2 z). repeat split; try assumption. rewrite map_length. exact L.
Qed.

(* One slip behind one spring, whose force is cut off at the yield force. *)
Definition cut (Y F : R) : R := Rmax (- Y) (Rmin Y F).
Definition one_slip (Y : R) : list element_between := [(slip_inside Y, (Some O, None))].
Definition slide (K Y : R) (ps Fs : list R) (w : R) : list R * (nat -> R) :=
  match Fs with
  | [F] => ([cut Y (F + K * w)], fun _ => w - (cut Y (F + K * w) - F) / K)
  | _ => (ps, fun _ => 0)
  end.
Definition slipping (K Y : R) : element := behind (elements_inside (one_slip Y) [Some O] (slide K Y)) [K].
Lemma slip_takes_in : forall K Y, 0 < K -> 0 <= Y -> takes_in (elements_inside (one_slip Y) [Some O] (slide K Y)) [K].
Proof.
  intros K Y HK HY. apply elements_take_in;
    [constructor; [exact HK | constructor] | reflexivity | constructor; [exact HY | constructor] |].
  intros ps Fs w L M B. destruct Fs as [|F [|]]; try discriminate. destruct ps as [|p [|]]; cbn in M; try tauto.
  destruct M as [M _]. specialize (B (fun _ => 1)). unfold stretch, at_node in B. cbn in B.
  assert (E : p = F) by lra. subst p.
  cbn. set (x := w - (cut Y (F + K * w) - F) / K). unfold stretch, at_node. cbn.
  assert (E : x = (F + K * w - cut Y (F + K * w)) * / K) by (unfold x; field; lra).
  assert (HI : 0 < / K) by (apply Rinv_0_lt_compat; exact HK).
  assert (C : - Y <= cut Y (F + K * w) <= Y /\ (0 < x -> cut Y (F + K * w) = Y) /\ (x < 0 -> cut Y (F + K * w) = - Y)).
  { rewrite E. clear E x B L. generalize (F + K * w) as t. intros t. unfold cut, Rmax, Rmin.
    destruct (Rle_dec Y t) as [T|T]; destruct (Rle_dec (- Y) _) as [U|U]; repeat split; intros; try lra; nra. }
  split; [split; [|exact I]|].
  - rewrite Rminus_0_r. exact C.
  - intros z. cbn. unfold stretch, at_node. cbn. unfold x. field. lra.
Qed.

(* ---------- side by side ---------- *)
Definition nothing : element :=
  {| state := unit; occurs _ := True; energy _ := 0; memory _ := 0; force _ := 0; next s _ := s; beta := 0 |}.
Definition beside (e f : element) : element :=
  {| state := state e * state f;
     occurs s := occurs e (fst s) /\ occurs f (snd s);
     energy s := energy e (fst s) + energy f (snd s);
     memory s := memory e (fst s) + memory f (snd s);
     force s := force e (fst s) + force f (snd s);
     next s w := (next e (fst s) w, next f (snd s) w);
     beta := beta e + beta f |}.
Definition all_of (es : list element) : element := fold_right beside nothing es.
Lemma all_hold : forall es, Forall holds es -> holds (all_of es).
Proof.
  induction 1 as [|e es (B & N & E) _ (C & M & F)]; [repeat split; cbn; intros; lra|].
  unfold all_of in *. split; [|split]; cbn; [lra| |].
  - intros [s t]. destruct (N s), (M t). cbn. lra.
  - intros [s t] w [O O2]. cbn in *. destruct (E s w O), (F t w O2). split; [split; assumption | lra].
Qed.
Lemma all_follow : forall es, Forall follows es -> follows (all_of es).
Proof.
  induction 1 as [|e es E _ F]; [intros s w t _; cbn; lra|]. unfold all_of in *. intros [s r] w t [O O2]. cbn in *.
  specialize (E s w t O). specialize (F r w t O2). lra.
Qed.

(* ---------- any number of holds, with forces that are n samples late ---------- *)
(* Over a hold of the length T the tool moves by w, and a damper b takes at least b w^2 / T (Hold.v). *)
Record motion := { w : R; length_of_hold : R; dissipated : R }.
Definition is_motion (b longest : R) (h : motion) : Prop :=
  0 < length_of_hold h <= longest /\ b * (w h * w h) / length_of_hold h <= dissipated h.
Lemma motion_pays : forall beta b longest h, 0 <= beta -> beta * longest <= b -> is_motion b longest h ->
  beta * (w h * w h) <= dissipated h.
Proof.
  intros beta b longest h P B [[T L] D]. apply Rle_trans with (2 := D). apply Rmult_le_reg_r with (1 := T).
  replace (b * (w h * w h) / length_of_hold h * length_of_hold h) with (b * (w h * w h)) by (field; lra).
  replace (beta * (w h * w h) * length_of_hold h) with (beta * length_of_hold h * (w h * w h)) by ring.
  apply Rmult_le_compat_r; [apply Rle_0_sqr|]. apply Rle_trans with (2 := B). apply Rmult_le_compat_l; lra.
Qed.

(* What the tool puts in over the first N holds, where a hold has the force of n samples before, at first the first. *)
Definition work (f : nat -> R) (motions : nat -> motion) (n N : nat) : R :=
  sum N (fun k => f (k - n)%nat * w (motions k) + dissipated (motions k)).

Section Late.
Variables (f : nat -> R) (u : nat -> R) (beta0 V M : R).   (* V is stored at first, M remembered *)
Hypothesis beta_positive : 0 <= beta0.
Hypothesis f_follows :
  forall t N, sum N (fun k => t k * (f (S k) - f k)) <= sum N (fun k => beta0 * (u k * u k + t k * t k)) + M.
Lemma sample_late : forall n N,
  sum N (fun k => (f (k - n)%nat - f (k - S n)%nat) * u k) <= sum N (fun k => 2 * beta0 * (u k * u k)) + M.
Proof.
  intros n N. rewrite (sum_from (S n) N (fun k => (f (k - n)%nat - f (k - S n)%nat) * u k))
    by (intros k L; replace (k - n)%nat with O by lia; replace (k - S n)%nat with O by lia; ring).
  rewrite (sum_ext _ _ (fun k => u (S n + k)%nat * (f (S k) - f k)))
    by (intros k L; replace (S n + k - n)%nat with (S k) by lia; replace (S n + k - S n)%nat with k by lia; ring).
  apply Rle_trans with (1 := f_follows (fun k => u (S n + k)%nat) (N - S n)).
  rewrite (sum_ext _ _ (fun k => beta0 * (u k * u k) + beta0 * (u (S n + k)%nat * u (S n + k)%nat))) by (intros; ring).
  rewrite sum_plus. rewrite (sum_ext N _ (fun k => beta0 * (u k * u k) + beta0 * (u k * u k))) by (intros; ring).
  rewrite sum_plus. apply Rplus_le_compat_r.
  assert (P : forall k, 0 <= beta0 * (u k * u k)).
  { intros. apply Rmult_le_pos; [exact beta_positive | apply Rle_0_sqr]. }
  apply Rplus_le_compat; [apply sum_monotone; [lia | auto]|].
  destruct (Nat.le_gt_cases (S n) N) as [L|L].
  - replace N with (S n + (N - S n))%nat at 2 by lia. generalize (N - S n)%nat as m. clear - P. intros m.
    induction m as [|m IH]; [cbn [sum]; apply sum_positive; auto|].
    replace (S n + S m)%nat with (S (S n + m)) by lia. cbn [sum]. lra.
  - replace (N - S n)%nat with O by lia. apply sum_positive. auto.
Qed.
Theorem late : (forall N, - V <= sum N (fun k => f k * u k + beta0 * (u k * u k))) ->
  forall n N, - (V + INR n * M) <= sum N (fun k => f (k - n)%nat * u k + beta0 * (1 + 2 * INR n) * (u k * u k)).
Proof.
  intros H. induction n as [|n IH]; intros N.
  - replace (- (V + INR 0 * M)) with (- V) by (cbn; ring). apply Rle_trans with (1 := H N), sum_le.
    intros k L. replace (k - 0)%nat with k by lia. cbn. lra.
  - specialize (IH N). pose proof (sample_late n N) as D.
    assert (E : sum N (fun k => f (k - S n)%nat * u k + beta0 * (1 + 2 * INR (S n)) * (u k * u k))
      = sum N (fun k => f (k - n)%nat * u k + beta0 * (1 + 2 * INR n) * (u k * u k))
        + (-1 * sum N (fun k => (f (k - n)%nat - f (k - S n)%nat) * u k) + sum N (fun k => 2 * beta0 * (u k * u k)))).
    { rewrite <- sum_times, <- !sum_plus. apply sum_ext. intros k L. rewrite S_INR. ring. }
    rewrite E, S_INR. lra.
Qed.
End Late.

Fixpoint after (e : element) (s : state e) (u : nat -> R) (k : nat) : state e :=
  match k with O => s | S j => next e (after e s u j) (u j) end.
Definition forces (e : element) (s : state e) (u : nat -> R) (k : nat) : R := force e (after e s u k).
Definition displacements (motions : nat -> motion) (k : nat) : R := w (motions k).

Section Loop.
Variables (e : element) (s : state e) (u : nat -> R).
Hypotheses (H : holds e) (s_occurs : occurs e s).
Lemma after_occurs : forall k, occurs e (after e s u k).
Proof. induction k as [|k IH]; [exact s_occurs|]. destruct H as (_ & _ & G). exact (proj1 (G _ _ IH)). Qed.
Lemma prompt : forall N, energy e (after e s u N) - energy e s
  <= sum N (fun k => forces e s u k * u k + beta e * (u k * u k)).
Proof.
  induction N as [|N IH]; cbn; [lra|]. destruct H as (_ & _ & G). pose proof (proj2 (G _ (u N) (after_occurs N))).
  unfold forces in *. lra.
Qed.
Lemma following : follows e -> forall t N, sum N (fun k => t k * (forces e s u (S k) - forces e s u k))
  <= sum N (fun k => beta e * (u k * u k + t k * t k)) + memory e s.
Proof.
  intros F t N. enough (sum N (fun k => t k * (forces e s u (S k) - forces e s u k))
    <= sum N (fun k => beta e * (u k * u k + t k * t k)) + memory e s - memory e (after e s u N)).
  { destruct H as (_ & Q & _). destruct (Q (after e s u N)). lra. }
  induction N as [|N IH]; [cbn; lra|]. pose proof (F _ (u N) (t N) (after_occurs N)). unfold forces in *. cbn in *. lra.
Qed.
End Loop.

(* The energy rises by no more than what the tool puts in. *)
Theorem passive : forall e s motions b longest, holds e -> occurs e s -> beta e * longest <= b ->
  (forall k, is_motion b longest (motions k)) ->
  forall N, energy e (after e s (displacements motions) N) - energy e s
            <= work (forces e s (displacements motions)) motions 0 N.
Proof.
  intros e s motions b longest H O B D N. apply Rle_trans with (1 := prompt e s _ H O N). apply sum_le. intros k _.
  replace (k - 0)%nat with k by lia. destruct H as (P & _). pose proof (motion_pays _ _ _ _ P B (D k)).
  unfold displacements at 2 3 4. lra.
Qed.
(* n samples late no more is given out than was stored, or remembered, at first. *)
Theorem passive_when_late : forall e s motions n b longest, holds e -> follows e -> occurs e s ->
  beta e * (1 + 2 * INR n) * longest <= b -> (forall k, is_motion b longest (motions k)) ->
  forall N, - (energy e s + INR n * memory e s) <= work (forces e s (displacements motions)) motions n N.
Proof.
  intros e s motions n b longest H F O B D N. set (u := displacements motions). pose proof H as (P & Q & _).
  assert (V : forall m, - energy e s <= sum m (fun k => forces e s u k * u k + beta e * (u k * u k))).
  { intros m. pose proof (prompt e s u H O m). destruct (Q (after e s u m)). lra. }
  apply Rle_trans with (1 := late _ u (beta e) _ _ P (following e s u H O F) V n N).
  apply sum_le. intros k _. pose proof (pos_INR n).
  assert (P2 : 0 <= beta e * (1 + 2 * INR n)) by (apply Rmult_le_pos; lra).
  pose proof (motion_pays _ _ _ _ P2 B (D k)). unfold u, displacements at 2 3 4. lra.
Qed.

(* Of springs, relaxing modes and springs that slip, side by side, nothing is extracted from rest; nor of anything else
   that holds, and in a loop that is late of anything else that follows as well. *)
Corollary nothing_is_extracted : forall es b longest, Forall holds es -> beta (all_of es) * longest <= b ->
  forall motions s, occurs (all_of es) s -> energy (all_of es) s = 0 -> (forall k, is_motion b longest (motions k)) ->
  forall N, 0 <= work (forces (all_of es) s (displacements motions)) motions 0 N.
Proof.
  intros es b longest H B motions s O E D N. pose proof (all_hold es H) as A.
  pose proof (passive _ s motions b longest A O B D N). destruct A as (_ & P & _).
  destruct (P (after _ s (displacements motions) N)). lra.
Qed.
Corollary nothing_is_extracted_when_late : forall es n b longest, Forall holds es -> Forall follows es ->
  beta (all_of es) * (1 + 2 * INR n) * longest <= b ->
  forall motions s, occurs (all_of es) s -> energy (all_of es) s = 0 -> memory (all_of es) s = 0 ->
  (forall k, is_motion b longest (motions k)) ->
  forall N, 0 <= work (forces (all_of es) s (displacements motions)) motions n N.
Proof.
  intros es n b longest H F B motions s O E M D N.
  pose proof (passive_when_late _ s motions n b longest (all_hold es H) (all_follow es F) O B D N) as P.
  rewrite E, M in P. lra.
Qed.
