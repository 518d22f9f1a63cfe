(* What a hold of a sampled loop costs a tool that moves as it likes, from integrals over the hold.

   The tool moves with the velocity v, continuous over the hold [0, T]. A damper b dissipates b v^2. Whatever the motion:
   - the displacement w costs at least b w^2 / T (Cauchy and Schwarz);
   - behind an amplifier's first-order lag the motor's force is  y + e exp(-s/tau). Its work is  y w + e (p w + rho)  with
     p the mean of exp(-s/tau) and rho the integral of (exp(-s/tau) - p) v, and w and rho together cost at least
     b (w^2 / T + rho^2 / (kappa T)), kappa the variance of exp(-s/tau). *)
Require Import Reals Lra.
Set Warnings "-ambiguous-paths".
From Coquelicot Require Import Coquelicot.
Local Open Scope R_scope.

Definition integral (f : R -> R) (T : R) : R := RInt (V := R_CompleteNormedModule) f 0 T.
Definition is_continuous (f : R -> R) : Prop := forall s, continuous (T := R_UniformSpace) (U := R_UniformSpace) f s.

Lemma integral_ext : forall T f g, (forall s, f s = g s) -> integral f T = integral g T.
Proof. intros T f g H. unfold integral. apply (RInt_ext (V := R_CompleteNormedModule)). intros. apply H. Qed.

Lemma constant_continuous : forall k : R, is_continuous (fun _ => k).
Proof. intros k s. apply (continuous_const (U := R_UniformSpace) (V := R_UniformSpace)). Qed.

Lemma product_continuous : forall f g, is_continuous f -> is_continuous g -> is_continuous (fun s => f s * g s).
Proof. intros f g F G s. apply (continuous_mult (K := R_AbsRing)); [apply F | apply G]. Qed.
Lemma sum_continuous : forall a b f g, is_continuous f -> is_continuous g -> is_continuous (fun s => a * f s + b * g s).
Proof.
  intros a b f g F G s. apply (continuous_plus (K := R_AbsRing) (V := R_NormedModule));
    apply (continuous_mult (K := R_AbsRing)); try apply constant_continuous; [apply F | apply G].
Qed.
Lemma integrable : forall f T, is_continuous f -> ex_RInt (V := R_CompleteNormedModule) f 0 T.
Proof. intros f T H. apply (ex_RInt_continuous (V := R_CompleteNormedModule)). intros s _. exact (H s). Qed.
Lemma integral_sum : forall a b f g T, is_continuous f -> is_continuous g ->
  integral (fun s => a * f s + b * g s) T = a * integral f T + b * integral g T.
Proof.
  intros a b f g T F G. unfold integral.
  rewrite (RInt_plus (V := R_CompleteNormedModule) (fun s => a * f s) (fun s => b * g s));
    try (apply integrable; apply product_continuous; [apply constant_continuous | assumption]).
  apply (f_equal2 Rplus); apply (RInt_scal (V := R_CompleteNormedModule)); apply integrable; assumption.
Qed.
Lemma integral_one : forall T, integral (fun _ => 1) T = T.
Proof. intros T. unfold integral. rewrite RInt_const. unfold scal; simpl. unfold mult; simpl. lra. Qed.
Lemma square_never_negative : forall f T, 0 < T -> is_continuous f -> 0 <= integral (fun s => f s * f s) T.
Proof.
  intros f T P F. unfold integral. apply RInt_ge_0; [lra | apply (integrable (fun s => f s * f s)); apply product_continuous; exact F|].
  intros. apply Rle_0_sqr.
Qed.

Definition displacement (T : R) (v : R -> R) : R := integral v T.

(* For any shape of mean zero and variance kappa over the hold, of which rho is the share in the velocity. *)
Theorem least_dissipation : forall T v shape kappa, 0 < T -> 0 < kappa -> is_continuous v -> is_continuous shape ->
  integral shape T = 0 -> integral (fun s => shape s * shape s) T = kappa * T ->
  let w := displacement T v in
  let rho := integral (fun s => shape s * v s) T in
  w * w / T + rho * rho / (kappa * T) <= integral (fun s => v s * v s) T.
