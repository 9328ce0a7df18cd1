(* Identities between quotients of polynomials, over every field of characteristic 0.

   A certificate says of trees `left` and `right`, of relations r1, r2, ... and of cofactors c1, c2, ...:
   the numerator of left - right is c1 r1 + c2 r2 + ... .  `proves` computes whether that is so; `identity` says what
   follows: left = right wherever the relations are 0 and no denominator is.  A variable may be the name of a tree in
   the variables before: wherever it is equal to this tree. *)

Require Import ZArith List Bool Setoid Lia Field.
Require Import BinList Ring_theory Ring_polynom InitialRing Field_theory.
Import ListNotations.

Record field := {
  carrier :> Type;
  zero : carrier; one : carrier;
  plus : carrier -> carrier -> carrier; times : carrier -> carrier -> carrier;
  minus : carrier -> carrier -> carrier; opposite : carrier -> carrier;
  over : carrier -> carrier -> carrier; inverse : carrier -> carrier;
  is_field : field_theory zero one plus times minus opposite over inverse eq;
  characteristic_0 : forall p, gen_phiZ zero one plus times opposite (Zpos p) <> zero
}.
Arguments zero {f}. Arguments one {f}. Arguments plus {f}. Arguments times {f}. Arguments minus {f}.
Arguments opposite {f}. Arguments over {f}. Arguments inverse {f}.

(* The integer z in a field. *)
Definition integer {F : field} (z : Z) : F := gen_phiZ zero one plus times opposite z.
Arguments integer {F} z : simpl never.
Fixpoint power {F : field} (x : F) (k : nat) : F := match k with O => one | S k => times x (power x k) end.

Declare Scope field_of_0.
Delimit Scope field_of_0 with F.
Notation "# z" := (integer z%Z) (at level 1, z at level 0, format "# z") : field_of_0.
Infix "+" := plus : field_of_0.
Infix "*" := times : field_of_0.
Infix "/" := over : field_of_0.
Notation "/ x" := (inverse x) : field_of_0.
Notation "x ^ k" := (power x k%nat) : field_of_0.
Open Scope nat_scope.
Open Scope field_of_0.

(* Expressions as data.  A pair of integers is a quotient. *)
Inductive tree :=
  | Int (a : Z) | Rat (a : Z) (b : positive) | Var (i : positive)
  | Sum (s t : tree) | Prod (s t : tree) | Pow (t : tree) (k : nat) | Inv (t : tree).

Fixpoint same (s t : tree) : bool :=
  match s, t with
  | Int a, Int b => Z.eqb a b
  | Rat a b, Rat c d => Z.eqb a c && Pos.eqb b d
  | Var i, Var j => Pos.eqb i j
  | Sum a b, Sum c d | Prod a b, Prod c d => same a c && same b d
  | Pow a k, Pow c n => same a c && Nat.eqb k n
  | Inv a, Inv c => same a c
  | _, _ => false
  end.

Lemma same_eq s : forall t, same s t = true -> s = t.
Proof.
  induction s; intros [] H; simpl in H; try discriminate H;
    repeat match goal with E : _ && _ = true |- _ => apply andb_true_iff in E; destruct E end;
    f_equal; auto; (now apply Z.eqb_eq) || (now apply Pos.eqb_eq) || (now apply Nat.eqb_eq).
Qed.

Notation polynomial := (Pol Z).
Notation "x +! y" := (Padd 0%Z Z.add Zeq_bool x y) (at level 50).
Notation "x *! y" := (Pmul 0%Z 1%Z Z.add Z.mul Zeq_bool x y) (at level 40).
Notation constant := (@Pc Z).
Notation variable i := (mk_X 0%Z 1%Z i).
Notation agree := (Peq Zeq_bool).
Fixpoint ppow (p : polynomial) (k : nat) : polynomial :=
  match k with O => constant 1%Z | 1 => p | S k => p *! ppow p k end.

