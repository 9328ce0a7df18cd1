(* Expressions at rational points, in every field of characteristic 0.

   `some_point` says that facts computed with rational numbers are true of numbers in the field, the same ones: what
   shows that hypotheses can be true, and that a printed statement is false. *)

Require Import ZArith List Bool QArith Qcanon Lia Field.
Require Import BinList Ring_theory InitialRing Field_theory.
Require Import Identities.
Import ListNotations.
Open Scope nat_scope.
Open Scope field_of_0.

Fixpoint rational_value (point : list Q) (t : tree) : option Q :=
  let both f s t :=
    match rational_value point s, rational_value point t with Some x, Some y => Some (Qred (f x y)) | _, _ => None end in
  match t with
  | Int a => Some (inject_Z a)
  | Rat a b => Some (Qmake a b)
  | Var i => Some (nth 0%Q i point)
  | Sum s t => both Qplus s t
  | Prod s t => both Qmult s t
  | Pow t k => match rational_value point t with
      | Some x => Some ((fix power k := match k with O => 1%Q | S k => Qred (Qmult x (power k)) end) k)
      | None => None end
  | Inv t => match rational_value point t with
      | Some x => if Qeq_bool x 0 then None else Some (Qinv x)
      | None => None end
  end.

Inductive fact := Equal (sides : list (tree * tree)) | Unequal (sides : list (tree * tree)).

Definition equal_at point (sides : tree * tree) : option bool :=
  match rational_value point (fst sides), rational_value point (snd sides) with
  | Some x, Some y => Some (Qeq_bool x y) | _, _ => None end.

Definition holds_at (point : list Q) (f : fact) : bool :=
  match f with
  | Equal sides => forallb (fun s => match equal_at point s with Some true => true | _ => false end) sides
  | Unequal sides => existsb (fun s => match equal_at point s with Some false => true | _ => false end) sides
  end.

Arguments Qred : simpl never.
Section Points.
Variable F : field.
Let Fth := is_field F.
Add Field yet_this_field : Fth.

Definition rational (q : Q) : F := #(Qnum q) / #(Zpos (Qden q)).

Lemma rational_0 : rational 0 = zero.
Proof. unfold rational. simpl. rewrite integer_0. field. apply positive_0. Qed.
Lemma rational_add x y : rational (Qplus x y) = rational x + rational y.
Proof.
  unfold rational. simpl. rewrite integer_add, !integer_mul, Pos2Z.inj_mul, integer_mul. field.
  repeat split; apply positive_0.
Qed.
Lemma rational_mul x y : rational (Qmult x y) = rational x * rational y.
Proof.
  unfold rational. simpl. rewrite Pos2Z.inj_mul, !integer_mul. field. repeat split; apply positive_0.
