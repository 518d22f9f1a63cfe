(* Symmetric forms with whole coefficients: when one is never negative, decided by computing with whole numbers.
   A form M is accepted with a witness, M = k L L' + R where R is diagonally dominant. *)
Require Import ZArith Reals List Lra Lia Bool.
Import ListNotations.
Local Open Scope R_scope.
Local Open Scope bool_scope.

(* ---------- vectors of integers against vectors of reals; what is missing counts as zero ---------- *)
Fixpoint dot (v : list Z) (x : list R) : R :=
  match v, x with a :: v', y :: x' => IZR a * y + dot v' x' | _, _ => 0 end.
Fixpoint comb (s : Z) (v : list Z) (t : Z) (w : list Z) {struct v} : list Z :=   (* s v + t w *)
  match v, w with
  | a :: v', b :: w' => (s * a + t * b)%Z :: comb s v' t w'
  | _, [] => map (Z.mul s) v
  | [], _ => map (Z.mul t) w
  end.
Lemma dot_nil : forall x, dot [] x = 0. Proof. destruct x; reflexivity. Qed.
Lemma dot_map : forall v s x, dot (map (Z.mul s) v) x = IZR s * dot v x.
Proof. induction v as [|a v IH]; intros s [|y x]; cbn [dot map]; rewrite ?mult_IZR, ?IH; ring. Qed.
Lemma dot_comb : forall v w s t x, dot (comb s v t w) x = IZR s * dot v x + IZR t * dot w x.
Proof.
  induction v as [|a v IH]; intros [|b w] s t x; cbn [comb]; rewrite ?dot_map, ?dot_nil; try ring.
  destruct x as [|y x]; cbn [dot]; rewrite ?plus_IZR, ?mult_IZR, ?IH; ring.
Qed.

(* ---------- symmetric matrices: a diagonal entry and what is right of it ---------- *)
Definition sym := list (Z * list Z).
Fixpoint quad (M : sym) (x : list R) : R :=
  match M, x with
  | (d, v) :: M', y :: x' => IZR d * (y * y) + 2 * y * dot v x' + quad M' x'
  | _, _ => 0
  end.
Lemma quad_nil : forall x, quad [] x = 0. Proof. destruct x; reflexivity. Qed.

(* s M + t N *)
Definition times (s : Z) (M : sym) : sym := map (fun r => ((s * fst r)%Z, map (Z.mul s) (snd r))) M.
Lemma quad_times : forall M s x, quad (times s M) x = IZR s * quad M x.
Proof.
  induction M as [|[d v] M IH]; intros s [|y x]; cbn [times map quad fst snd]; try ring.
  fold (times s M). rewrite mult_IZR, dot_map, IH. ring.
Qed.
Fixpoint mix (s : Z) (M : sym) (t : Z) (N : sym) {struct M} : sym :=
  match M, N with
  | (d, v) :: M', (e, w) :: N' => ((s * d + t * e)%Z, comb s v t w) :: mix s M' t N'
  | _, [] => times s M
  | [], _ => times t N
  end.
Lemma quad_mix : forall M N s t x, quad (mix s M t N) x = IZR s * quad M x + IZR t * quad N x.
Proof.
  induction M as [|[d v] M IH]; intros [|[e w] N] s t x; cbn [mix]; rewrite ?quad_times, ?quad_nil; try ring.
  destruct x as [|y x]; cbn [quad]; rewrite ?plus_IZR, ?mult_IZR, ?dot_comb, ?IH; ring.
Qed.

(* The square of a linear form. *)
Fixpoint self (v : list Z) : sym :=
  match v with [] => [] | a :: v' => ((a * a)%Z, comb a v' 0 []) :: self v' end.
Lemma quad_self : forall v x, quad (self v) x = dot v x * dot v x.
Proof.
  induction v as [|a v IH]; intros [|y x]; simpl; try lra.
  rewrite mult_IZR, dot_comb, IH. ring.