Proof.
  intros T v shape kappa TP KP CV CS mean variance w rho. set (m := w / T). set (n := rho / (kappa * T)).
  pose proof (constant_continuous 1) as C1.
  pose proof (product_continuous _ _ CS CV) as CP. pose proof (product_continuous _ _ CS CS) as CSS.
  pose proof (product_continuous _ _ CV CV) as CVV.
  pose (g4 := fun s => (2 * m * n) * shape s + (n * n) * (shape s * shape s)).
  assert (G4 : is_continuous g4) by (apply sum_continuous; assumption).
  pose (g3 := fun s => (m * m) * 1 + 1 * g4 s). assert (G3 : is_continuous g3) by (apply sum_continuous; assumption).
  pose (g2 := fun s => (-2 * n) * (shape s * v s) + 1 * g3 s). assert (G2 : is_continuous g2) by (apply sum_continuous; assumption).
  pose (g1 := fun s => (-2 * m) * v s + 1 * g2 s). assert (G1 : is_continuous g1) by (apply sum_continuous; assumption).
  pose (r1 := fun s => (- m) * 1 + (- n) * shape s). assert (R1 : is_continuous r1) by (apply sum_continuous; assumption).
  pose (rest := fun s => 1 * v s + 1 * r1 s). assert (R0 : is_continuous rest) by (apply sum_continuous; assumption).
  pose proof (square_never_negative rest T TP R0) as N.
  rewrite (integral_ext T _ (fun s => 1 * (v s * v s) + 1 * g1 s)) in N by (intros; unfold rest, r1, g1, g2, g3, g4; ring).
  rewrite (integral_sum _ _ (fun s => v s * v s) g1 T CVV G1) in N. unfold g1 in N.
  rewrite (integral_sum _ _ v g2 T CV G2) in N. unfold g2 in N.
  rewrite (integral_sum _ _ (fun s => shape s * v s) g3 T CP G3) in N. unfold g3 in N.
  rewrite (integral_sum _ _ (fun _ => 1) g4 T C1 G4) in N. unfold g4 in N.
  rewrite (integral_sum _ _ shape (fun s => shape s * shape s) T CS CSS) in N.
  rewrite mean, variance, integral_one in N.
  change (integral (fun s => shape s * v s) T) with rho in N. change (integral v T) with w in N.
  set (whole := integral (fun s => v s * v s) T) in *. clearbody whole.
  assert (Ew : m * T = w) by (unfold m; field; lra). assert (Er : n * (kappa * T) = rho) by (unfold n; field; lra).
  replace (w * w / T) with (m * w) by (unfold m; field; lra).
  replace (rho * rho / (kappa * T)) with (n * rho) by (unfold n; field; lra).
  replace (m * m * T) with (m * w) in N by (rewrite <- Ew; ring).
  replace (n * n * (kappa * T)) with (n * rho) in N by (rewrite <- Er; ring). clear - N. lra.
Qed.

(* Without a second input. *)
Theorem least_dissipation_of_displacement : forall T v, 0 < T -> is_continuous v ->
  displacement T v * displacement T v / T <= integral (fun s => v s * v s) T.
Proof.
  intros T v TP CV. set (w := displacement T v). set (m := w / T).
  pose proof (constant_continuous 1) as C1. pose proof (product_continuous _ _ CV CV) as CVV.
  pose (g1 := fun s => (-2 * m) * v s + (m * m) * 1). assert (G1 : is_continuous g1) by (apply sum_continuous; assumption).
  pose (rest := fun s => 1 * v s + (- m) * 1). assert (R0 : is_continuous rest) by (apply sum_continuous; assumption).
  pose proof (square_never_negative rest T TP R0) as N.
  rewrite (integral_ext T _ (fun s => 1 * (v s * v s) + 1 * g1 s)) in N by (intros; unfold rest, g1; ring).
  rewrite (integral_sum _ _ (fun s => v s * v s) g1 T CVV G1) in N. unfold g1 in N.
  rewrite (integral_sum _ _ v (fun _ => 1) T CV C1), integral_one in N. change (integral v T) with w in N.
  set (whole := integral (fun s => v s * v s) T) in *. clearbody whole.
  replace (w * w / T) with (m * w) by (unfold m; field; lra).
  assert (E : m * T = w) by (unfold m; field; lra).
  replace (m * m * T) with (m * w) in N by (rewrite <- E; ring). lra.
Qed.

(* A longer hold is cheaper: the bound with T is one for every hold that is not longer. *)
Corollary least_dissipation_of_shorter_holds : forall T longest v, 0 < T <= longest -> is_continuous v ->
  displacement T v * displacement T v / longest <= integral (fun s => v s * v s) T.
Proof.
  intros T longest v [P L] C. apply Rle_trans with (2 := least_dissipation_of_displacement T v P C).
  apply Rmult_le_compat_l; [apply Rle_0_sqr | apply Rinv_le_contravar; lra].
Qed.

