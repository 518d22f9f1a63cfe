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
Fixpoint gram (L : list (list Z)) : sym := match L with [] => [] | c :: L' => mix 1 (self c) 1 (gram L') end.
Lemma gram_psd : forall L x, 0 <= quad (gram L) x.
Proof.
  induction L as [|c L IH]; intros x; cbn [gram]; rewrite ?quad_nil; [lra|].
  rewrite quad_mix, quad_self. pose proof (Rle_0_sqr (dot c x)) as S. unfold Rsqr in S. pose proof (IH x). lra.
Qed.
Definition psd_by (L : list (list Z)) (k : positive) (M : sym) : bool :=
  let R := mix 1 M (- Zpos k) (gram L) in dominant (length R) R.
Lemma psd_by_sound : forall L k M, psd_by L k M = true -> forall x, 0 <= quad M x.
Proof.
  intros L k M H x. unfold psd_by in H. pose proof (dominant_sound _ _ H x) as Q. rewrite quad_mix, opp_IZR in Q.
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
