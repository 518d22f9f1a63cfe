(* The clamp theorem: a motor that clips. Of a linear law that position alone drives, springs and relaxing modes, it may
   hold phi(M) in place of the force M, for every fixed phi with phi(0) = 0 that nowhere falls and nowhere rises faster
   than M. Nothing is extracted from rest, with the same damping  beta T,  n samples late  beta (1 + 2n) T.

   The states do not know of phi. So the motion u that there is is held against the motion v of which the law without a
   limit makes the clipped forces. Clipped forces do at least the work on u that they do on v (Kaluza's theorem and
   Zames and Falb's multiplier), and on v they do what pays for holding them. *)
Require Import Reals List Lra Lia Sums Slips.
Import ListNotations.
Local Open Scope R_scope.

(* ---------- the law: modes (a, c), springs among them with a = 1; from rest ---------- *)
Definition modes := list (R * R).
Definition are_modes (ms : modes) : Prop := ms <> [] /\ Forall (fun m => 0 <= fst m <= 1 /\ 0 < snd m) ms.
Fixpoint over_modes (ms : modes) (f : R -> R -> R) : R :=
  match ms with (a, c) :: rest => f a c + over_modes rest f | [] => 0 end.
Fixpoint mode_force (a c : R) (u : nat -> R) (k : nat) : R :=
  match k with O => 0 | S j => a * mode_force a c u j + c * u j end.
(* after k holds over which the tool moved by u *)
Definition law_force (ms : modes) (u : nat -> R) (k : nat) : R := over_modes ms (fun a c => mode_force a c u k).
Definition law_beta (ms : modes) : R := over_modes ms (fun a c => c / (1 + a)).
(* The same from the elements of Slips.v. *)
Definition law (ms : modes) : element := all_of (map (fun m => relaxing (fst m) (snd m)) ms).
Fixpoint at_rest (ms : modes) : state (law ms) := match ms with [] => tt | _ :: rest => (0, at_rest rest) end.
Lemma after_beside : forall e f s t u k, after (beside e f) (s, t) u k = (after e s u k, after f t u k).
Proof. induction k as [|k IH]; cbn [after]; [reflexivity | rewrite IH; reflexivity]. Qed.
Lemma forces_of_law : forall ms u k, forces (law ms) (at_rest ms) u k = law_force ms u k.
Proof.
  intros ms u k. unfold forces. induction ms as [|[a c] ms IH]; [reflexivity|].
  change (law ((a, c) :: ms)) with (beside (relaxing a c) (law ms)).
  change (at_rest ((a, c) :: ms)) with ((0, at_rest ms) : state (beside (relaxing a c) (law ms))).
  rewrite after_beside. cbn [beside force fst snd]. rewrite IH. unfold law_force. cbn [over_modes]. f_equal.
  clear. induction k as [|k IH]; [reflexivity|]. cbn in *. rewrite IH. reflexivity.
Qed.
Lemma beta_of_law : forall ms, beta (law ms) = law_beta ms.
Proof. induction ms as [|[a c] ms IH]; cbn; [|unfold law, all_of, law_beta in *; rewrite <- IH]; reflexivity. Qed.
Lemma memory_at_rest : forall ms, memory (law ms) (at_rest ms) = 0.
Proof. induction ms as [|[a c] ms IH]; cbn; [reflexivity|]. unfold law, all_of in IH. rewrite IH. ring. Qed.
Lemma law_holds : forall ms, are_modes ms -> holds (law ms) /\ follows (law ms) /\ occurs (law ms) (at_rest ms).
Proof.
  intros ms [_ P]. split; [|split].
  - apply all_hold. induction P as [|[a c] ms [A C] _ IH]; constructor; [apply relaxing_holds; assumption | exact IH].
  - apply all_follow.
    induction P as [|[a c] ms [A C] _ IH]; constructor; [apply relaxing_follows; assumption | exact IH].
  - clear. induction ms as [|[a c] ms IH]; cbn; [exact I | split; [exact I | exact IH]].
Qed.

(* ---------- sums over modes ---------- *)
Lemma over_modes_ext : forall ms f g, (forall a c, In (a, c) ms -> f a c = g a c) -> over_modes ms f = over_modes ms g.
Proof.
  induction ms as [|[a c] ms IH]; intros f g H; cbn; [reflexivity|].
  f_equal; [apply H; left | apply IH; intros; apply H; right]; auto.
Qed.
Lemma over_modes_linear : forall ms p f q g,
  over_modes ms (fun a c => p * f a c + q * g a c) = p * over_modes ms f + q * over_modes ms g.
Proof. induction ms as [|[a c] ms IH]; intros; cbn; [lra|]. rewrite IH. ring. Qed.
Lemma over_modes_sum : forall ms n f,
  over_modes ms (fun a c => sum n (f a c)) = sum n (fun k => over_modes ms (fun a c => f a c k)).
Proof.
  induction ms as [|[a c] ms IH]; intros; cbn [over_modes]; [rewrite sum_zero; reflexivity|].
  rewrite IH, <- sum_plus. reflexivity.
Qed.
Lemma over_modes_le : forall ms f g, (forall a c, In (a, c) ms -> f a c <= g a c) -> over_modes ms f <= over_modes ms g.
Proof.
  induction ms as [|[a c] ms IH]; intros f g H; cbn; [lra|].
  apply Rplus_le_compat; [apply H; left | apply IH; intros; apply H; right]; auto.
Qed.
Lemma over_modes_not_negative : forall ms f, (forall a c, In (a, c) ms -> 0 <= f a c) -> 0 <= over_modes ms f.
Proof.
  induction ms as [|[a c] ms IH]; intros f H; cbn; [lra|].
  apply Rplus_le_le_0_compat; [apply H; left | apply IH; intros; apply H; right]; auto.
Qed.
Lemma over_modes_positive : forall ms f, ms <> [] -> (forall a c, In (a, c) ms -> 0 < f a c) -> 0 < over_modes ms f.
Proof.
  intros [|[a c] ms] f N H; [contradiction|]. cbn. pose proof (H a c (or_introl eq_refl)).
  assert (0 <= over_modes ms f) by (apply over_modes_not_negative; intros; left; apply H; right; assumption). lra.
Qed.

(* ---------- the law's forces ---------- *)
Lemma law_force_ext : forall ms u v n, (forall k, (k < n)%nat -> u k = v k) -> law_force ms u n = law_force ms v n.
Proof.
  intros ms u v n H. apply over_modes_ext. intros a c _.
  induction n as [|n IH]; cbn; [reflexivity|]. rewrite IH, H; auto with arith.
Qed.
Lemma law_force_linear : forall ms p u q v n,
  law_force ms (fun k => p * u k + q * v k) n = p * law_force ms u n + q * law_force ms v n.
Proof.
  intros. unfold law_force. rewrite <- over_modes_linear. apply over_modes_ext. intros a c _.
  induction n as [|n IH]; cbn; [ring|]. rewrite IH. ring.
Qed.
Lemma law_force_rest : forall ms u, law_force ms u 0 = 0.
Proof.
  intros. unfold law_force. cbn [mode_force]. induction ms as [|[a c] ms IH]; cbn; [reflexivity | rewrite IH; ring].
Qed.
Lemma law_force_accumulated : forall ms u n, law_force ms (fun k => sum (S k) u) n = sum (S n) (law_force ms u).
Proof.
  intros ms u n. unfold law_force. rewrite <- over_modes_sum. apply over_modes_ext. intros a c _.
  induction n as [|n IH]; [cbn; ring|].
  change (mode_force a c (fun k => sum (S k) u) (S n))
    with (a * mode_force a c (fun k => sum (S k) u) n + c * sum (S n) u).
  rewrite IH, (sum_first (S n)), <- !sum_times, <- sum_plus. cbn [mode_force]. rewrite Rplus_0_l. reflexivity.
Qed.
(* Any forces are those of some motion. *)
Lemma motion_of_forces : forall ms f, are_modes ms -> f O = 0 ->
  forall N, exists v, forall k, (k <= N)%nat -> law_force ms v k = f k.
Proof.
  intros ms f [NE P] F0. assert (G : 0 < over_modes ms (fun _ c => c)).
  { apply over_modes_positive; [exact NE|]. intros a c I. rewrite Forall_forall in P. apply (P _ I). }
  induction N as [|N [v IH]].
  - exists (fun _ => 0). intros k L. replace k with O by lia. rewrite law_force_rest, F0. reflexivity.
  - set (left := over_modes ms (fun a c => a * mode_force a c v N)). set (g := over_modes ms (fun _ c => c)) in *.
    set (next := (f (S N) - left) / g). set (longer := fun k => if Nat.eqb k N then next else v k).
    assert (same : forall j, (j < N)%nat -> longer j = v j).
    { intros j Lj. unfold longer. destruct (Nat.eqb_spec j N); [lia | reflexivity]. }
    exists longer. intros k L. destruct (Nat.eq_dec k (S N)) as [->|D].
    + assert (E : forall a c, mode_force a c longer N = mode_force a c v N).
      { intros a c. enough (H : forall m, (m <= N)%nat -> mode_force a c longer m = mode_force a c v m) by auto.
        induction m as [|m IHm]; intros Lm; cbn; [reflexivity|]. rewrite IHm, same by lia. reflexivity. }
      unfold law_force. cbn [mode_force].
      rewrite (over_modes_ext ms _ (fun a c => 1 * (a * mode_force a c v N) + next * c))
        by (intros; rewrite E; unfold longer; rewrite Nat.eqb_refl; ring).
      rewrite over_modes_linear. fold left g. unfold next. field. lra.
    + rewrite <- (IH k) by lia. apply law_force_ext. intros j Lj. apply same. lia.
Qed.

(* ---------- Kaluza ---------- *)
(* What is left after k samples of the force of one displacement. *)
Definition left_of (ms : modes) (k : nat) : R := over_modes ms (fun a c => c * a ^ k).
Lemma law_force_is_a_sum : forall ms u n, law_force ms u n = sum n (fun i => left_of ms (n - S i) * u i).
Proof.
  intros ms u n. unfold law_force, left_of.
  assert (E : forall a c, mode_force a c u n = sum n (fun i => c * a ^ (n - S i) * u i)).
  { intros a c. induction n as [|n IH]; [reflexivity|]. cbn [mode_force sum]. rewrite IH, <- sum_times.
    rewrite Nat.sub_diag, (sum_ext n _ (fun i => c * a ^ (S n - S i) * u i)); [cbn; ring|].
    intros k L. replace (S n - S k)%nat with (S (n - S k)) by lia. cbn. ring. }
  rewrite (over_modes_ext ms _ _ (fun a c _ => E a c)), over_modes_sum. apply sum_ext. intros k _.
  rewrite Rmult_comm, <- (Rplus_0_r (u k * _)), <- (Rmult_0_l (over_modes ms (fun _ _ => 0))), <- over_modes_linear.
  apply over_modes_ext. intros. ring.
Qed.

Section Kaluza.
Variable h : nat -> R.
Hypotheses (h_positive : forall n, 0 < h n) (h_falls : forall n, h (S n) <= h n)
  (h_log_convex : forall n, h (S n) * h (S n) <= h n * h (S (S n))).
Lemma ratios_rise : forall j n, h (S j) * h (n + j)%nat <= h j * h (S (n + j)).
Proof.
  induction n as [|n IH]; cbn [plus]; [lra|]. pose proof (h_log_convex (n + j)) as C.
  apply Rmult_le_reg_r with (1 := h_positive (n + j)).
  apply Rle_trans with (h j * (h (S (n + j)) * h (S (n + j)))).
  - pose proof (Rmult_le_compat_r _ _ _ (Rlt_le _ _ (h_positive (S (n + j)))) IH). lra.
  - pose proof (Rmult_le_compat_l _ _ _ (Rlt_le _ _ (h_positive j)) C). lra.
Qed.
(* 1/h is h0^-1 (1 - sum of p_i z^-(i+1)) with p >= 0 and sum of p <= 1. *)
Lemma inverse : forall n, exists p, (forall i, 0 <= p i) /\
  (forall m, (m < n)%nat -> sum (S m) (fun i => p i * h (m - i)%nat) = h (S m)) /\ sum n p <= 1.
Proof.
  enough (W : forall n, exists p, (forall i, 0 <= p i) /\
    (forall m, (m < n)%nat -> sum (S m) (fun i => p i * h (m - i)%nat) = h (S m))).
  { intros n. destruct (W n) as (p & P & E). exists p. split; [exact P | split; [exact E|]].
    destruct n as [|n]; [cbn; lra|]. specialize (E n ltac:(lia)).
    assert (mono : forall i j, (i <= j)%nat -> h j <= h i).
    { intros i j L. induction L as [|j L IH]; [lra|]. pose proof (h_falls j). lra. }
    apply Rmult_le_reg_l with (1 := h_positive (S n)). rewrite Rmult_1_r. apply Rle_trans with (2 := Req_le _ _ E).
    rewrite <- sum_times. apply sum_le.
    intros k L. rewrite Rmult_comm. apply Rmult_le_compat_l; [apply P | apply mono; lia]. }
  induction n as [|n (p & P & E)]; [exists (fun _ => 0); split; [intros; lra | intros; lia]|].
  set (new := (h (S n) - sum n (fun i => p i * h (n - i)%nat)) / h O).
  exists (fun i => if Nat.eqb i n then new else p i). split.
  - intros i. destruct (Nat.eqb_spec i n) as [->|D]; [|apply P]. unfold new.
    apply Rmult_le_pos; [|left; apply Rinv_0_lt_compat, h_positive].
    destruct n as [|n]; [cbn; pose proof (h_positive 1); lra|].
    apply Rmult_le_reg_l with (1 := h_positive (S n)). rewrite Rmult_0_r, Rmult_minus_distr_l.
    rewrite <- (E n) at 1 by lia. rewrite Rmult_comm, <- !sum_times.
    enough (sum (S n) (fun k => h (S n) * (p k * h (S n - k)%nat))
            <= sum (S n) (fun k => h (S (S n)) * (p k * h (n - k)%nat))) by lra.
    apply sum_le. intros k L. pose proof (ratios_rise (n - k) (S k)) as R.
    replace (S k + (n - k))%nat with (S n) in R by lia. replace (S n - k)%nat with (S (n - k)) by lia.
    pose proof (Rmult_le_compat_l _ _ _ (P k) R). lra.
  - intros m L. cbn [sum]. rewrite (sum_ext m _ (fun i => p i * h (m - i)%nat)).
    + destruct (Nat.eqb_spec m n) as [->|D].
      * rewrite Nat.sub_diag. unfold new. field. pose proof (h_positive 0). lra.
      * rewrite <- (E m) by lia. reflexivity.
    + intros k Lk. destruct (Nat.eqb_spec k n); [lia | reflexivity].
Qed.
Lemma largest_was_pushed : forall x n (X := fun k => sum k (fun i => h (k - S i)%nat * x i)),
  (forall k, (k <= n)%nat -> X k <= X (S n)) -> 0 <= x n.
Proof.
  intros x n X H. destruct (inverse n) as (p & P & E & One).
  assert (K : h O * x n = X (S n) - sum n (fun i => p i * X (n - i)%nat)).
  { unfold X. cbn [sum]. rewrite Nat.sub_diag.
    enough (T : sum n (fun i => p i * sum (n - i) (fun l => h (n - i - S l)%nat * x l))
                = sum n (fun l => h (S n - S l)%nat * x l)) by (rewrite T; ring).
    rewrite (sum_ext n _ (fun i => sum (n - i) (fun l => p i * (h (n - i - S l)%nat * x l))))
      by (intros; rewrite sum_times; reflexivity).
    rewrite (sum_triangle n (fun i l => p i * (h (n - i - S l)%nat * x l))). apply sum_ext. intros l L.
    replace (S n - S l)%nat with (S (n - S l)) by lia. rewrite <- (E (n - S l)%nat) by lia.
    replace (S (n - S l)) with (n - l)%nat by lia. rewrite Rmult_comm, <- sum_times. apply sum_ext. intros i Li.
    replace (n - i - S l)%nat with (n - S l - i)%nat by lia. ring. }
  assert (X0 : 0 <= X (S n)) by (apply (H O); lia).
  assert (sum n (fun i => p i * X (n - i)%nat) <= X (S n) * sum n p).
  { rewrite <- sum_times. apply sum_le. intros i L. rewrite (Rmult_comm (X (S n))).
    apply Rmult_le_compat_l; [apply P | apply H; lia]. }
  pose proof (Rmult_le_compat_l _ _ _ X0 One). apply Rmult_le_reg_l with (1 := h_positive 0). lra.
Qed.
End Kaluza.

Lemma left_of_law : forall ms, are_modes ms -> 0 < left_of ms 1 ->
  (forall n, 0 < left_of ms n) /\ (forall n, left_of ms (S n) <= left_of ms n) /\
  (forall n, left_of ms (S n) * left_of ms (S n) <= left_of ms n * left_of ms (S (S n))).
Proof.
  intros ms [NE P] Z. rewrite Forall_forall in P.
  assert (A : forall a c n, In (a, c) ms -> 0 <= a <= 1 /\ 0 <= a ^ n /\ 0 <= c * a ^ n).
  { intros a c n I. destruct (P _ I) as [A C]. cbn in A, C. pose proof (pow_le a n ltac:(lra)).
    split; [exact A | split; [|apply Rmult_le_pos]]; lra. }
  assert (C : forall n, 0 < left_of ms n -> left_of ms (S n) * left_of ms (S n) <= left_of ms n * left_of ms (S (S n))).
  { intros n N. set (x := left_of ms (S n)). set (y := left_of ms n).
    assert (Q : 0 <= over_modes ms (fun a c =>
      1 * (x * x * (c * a ^ n) + -2 * x * y * (c * a ^ S n)) + y * y * (c * a ^ S (S n)))).
    { apply over_modes_not_negative. intros a c I. destruct (A a c n I) as (_ & _ & K).
      pose proof (Rmult_le_pos _ _ K (Rle_0_sqr (x - a * y))) as Q. unfold Rsqr in Q. cbn [pow]. lra. }
    rewrite !over_modes_linear in Q. fold (left_of ms n) (left_of ms (S n)) (left_of ms (S (S n))) in Q. fold x y in Q.
    apply Rmult_le_reg_l with (1 := N). fold y. lra. }
  assert (L : forall n, 0 < left_of ms n /\ 0 < left_of ms (S n)).
  { induction n as [|n [N N2]].
    - split; [|exact Z]. apply over_modes_positive; [exact NE|]. intros a c I. destruct (P _ I). cbn in *. lra.
    - split; [exact N2|]. pose proof (C n N) as D. pose proof (Rmult_lt_0_compat _ _ N2 N2).
      apply Rmult_lt_reg_l with (1 := N). lra. }
  split; [apply L | split; [|intros; apply C, L]].
  intros n. apply over_modes_le. intros a c I. destruct (A a c n I) as (U & _ & K). cbn [pow].
  pose proof (Rmult_le_compat_l _ _ _ K (proj2 U)). lra.
Qed.
(* A force of the law that is larger than all before, the one of rest among them, comes from a push. *)
Lemma largest_comes_from_a_push : forall ms u n, are_modes ms ->
  (forall k, (k <= n)%nat -> law_force ms u k <= law_force ms u (S n)) -> 0 <= u n.
Proof.
  intros ms u n M H. destruct (Rlt_le_dec 0 (left_of ms 1)) as [Z|Z].
  { destruct (left_of_law ms M Z) as (A & B & C). apply (largest_was_pushed (left_of ms) A B C).
    intros k L. rewrite <- !law_force_is_a_sum. apply H. exact L. }
  (* Of modes that vanish within a sample nothing is left. *)
  destruct M as [NE P]. rewrite Forall_forall in P.
  assert (A : forall a c, In (a, c) ms -> a = 0).
  { intros a c I. destruct (Req_dec a 0) as [E|E]; [exact E|]. exfalso. destruct (P _ I) as [A C]. cbn in A, C.
    enough (0 < left_of ms 1) by lra. clear - P I A C E. unfold left_of.
    induction ms as [|[b d] ms IH]; [contradiction|].
    cbn [over_modes]. assert (K : forall a c, In (a, c) ((b, d) :: ms) -> 0 <= c * a ^ 1).
    { intros a2 c2 I2. destruct (P _ I2) as [A2 C2]. cbn in A2, C2. rewrite pow_1. apply Rmult_le_pos; lra. }
    destruct I as [I|I].
    - injection I as -> ->. pose proof (over_modes_not_negative ms _ (fun a c I => K a c (or_intror I))).
      assert (0 < c * a ^ 1) by (rewrite pow_1; apply Rmult_lt_0_compat; lra). lra.
    - pose proof (IH ltac:(intros; apply P; right; assumption) I). pose proof (K b d (or_introl eq_refl)). lra. }
  specialize (H O ltac:(lia)). rewrite law_force_rest in H. unfold law_force in H. cbn [mode_force] in H.
  rewrite (over_modes_ext ms _ (fun _ c => u n * c + 0 * c)), over_modes_linear in H
    by (intros a c I; rewrite (A a c I); ring).
  assert (G : 0 < over_modes ms (fun _ c => c)).
  { apply over_modes_positive; [exact NE | intros a c I; apply (P _ I)]. }
  apply Rmult_le_reg_r with (1 := G). lra.
Qed.

(* ---------- what is clipped ---------- *)
Definition clips (phi : R -> R) : Prop := phi 0 = 0 /\ forall x y, x <= y -> 0 <= phi y - phi x <= y - x.
Lemma clips_at_limit : forall limit, 0 <= limit -> clips (cut limit).
Proof.
  intros l L. unfold clips, cut, Rmax, Rmin.
  split; [destruct (Rle_dec l 0) | intros x y H; destruct (Rle_dec l x), (Rle_dec l y)];
    repeat (match goal with |- context [Rle_dec (- l) ?q] => destruct (Rle_dec (- l) q) end); lra.
Qed.

Fixpoint falls (v : list R) : Prop :=
  match v with x :: rest => (forall y, In y rest -> y <= x) /\ falls rest | [] => True end.
Lemma sorted_in : forall v x, falls v -> exists s, falls s /\ forall y, In y s <-> y = x \/ In y v.
Proof.
  induction v as [|t v IH]; intros x F.
  - exists [x]. split; [cbn; tauto|]. intros y. cbn. intuition congruence.
  - destruct F as [B F]. destruct (Rle_lt_dec t x) as [L|L].
    + exists (x :: t :: v). split; [|intros y; cbn; intuition congruence]. split; [|split; assumption].
      intros y [->|I]; [exact L | pose proof (B y I); lra].
    + destruct (IH x F) as (s & Fs & I). exists (t :: s). split.
      * split; [|exact Fs]. intros y Iy. apply I in Iy as [->|Iy]; [lra | exact (B y Iy)].
      * intros y. cbn. rewrite I. intuition congruence.
Qed.
Lemma sorted : forall v, exists s, falls s /\ forall y, In y v -> In y s.
Proof.
  induction v as [|x v (s & F & I)]; [exists []; cbn; tauto|]. destruct (sorted_in s x F) as (s2 & F2 & I2).
  exists s2. split; [exact F2|]. intros y [->|Iy]; apply I2; auto.
Qed.
(* phi and what it takes away rise together: between any of finitely many forces it has a potential. *)
Lemma potential_of_sorted : forall phi, clips phi -> forall s, falls s -> exists Phi, forall x y, In x s -> In y s ->
  Phi x - Phi y <= phi x * ((x - phi x) - (y - phi y)).
Proof.
  intros phi [Z C]. induction s as [|x s IH]; intros F; [exists (fun _ => 0); cbn; tauto|].
  destruct F as [B F]. destruct (IH F) as [Phi H]. destruct s as [|t s].
  { exists (fun _ => 0). intros y z [<-|[]] [<-|[]]. lra. }
  set (new := Phi t + phi t * ((x - phi x) - (t - phi t))).
  exists (fun y => if Req_EM_T y x then new else Phi y).
  assert (T : In t (t :: s)) by (left; reflexivity).
  pose proof (C t x (B t T)) as Ct.
  intros y z Iy Iz. destruct (Req_EM_T y x) as [->|Dy]; destruct (Req_EM_T z x) as [->|Dz].
  - lra.
  - destruct Iz as [E|Iz]; [congruence|]. pose proof (H t z T Iz) as Htz. pose proof (C z x (B z Iz)) as Cz.
    assert (0 <= (phi x - phi t) * ((x - phi x) - (z - phi z))) by (apply Rmult_le_pos; lra). unfold new. lra.
  - destruct Iy as [E|Iy]; [congruence|]. pose proof (H y t Iy T) as Hyt.
    assert (Ly : y <= t) by (destruct Iy as [<-|Iy]; [lra | apply F; exact Iy]). pose proof (C y t Ly) as Cy.
    assert (0 <= (phi t - phi y) * ((x - phi x) - (t - phi t))) by (apply Rmult_le_pos; lra). unfold new. lra.
  - destruct Iy as [E|Iy]; [congruence|]. destruct Iz as [E|Iz]; [congruence|]. exact (H y z Iy Iz).
Qed.
Lemma potential : forall phi v, clips phi -> exists Phi, Phi 0 = 0 /\ (forall x, In x v -> 0 <= Phi x) /\
  forall x y, In x v -> In y v -> Phi x - Phi y <= phi x * ((x - phi x) - (y - phi y)).
Proof.
  intros phi v C. destruct (sorted (0 :: v)) as (s & F & I). destruct (potential_of_sorted phi C s F) as [Phi H].
  exists (fun x => Phi x - Phi 0). split; [lra | split].
  - intros x Ix. pose proof (H 0 x (I 0 (or_introl eq_refl)) (I x (or_intror Ix))) as L.
    destruct C as [Z _]. rewrite Z in L. lra.
  - intros x y Ix Iy. pose proof (H x y (I x (or_intror Ix)) (I y (or_intror Iy))). lra.
Qed.

(* ---------- the theorem ---------- *)
Section Clamp.
Variables (ms : modes) (phi : R -> R) (u : nat -> R).
Hypotheses (M : are_modes ms) (C : clips phi).
Definition held (k : nat) : R := phi (law_force ms u k).

(* Zames and Falb: clipped forces do at least the work on the motion that there is that they do on their own. *)
Lemma clipped_work : forall N v, (forall k, (k <= N)%nat -> law_force ms v k = held k) ->
  sum N (fun k => held (S k) * v k) <= sum N (fun k => held (S k) * u k).
Proof.
  intros N v V.
  destruct (potential phi (map (law_force ms u) (seq 0 (S N))) C) as (Phi & Phi0 & Pos & H).
  assert (I : forall k, (k <= N)%nat -> In (law_force ms u k) (map (law_force ms u) (seq 0 (S N)))).
  { intros k L. apply in_map, in_seq. lia. }
  destruct (motion_of_forces ms (fun k => Phi (law_force ms u k)) M) with (N := N) as [z Z].
  { rewrite law_force_rest. exact Phi0. }
  assert (A : forall k, (k < N)%nat -> z k <= held (S k) * (u k - v k)).
  { intros k L. enough (0 <= held (S k) * (u k - v k) - z k) by lra.
    pose (x := fun j => held (S k) * (1 * u j + -1 * v j) + -1 * z j).
    assert (X : forall j, (j <= N)%nat ->
      law_force ms x j = held (S k) * (law_force ms u j - held j) - Phi (law_force ms u j)).
    { intros j Lj. unfold x. rewrite law_force_linear, law_force_linear, V, Z by exact Lj. ring. }
    enough (0 <= x k) by (unfold x in *; lra). apply (largest_comes_from_a_push ms x k M).
    intros j Lj. rewrite !X by lia. pose proof (H _ _ (I (S k) ltac:(lia)) (I j ltac:(lia))). unfold held in *. lra. }
  assert (B : 0 <= sum N z).
  { destruct N as [|N]; [cbn; lra|]. change (0 <= (fun k => sum (S k) z) N). apply (largest_comes_from_a_push ms _ N M).
    intros k L. rewrite !law_force_accumulated. apply sum_monotone; [lia|].
    intros j Lj. rewrite Z by lia. apply Pos, I. lia. }
  assert (D : sum N z <= sum N (fun k => held (S k) * u k + -1 * (held (S k) * v k))).
  { apply sum_le. intros k L. pose proof (A k L). lra. }
  rewrite sum_plus, sum_times in D. lra.
Qed.

(* Of its own motion v the law takes in what pays for holding its forces over any other motion u. *)
Lemma own_work : forall v N, 0 <= sum N (fun k =>
  law_force ms v (S k) * v k - (law_force ms v (S k) - law_force ms v k) * u k + law_beta ms * (u k * u k)).
Proof.
  intros v N. destruct M as [_ P]. rewrite Forall_forall in P.
  pose (paid := fun a c k => mode_force a c v (S k) * v k - (mode_force a c v (S k) - mode_force a c v k) * u k
                             + c / (1 + a) * (u k * u k)).
  rewrite (sum_ext N _ (fun k => over_modes ms (fun a c => paid a c k))).
  2: { intros k _. unfold law_force, law_beta, paid. clear.
       induction ms as [|[a c] rest IH]; cbn [over_modes]; [ring|]. rewrite <- IH. ring. }
  rewrite <- (over_modes_sum ms N paid). apply over_modes_not_negative.
  intros a c I. destruct (P _ I) as [A K]. cbn [fst snd] in A, K.
  assert (I2 : 0 < / (2 * c)) by (apply Rinv_0_lt_compat; lra).
  enough (E : forall n, mode_force a c v n * mode_force a c v n / (2 * c) <= sum n (paid a c)).
  { apply Rle_trans with (2 := E N). apply Rmult_le_pos; [apply Rle_0_sqr | lra]. }
  induction n as [|n IH]; [cbn; unfold Rdiv; lra|]. cbn [sum]. unfold paid at 2. cbn [mode_force].
  set (F := mode_force a c v n) in *. set (G := a * F + c * v n). set (x := u n).
  set (d := x - (1 + a) / (2 * c) * (G - F)).
  assert (E : G * v n - (G - F) * x + c / (1 + a) * (x * x) - (G * G / (2 * c) - F * F / (2 * c))
    = (1 - a) / (4 * c) * ((G + F) * (G + F)) + c / (1 + a) * (d * d)) by (unfold d, G; field; lra).
  assert (0 <= (1 - a) / (4 * c)) by (apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra]).
  assert (0 <= c / (1 + a)) by (apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra]).
  assert (0 <= (1 - a) / (4 * c) * ((G + F) * (G + F))) by (apply Rmult_le_pos; [assumption | apply Rle_0_sqr]).
  assert (0 <= c / (1 + a) * (d * d)) by (apply Rmult_le_pos; [assumption | apply Rle_0_sqr]). lra.
Qed.

Lemma held_at_rest : held 0 = 0.
Proof. unfold held. rewrite law_force_rest. apply C. Qed.
Lemma clipped_prompt : forall N, 0 <= sum N (fun k => held k * u k + law_beta ms * (u k * u k)).
Proof.
  intros N. destruct (motion_of_forces ms held M held_at_rest N) as [v V].
  pose proof (own_work v N) as W. pose proof (clipped_work N v V) as Z.
  rewrite (sum_ext N _ (fun k => held (S k) * v k
      + (-1 * (held (S k) * u k) + (held k * u k + law_beta ms * (u k * u k))))) in W
    by (intros k L; rewrite !V by lia; ring).
  rewrite sum_plus, (sum_plus N (fun k => -1 * _)), sum_times in W. lra.
Qed.
Lemma clipped_follows : forall t N,
  sum N (fun k => t k * (held (S k) - held k)) <= sum N (fun k => law_beta ms * (u k * u k + t k * t k)) + 0.
Proof.
  intros t N. pose (D := fun k => law_force ms u (S k) - law_force ms u k).
  pose (s := fun k => if Rle_lt_dec 0 (D k) then Rabs (t k) else - Rabs (t k)).
  assert (A : forall k, t k * (held (S k) - held k) <= s k * D k).
  { intros k. destruct C as [_ L]. unfold s, held, D. pose proof (Rle_abs (t k)). pose proof (Rle_abs (- t k)) as O.
    rewrite Rabs_Ropp in O. destruct (Rle_lt_dec 0 (law_force ms u (S k) - law_force ms u k)) as [G|G].
    - pose proof (L (law_force ms u k) (law_force ms u (S k)) ltac:(lra)). nra.
    - pose proof (L (law_force ms u (S k)) (law_force ms u k) ltac:(lra)). nra. }
  destruct (law_holds ms M) as (H & F & O). pose proof (following (law ms) (at_rest ms) u H O F s N) as B.
  rewrite beta_of_law, memory_at_rest in B.
  apply Rle_trans with (sum N (fun k => s k * D k)); [apply sum_le; intros; apply A|].
  rewrite (sum_ext N (fun k => law_beta ms * (u k * u k + t k * t k)) (fun k => law_beta ms * (u k * u k + s k * s k))).
  - apply Rle_trans with (2 := B). apply sum_le. intros k _. rewrite !forces_of_law. apply Rle_refl.
  - intros k _. unfold s. destruct (Rle_lt_dec 0 (D k)); rewrite ?Rmult_opp_opp, <- Rabs_mult, Rabs_pos_eq;
      try apply Rle_0_sqr; reflexivity.
Qed.
End Clamp.

(* The motor holds phi of the forces of the law, those of n samples before. *)
Theorem nothing_is_extracted_from_a_clipped_force : forall ms phi n b longest, are_modes ms -> clips phi ->
  beta (law ms) * (1 + 2 * INR n) * longest <= b ->
  forall motions, (forall k, is_motion b longest (motions k)) ->
  forall N, 0 <= work (fun k => phi (forces (law ms) (at_rest ms) (displacements motions) k)) motions n N.
Proof.
  intros ms phi n b longest M C B motions D N. set (u := displacements motions).
  assert (P : 0 <= law_beta ms) by (rewrite <- beta_of_law; apply (law_holds ms M)).
  rewrite beta_of_law in B.
  pose proof (late (held ms phi u) u (law_beta ms) 0 0 P (clipped_follows ms phi u M C)
    ltac:(intros m; rewrite Ropp_0; apply clipped_prompt; assumption) n N) as L.
  rewrite Rmult_0_r, Rplus_0_r, Ropp_0 in L. apply Rle_trans with (1 := L). apply sum_le. intros k _.
  rewrite forces_of_law. unfold held. pose proof (pos_INR n).
  assert (P2 : 0 <= law_beta ms * (1 + 2 * INR n)) by (apply Rmult_le_pos; lra).
  pose proof (motion_pays _ _ _ _ P2 B (D k)). unfold u, displacements at 2 3 4. lra.
Qed.
