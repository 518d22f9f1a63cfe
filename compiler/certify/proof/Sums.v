(* Sums of real numbers over what comes before a number of samples. *)
Require Import Reals Lra Lia.
Local Open Scope R_scope.

Fixpoint sum (n : nat) (f : nat -> R) : R := match n with O => 0 | S m => sum m f + f m end.

Lemma sum_ext : forall n f g, (forall k, (k < n)%nat -> f k = g k) -> sum n f = sum n g.
Proof. induction n as [|n IH]; intros f g H; cbn; [reflexivity|]. rewrite (IH f g), H; auto with arith. Qed.
Lemma sum_le : forall n f g, (forall k, (k < n)%nat -> f k <= g k) -> sum n f <= sum n g.
Proof.
  induction n as [|n IH]; intros f g H; cbn; [lra|]. apply Rplus_le_compat; [apply IH|apply H]; auto with arith.
Qed.
Lemma sum_zero : forall n, sum n (fun _ => 0) = 0.
Proof. induction n; cbn; lra. Qed.
Lemma sum_positive : forall n f, (forall k, (k < n)%nat -> 0 <= f k) -> 0 <= sum n f.
Proof. intros n f H. rewrite <- (sum_zero n). apply sum_le. exact H. Qed.
Lemma sum_plus : forall n f g, sum n (fun k => f k + g k) = sum n f + sum n g.
Proof. induction n as [|n IH]; intros f g; cbn; [|rewrite IH]; lra. Qed.
Lemma sum_times : forall n r f, sum n (fun k => r * f k) = r * sum n f.
Proof. induction n as [|n IH]; intros r f; cbn; [|rewrite IH]; lra. Qed.
Lemma sum_first : forall n f, sum (S n) f = f O + sum n (fun k => f (S k)).
Proof.
  induction n as [|n IH]; intros f; [cbn; lra|].
  change (sum (S (S n)) f) with (sum (S n) f + f (S n)). rewrite IH. cbn. lra.
Qed.
Lemma sum_monotone : forall m n f, (m <= n)%nat -> (forall k, (k < n)%nat -> 0 <= f k) -> sum m f <= sum n f.
Proof.
  intros m n f L. induction L as [|n L IH]; intros H; [lra|]. cbn.
  pose proof (H n ltac:(lia)). assert (sum m f <= sum n f) by (apply IH; intros; apply H; lia). lra.
Qed.
(* What vanishes at first may be left out. *)
Lemma sum_from : forall m n f, (forall k, (k < m)%nat -> f k = 0) -> sum n f = sum (n - m) (fun k => f (m + k)%nat).
Proof.
  intros m n f H. induction n as [|n IH]; [reflexivity|].
  destruct (Nat.le_gt_cases m n) as [L|L].
  - replace (S n - m)%nat with (S (n - m)) by lia. cbn. rewrite IH. f_equal. f_equal. lia.
  - replace (S n - m)%nat with O by lia. cbn. rewrite IH, (H n L). replace (n - m)%nat with O by lia. cbn. lra.
Qed.
Lemma sum_reversed : forall n f, sum n f = sum n (fun k => f (n - S k)%nat).
Proof.
  induction n as [|n IH]; intros f; [reflexivity|]. rewrite (sum_first n (fun k => f (S n - S k)%nat)). cbn [sum].
  rewrite IH. replace (S n - 1)%nat with n by lia.
  rewrite (sum_ext n (fun k => f (S n - S (S k))%nat) (fun k => f (n - S k)%nat)); [lra | intros; f_equal; lia].
Qed.
(* A triangle, by rows and by columns. *)
Lemma sum_triangle : forall n (g : nat -> nat -> R),
  sum n (fun i => sum (n - i) (fun l => g i l)) = sum n (fun l => sum (n - l) (fun i => g i l)).
Proof.
  assert (H : forall n g, sum (S n) (fun i => sum (S n - i) (g i))
                          = sum n (fun i => sum (n - i) (g i)) + sum (S n) (fun i => g i (n - i)%nat)).
  { intros n g. rewrite (sum_ext (S n) _ (fun i => sum (n - i) (g i) + g i (n - i)%nat)).
    - rewrite sum_plus. cbn. rewrite Nat.sub_diag. cbn. lra.
    - intros k L. replace (S n - k)%nat with (S (n - k)) by lia. reflexivity. }
  induction n as [|n IH]; intros g; [reflexivity|].
  etransitivity; [exact (H n g)|]. etransitivity; [|symmetry; exact (H n (fun l i => g i l))]. rewrite IH. f_equal.
  rewrite sum_reversed. apply sum_ext. intros k L. f_equal; lia.
Qed.
