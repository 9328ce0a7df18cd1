(* Functions of a state to first order at x: what is left is at most a constant times the square of the distance. *)
From Coq Require Import Reals Lra Psatz.
Require Import Statement Branch.
Open Scope R_scope.

Section At.
Variable x : state.

Lemma apart_pos v w : 0 <= apart v w.
Proof. unfold apart; generalize (Rabs_pos (c1 v - c1 w)), (Rabs_pos (c2 v - c2 w)), (Rabs_pos (c3 v - c3 w)); lra. Qed.
Lemma distance_pos y : 0 <= distance y x.
Proof. unfold distance; generalize (apart_pos (fst y) (fst x)), (apart_pos (snd y) (snd x)); lra. Qed.

(* What holds at all states within some distance of x. *)
Definition close (P : state -> Prop) := exists d, 0 < d /\ forall y, distance y x < d -> P y.
Lemma close_and P Q : close P -> close Q -> close (fun y => P y /\ Q y).
Proof.
intros [d [d0 A]] [e [e0 B]]; exists (Rmin d e); split; [apply Rmin_pos; assumption |].
intros y Y; split; [apply A | apply B]; eapply Rlt_le_trans; try exact Y; [apply Rmin_l | apply Rmin_r].
Qed.
Lemma close_mono (P Q : state -> Prop) : (forall y, P y -> Q y) -> close P -> close Q.
Proof. intros I [d [d0 A]]; exists d; auto. Qed.
Lemma close_within d : 0 < d -> close (fun y => distance y x < d).
Proof. intros; exists d; auto. Qed.

Lemma close_all (P : state -> Prop) : (forall y, P y) -> close P.
Proof. intros A; exists 1; split; [lra | auto]. Qed.

(* At most a constant times w near x: with the distance for w it is small, with its square tiny. *)
Definition order (w f : state -> R) := exists C, 0 <= C /\ close (fun y => Rabs (f y) <= C * w y).
Notation small := (order (fun y => distance y x)).
Notation tiny := (order (fun y => distance y x * distance y x)).

Lemma order_ext w f g : close (fun y => f y = g y) -> order w f -> order w g.
Proof.
intros E [C [c0 A]]; exists C; split; [assumption |].
generalize (close_and _ _ E A); apply close_mono; intros y [-> B]; exact B.
Qed.
Lemma order_zero w : order w (fun _ => 0).
Proof. exists 0; split; [lra |]; apply close_all; intros; rewrite Rabs_R0; lra. Qed.
Lemma order_plus w f g : order w f -> order w g -> order w (fun y => f y + g y).
Proof.
intros [C [c0 A]] [E [e0 B]]; exists (C + E); split; [lra |].
generalize (close_and _ _ A B); apply close_mono; intros y [P Q].
generalize (Rabs_triang (f y) (g y)); lra.
Qed.
Lemma order_mult w v f g : order w f -> order v g -> order (fun y => w y * v y) (fun y => f y * g y).
Proof.
intros [C [c0 A]] [E [e0 B]]; exists (C * E); split; [apply Rmult_le_pos; assumption |].
generalize (close_and _ _ A B); apply close_mono; intros y [P Q].
rewrite Rabs_mult; replace (C * E * (w y * v y)) with (C * w y * (E * v y)) by ring.
apply Rmult_le_compat; auto using Rabs_pos.
Qed.
Lemma order_bounded w f g B : order w f -> 0 <= B -> close (fun y => Rabs (g y) <= B) -> order w (fun y => f y * g y).
Proof.
intros A b0 E; destruct (order_mult w (fun _ => 1) f g A) as [C [c0 F]].
{ exists B; split; [assumption |]; revert E; apply close_mono; intros; lra. }
exists C; split; [assumption |]; revert F; apply close_mono; intros y; rewrite Rmult_1_r; trivial.
Qed.
Lemma order_scale w c f : order w f -> order w (fun y => c * f y).
Proof.
intros A; apply order_ext with (fun y => f y * c); [apply close_all; intros; ring |].
apply order_bounded with (Rabs c); auto using Rabs_pos; apply close_all; intros; lra.
Qed.
Lemma tiny_small f : tiny f -> small f.
Proof.
intros [C [c0 A]]; exists C; split; [assumption |].
generalize (close_and _ _ A (close_within 1 Rlt_0_1)); apply close_mono; intros y [B E].
generalize (distance_pos y); intros; eapply Rle_trans; [exact B | apply Rmult_le_compat_l; nra].
Qed.
Lemma small_bounded f : small f -> forall e, 0 < e -> close (fun y => Rabs (f y) <= e).
Proof.
intros [C [c0 A]] e e0.
assert (0 < e / (C + 1)) by (apply Rdiv_lt_0_compat; lra).
generalize (close_and _ _ A (close_within _ H)); apply close_mono; intros y [P Q].
eapply Rle_trans; [exact P |].
apply Rle_trans with ((C + 1) * (e / (C + 1))); [apply Rmult_le_compat; generalize (distance_pos y); lra | right; field; lra].
Qed.