(* numerator / (scale * product of factor ^ power) *)
Definition factors := list (polynomial * nat).
Record quotient := Quotient { numerator : polynomial; scale : positive; denominators : factors }.

Definition lifted (p : polynomial) (k : positive) (more : factors) : polynomial :=
  fold_left (fun p '(f, n) => p *! ppow f n) more (if Pos.eqb k 1 then p else p *! constant (Zpos k)).

(* The power of a factor in a product, and the rest of it. *)
Fixpoint taken (f : polynomial) (ds : factors) : nat * factors :=
  match ds with
  | [] => (O, [])
  | (g, n) :: ds => if agree g f then (n, ds) else let (m, rest) := taken f ds in (m, (g, n) :: rest)
  end.

(* A common multiple of two products, and what each lacks. *)
Fixpoint common (ds es : factors) : factors * factors * factors :=
  match es with
  | [] => (ds, [], ds)
  | (f, n) :: es =>
      let (m, rest) := taken f ds in
      let '(all, a, b) := common rest es in
      if Nat.eqb m n then ((f, n) :: all, a, b)
      else if Nat.ltb m n then ((f, n) :: all, (f, n - m)%nat :: a, b)
      else ((f, m) :: all, a, (f, m - n)%nat :: b)
  end.

Definition qadd (x y : quotient) : quotient :=
  let '(all, a, b) := common (denominators x) (denominators y) in
  let '(_, (i, j)) := Pos.ggcd (scale x) (scale y) in
  Quotient (lifted (numerator x) j a +! lifted (numerator y) i b) (scale x * j) all.

Definition qmul (x y : quotient) : quotient :=
  let fix put ds es := match es with
    | [] => ds
    | (f, n) :: es => let (m, rest) := taken f ds in (f, m + n)%nat :: put rest es
    end in
  Quotient (numerator x *! numerator y) (scale x * scale y) (put (denominators x) (denominators y)).

Definition qnumber (a : Z) (b : positive) := Quotient (constant a) b [].
Definition qvariable i := Quotient (variable i) 1 [].
Fixpoint qpow (x : quotient) (k : nat) : quotient :=
  match k with O => qnumber 1 1 | 1 => x | S k => qmul x (qpow x k) end.

(* 1 / x, for what is not 0. *)
Definition qinv (x : quotient) : quotient :=
  Quotient (lifted (constant 1%Z) (scale x) (denominators x)) 1 [(numerator x, 1%nat)].

(* What names stand for. *)
Definition names := list (positive * quotient).
Fixpoint meaning (ns : names) (i : positive) : quotient :=
  match ns with [] => qvariable i | (j, q) :: ns => if Pos.eqb j i then q else meaning ns i end.

(* The quotient of an expression (or of its inverse), where the denominators are among those known not to be 0. *)
Fixpoint form (known : list tree) (ns : names) (inverted : bool) (t : tree) : option quotient :=
  let both inverted f s t :=
    match form known ns inverted s, form known ns inverted t with Some x, Some y => Some (f x y) | _, _ => None end in
  if inverted then
    match t with
    | Int (Zpos a) => Some (qnumber 1 a)
    | Int (Zneg a) => Some (qnumber (-1) a)
    | Rat (Zpos a) b => Some (qnumber (Zpos b) a)
    | Rat (Zneg a) b => Some (qnumber (Zneg b) a)
    | Var i => if existsb (same t) known then Some (qinv (meaning ns i)) else None
    | Sum s u => if existsb (same t) known then option_map qinv (both false qadd s u) else None
    | Prod s t => both true qmul s t
    | Pow t k => option_map (fun x => qpow x k) (form known ns true t)
    | Inv t => if existsb (same t) known then form known ns false t else None
    | _ => None
    end
  else
    match t with
    | Int a => Some (qnumber a 1)
    | Rat a b => Some (qnumber a b)
    | Var i => Some (meaning ns i)
    | Sum s t => both false qadd s t
    | Prod s t => both false qmul s t
    | Pow t k => option_map (fun x => qpow x k) (form known ns false t)
    | Inv t => form known ns true t
    end.

(* The names in the order of their definitions. *)
Fixpoint named (known : list tree) (ns : names) (definitions : list (positive * tree)) : option names :=
  match definitions with
  | [] => Some ns
  | (i, t) :: rest => match form known ns false t with Some q => named known ((i, q) :: ns) rest | None => None end
  end.

Definition combination (cofactors relations : list tree) : tree :=
  fold_right (fun cr t => Sum (Prod (fst cr) (snd cr)) t) (Int 0) (combine cofactors relations).

Fixpoint leading (p : polynomial) : Z :=
  match p with Pc a => a | Pinj _ p => leading p | PX p _ _ => leading p end.

(* The numerator of left - right is a multiple of the combination of the relations. *)
Definition proves (known : list tree) (ns : names) (relations : list tree) (entry : tree * tree * list tree) : bool :=
  let '(lhs, rhs, cofactors) := entry in
  match form known ns false (Sum lhs (Prod (Int (-1)) rhs)), form [] [] false (combination cofactors relations) with
  | Some x, Some y =>
      let p := numerator x in
      let q := numerator y in
      agree p (constant 0%Z) ||
        negb (Z.eqb (leading q) 0) && agree (p *! constant (leading q)) (q *! constant (leading p))
  | _, _ => false
  end.

Section Sound.
Variable F : field.
Let Fth := is_field F.
Let Rth := F_R Fth.
Add Field the_field : Fth.
Let ext := Eq_ext (@plus F) times opposite.
Let almost := Rth_ARth (Eqsth F) ext Rth.
Let morph := gen_phiZ_morph (Eqsth F) ext Rth.

Variable l : list F.

Fixpoint value (t : tree) : F :=
  match t with
  | Int a => #a
  | Rat a b => #a / #(Zpos b)
  | Var i => nth zero i l
  | Sum s t => value s + value t
  | Prod s t => value s * value t
  | Pow t k => value t ^ k
  | Inv t => / value t
  end.

Definition at_l (p : polynomial) : F := Pphi zero plus times integer l p.
Notation "p @" := (at_l p) (at level 10).

Lemma at_constant a : (constant a) @ = #a. Proof. reflexivity. Qed.
Lemma at_add p q : (p +! q) @ = p @ + q @.
Proof. apply (Padd_ok (Eqsth F) ext almost morph). Qed.
Lemma at_mul p q : (p *! q) @ = p @ * q @.
Proof. apply (Pmul_ok (Eqsth F) ext almost morph). Qed.
Lemma at_variable i : (variable i) @ = nth zero i l.
Proof. symmetry. apply (mkX_ok (Eqsth F) ext almost morph). Qed.
Lemma at_agree p q : agree p q = true -> p @ = q @.
Proof. intros H. exact (Peq_ok (Eqsth F) ext morph p q H l). Qed.

Lemma integer_add a b : #(a + b) = #a + #b :> F. Proof. apply (morph_add morph). Qed.
Lemma integer_mul a b : #(a * b) = #a * #b :> F. Proof. apply (morph_mul morph). Qed.
Lemma integer_opp a : #(- a) = opposite #a :> F. Proof. apply (morph_opp morph). Qed.
Lemma integer_0 : #0 = zero :> F. Proof. reflexivity. Qed.
Lemma integer_1 : #1 = one :> F. Proof. reflexivity. Qed.
Lemma positive_0 p : #(Zpos p) <> zero :> F. Proof. apply (characteristic_0 F). Qed.
Lemma integer_neq0 a : a <> 0%Z -> #a <> zero :> F.
Proof.
  destruct a as [|p|p]; intros H; [easy | apply positive_0 | ].
  change (Zneg p) with (- Zpos p)%Z. rewrite integer_opp. intros E. apply (positive_0 p).
  replace (#(Zpos p) : F) with (opposite (opposite #(Zpos p)) : F) by ring. rewrite E. ring.
Qed.

Lemma times_neq0 x y : x <> zero -> y <> zero -> x * y <> (zero : F).
Proof. intros Hx Hy E. apply Hy. replace y with (/ x * (x * y)) by (field; trivial). rewrite E. ring. Qed.
Lemma factor_neq0 x y : x * y <> (zero : F) -> x <> zero /\ y <> zero.
Proof. intros H; split; intros E; apply H; rewrite E; ring. Qed.
Lemma power_neq0 x k : x <> zero -> x ^ k <> (zero : F).
Proof.
  intros H; induction k; simpl; [apply (F_1_neq_0 Fth) | now apply times_neq0].
Qed.
Lemma power_add (x : F) m n : x ^ (m + n) = x ^ m * x ^ n.
Proof. induction m; simpl; [ring | rewrite IHm; ring]. Qed.
Lemma at_power p k : (ppow p k) @ = p @ ^ k.
Proof.
  induction k as [|[|k] IH]; [reflexivity | simpl; ring | ].
  change (ppow p (S (S k))) with (p *! ppow p (S k)). now rewrite at_mul, IH.
Qed.

Fixpoint product (ds : factors) : F := match ds with [] => one | (f, n) :: ds => f @ ^ n * product ds end.
Definition fine (ds : factors) := Forall (fun d => (fst d) @ <> zero) ds.

Lemma fine_product ds : fine ds -> product ds <> zero.
Proof.
  induction 1 as [|[f n] ds H _ IH]; simpl; [apply (F_1_neq_0 Fth) | ].
  apply times_neq0; trivial. now apply power_neq0.
Qed.

Lemma at_lifted more : forall p k, (lifted p k more) @ = p @ * #(Zpos k) * product more.
Proof.
  unfold lifted. intros p k.
  replace (p @ * #(Zpos k)) with ((if Pos.eqb k 1 then p else p *! constant (Zpos k)) @).
  - generalize (if Pos.eqb k 1 then p else p *! constant (Zpos k)). clear p k.
    induction more as [|[f n] more IH]; intros p; simpl; [ring | ].
    rewrite IH, at_mul, at_power. ring.
  - destruct (Pos.eqb_spec k 1) as [->|]; [rewrite ?integer_1; ring | now rewrite at_mul].
Qed.

Lemma taken_ok f ds : let (m, rest) := taken f ds in
  product ds = f @ ^ m * product rest /\ (fine ds -> fine rest).
Proof.
  induction ds as [|[g n] ds IH]; simpl; [split; [ring | trivial] | ].
  destruct (agree g f) eqn:E.
  - rewrite (at_agree _ _ E). split; [reflexivity | ]. intros H; now inversion H.
  - destruct (taken f ds) as [m rest]. destruct IH as [IH1 IH2]. simpl. rewrite IH1. split; [ring | ].
    intros H; inversion H; subst. constructor; [trivial | now apply IH2].
Qed.

Lemma common_ok es : forall ds, let '(all, a, b) := common ds es in
  product all = product ds * product a /\ product all = product es * product b /\
  (fine ds -> fine es -> fine all).
Proof.
  induction es as [|[f n] es IH]; intros ds; simpl; [repeat split; trivial; ring | ].
  generalize (taken_ok f ds). destruct (taken f ds) as [m rest]. intros [H1 H2].
  specialize (IH rest). destruct (common rest es) as [[all a] b]. destruct IH as [I1 [I2 I3]].
  assert (I : fine ds -> fine ((f, n) :: es) -> forall k, fine ((f, k) :: all)).
  { intros Hd He k. inversion He; subst. constructor; [trivial | apply I3; auto]. }
  assert (S : forall i j, (i <= j)%nat -> (f @ ^ j : F) = f @ ^ i * f @ ^ (j - i)).
  { intros i j L. rewrite <- power_add. f_equal. lia. }
  rewrite H1. destruct (Nat.eqb_spec m n) as [->|N]; [ | destruct (Nat.ltb_spec m n) as [L|L]];
    (split; [ | split; [ | intros; now apply I]]); simpl; try (rewrite I1; ring); try (rewrite I2; ring).
  - rewrite (S m n), I1 by lia. ring.
  - rewrite (S n m), I2 by lia. ring.
Qed.

(* What it means that a quotient is the value x. *)
Definition is (q : quotient) (x : F) :=
  fine (denominators q) /\ x * (#(Zpos (scale q)) * product (denominators q)) = (numerator q) @.

Lemma is_neq0 q x : is q x -> #(Zpos (scale q)) * product (denominators q) <> zero :> F.
Proof. intros [H _]. apply times_neq0; [apply positive_0 | now apply fine_product]. Qed.

Lemma is_number a b : is (qnumber a b) (#a / #(Zpos b)).
Proof. split; [constructor | ]. simpl. rewrite at_constant. field. apply positive_0. Qed.

Lemma is_variable i : is (qvariable i) (nth zero i l).
Proof. split; [constructor | ]. simpl numerator. rewrite at_variable. simpl. rewrite ?integer_1. ring. Qed.

Lemma is_add p x q y : is p x -> is q y -> is (qadd p q) (x + y).
Proof.
  unfold is, qadd. intros [P1 P2] [Q1 Q2].
  generalize (common_ok (denominators q) (denominators p)).
  destruct (common (denominators p) (denominators q)) as [[all a] b]. intros [A [B C]].
  generalize (Pos.ggcd_correct_divisors (scale p) (scale q)).
  destruct (Pos.ggcd (scale p) (scale q)) as [g [i j]]. simpl. intros [I J]. split; [auto | ].
  rewrite at_add, !at_lifted, <- P2, <- Q2, Pos2Z.inj_mul, integer_mul.
  transitivity (x * (#(Zpos (scale p)) * product (denominators p)) * #(Zpos j) * product a +
                y * (#(Zpos (scale p * j)) * product all)).
  { rewrite A, Pos2Z.inj_mul, integer_mul. ring. }
  f_equal. rewrite B. replace (scale p * j)%positive with (scale q * i)%positive.
  - rewrite Pos2Z.inj_mul, integer_mul. ring.
  - rewrite I, J. lia.
Qed.

Lemma is_mul p x q y : is p x -> is q y -> is (qmul p q) (x * y).
Proof.
  unfold is, qmul. intros [P1 P2] [Q1 Q2].
  simpl. rewrite at_mul, <- P2, <- Q2, Pos2Z.inj_mul, integer_mul. clear P2 Q2. revert P1 Q1.
  generalize (denominators p) (denominators q). intros ds es. revert ds.
  induction es as [|[f n] es IH]; intros ds Hd He; [simpl; split; [trivial | ring] | ].
  generalize (taken_ok f ds). destruct (taken f ds) as [m rest]. intros [H1 H2].
  inversion He; subst. destruct (IH rest) as [I1 I2]; auto.
  split; [constructor; auto | ]. simpl product. rewrite power_add, H1.
  match type of I2 with x * y * (_ * _ * ?z) = _ => set (r := z) in * end.
  transitivity (f @ ^ m * f @ ^ n * (x * y * (#(Zpos (scale p)) * #(Zpos (scale q)) * r))); [ring | ].
  rewrite I2. ring.
Qed.

Lemma is_pow p x k : is p x -> is (qpow p k) (x ^ k).
Proof.
  intros H. induction k as [|[|k] IH].
  - split; [constructor | ]. simpl. rewrite at_constant, ?integer_1. ring.
  - simpl. replace (x * one) with x by ring. trivial.
  - change (is (qmul p (qpow p (S k))) (x * x ^ (S k))). now apply is_mul.
Qed.

Lemma is_inv p x : x <> zero -> is p x -> is (qinv p) (/ x).
Proof.
  intros N H. assert (D := is_neq0 p x H). destruct H as [H1 H2]. split.
  - constructor; [ | constructor]. simpl. rewrite <- H2. now apply times_neq0.
  - simpl. rewrite at_lifted, at_constant, ?integer_1, <- H2. field. trivial.
Qed.

Variable known : list tree.
Hypothesis known_neq0 : Forall (fun t => value t <> zero) known.

Lemma known_ok t : existsb (same t) known = true -> value t <> zero.
Proof.
  intros H. apply existsb_exists in H. destruct H as [s [H E]]. rewrite (same_eq _ _ E).
  now apply (proj1 (Forall_forall _ _) known_neq0).
Qed.

Lemma inverse_times x y : x <> zero -> y <> zero -> / (x * y) = / x * / y :> F.
Proof. intros. field. now split. Qed.

Lemma inverse_power x k : x <> zero -> / (x ^ k) = (/ x) ^ k :> F.
Proof.
  intros H. induction k; simpl; [field; apply (F_1_neq_0 Fth) | ].
  rewrite <- IHk, inverse_times; trivial. now apply power_neq0.
Qed.

(* Names have the values of what they stand for. *)
Definition right_names (ns : names) := Forall (fun n => is (snd n) (nth zero (fst n) l)) ns.

Lemma is_meaning ns i : right_names ns -> is (meaning ns i) (nth zero i l).
Proof.
  induction 1 as [|[j q] ns H _ IH]; simpl; [apply is_variable | ].
  destruct (Pos.eqb_spec j i) as [<-|]; trivial.
Qed.

Lemma form_ok ns : right_names ns -> forall t inverted q, form known ns inverted t = Some q ->
  if inverted then value t <> zero /\ is q (/ value t) else is q (value t).
Proof.
  intros right_ns t.
  assert (N : forall a b, #(Zpos a) <> zero :> F /\ #(Zneg b) <> zero :> F).
  { intros. split; now apply integer_neq0. }
  induction t as [a|a b|i|s IHs t IHt|s IHs t IHt|t IH k|t IH]; intros [|] q H; cbn [form] in H; cbn [value].
  - destruct a as [|a|a]; inversion H.
    + split; [apply N; exact a | ]. replace (/ #(Zpos a) : F) with (#1 / #(Zpos a) : F); [apply is_number | ].
      rewrite ?integer_1. field. apply N. exact a.
    + split; [now apply integer_neq0 | ]. replace (/ #(Zneg a) : F) with (#(-1) / #(Zpos a) : F); [apply is_number | ].
      assert (O1 : #(-1) = opposite one :> F) by apply (integer_opp 1).
      assert (O2 : #(Zneg a) = opposite #(Zpos a) :> F) by apply (integer_opp (Zpos a)).
      assert (N2 := integer_neq0 (Zneg a)). rewrite O1, O2 in *. field.
      repeat split; (apply positive_0 || now apply N2).
  - inversion H. replace (#a : F) with (#a / #1 : F); [apply is_number | ]. rewrite ?integer_1. field.
    apply (F_1_neq_0 Fth).
  - destruct a as [|a|a]; inversion H.
    + assert (Na := proj1 (N a a)). assert (Nb := proj1 (N b b)).
      assert (E : / (#(Zpos a) / #(Zpos b)) = #(Zpos b) / #(Zpos a) :> F) by (field; now split).
      split; [ | rewrite E; apply is_number]. intros Z. apply Na.
      replace (#(Zpos a) : F) with (#(Zpos a) / #(Zpos b) * #(Zpos b) : F) by (field; trivial). rewrite Z. ring.
    + assert (Na := proj1 (N a a)). assert (Nb := proj1 (N b b)). assert (Na' := proj2 (N a a)).
      assert (O : #(Zneg a) = opposite #(Zpos a) :> F) by apply (integer_opp (Zpos a)).
      assert (E : / (#(Zneg a) / #(Zpos b)) = #(Zneg b) / #(Zpos a) :> F).
      { change (Zneg b) with (- Zpos b)%Z. rewrite integer_opp, O. field. now split. }
      split; [ | rewrite E; apply is_number]. intros Z. apply Na'.
      replace (#(Zneg a) : F) with (#(Zneg a) / #(Zpos b) * #(Zpos b) : F) by (field; trivial). rewrite Z. ring.
  - inversion H. apply is_number.
  - destruct (existsb (same (Var i)) known) eqn:K; inversion H. apply known_ok in K. split; [exact K | ].
    apply is_inv; [exact K | now apply is_meaning].
  - inversion H. now apply is_meaning.
  - destruct (existsb (same (Sum s t)) known) eqn:K; [ | discriminate H]. apply known_ok in K.
    destruct (form known ns false s) as [x|] eqn:Es; [ | discriminate H].
    destruct (form known ns false t) as [y|] eqn:Et; [ | discriminate H]. inversion H. split; [exact K | ].
    apply is_inv; [exact K | apply is_add; [now apply (IHs false) | now apply (IHt false)]].
  - destruct (form known ns false s) as [x|] eqn:Es; [ | discriminate H].
    destruct (form known ns false t) as [y|] eqn:Et; [ | discriminate H]. inversion H.
    apply is_add; [now apply (IHs false) | now apply (IHt false)].
  - destruct (form known ns true s) as [x|] eqn:Es; [ | discriminate H].
    destruct (form known ns true t) as [y|] eqn:Et; [ | discriminate H]. inversion H.
    destruct (IHs true x Es) as [S1 S2]. destruct (IHt true y Et) as [T1 T2].
    split; [now apply times_neq0 | ]. rewrite inverse_times by trivial. now apply is_mul.
  - destruct (form known ns false s) as [x|] eqn:Es; [ | discriminate H].
    destruct (form known ns false t) as [y|] eqn:Et; [ | discriminate H]. inversion H.
    apply is_mul; [now apply (IHs false) | now apply (IHt false)].
  - destruct (form known ns true t) as [x|] eqn:Et; [ | discriminate H]. inversion H.
    destruct (IH true x Et) as [T1 T2]. split; [now apply power_neq0 | ].
    rewrite inverse_power by trivial. now apply is_pow.
  - destruct (form known ns false t) as [x|] eqn:Et; [ | discriminate H]. inversion H. apply is_pow. now apply (IH false).
  - destruct (existsb (same t) known) eqn:K; [ | discriminate H]. apply known_ok in K.
    assert (J : / value t <> zero).
    { intros E. apply (F_1_neq_0 Fth). transitivity (/ value t * value t); [now field | rewrite E; ring]. }
    split; [exact J | ]. replace (/ / value t) with (value t) by (field; repeat split; trivial; apply (F_1_neq_0 Fth)). now apply (IH false).
  - now apply (IH true).
Qed.

Lemma named_ok definitions : Forall (fun d => nth zero (fst d) l = value (snd d)) definitions ->
  forall ns ms, right_names ns -> named known ns definitions = Some ms -> right_names ms.
Proof.
  induction 1 as [|[i t] rest H _ IH]; simpl; intros ns ms R E; [now injection E as <- | ].
  destruct (form known ns false t) as [q|] eqn:T; [ | discriminate E].
  apply IH in E; trivial. constructor; trivial. simpl in *. rewrite H. now apply (form_ok ns R t false).
Qed.

(* What a theorem says: hypotheses, then the equations. *)
Fixpoint under (hypotheses : list Prop) (G : Prop) : Prop :=
  match hypotheses with [] => G | H :: rest => H -> under rest G end.
Fixpoint every (parts : list Prop) : Prop :=
  match parts with [] => True | [G] => G | G :: rest => G /\ every rest end.

Lemma under_intro hypotheses (G : Prop) : (Forall (fun H : Prop => H) hypotheses -> G) -> under hypotheses G.
Proof. induction hypotheses as [|H rest IH]; simpl; intros K; [now apply K | ]. intros h. apply IH. auto. Qed.
Lemma every_intro parts : Forall (fun G : Prop => G) parts -> every parts.
Proof. induction 1 as [|G rest g _ IH]; simpl; trivial. destruct rest; [exact g | now split]. Qed.
End Sound.

Section Identity.
Variable F : field.
Let Fth := is_field F.
Add Field this_field : Fth.
Variable l : list F.

Definition identity_says relations definitions known (entries : list (tree * tree * list tree)) : Prop :=
  under (map (fun r => value F l r = zero) relations
      ++ map (fun d => value F l (Var (fst d)) = value F l (snd d)) definitions
      ++ map (fun t => value F l t <> zero) known)
    (every (map (fun e => value F l (fst (fst e)) = value F l (snd (fst e))) entries)).

Lemma combination_ok relations : Forall (fun r => value F l r = zero) relations ->
  forall cofactors, value F l (combination cofactors relations) = zero.
Proof.
  induction 1 as [|r rest H _ IH]; intros [|c cofactors]; try reflexivity.
  change (value F l c * value F l r + value F l (combination cofactors rest) = zero).
  rewrite IH, H. ring.
Qed.

Theorem identity relations definitions known entries :
  match named known [] definitions with Some ns => forallb (proves known ns relations) entries | None => false end = true ->
  identity_says relations definitions known entries.
Proof.
  intros C. apply under_intro. rewrite !Forall_app, !Forall_map. intros [R [D K]]. apply every_intro.
  destruct (named known [] definitions) as [ns|] eqn:N; [ | discriminate C].
  apply (named_ok F l known K definitions D [] ns (Forall_nil _)) in N. rename N into right_ns.
  rewrite Forall_map. apply Forall_forall. intros [[s t] cofactors] I. simpl.
  apply (proj1 (forallb_forall _ _) C) in I. unfold proves in I.
  destruct (form known ns false (Sum s (Prod (Int (-1)) t))) as [x|] eqn:X; [ | discriminate I].
  destruct (form [] [] false (combination cofactors relations)) as [y|] eqn:Y; [ | discriminate I].
  cbv zeta in I.
  apply (form_ok F l known K ns right_ns) in X. assert (N := is_neq0 F l _ _ X). destruct X as [_ X].
  apply (form_ok F l [] (Forall_nil _) [] (Forall_nil _)) in Y. destruct Y as [_ Y].
  rewrite (combination_ok relations R cofactors) in Y.
  assert (Z : at_l F l (numerator x) = zero).
  { destruct (agree (numerator x) (constant 0%Z)) eqn:A; [now apply at_agree with (l := l) in A | ].
    rewrite orb_false_l in I. apply andb_true_iff in I. destruct I as [I1 I2].
    apply at_agree with (F := F) (l := l) in I2. rewrite !at_mul, <- Y in I2.
    assert (L : #(leading (numerator y)) <> zero :> F).
    { apply integer_neq0. intros E. rewrite E in I1. discriminate I1. }
    replace (at_l F l (numerator x)) with
      (/ #(leading (numerator y)) * (at_l F l (numerator x) * #(leading (numerator y)))) by now field.
    etransitivity; [apply f_equal; exact I2 | ]. ring. }
  rewrite Z in X. set (d := #(Zpos (scale x)) * product F l (denominators x)) in *. simpl in X.
  replace (value F l s) with (/ d * ((value F l s + #(-1) * value F l t) * d) + value F l t).
  - rewrite X. ring.
  - assert (O : #(-1) = opposite one :> F) by reflexivity. rewrite O. now field.
Qed.
End Identity.
