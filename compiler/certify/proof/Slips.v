(* The hold certificate: what position alone drives, springs, relaxing modes and springs that slip, is passive with the
   damping  beta T  over holds of lengths up to T, for any motion and any lengths; whatever sticks or slides.

   An element remembers a state, stores an energy, and answers with a force that the motor holds while the tool moves on
   by w; then the state follows. It obeys the hold inequality when the energy rises by no more than the work of the held
   force and  beta w^2. *)
Require Import Reals List Lra.
Import ListNotations.
Local Open Scope R_scope.

Record element := {
  state : Type;
  energy : state -> R;
  force : state -> R;
  next : state -> R -> state;
  beta : R
}.
Definition holds (e : element) : Prop :=
  (forall s, 0 <= energy e s) /\
  forall s w, energy e (next e s w) - energy e s <= force e s * w + beta e * (w * w).

(* ---------- the elements; the state of each is its force ---------- *)
Definition spring (k : R) : element :=
  {| state := R; energy F := F * F / (2 * k); force F := F; next F w := F + k * w; beta := k / 2 |}.
Lemma spring_holds : forall k, 0 < k -> holds (spring k).
Proof.
  intros k K. split; cbn.
  - intros F. apply Rmult_le_pos; [apply Rle_0_sqr | left; apply Rinv_0_lt_compat; lra].
  - intros F w. right. field. lra.
Qed.

(* A Maxwell element as it is emitted: a of its force is left after a sample. *)
Definition relaxing (a c : R) : element :=
  {| state := R; energy F := F * F / (2 * c); force F := F; next F w := a * F + c * w; beta := c / (1 + a) |}.
Lemma relaxing_holds : forall a c, 0 <= a < 1 -> 0 < c -> holds (relaxing a c).
Proof.
  intros a c A C. split; cbn.
  - intros F. apply Rmult_le_pos; [apply Rle_0_sqr | left; apply Rinv_0_lt_compat; lra].
  - intros F w.
    assert (H : F * w + c / (1 + a) * (w * w) - ((a * F + c * w) * (a * F + c * w) / (2 * c) - F * F / (2 * c))
                = (1 - a) / (2 * c * (1 + a)) * (((1 + a) * F + c * w) * ((1 + a) * F + c * w))).
    { field. split; lra. }
    assert (0 <= (1 - a) / (2 * c * (1 + a)) * (((1 + a) * F + c * w) * ((1 + a) * F + c * w))).
    { apply Rmult_le_pos; [|apply Rle_0_sqr]. apply Rmult_le_pos; [lra|]. left. apply Rinv_0_lt_compat.
      repeat apply Rmult_lt_0_compat; lra. }
    lra.
Qed.

(* ---------- what slips ---------- *)
(* First everything moves as if all slips stuck; then those that are loaded beyond their yield force slide. Sliding only
   lowers the energy that is stored: nothing else is asked of it, so that it may be that of any network of slips. *)
Definition sliding (e : element) (slide : state e -> state e) : element :=
  {| state := state e; energy := energy e; force := force e; next s w := slide (next e s w); beta := beta e |}.
Lemma sliding_holds : forall e slide, holds e -> (forall s, energy e (slide s) <= energy e s) ->
  holds (sliding e slide).
Proof.
  intros e slide [N H] L. split; [exact N|]. intros s w. cbn. specialize (H s w). specialize (L (next e s w)). lra.
Qed.

(* A spring in series with one slip: its force is cut off at the yield force. *)
Definition cut (Y F : R) : R := Rmax (- Y) (Rmin Y F).
Definition slipping (K Y : R) : element := sliding (spring K) (cut Y).
Lemma slipping_holds : forall K Y, 0 < K -> 0 <= Y -> holds (slipping K Y).
Proof.
  intros K Y HK HY. apply sliding_holds; [exact (spring_holds K HK)|]. intros F. cbn in *.
  apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; lra|]. unfold cut, Rmax, Rmin.
  destruct (Rle_dec Y F) as [A|A]; destruct (Rle_dec (- Y) _) as [B|B]; try nra.