Qed.
Lemma rational_eq x y : rational x = rational y <-> (x == y)%Q.
Proof.
  assert (Nx := positive_0 F (Qden x)). assert (Ny := positive_0 F (Qden y)).
  assert (E : rational x = rational y <-> #(Qnum x * Zpos (Qden y)) = #(Qnum y * Zpos (Qden x)) :> F).
  { unfold rational. rewrite !integer_mul. split; intros E.
    - replace (#(Qnum x) : F) with (#(Qnum x) / #(Zpos (Qden x)) * #(Zpos (Qden x)) : F) by now field.
      rewrite E. now field.
    - replace (#(Qnum x) : F) with (#(Qnum x) * #(Zpos (Qden y)) / #(Zpos (Qden y)) : F) by now field.
      rewrite E. field. now split. }
  rewrite E. unfold Qeq. split; [ | now intros ->].
  intros H. destruct (Z.eq_dec (Qnum x * Zpos (Qden y)) (Qnum y * Zpos (Qden x))) as [|N]; trivial.
  exfalso. apply (integer_neq0 F (Qnum x * Zpos (Qden y) - Qnum y * Zpos (Qden x))); [lia | ].
  replace (_ - _)%Z with (Qnum x * Zpos (Qden y) + - (Qnum y * Zpos (Qden x)))%Z by lia.
  rewrite integer_add, integer_opp, H. ring.
Qed.
Lemma rational_red x : rational (Qred x) = rational x.
Proof. apply rational_eq, Qred_correct. Qed.
Lemma rational_inv x : Qeq_bool x 0 = false -> rational (Qinv x) = / rational x.
Proof.
  intros H. assert (N : rational x <> zero).
  { rewrite <- rational_0, rational_eq. intros E. apply Qeq_bool_iff in E. rewrite E in H. discriminate. }
  replace (rational (Qinv x)) with (rational (Qinv x) * rational x / rational x) by now field.
  rewrite <- rational_mul. replace (rational (Qmult (Qinv x) x)) with (one : F); [now field | ].
  transitivity (rational 1); [ | apply rational_eq].
  - unfold rational. simpl. rewrite ?integer_1. field. apply (F_1_neq_0 Fth).
  - rewrite Qmult_comm. symmetry. apply Qmult_inv_r. intros E. apply Qeq_bool_iff in E. rewrite E in H. discriminate.
Qed.

Lemma rational_nth i : forall point, nth zero i (map rational point) = rational (nth 0%Q i point).
Proof.
  assert (T : forall point, tl (map rational point) = map rational (tl point)) by now intros [].
  assert (J : forall i point, jump i (map rational point) = map rational (jump i point)).
  { clear i. induction i as [i IH|i IH|]; intros point; simpl; rewrite ?T, ?IH; trivial. }
  induction i as [i IH|i IH|]; intros point; simpl; rewrite ?T, ?J; trivial.
  destruct point; [symmetry; apply rational_0 | reflexivity].
Qed.

(* What a fact says. *)
Definition says (l : list F) (f : fact) : Prop :=
  match f with
  | Equal sides => every (map (fun s => value F l (fst s) = value F l (snd s)) sides)
  | Unequal sides => ~ every (map (fun s => value F l (fst s) = value F l (snd s)) sides)
  end.

Section At.
Variable point : list Q.
Notation l := (map rational point).

Lemma rational_value_ok t : forall x, rational_value point t = Some x -> value F l t = rational x.
Proof.
  induction t as [a|a b|i|s IHs t IHt|s IHs t IHt|t IH k|t IH]; intros x H; cbn [rational_value] in H; cbn [value].
  - injection H as <-. unfold rational. simpl. rewrite ?integer_1. field. apply (F_1_neq_0 Fth).
  - injection H as <-. reflexivity.
  - injection H as <-. apply rational_nth.
  - destruct (rational_value point s) as [y|]; [ | discriminate H].
    destruct (rational_value point t) as [z|]; [ | discriminate H]. replace x with (Qred (Qplus y z)) by congruence.
    rewrite (IHs y), (IHt z), rational_red, rational_add; trivial.
  - destruct (rational_value point s) as [y|]; [ | discriminate H].
    destruct (rational_value point t) as [z|]; [ | discriminate H]. replace x with (Qred (Qmult y z)) by congruence.
    rewrite (IHs y), (IHt z), rational_red, rational_mul; trivial.
  - destruct (rational_value point t) as [y|]; [ | discriminate H]. injection H as <-. rewrite (IH y) by trivial. clear IH.
    induction k; simpl.
    + unfold rational. simpl. rewrite ?integer_1. field. apply (F_1_neq_0 Fth).
    + now rewrite IHk, rational_red, rational_mul.
  - destruct (rational_value point t) as [y|]; [ | discriminate H].
    destruct (Qeq_bool y 0) eqn:N; [discriminate H | ]. injection H as <-. now rewrite (IH y), rational_inv.
Qed.

Lemma equal_at_ok s t b : equal_at point (s, t) = Some b -> value F l s = value F l t <-> b = true.
Proof.
  unfold equal_at. simpl.
  destruct (rational_value point s) as [x|] eqn:X; [ | discriminate].
  destruct (rational_value point t) as [y|] eqn:Y; [ | discriminate].
  intros H. inversion H. rewrite (rational_value_ok _ _ X), (rational_value_ok _ _ Y), rational_eq.
  symmetry. apply Qeq_bool_iff.
Qed.

Lemma every_elim parts : every parts -> Forall (fun G : Prop => G) parts.
Proof.
  induction parts as [|G rest IH]; [constructor | ]. intros H. destruct rest as [|K rest].
  - constructor; trivial.
  - destruct H. constructor; auto.
Qed.

Lemma facts_at facts : forallb (holds_at point) facts = true -> every (map (says l) facts).
Proof.
  intros H. apply every_intro. rewrite Forall_map. apply Forall_forall. intros f I.
  apply (proj1 (forallb_forall _ _) H) in I. destruct f as [sides|sides]; simpl in *.
  - apply every_intro. rewrite Forall_map. apply Forall_forall. intros [s t] J.
    apply (proj1 (forallb_forall _ _) I) in J. destruct (equal_at point (s, t)) as [[|]|] eqn:E; try discriminate J.
    now apply (equal_at_ok _ _ _ E).
  - intros K. apply every_elim in K. rewrite Forall_map in K. apply existsb_exists in I.
    destruct I as [[s t] [I J]]. apply (proj1 (Forall_forall _ _) K) in I.
    destruct (equal_at point (s, t)) as [[|]|] eqn:E; try discriminate J.
    apply (equal_at_ok _ _ _ E) in I. discriminate I.
Qed.
End At.

(* There are n numbers of which P is true. *)
Fixpoint some (n : nat) (P : list F -> Prop) : Prop :=
  match n with O => P [] | S n => exists x, some n (fun l => P (x :: l)) end.

Theorem some_point point facts :
  forallb (holds_at point) facts = true -> some (length point) (fun l => every (map (says l) facts)).
Proof.
  intros H. apply facts_at in H.
  assert (W : forall P : list F -> Prop, P (map rational point) -> some (length point) P).
  { clear. induction point as [|q point IH]; intros P H; simpl; [exact H | ]. exists (rational q). now apply IH. }
  exact (W _ H).
Qed.
End Points.

(* There is such a field: the rational numbers. *)
Lemma rational_numbers_0 p : gen_phiZ 0%Qc 1%Qc Qcplus Qcmult Qcopp (Zpos p) <> 0%Qc.
Proof.
  assert (H : forall p, (this (gen_phiZ 0%Qc 1%Qc Qcplus Qcmult Qcopp (Zpos p)) == inject_Z (Zpos p))%Q).
  { clear. intros p. rewrite (same_genZ (Eqsth Qc) (Eq_ext Qcplus Qcmult Qcopp) Qcrt).
    simpl. induction p using Pos.peano_ind; [reflexivity | ].
    rewrite (ARgen_phiPOS_Psucc (Eqsth Qc) (Eq_ext Qcplus Qcmult Qcopp) (Rth_ARth (Eqsth Qc) (Eq_ext Qcplus Qcmult Qcopp) Qcrt)).
    change (this (1 + gen_phiPOS1 1 Qcplus Qcmult p)%Qc) with (Qred (1 + this (gen_phiPOS1 1%Qc Qcplus Qcmult p))).
    rewrite Qred_correct, IHp. rewrite <- Pos.add_1_l, Pos2Z.inj_add. now rewrite inject_Z_plus. }
  intros E. specialize (H p). rewrite E in H. discriminate H.
Qed.
Definition rational_numbers : field := Build_field Qc 0%Qc 1%Qc Qcplus Qcmult Qcminus Qcopp Qcdiv Qcinv Qcft rational_numbers_0.