(* ---------- behind an amplifier's first-order lag ---------- *)
Lemma exponential_continuous : forall tau, is_continuous (fun s => exp (- s / tau)).
Proof.
  intros tau s. apply (ex_derive_continuous (K := R_AbsRing) (V := R_NormedModule)). unfold Rdiv. auto_derive. exact I.
Qed.
Lemma integral_exponential : forall tau T, 0 < tau -> integral (fun s => exp (- s / tau)) T = tau * (1 - exp (- T / tau)).
Proof.
  intros tau T P. unfold integral. apply (is_RInt_unique (V := R_CompleteNormedModule)).
  replace (tau * (1 - exp (- T / tau))) with ((fun s => - tau * exp (- s / tau)) T - (fun s => - tau * exp (- s / tau)) 0).
  - apply (is_RInt_derive (V := R_CompleteNormedModule) (fun s => - tau * exp (- s / tau)) (fun s => exp (- s / tau))).
    + intros s _. unfold Rdiv. auto_derive; [exact I | field; lra].
    + intros s _. apply exponential_continuous.
  - cbn beta. replace (- 0 / tau) with 0 by (field; lra). rewrite exp_0. ring.
Qed.

Section Lag.
Variables tau T : R.
Hypotheses (tau_positive : 0 < tau) (T_positive : 0 < T).
Definition decay := exp (- T / tau).
Definition share := (1 - decay) * tau / T.
Definition spread := share * ((1 + decay) / 2 - share).
Definition lag_shape (s : R) := 1 * exp (- s / tau) + (- share) * 1.

Lemma lag_shape_continuous : is_continuous lag_shape.
Proof. apply sum_continuous; [apply exponential_continuous | apply constant_continuous]. Qed.
Lemma lag_shape_mean : integral lag_shape T = 0.
Proof.
  unfold lag_shape. rewrite (integral_sum _ _ (fun s => exp (- s / tau)) (fun _ => 1)) by (apply exponential_continuous || apply constant_continuous).
  rewrite integral_exponential, integral_one by exact tau_positive. unfold share, decay. field. lra.
Qed.
Lemma lag_shape_variance : integral (fun s => lag_shape s * lag_shape s) T = spread * T.
Proof.
  assert (H : 0 < tau / 2) by lra. pose proof (exponential_continuous tau) as C. pose proof (exponential_continuous (tau / 2)) as C2.
  pose proof (constant_continuous 1) as C1.
  pose (g := fun s => (-2 * share) * exp (- s / tau) + (share * share) * 1).
  assert (G : is_continuous g) by (apply sum_continuous; assumption).
  rewrite (integral_ext T _ (fun s => 1 * exp (- s / (tau / 2)) + 1 * g s)).
  - rewrite (integral_sum _ _ (fun s => exp (- s / (tau / 2))) g T C2 G). unfold g.
    rewrite (integral_sum _ _ (fun s => exp (- s / tau)) (fun _ => 1) T C C1), !integral_exponential, integral_one by lra.
    replace (exp (- T / (tau / 2))) with (decay * decay) by (unfold decay; rewrite <- exp_plus; f_equal; field; lra).
    unfold spread, share. fold decay. field. lra.
  - intros s. unfold lag_shape, g. replace (exp (- s / (tau / 2))) with (exp (- s / tau) * exp (- s / tau))
      by (rewrite <- exp_plus; f_equal; field; lra). ring.
Qed.

(* The force of the hold, y + e exp(-s/tau), works y w + e (p w + rho) on the tool, and a damper b takes at least
   b (w^2 / T + rho^2 / (kappa T)) out of the motion: what Loop.v assumes of a hold. *)
Theorem lagging_hold : forall v y e, is_continuous v -> 0 < spread ->
  let w := displacement T v in
  let rho := integral (fun s => lag_shape s * v s) T in
  integral (fun s => (y + e * exp (- s / tau)) * v s) T = y * w + e * (share * w + rho) /\
  w * w / T + rho * rho / (spread * T) <= integral (fun s => v s * v s) T.
Proof.
  intros v y e V K w rho. split.
  - pose proof (product_continuous _ _ lag_shape_continuous V) as P.
    rewrite (integral_ext T _ (fun s => (y + e * share) * v s + e * (lag_shape s * v s))) by (intros; unfold lag_shape; ring).
    rewrite (integral_sum _ _ v (fun s => lag_shape s * v s) T V P). unfold w, rho, displacement. ring.
  - exact (least_dissipation T v lag_shape spread T_positive K V lag_shape_continuous lag_shape_mean lag_shape_variance).
Qed.
End Lag.