Qed.
(* ---------- a form of linear images: quad P (A xi), twice ---------- *)
Fixpoint lincomb (v : list Z) (A : list (list Z)) : list Z :=   (* sum of v_j A_j *)
  match v, A with a :: v', r :: A' => comb a r 1 (lincomb v' A') | _, _ => [] end.
Definition image (A : list (list Z)) (x : list R) : list R := map (fun r => dot r x) A.
Lemma dot_lincomb : forall v A x, dot (lincomb v A) x = dot v (image A x).
Proof.
  induction v as [|a v IH]; intros [|r A] x; simpl; rewrite ?dot_nil; try lra.
  rewrite dot_comb, IH. lra.
Qed.
(* a t' + t a'; zeros, of which a sparse recursion has many, cost nothing *)
Fixpoint cross (a t : list Z) : sym :=
  match a, t with b :: a', c :: t' => ((2 * (b * c))%Z, comb b t' c a') :: cross a' t' | _, _ => [] end.
Lemma quad_cross : forall a t x, quad (cross a t) x = 2 * dot a x * dot t x.
Proof.
  induction a as [|b a IH]; intros [|c t] [|y x]; cbn [cross quad dot]; try ring.
  rewrite ?mult_IZR, dot_comb, IH. ring.
Qed.
Fixpoint pull (P : sym) (A : list (list Z)) : sym :=
  match P, A with
  | (d, v) :: P', r :: A' => mix 1 (cross r (comb d r 2 (lincomb v A'))) 1 (pull P' A')
  | _, _ => []
  end.
Lemma quad_pull : forall P A x, quad (pull P A) x = 2 * quad P (image A x).
Proof.
  induction P as [|[d v] P IH]; intros [|r A] x; simpl; rewrite ?quad_nil; try lra.
  rewrite quad_mix, quad_cross, dot_comb, dot_lincomb, IH. ring.
Qed.

(* Of several A that differ in their first rows: what the others have in common is paid once. *)
Definition after_first (P : sym) (A : list (list Z)) : list Z * sym :=
  match P, A with (_, v) :: P', _ :: A' => (lincomb v A', pull P' A') | _, _ => ([], []) end.
Definition shared := (list (list Z) * (list Z * sym))%type.
Definition shared_by (P : sym) (A : list (list Z)) : shared := (tl A, after_first P A).
Definition pull_sharing (P : sym) (s : shared) (A : list (list Z)) : sym :=
  if list_eq_dec (list_eq_dec Z.eq_dec) (tl A) (fst s) then
    match P, A with (d, _) :: _, r :: _ => mix 1 (cross r (comb d r 2 (fst (snd s)))) 1 (snd (snd s)) | _, _ => [] end
  else pull P A.
Lemma pull_sharing_is_pull : forall P A B, pull_sharing P (shared_by P B) A = pull P A.
Proof.
  intros P A B. unfold pull_sharing, shared_by. cbn [fst snd].
  destruct (list_eq_dec (list_eq_dec Z.eq_dec) (tl A) (tl B)) as [T|]; [|reflexivity].
  destruct P as [|[d v] P], A as [|r A]; try reflexivity. cbn [tl] in T. subst A.
  destruct B as [|b B]; cbn [after_first tl pull fst snd]; [|reflexivity]. destruct v, P as [|[? ?] ?]; reflexivity.
Qed.

(* ---------- the witness ---------- *)
Fixpoint size (v : list Z) : Z := match v with [] => 0%Z | a :: v' => (Z.abs a + size v')%Z end.
Fixpoint sub_diagonal (M : sym) (v : list Z) : sym :=   (* M less diag |v| *)
  match M, v with
  | (d, r) :: M', a :: v' => ((d - Z.abs a)%Z, r) :: sub_diagonal M' v'
  | _, [] => M
  | [], a :: v' => ((- Z.abs a)%Z, []) :: sub_diagonal [] v'
  end.
Fixpoint squares (v : list Z) (x : list R) : R :=   (* sum of |v_j| x_j^2 *)
  match v, x with a :: v', y :: x' => IZR (Z.abs a) * (y * y) + squares v' x' | _, _ => 0 end.
Lemma quad_sub : forall v M x, quad (sub_diagonal M v) x = quad M x - squares v x.
Proof.
  induction v as [|a v IH]; intros [|[d r] M] [|y x]; cbn [sub_diagonal quad squares]; rewrite ?dot_nil; try lra;
    rewrite IH, ?minus_IZR, ?opp_IZR, ?quad_nil; ring.
Qed.
Lemma split_row : forall v y x, 0 <= IZR (size v) * (y * y) + 2 * y * dot v x + squares v x.
Proof.
  induction v as [|a v IH]; intros y [|z x]; cbn [size dot squares]; rewrite ?plus_IZR; try lra.
  - assert (0 <= IZR (Z.abs a) + IZR (size v)).
    { apply Rplus_le_le_0_compat; [apply (IZR_le 0); lia|]. clear. induction v; cbn [size]; [lra|].
      rewrite plus_IZR. apply Rplus_le_le_0_compat; [apply (IZR_le 0); lia | assumption]. }
    pose proof (Rle_0_sqr y) as S. unfold Rsqr in S. pose proof (Rmult_le_pos _ _ H S). lra.
  - pose proof (IH y x) as H. assert (G : 0 <= IZR (Z.abs a) * (y * y) + 2 * y * (IZR a * z) + IZR (Z.abs a) * (z * z)).
    { destruct (Z.abs_eq_or_opp a) as [E|E]; rewrite E, ?opp_IZR.
      - assert (P : 0 <= IZR a) by (apply (IZR_le 0); lia). pose proof (Rle_0_sqr (y + z)) as S. unfold Rsqr in S.
        pose proof (Rmult_le_pos _ _ P S). lra.
      - assert (P : 0 <= - IZR a) by (rewrite <- opp_IZR; apply (IZR_le 0); lia). pose proof (Rle_0_sqr (y - z)) as S.
        unfold Rsqr in S. pose proof (Rmult_le_pos _ _ P S). lra. }
    lra.
Qed.
Fixpoint dominant (fuel : nat) (M : sym) : bool :=
  match M with
  | [] => true
  | (d, v) :: M' => match fuel with O => false | S f => (size v <=? d)%Z && dominant f (sub_diagonal M' v) end
  end.
Lemma dominant_sound : forall fuel M, dominant fuel M = true -> forall x, 0 <= quad M x.
Proof.
  induction fuel as [|f IH]; intros [|[d v] M] H [|y x]; cbn [dominant quad] in *; try discriminate; try lra.
  apply andb_prop in H as [H1 H2]. apply Z.leb_le, IZR_le in H1. pose proof (IH _ H2 x) as Q. rewrite quad_sub in Q.
  pose proof (split_row v y x) as S. pose proof (Rle_0_sqr y) as Y. unfold Rsqr in Y.
  assert (0 <= (IZR d - IZR (size v)) * (y * y)) by (apply Rmult_le_pos; lra). lra.
Qed.
(* L L', of columns of L from their diagonal entry on *)
Fixpoint gram (L : list (list Z)) : sym :=
  match L with [] => [] | c :: L' => mix 1 (self c) 1 ((0%Z, []) :: gram L') end.
Lemma gram_psd : forall L x, 0 <= quad (gram L) x.
Proof.
  induction L as [|c L IH]; intros x; cbn [gram]; rewrite ?quad_nil; [lra|].
  rewrite quad_mix, quad_self. pose proof (Rle_0_sqr (dot c x)) as S. unfold Rsqr in S.
  destruct x as [|y x]; cbn [quad]; rewrite ?dot_nil; [lra|]. pose proof (IH x). lra.
Qed.
(* Of several forms by one L: what it costs to square it is paid once. *)
Definition psd_by (L : list (list Z)) (k : positive) (Ms : list sym) : bool :=
  let G := gram L in forallb (fun M => let R := mix 1 M (- Zpos k) G in dominant (length R) R) Ms.
Lemma psd_by_sound : forall L k Ms, psd_by L k Ms = true -> Forall (fun M => forall x, 0 <= quad M x) Ms.
Proof.
  intros L k Ms H. unfold psd_by in H. rewrite forallb_forall in H. apply Forall_forall. intros M I x. specialize (H M I).
  pose proof (dominant_sound _ _ H x) as Q. rewrite quad_mix, opp_IZR in Q.
  assert (P : 0 <= IZR (Zpos k)) by (apply (IZR_le 0); lia). pose proof (Rmult_le_pos _ _ P (gram_psd L x)). lra.
Qed.

(* ---------- what is beyond the end counts as zero ---------- *)
(* A row of the form reaches no further than `n` places. *)
Fixpoint upper (n : nat) (M : sym) : bool :=
  match M with [] => true | (_, v) :: M' => match n with O => false | S m => Nat.leb (length v) m && upper m M' end end.
Definition unit_at (n : nat) : list Z := repeat 0%Z n ++ [1%Z].
Lemma dot_app : forall v x z, (length v <= length x)%nat -> dot v (x ++ z) = dot v x.
Proof.
  induction v as [|a v IH]; intros x z H; destruct x as [|y x]; simpl in *; rewrite ?dot_nil; try lra; try lia.
  rewrite IH by lia. lra.
Qed.
Lemma quad_app : forall M x z, upper (length x) M = true -> quad M (x ++ z) = quad M x.
Proof.
  induction M as [|[d v] M IH]; intros x z H; destruct x as [|y x]; simpl in *; rewrite ?quad_nil; try lra; try discriminate.
  apply andb_prop in H as [H1 H2]. apply Nat.leb_le in H1. rewrite dot_app, IH by assumption. lra.
Qed.
Lemma dot_unit : forall x w, dot (unit_at (length x)) (x ++ [w]) = w.
Proof. unfold unit_at. induction x as [|y x IH]; intros w; simpl; [lra | rewrite IH; lra]. Qed.
Lemma dot_scale : forall v x s, dot v (map (fun r => r / s) x) = dot v x / s.
Proof. induction v as [|a v IH]; intros [|y x] s; simpl; rewrite ?IH; unfold Rdiv; ring. Qed.
Lemma quad_scale : forall M x s, quad M (map (fun r => r / s) x) = quad M x / s / s.
Proof.
  induction M as [|[d v] M IH]; intros [|y x] s; simpl; rewrite ?dot_scale, ?IH; unfold Rdiv; ring.
Qed.

(* ---------- on_line two points a form that is never negative is convex ---------- *)
Fixpoint on_line (t : R) (x y : list R) : list R :=   (* (1 - t) x + t y *)
  match x, y with a :: x', b :: y' => ((1 - t) * a + t * b) :: on_line t x' y' | _, _ => [] end.
Lemma on_line_length : forall t x y, length x = length y -> length (on_line t x y) = length x.
Proof. induction x as [|a x IH]; intros [|b y] H; cbn [on_line length] in *; try discriminate; auto. Qed.
Fixpoint minus (x y : list R) : list R :=
  match x, y with a :: x', b :: y' => (a - b) :: minus x' y' | _, _ => [] end.
Lemma dot_on_line : forall v t x y, length x = length y -> dot v (on_line t x y) = (1 - t) * dot v x + t * dot v y.
Proof.
  induction v as [|a v IH]; intros t [|b x] [|c y] H; cbn [dot on_line length] in *; try discriminate; try lra.
  rewrite IH by lia. ring.
Qed.
Lemma dot_minus : forall v x y, length x = length y -> dot v (minus x y) = dot v x - dot v y.
Proof.
  induction v as [|a v IH]; intros [|b x] [|c y] H; cbn [dot minus length] in *; try discriminate; try lra.
  rewrite IH by lia. ring.
Qed.
Lemma quad_on_line : forall M t x y, length x = length y ->
  quad M (on_line t x y) = (1 - t) * quad M x + t * quad M y - t * (1 - t) * quad M (minus x y).
Proof.
  induction M as [|[d v] M IH]; intros t [|b x] [|c y] H; cbn [quad on_line minus length] in *; try discriminate; try lra.
  rewrite IH, dot_on_line, dot_minus by lia. ring.
Qed.
Lemma convex : forall M t x y, length x = length y -> (forall z, 0 <= quad M z) -> 0 <= t <= 1 ->
  quad M (on_line t x y) <= (1 - t) * quad M x + t * quad M y.
Proof.
  intros M t x y L H T. rewrite quad_on_line by exact L.
  assert (0 <= t * (1 - t) * quad M (minus x y)) by (apply Rmult_le_pos; [apply Rmult_le_pos; lra | apply H]). lra.
Qed.
Lemma quad_zeros : forall M n, quad M (repeat 0 n) = 0.
Proof.
  assert (D0 : forall v n, dot v (repeat 0 n) = 0) by (induction v; intros [|n]; simpl; rewrite ?IHv; lra).
  induction M as [|[d v] M IH]; intros [|n]; simpl; rewrite ?IH, ?D0; lra.
Qed.

(* ---------- short coefficients in place of long ones ---------- *)
(* Without the last k binary digits, rounded down. *)
Definition shorter (k : Z) (A : list (list Z)) : list (list Z) := map (map (fun a => Z.shiftr a k)) A.
Fixpoint magnitude (M : sym) : Z := match M with (d, v) :: M' => (Z.abs d + 2 * size v + magnitude M')%Z | [] => 0%Z end.
Fixpoint ones (m : nat) : sym := match m with O => [] | S n => (1%Z, []) :: ones n end.
Fixpoint sum_of_sizes (m : nat) (x : list R) : R :=
  match m, x with S n, y :: x' => Rabs y + sum_of_sizes n x' | _, _ => 0 end.
Lemma sum_of_sizes_positive : forall m x, 0 <= sum_of_sizes m x.
Proof. induction m as [|m IH]; intros [|y x]; cbn; try lra. pose proof (Rabs_pos y). pose proof (IH x). lra. Qed.
Lemma quad_ones_positive : forall m x, 0 <= quad (ones m) x.
Proof.
  induction m as [|m IH]; intros [|y x]; cbn; rewrite ?dot_nil; try lra. pose proof (Rle_0_sqr y) as Y. unfold Rsqr in Y.
  pose proof (IH x). lra.
Qed.
Lemma sizes_by_squares : forall m x, sum_of_sizes m x * sum_of_sizes m x <= INR m * quad (ones m) x.
Proof.
  induction m as [|m IH]; intros [|y x]; cbn [sum_of_sizes ones quad]; rewrite ?dot_nil; try lra; try (cbn; lra).
  specialize (IH x). rewrite S_INR. set (n := INR m) in *. set (s := sum_of_sizes m x) in *. set (q := quad (ones m) x) in *.
  assert (Y : Rabs y * Rabs y = y * y) by (rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
  set (a := Rabs y) in *. rewrite <- Y. pose proof (sum_of_sizes_positive m x) as P. fold s in P.
  pose proof (quad_ones_positive m x) as Q. fold q in Q. pose proof (pos_INR m) as N. fold n in N.
  enough (2 * (a * s) <= n * (a * a) + q) by lra.
  destruct (Req_dec n 0) as [Z|Z].
  - rewrite Z in *. assert (s = 0) by nra. nra.
  - apply Rmult_le_reg_l with n; [lra|]. pose proof (Rle_0_sqr (n * a - s)) as D. unfold Rsqr in D. lra.
Qed.
Lemma size_positive : forall v, 0 <= IZR (size v).
Proof. intros v. apply (IZR_le 0). induction v; cbn [size]; lia. Qed.
Lemma magnitude_positive : forall M, 0 <= IZR (magnitude M).
Proof.
  induction M as [|[d v] M IH]; cbn [magnitude]; [lra|]. pose proof (size_positive v). rewrite !plus_IZR, mult_IZR.
  pose proof (IZR_le 0 (Z.abs d) ltac:(lia)). lra.
Qed.
Lemma dot_bounded : forall v x b, 0 <= b -> Forall (fun y => Rabs y <= b) x -> Rabs (dot v x) <= IZR (size v) * b.
Proof.
  intros v x b B H. revert v. induction H as [|y x Y _ IH]; intros [|a v]; cbn [dot]; rewrite ?Rabs_R0;
    try (apply Rmult_le_pos; [apply size_positive | exact B]).
  apply Rle_trans with (1 := Rabs_triang _ _). cbn [size]. rewrite Rabs_mult, plus_IZR, abs_IZR. specialize (IH v).
  pose proof (Rmult_le_compat_l _ _ _ (Rabs_pos (IZR a)) Y). lra.
Qed.
Lemma quad_bounded : forall M x b, 0 <= b -> Forall (fun y => Rabs y <= b) x -> quad M x <= IZR (magnitude M) * (b * b).
Proof.
  intros M x b B H. revert M. induction H as [|y x Y H IH]; intros [|[d v] M]; cbn [quad];
    try (apply Rmult_le_pos; [apply magnitude_positive | apply Rle_0_sqr]).
  cbn [magnitude]. rewrite !plus_IZR, mult_IZR, abs_IZR. specialize (IH M). pose proof (dot_bounded v x b B H) as D.
  pose proof (Rle_abs (IZR d * (y * y))) as U. rewrite Rabs_mult, (Rabs_pos_eq (y * y)) in U by apply Rle_0_sqr.
  pose proof (Rle_abs (y * dot v x)) as W. rewrite Rabs_mult in W.
  assert (YY : y * y <= b * b).
  { rewrite <- (Rabs_pos_eq (y * y)), Rabs_mult by apply Rle_0_sqr. apply Rmult_le_compat; try apply Rabs_pos; exact Y. }
  pose proof (Rmult_le_compat_l _ _ _ (Rabs_pos (IZR d)) YY).
  pose proof (Rmult_le_compat _ _ _ _ (Rabs_pos y) (Rabs_pos (dot v x)) Y D). lra.
Qed.
Lemma shift_leaves : forall a k, (0 <= k)%Z ->
  exists r, IZR a = IZR (2 ^ k) * IZR (Z.shiftr a k) + r /\ 0 <= r <= IZR (2 ^ k).
Proof.
  intros a k K. rewrite Z.shiftr_div_pow2 by exact K. assert (P : (0 < 2 ^ k)%Z) by (apply Z.pow_pos_nonneg; lia).
  exists (IZR (a mod 2 ^ k)). rewrite <- mult_IZR, <- plus_IZR, <- Z.div_mod by lia. split; [reflexivity|].
  pose proof (Z.mod_pos_bound a _ P). split; [apply (IZR_le 0) | apply IZR_le]; lia.
Qed.
Lemma dot_shorter : forall k, (0 <= k)%Z -> forall v m x, (length v <= m)%nat ->
  Rabs (dot v x - IZR (2 ^ k) * dot (map (fun a => Z.shiftr a k) v) x) <= IZR (2 ^ k) * sum_of_sizes m x.
Proof.
  intros k K. assert (P : 0 <= IZR (2 ^ k)) by (apply (IZR_le 0), Z.pow_nonneg; lia).
  assert (Q : forall m x, 0 <= IZR (2 ^ k) * sum_of_sizes m x).
  { intros. apply Rmult_le_pos; [exact P | apply sum_of_sizes_positive]. }
  induction v as [|a v IH]; intros m [|y x] L; cbn [dot map]; rewrite ?Rmult_0_r, ?Rminus_0_r, ?Rabs_R0; try apply Q.
  destruct m as [|m]; cbn [length] in L; [lia|]. cbn [sum_of_sizes]. specialize (IH m x ltac:(lia)).
  destruct (shift_leaves a k K) as (r & E & B). rewrite E.
  replace ((IZR (2 ^ k) * IZR (Z.shiftr a k) + r) * y + dot v x
      - IZR (2 ^ k) * (IZR (Z.shiftr a k) * y + dot (map (fun a0 => Z.shiftr a0 k) v) x))
    with (r * y + (dot v x - IZR (2 ^ k) * dot (map (fun a0 => Z.shiftr a0 k) v) x)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_mult, (Rabs_pos_eq r) by lra.
  pose proof (Rmult_le_compat_r (Rabs y) r (IZR (2 ^ k)) (Rabs_pos y) ltac:(lra)). lra.
Qed.
(* What a form makes of the long coefficients is what it makes of the short ones, but for a share 1/n and a little. *)
Lemma quad_shorter : forall P k n m A x,
  (forall z, 0 <= quad P z) -> (0 <= k)%Z -> Forall (fun r => (length r <= m)%nat) A ->
  let q := IZR (2 ^ k) in let N := IZR (Zpos n) in
  N * quad P (image A x)
  <= (N + 1) * (q * q) * (quad P (image (shorter k A) x) + N * IZR (magnitude P) * (INR m * quad (ones m) x)).
Proof.
  intros P k n m A x HP K L q N. assert (PN : 0 < N) by (apply (IZR_lt 0); lia).
  assert (Pq : 0 <= q) by (apply (IZR_le 0), Z.pow_nonneg; lia).
  assert (Q0 : 0 < q) by (apply (IZR_lt 0), Z.pow_pos_nonneg; lia).
  set (t := / (N + 1)). assert (T : 0 < t < 1).
  { unfold t. split; [apply Rinv_0_lt_compat; lra|]. rewrite <- Rinv_1. apply Rinv_lt_contravar; lra. }
  assert (T1 : 1 - t = N / (N + 1)) by (unfold t; field; lra).
  set (B := image (shorter k A) x). set (D := map (fun r => dot r x - q * dot (map (fun a => Z.shiftr a k) r) x) A).
  assert (E : image A x = on_line t (map (fun z => z / ((1 - t) / q)) B) (map (fun z => z / t) D)).
  { unfold B, D, image, shorter. clear - T Q0. induction A as [|r A IH]; cbn [map on_line]; [reflexivity|].
    rewrite <- IH. f_equal. field. lra. }
  assert (LD : length (map (fun z => z / ((1 - t) / q)) B) = length (map (fun z => z / t) D)).
  { unfold B, D, image, shorter. rewrite !map_length. reflexivity. }
  pose proof (convex P t _ _ LD HP ltac:(lra)) as C. rewrite <- E, !quad_scale in C.
  assert (QD : quad P D <= IZR (magnitude P) * (q * sum_of_sizes m x * (q * sum_of_sizes m x))).
  { apply quad_bounded; [apply Rmult_le_pos; [exact Pq | apply sum_of_sizes_positive]|].
    unfold D. apply Forall_map. apply Forall_impl with (2 := L). intros r Lr. exact (dot_shorter k K r m x Lr). }
  pose proof (Rmult_le_compat_l _ _ _ (Rle_0_sqr q) (sizes_by_squares m x)) as S.
  apply (Rmult_le_compat_l _ _ _ (magnitude_positive P)) in S. unfold Rsqr in S.
  set (y := INR m * quad (ones m) x) in *. set (u := sum_of_sizes m x) in *.
  apply Rmult_le_compat_l with (r := N) in C; [|lra]. fold B in C.
  replace (N * ((1 - t) * (quad P B / ((1 - t) / q) / ((1 - t) / q)) + t * (quad P D / t / t)))
    with ((N + 1) * (q * q) * quad P B + N * (N + 1) * quad P D) in C.
  - assert (QD2 : quad P D <= IZR (magnitude P) * (q * q * y)) by (apply Rle_trans with (1 := QD); lra).
    apply (Rmult_le_compat_l (N * (N + 1))) in QD2; [|apply Rmult_le_pos; lra]. apply Rle_trans with (1 := C). lra.
  - rewrite T1. unfold t. field. lra.
Qed.
