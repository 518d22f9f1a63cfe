(* The storage function's inequality of a sampled loop, accepted by computing with whole numbers, and what follows from it
   for every motion: nothing is extracted from rest.

   At a sample the tool is at u and the loop in the states x. Over the hold that follows the tool moves by w. The motor's
   force over the hold makes the work  y w + e rho,  where y = k0 u + C x, e = E x, and rho is a second input that is
   free (behind an amplifier's lag; without one E and gamma are zero). What is dissipated is at least
   beta w^2 + gamma rho^2. The states become A (x, w, rho).

   A hold belongs to one of the parts of a list, for instance by its length. Within a part A lies between A1 and A2, and C
   between C1 and C2: the decay q of a lag and its share p are no rational numbers, but lie between some. *)
Require Import Forms ZArith Reals List Lra Lia Bool.
Import ListNotations.
Local Open Scope R_scope.
Local Open Scope bool_scope.

Record part := { A1 : list (list Z); A2 : list (list Z); C1 : list Z; C2 : list Z; beta : Z; gamma : Z }.
Record loop := {
  states : nat;
  E : list Z; k0 : Z;
  P : sym; eP : positive;              (* V = k0 u^2 / 2 + x'P x / eP *)
  eA : positive;                       (* all A over eA *)
  eS : positive;                       (* k0, C, E, beta, gamma over eS *)
  parts : list part
}.
Definition over (z : Z) (e : positive) : R := IZR z / IZR (Zpos e).
Definition step (c : loop) (A : list (list Z)) (x : list R) (w rho : R) : list R :=
  map (fun r => dot r (x ++ [w; rho]) / IZR (Zpos (eA c))) A.
Definition next (c : loop) (p : part) (t : R) x w rho := on_line t (step c (A1 p) x w rho) (step c (A2 p) x w rho).
Definition answer (c : loop) (C : list Z) (x : list R) : R := dot C x / IZR (Zpos (eS c)).
Definition force (c : loop) (p : part) (s u : R) (x : list R) : R :=
  over (k0 c) (eS c) * u + ((1 - s) * answer c (C1 p) x + s * answer c (C2 p) x).
Definition storage (c : loop) (u : R) (x : list R) : R :=
  over (k0 c) (eS c) * u * u / 2 + quad (P c) x / IZR (Zpos (eP c)).

(* 2 eA^2 eP eS (what goes in + V - V after the hold), less what the static spring stores *)
Definition balance (c : loop) (A : list (list Z)) (C : list Z) (beta gamma : Z) : sym :=
  let w := unit_at (states c) in
  let rho := unit_at (S (states c)) in
  let s := (Zpos (eA c) * Zpos (eA c) * Zpos (eP c))%Z in
  mix 1 (mix s (mix 1 (cross C w) 1 (cross (E c) rho)) s (mix (2 * beta - k0 c) (self w) (2 * gamma) (self rho)))
      (Zpos (eS c)) (mix (2 * (Zpos (eA c) * Zpos (eA c))) (P c) (-1) (pull (P c) A)).

Definition shape_of (c : loop) (p : part) : bool :=
  Nat.eqb (length (A1 p)) (states c) && Nat.eqb (length (A2 p)) (states c)
  && Nat.leb (length (C1 p)) (states c) && Nat.leb (length (C2 p)) (states c).
Definition shape (c : loop) : bool :=
  Nat.leb (length (E c)) (states c) && upper (states c) (P c) && (0 <=? k0 c)%Z && forallb (shape_of c) (parts c).

Definition corners (c : loop) (p : part) : list sym :=
  [balance c (A1 p) (C1 p) (beta p) (gamma p); balance c (A1 p) (C2 p) (beta p) (gamma p);
   balance c (A2 p) (C1 p) (beta p) (gamma p); balance c (A2 p) (C2 p) (beta p) (gamma p)].
Definition never_negative (M : sym) : Prop := forall x, 0 <= quad M x.
Definition sound (c : loop) : Prop :=
  shape c = true /\ never_negative (P c) /\ Forall (fun p => Forall never_negative (corners c p)) (parts c).

(* ---------- the checker ---------- *)
(* It computes with the leading digits of A, which may have hundreds, and pays for the others: with a share 1/slack of what
   is stored after the hold, and with a little of the square of every state and input. *)
Definition width (A : list (list Z)) : nat := fold_right (fun row m => Nat.max (length row) m) O A.
Lemma within_width : forall A, Forall (fun row => (length row <= width A)%nat) A.
Proof.
  induction A as [|row A IH]; constructor; cbn; [lia|]. apply Forall_impl with (2 := IH). fold (width A). intros. lia.
Qed.
Record digits := { kept : positive; dropped : nat; slack : positive }.   (* eA = kept 2^dropped *)
Definition near_pull (c : loop) (r : digits) (A : list (list Z)) : sym :=
  mix 1 (pull (P c) (shorter (Z.of_nat (dropped r)) A))
      (2 * (Zpos (slack r) * magnitude (P c) * Z.of_nat (width A))) (ones (width A)).
Definition near (c : loop) (r : digits) (pulled : sym) (C : list Z) (beta gamma : Z) : sym :=
  let w := unit_at (states c) in
  let rho := unit_at (S (states c)) in
  let s := (Zpos (slack r) * (Zpos (kept r) * Zpos (kept r)))%Z in
  let t := (Zpos (eP c) * s)%Z in
  let more := (Zpos (eS c) * (Zpos (slack r) + 1))%Z in
  mix 1 (mix t (mix 1 (cross C w) 1 (cross (E c) rho)) t (mix (2 * beta - k0 c) (self w) (2 * gamma) (self rho)))
      1 (mix (2 * s * Zpos (eS c)) (P c) (- more) pulled).
Definition keeps (c : loop) (r : digits) : bool := (Zpos (eA c) =? Zpos (kept r) * 2 ^ Z.of_nat (dropped r))%Z.
Lemma near_is_enough : forall c r A C b g, never_negative (P c) -> keeps c r = true ->
  never_negative (near c r (near_pull c r A) C b g) -> never_negative (balance c A C b g).
Proof.
  intros c r A C b g HP HK H x. specialize (H x). unfold near, near_pull, balance in *.
  unfold keeps in HK. apply Z.eqb_eq in HK. rewrite HK.
  pose proof (quad_shorter (P c) (Z.of_nat (dropped r)) (slack r) (width A) A x HP ltac:(lia) (within_width A)) as Q.
  rewrite !quad_mix, quad_pull in *. rewrite ?opp_IZR, ?mult_IZR, ?plus_IZR, ?mult_IZR, <- ?INR_IZR_INZ in *.
  set (q := IZR (2 ^ Z.of_nat (dropped r))) in *. set (N := IZR (Z.pos (slack r))) in *.
  set (e := IZR (Z.pos (kept r))) in *. set (eSc := IZR (Z.pos (eS c))) in *. set (ePc := IZR (Z.pos (eP c))) in *.
  set (QA := quad (P c) (image A x)) in *. set (QB := quad (P c) (image (shorter (Z.of_nat (dropped r)) A) x)) in *.
  set (mag := IZR (magnitude (P c))) in *. set (o := quad (ones (width A)) x) in *.
  set (m := INR (width A)) in *. set (p := quad (P c) x) in *.
  set (W := quad (self (unit_at (states c))) x) in *. set (V := quad (self (unit_at (S (states c)))) x) in *.
  set (X1 := quad (cross C (unit_at (states c))) x) in *. set (X2 := quad (cross (E c) (unit_at (S (states c)))) x) in *.
  assert (PN : 0 < N) by (apply (IZR_lt 0); lia). assert (PS : 0 < eSc) by (apply (IZR_lt 0); lia).
  apply (Rmult_le_compat_l (q * q)) in H; [|apply Rle_0_sqr]. rewrite Rmult_0_r in H.
  apply (Rmult_le_compat_l (2 * eSc)) in Q; [|lra].
  apply Rmult_le_reg_l with (1 := PN). rewrite Rmult_0_r. apply Rle_trans with (1 := H). lra.
Qed.
Definition witness := (list (list Z) * positive)%type.
Definition accepts_forms (Ms : list sym) (w : witness) : bool := psd_by (fst w) (snd w) Ms.
(* Where nothing lies between, one corner is all four. *)
Definition is_exact (p : part) : bool :=
  if list_eq_dec (list_eq_dec Z.eq_dec) (A1 p) (A2 p) then if list_eq_dec Z.eq_dec (C1 p) (C2 p) then true else false else false.
(* The A of all parts differ in their first rows, if the first state is what an amplifier's lag keeps back. *)
Definition shared_of (c : loop) (r : digits) : shared :=
  shared_by (P c) (match parts c with p :: _ => shorter (Z.of_nat (dropped r)) (A1 p) | [] => [] end).
Definition near_pull_sharing (c : loop) (r : digits) (s : shared) (A : list (list Z)) : sym :=
  mix 1 (pull_sharing (P c) s (shorter (Z.of_nat (dropped r)) A))
      (2 * (Zpos (slack r) * magnitude (P c) * Z.of_nat (width A))) (ones (width A)).
(* The corners of one A. *)
Definition near_corners (c : loop) (r : digits) (s : shared) (p : part) (A : list (list Z)) : list sym :=
  let M := near_pull_sharing c r s A in
  [near c r M (C1 p) (beta p) (gamma p); near c r M (C2 p) (beta p) (gamma p)].
(* By one witness for all corners, or by one for each A: between C1 and C2 there is hardly anything. *)
Definition accepts_part (c : loop) (r : digits) (s : shared) (f : part * list witness) : bool :=
  let p := fst f in
  if is_exact p then
    match snd f with
    | [w] => accepts_forms [near c r (near_pull_sharing c r s (A1 p)) (C1 p) (beta p) (gamma p)] w
    | _ => false
    end
  else
    match snd f with
    | [w] => accepts_forms (near_corners c r s p (A1 p) ++ near_corners c r s p (A2 p)) w
    | [w1; w2] => accepts_forms (near_corners c r s p (A1 p)) w1 && accepts_forms (near_corners c r s p (A2 p)) w2
    | _ => false
    end.
Definition accepts (c : loop) (r : digits) (of_P : witness) (of_parts : list (list witness)) : bool :=
  let s := shared_of c r in
  shape c && keeps c r && accepts_forms [times (Zpos (eS c)) (P c)] of_P
  && Nat.eqb (length (parts c)) (length of_parts) && forallb (accepts_part c r s) (combine (parts c) of_parts).

Lemma accepted_forms : forall Ms w, accepts_forms Ms w = true -> Forall never_negative Ms.
Proof. intros Ms [L k] H. exact (psd_by_sound L k Ms H). Qed.
Lemma near_pull_shared : forall c r A, near_pull_sharing c r (shared_of c r) A = near_pull c r A.
Proof. intros. unfold near_pull_sharing, shared_of. rewrite pull_sharing_is_pull. reflexivity. Qed.
Lemma near_corners_are_enough : forall c r p A, never_negative (P c) -> keeps c r = true ->
  Forall never_negative (near_corners c r (shared_of c r) p A) ->
  Forall never_negative [balance c A (C1 p) (beta p) (gamma p); balance c A (C2 p) (beta p) (gamma p)].
Proof.
  intros c r p A HP HK F. unfold near_corners in F. rewrite near_pull_shared in F.
  inversion F as [|? ? M1 F2]; inversion F2 as [|? ? M2 F3]; subst.
  repeat apply Forall_cons; try apply Forall_nil; apply (near_is_enough c r _ _ _ _ HP HK); assumption.
Qed.
Lemma accepted_part : forall c r p ws, never_negative (P c) -> keeps c r = true ->
  accepts_part c r (shared_of c r) (p, ws) = true -> Forall never_negative (corners c p).
Proof.
  intros c r p ws HP HK H. unfold accepts_part in H. cbn [fst snd] in H.
  destruct (is_exact p) eqn:X.
  - destruct ws as [|w0 [|? ?]]; try discriminate. apply accepted_forms in H. inversion H as [|? ? M _]; subst.
    rewrite near_pull_shared in M. apply (near_is_enough c r _ _ _ _ HP HK) in M. unfold is_exact in X.
    destruct (list_eq_dec (list_eq_dec Z.eq_dec) (A1 p) (A2 p)) as [EA|]; [|discriminate].
    destruct (list_eq_dec Z.eq_dec (C1 p) (C2 p)) as [EC|]; [|discriminate].
    unfold corners. rewrite <- EA, <- EC. repeat (apply Forall_cons; [exact M|]). apply Forall_nil.
  - set (near_of := near_corners c r (shared_of c r) p) in *.
    enough (G : Forall never_negative (near_of (A1 p)) /\ Forall never_negative (near_of (A2 p))).
    { destruct G as [G1 G2]. apply (near_corners_are_enough c r p _ HP HK) in G1, G2.
      exact (proj2 (Forall_app _ [_; _] [_; _]) (conj G1 G2)). }
    destruct ws as [|w1 [|w2 [|? ?]]]; try discriminate.
    + apply accepted_forms, Forall_app in H. exact H.
    + apply andb_prop in H as [H1 H2]. split; [exact (accepted_forms _ _ H1) | exact (accepted_forms _ _ H2)].
Qed.
Lemma accepted_parts : forall c r, never_negative (P c) -> keeps c r = true ->
  forall ps ws, length ps = length ws -> forallb (accepts_part c r (shared_of c r)) (combine ps ws) = true ->
  Forall (fun p => Forall never_negative (corners c p)) ps.
Proof.
  intros c r HP HK.
  induction ps as [|p ps IH]; intros [|w ws] L H; cbn [combine forallb length] in *; try discriminate; constructor;
    apply andb_prop in H as [H1 H2].
  - exact (accepted_part c r p w HP HK H1).
  - apply (IH ws); [lia | exact H2].
Qed.
Lemma sound_if_accepted : forall c r of_P of_parts, accepts c r of_P of_parts = true -> sound c.
Proof.
  intros c r of_P of_parts H. unfold accepts in H.
  apply andb_prop in H as [H H0]. apply andb_prop in H as [H H1].
  apply andb_prop in H as [H H2]. apply andb_prop in H as [H H3].
  apply Nat.eqb_eq in H1. assert (HP : never_negative (P c)).
  { intros x. pose proof (Forall_inv (accepted_forms _ _ H2) x) as Q. rewrite quad_times in Q.
    apply Rmult_le_reg_l with (IZR (Zpos (eS c))); [apply (IZR_lt 0); lia | lra]. }
  split; [exact H | split; [exact HP | exact (accepted_parts c r HP H3 _ _ H1 H0)]].
Qed.

(* ---------- one hold ---------- *)
Lemma dot_second_unit : forall x w rho, dot (unit_at (S (length x))) (x ++ [w; rho]) = rho.
Proof. unfold unit_at. induction x as [|y x IH]; intros w rho; [simpl; lra|]. simpl in *. rewrite IH. lra. Qed.
Lemma dot_first_unit : forall x w rho, dot (unit_at (length x)) (x ++ [w; rho]) = w.
Proof. unfold unit_at. induction x as [|y x IH]; intros w rho; simpl; [lra | rewrite IH; lra]. Qed.

Section OneHold.
Variable c : loop.
Lemma positives : 0 < IZR (Zpos (eA c)) /\ 0 < IZR (Zpos (eS c)) /\ 0 < IZR (Zpos (eP c)).
Proof. repeat split; apply (IZR_lt 0); lia. Qed.

Lemma corner : forall A C b g, length A = states c -> (length C <= states c)%nat -> (length (E c) <= states c)%nat ->
  upper (states c) (P c) = true -> never_negative (balance c A C b g) ->
  forall u x w rho, length x = states c ->
  storage c (u + w) (step c A x w rho) - storage c u x
  <= (over (k0 c) (eS c) * u + answer c C x) * w + answer c (E c) x * rho + (over b (eS c) * (w * w) + over g (eS c) * (rho * rho)).
Proof.
  intros A C b g HA HC HE HU HM u x w rho L.
  pose proof (HM (x ++ [w; rho])) as D. unfold balance in D.
  rewrite !quad_mix, quad_pull, !quad_cross, !quad_self in D.
  rewrite <- L, dot_first_unit, dot_second_unit, !dot_app in D by lia. rewrite <- L in HU.
  rewrite (quad_app _ x [w; rho] HU) in D.
  rewrite ?minus_IZR, ?mult_IZR, ?minus_IZR, ?mult_IZR in D.
  unfold storage, over, answer, step.
  replace (map (fun r => dot r (x ++ [w; rho]) / IZR (Z.pos (eA c))) A)
    with (map (fun r => r / IZR (Z.pos (eA c))) (image A (x ++ [w; rho]))) by (unfold image; rewrite map_map; reflexivity).
  rewrite quad_scale. destruct positives as (pA & pS & pP).
  set (a := IZR (Z.pos (eA c))) in *. set (s := IZR (Z.pos (eS c))) in *. set (e := IZR (Z.pos (eP c))) in *.
  set (Q := quad (P c) (image A (x ++ [w; rho]))) in *. set (q := quad (P c) x) in *. set (y := dot C x) in *.
  set (f := dot (E c) x) in *. set (k := IZR (k0 c)) in *. set (be := IZR b) in *. set (ga := IZR g) in *.
  match type of D with 0 <= ?X => set (D0 := X) in * end.
  assert (H : (k / s * u + y / s) * w + f / s * rho + (be / s * (w * w) + ga / s * (rho * rho))
       - (k / s * (u + w) * (u + w) / 2 + Q / a / a / e - (k / s * u * u / 2 + q / e)) = D0 / (2 * (a * a * e * s)))
    by (unfold D0; field; repeat split; lra).
  assert (0 <= D0 / (2 * (a * a * e * s))).
  { apply Rmult_le_pos; [exact D | left; apply Rinv_0_lt_compat; repeat apply Rmult_lt_0_compat; lra]. }
  lra.
Qed.

Lemma storage_never_negative : sound c -> forall u x, 0 <= storage c u x.
Proof.
  intros (H & HP & _) u x. unfold shape in H. repeat (apply andb_prop in H; destruct H as [H ?]).
  apply Z.leb_le in H1. destruct positives as (_ & pS & pP). unfold storage, over.
  set (s := IZR (Z.pos (eS c))) in *. set (e := IZR (Z.pos (eP c))) in *.
  assert (pk : 0 <= IZR (k0 c)) by (apply (IZR_le 0); exact H1).
  replace (IZR (k0 c) / s * u * u / 2) with (IZR (k0 c) * (u * u) * / (2 * s)) by (field; lra).
  apply Rplus_le_le_0_compat; apply Rmult_le_pos; try apply Rmult_le_pos; try apply HP; try apply Rle_0_sqr; try lra;
    left; apply Rinv_0_lt_compat; lra.
Qed.

Lemma hold : sound c -> forall p u x w rho t h, In p (parts c) -> length x = states c -> 0 <= t <= 1 -> 0 <= h <= 1 ->
  storage c (u + w) (next c p t x w rho) - storage c u x
    <= force c p h u x * w + answer c (E c) x * rho + (over (beta p) (eS c) * (w * w) + over (gamma p) (eS c) * (rho * rho))
  /\ length (next c p t x w rho) = states c.
Proof.
  intros (H & HP & HM) p u x w rho t h I L T Hh. unfold shape in H. repeat (apply andb_prop in H; destruct H as [H ?]).
  rewrite forallb_forall in H0. specialize (H0 p I). unfold shape_of in H0. repeat (apply andb_prop in H0; destruct H0 as [H0 ?]).
  apply Nat.leb_le in H, H3, H4. apply Nat.eqb_eq in H0, H5.
  rewrite Forall_forall in HM. specialize (HM p I). unfold corners in HM.
  inversion HM as [|? ? M11 R1]; inversion R1 as [|? ? M12 R2]; inversion R2 as [|? ? M21 R3]; inversion R3 as [|? ? M22 R4]; subst.
  assert (S1 : length (step c (A1 p) x w rho) = states c) by (unfold step; rewrite map_length; exact H0).
  assert (S2 : length (step c (A2 p) x w rho) = states c) by (unfold step; rewrite map_length; exact H5).
  split.
  - pose proof (corner _ _ _ _ H0 H4 H H2 M11 u x w rho L) as K11. pose proof (corner _ _ _ _ H0 H3 H H2 M12 u x w rho L) as K12.
    pose proof (corner _ _ _ _ H5 H4 H H2 M21 u x w rho L) as K21. pose proof (corner _ _ _ _ H5 H3 H H2 M22 u x w rho L) as K22.
    pose proof (convex (P c) t _ _ (eq_trans S1 (eq_sym S2)) HP T) as V.
    destruct positives as (_ & _ & pP). fold (next c p t x w rho) in V.
    assert (V2 : storage c (u + w) (next c p t x w rho)
            <= (1 - t) * storage c (u + w) (step c (A1 p) x w rho) + t * storage c (u + w) (step c (A2 p) x w rho)).
    { unfold storage. set (e := IZR (Z.pos (eP c))) in *.
      assert (I2 : 0 < / e) by (apply Rinv_0_lt_compat; exact pP).
      pose proof (Rmult_le_compat_r _ _ _ (Rlt_le _ _ I2) V) as V3. unfold Rdiv. lra. }
    unfold force.
    set (v1 := storage c (u + w) (step c (A1 p) x w rho)) in *. set (v2 := storage c (u + w) (step c (A2 p) x w rho)) in *.
    set (v := storage c u x) in *. set (k := over (k0 c) (eS c) * u) in *. set (y1 := answer c (C1 p) x) in *.
    set (y2 := answer c (C2 p) x) in *. set (r := answer c (E c) x * rho + (over (beta p) (eS c) * (w * w) + over (gamma p) (eS c) * (rho * rho))) in *.
    assert (Q1 : v1 - v <= (k + ((1 - h) * y1 + h * y2)) * w + r).
    { pose proof (Rmult_le_compat_l (1 - h) _ _ ltac:(lra) K11). pose proof (Rmult_le_compat_l h _ _ ltac:(lra) K12). unfold r in *. lra. }
    assert (Q2 : v2 - v <= (k + ((1 - h) * y1 + h * y2)) * w + r).
    { pose proof (Rmult_le_compat_l (1 - h) _ _ ltac:(lra) K21). pose proof (Rmult_le_compat_l h _ _ ltac:(lra) K22). unfold r in *. lra. }
    pose proof (Rmult_le_compat_l (1 - t) _ _ ltac:(lra) Q1). pose proof (Rmult_le_compat_l t _ _ ltac:(lra) Q2). unfold r in *. lra.
  - unfold next. rewrite on_line_length; congruence.
Qed.
End OneHold.

(* ---------- any number of holds ---------- *)
Record motion := { in_part : part; between_A : R; between_C : R; w : R; rho : R; dissipated : R }.
Definition is_motion (c : loop) (h : motion) : Prop :=
  In (in_part h) (parts c) /\ 0 <= between_A h <= 1 /\ 0 <= between_C h <= 1 /\
  over (beta (in_part h)) (eS c) * (w h * w h) + over (gamma (in_part h)) (eS c) * (rho h * rho h) <= dissipated h.
Definition after (c : loop) (x : list R) (h : motion) := next c (in_part h) (between_A h) x (w h) (rho h).
(* what the tool puts in *)
Fixpoint work (c : loop) (u : R) (x : list R) (holds : list motion) : R :=
  match holds with
  | [] => 0
  | h :: rest => force c (in_part h) (between_C h) u x * w h + answer c (E c) x * rho h + dissipated h
                 + work c (u + w h) (after c x h) rest
  end.
Fixpoint at_end (c : loop) (u : R) (x : list R) (holds : list motion) : R :=
  match holds with [] => storage c u x | h :: rest => at_end c (u + w h) (after c x h) rest end.

Theorem passive : forall c, sound c -> forall holds u x, length x = states c -> Forall (is_motion c) holds ->
  at_end c u x holds - storage c u x <= work c u x holds /\ 0 <= at_end c u x holds.
Proof.
  intros c H. induction holds as [|h rest IH]; intros u x L F; cbn [work at_end].
  - pose proof (storage_never_negative c H u x). lra.
  - inversion F as [|? ? (I & T & K & D) F2]; subst.
    destruct (hold c H (in_part h) u x (w h) (rho h) (between_A h) (between_C h) I L T K) as [V L2].
    destruct (IH (u + w h) (after c x h) L2 F2). unfold after in *. lra.
Qed.

Corollary nothing_is_extracted : forall c, sound c -> forall holds, Forall (is_motion c) holds ->
  0 <= work c 0 (repeat 0 (states c)) holds.
Proof.
  intros c H holds F. destruct (passive c H holds 0 (repeat 0 (states c)) (repeat_length _ _) F) as [V S].
  unfold storage in V. rewrite quad_zeros in V.
  replace (over (k0 c) (eS c) * 0 * 0 / 2 + 0 / IZR (Z.pos (eP c))) with 0 in V by (unfold Rdiv; ring). lra.
Qed.