Qed.

(* ---------- side by side ---------- *)
Definition nothing : element := {| state := unit; energy _ := 0; force _ := 0; next s _ := s; beta := 0 |}.
Definition beside (e f : element) : element :=
  {| state := state e * state f;
     energy s := energy e (fst s) + energy f (snd s);
     force s := force e (fst s) + force f (snd s);
     next s w := (next e (fst s) w, next f (snd s) w);
     beta := beta e + beta f |}.
Definition all_of (es : list element) : element := fold_right beside nothing es.
Lemma beside_holds : forall e f, holds e -> holds f -> holds (beside e f).
Proof.
  intros e f [NE E] [NF F]. split; cbn.
  - intros [s t]. specialize (NE s). specialize (NF t). cbn. lra.
  - intros [s t] w. specialize (E s w). specialize (F t w). cbn. lra.
Qed.
Lemma all_hold : forall es, Forall holds es -> holds (all_of es).
Proof.
  induction es as [|e es IH]; intros H; cbn.
  - split; cbn; intros; lra.
  - inversion H; subst. apply beside_holds; auto.
Qed.

(* ---------- any number of holds ---------- *)
(* Over a hold of the length T the tool moves by w, and a damper b takes at least b w^2 / T (Hold.v). *)
Record motion := { w : R; length_of_hold : R; dissipated : R }.
Definition is_motion (b longest : R) (h : motion) : Prop :=
  0 < length_of_hold h <= longest /\ b * (w h * w h) / length_of_hold h <= dissipated h.
Fixpoint at_end (e : element) (s : state e) (motions : list motion) : state e :=
  match motions with [] => s | h :: rest => at_end e (next e s (w h)) rest end.
(* what the tool puts in *)
Fixpoint work (e : element) (s : state e) (motions : list motion) : R :=
  match motions with [] => 0 | h :: rest => force e s * w h + dissipated h + work e (next e s (w h)) rest end.

Theorem passive : forall e b longest, holds e -> 0 <= b -> beta e * longest <= b ->
  forall motions s, Forall (is_motion b longest) motions ->
  energy e (at_end e s motions) - energy e s <= work e s motions.
Proof.
  intros e b longest [N H] B E. induction motions as [|h rest IH]; intros s F; cbn; [lra|].
  inversion F as [|? ? [[P L] D] F2]; subst. specialize (IH (next e s (w h)) F2). specialize (H s (w h)).
  assert (beta e * (w h * w h) <= dissipated h); [|lra].
  apply Rle_trans with (2 := D). apply Rmult_le_reg_r with (1 := P).
  replace (b * (w h * w h) / length_of_hold h * length_of_hold h) with (b * (w h * w h)) by (field; lra).
  replace (beta e * (w h * w h) * length_of_hold h) with (beta e * length_of_hold h * (w h * w h)) by ring.
  apply Rmult_le_compat_r; [apply Rle_0_sqr|]. destruct (Rle_dec 0 (beta e)) as [K|K]; [|nra].
  apply Rle_trans with (2 := E). apply Rmult_le_compat_l; lra.
Qed.

(* Of springs, relaxing modes and springs that slip, side by side, nothing is extracted from rest; nor of anything else
   that holds. *)
Corollary nothing_is_extracted : forall es b longest, Forall holds es -> 0 <= b -> beta (all_of es) * longest <= b ->
  forall motions s, energy (all_of es) s = 0 -> Forall (is_motion b longest) motions -> 0 <= work (all_of es) s motions.
Proof.
  intros es b longest H B E motions s R F.
  pose proof (passive (all_of es) b longest (all_hold es H) B E motions s F) as V.
  destruct (all_hold es H) as [N _]. specialize (N (at_end (all_of es) s motions)). lra.
Qed.