(* f is f(x) + l to first order. *)
Definition expands f l := tiny (fun y => f y - f x - l y) /\ small l.

Lemma expands_small f l : expands f l -> small (fun y => f y - f x).
Proof.
intros [A B]; apply order_ext with (fun y => (f y - f x - l y) + l y); [apply close_all; intros; ring |].
apply order_plus; [apply tiny_small |]; assumption.
Qed.
Lemma expands_self f : small (fun y => f y - f x) -> expands f (fun y => f y - f x).
Proof. split; [|assumption]; apply order_ext with (fun _ => 0); [apply close_all; intros; ring | apply order_zero]. Qed.
Lemma expands_const c : expands (fun _ => c) (fun _ => 0).
Proof. split; [|apply order_zero]; apply order_ext with (fun _ => 0); [apply close_all; intros; ring | apply order_zero]. Qed.
Lemma expands_plus f g l m : expands f l -> expands g m -> expands (fun y => f y + g y) (fun y => l y + m y).
Proof.
intros [A B] [C E]; split; [|apply order_plus; assumption].
apply order_ext with (fun y => (f y - f x - l y) + (g y - g x - m y)); [apply close_all; intros; ring | apply order_plus; assumption].
Qed.
Lemma expands_mult f g l m : expands f l -> expands g m -> expands (fun y => f y * g y) (fun y => f x * m y + g x * l y).
Proof.
intros F G; assert (F' := expands_small _ _ F); assert (G' := expands_small _ _ G); destruct F as [A B], G as [C E].
split; [|apply order_plus; apply order_scale; assumption].
apply order_ext with (fun y => (f x * (g y - g x - m y) + g x * (f y - f x - l y)) + (f y - f x) * (g y - g x)).
{ apply close_all; intros; ring. }
apply order_plus; [apply order_plus; apply order_scale; assumption | apply order_mult; assumption].
Qed.
Lemma expands_opp f l : expands f l -> expands (fun y => - f y) (fun y => - l y).
Proof.
intros [A B]; split.
- apply order_ext with (fun y => -1 * (f y - f x - l y)); [apply close_all; intros; ring | apply order_scale; assumption].
- apply order_ext with (fun y => -1 * l y); [apply close_all; intros; ring | apply order_scale; assumption].
Qed.
Lemma expands_minus f g l m : expands f l -> expands g m -> expands (fun y => f y - g y) (fun y => l y - m y).
Proof. intros; apply expands_plus; [|apply expands_opp]; assumption. Qed.
Lemma expands_inv f l : f x <> 0 -> expands f l -> expands (fun y => / f y) (fun y => - / (f x * f x) * l y).
Proof.
intros Z F; assert (F' := expands_small _ _ F); destruct F as [A B]; split; [|apply order_scale; assumption].
assert (p : 0 < Rabs (f x)) by (apply Rabs_pos_lt; assumption).
assert (N : close (fun y => Rabs (f x) / 2 <= Rabs (f y))).
{ generalize (small_bounded _ F' (Rabs (f x) / 2) ltac:(lra)); apply close_mono; intros y Q.
  generalize (Rabs_triang_inv (f x) (f x - f y)); replace (f x - (f x - f y)) with (f y) by ring.
  rewrite (Rabs_minus_sym (f x) (f y)); lra. }
apply order_ext with (fun y => (/ (f x * f x) * (- f x * (f y - f x - l y) + l y * (f y - f x))) * / f y).
{ revert N; apply close_mono; intros y Q; assert (f y <> 0) by (intros E; rewrite E, Rabs_R0 in Q; lra).
  field; split; assumption. }
apply order_bounded with (2 / Rabs (f x)).
- apply order_scale, order_plus; [apply order_scale; assumption | apply order_mult; assumption].
- apply Rlt_le, Rdiv_lt_0_compat; lra.
- revert N; apply close_mono; intros y Q.
  assert (f y <> 0) by (intros E; rewrite E, Rabs_R0 in Q; lra).
  rewrite Rabs_Rinv by assumption; replace (2 / Rabs (f x)) with (/ (Rabs (f x) / 2)) by (field; lra).
  apply Rinv_le_contravar; lra.
Qed.
Lemma expands_div f g l m : g x <> 0 -> expands f l -> expands g m ->
  expands (fun y => f y / g y) (fun y => f x * (- / (g x * g x) * m y) + / g x * l y).
Proof. intros Z F G; unfold Rdiv; apply expands_mult with (g := fun y => / g y); [|apply expands_inv]; assumption. Qed.

Lemma small_coordinates :
  (small (fun y => c1 (fst y) - c1 (fst x)) /\ small (fun y => c2 (fst y) - c2 (fst x)) /\ small (fun y => c3 (fst y) - c3 (fst x)))
  /\ small (fun y => c1 (snd y) - c1 (snd x)) /\ small (fun y => c2 (snd y) - c2 (snd x)) /\ small (fun y => c3 (snd y) - c3 (snd x)).
Proof.
repeat split; exists 1; (split; [lra | apply close_all; intros y; unfold distance, apart; rewrite Rmult_1_l;
  repeat match goal with |- context [Rabs ?a] => generalize (Rabs_pos a); generalize (Rabs a); intros end; lra]).
Qed.

(* Vector-valued functions whose difference from the value at x is small. *)
Definition follows (v : state -> vec) :=
  small (fun y => c1 (v y) - c1 (v x)) /\ small (fun y => c2 (v y) - c2 (v x)) /\ small (fun y => c3 (v y) - c3 (v x)).
Lemma follows_fst : follows fst. Proof. apply small_coordinates. Qed.
Lemma follows_snd : follows snd. Proof. apply small_coordinates. Qed.
End At.

Notation small x := (order x (fun y => distance y x)).
Notation tiny x := (order x (fun y => distance y x * distance y x)).

Ltac expand := lazymatch goal with
  | |- expands ?x (fun y => @?f y + @?g y) _ => eapply (expands_plus x f g); expand
  | |- expands ?x (fun y => @?f y - @?g y) _ => eapply (expands_minus x f g); expand
  | |- expands ?x (fun y => @?f y * @?g y) _ => eapply (expands_mult x f g); expand
  | |- expands ?x (fun y => @?f y / @?g y) _ => eapply (expands_div x f g); [cbv beta | expand | expand]
  | |- expands ?x (fun y => / @?f y) _ => eapply (expands_inv x f); [cbv beta | expand]
  | |- expands ?x (fun y => - @?f y) _ => eapply (expands_opp x f); expand
  | |- expands ?x ?f _ => first [apply (expands_const x) | apply (expands_self x f); cbv beta]
  end.
