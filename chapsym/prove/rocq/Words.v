(* Sums of words in matrices, over every commutative ring and for matrices of every size n.

   A letter is a matrix n x n, a column or a row; a rule says what the product of two letters is.  `follows` computes
   whether left - right becomes 0 by the rules; `words` says what follows: left = right for all matrices for which the
   rules hold.  Parameter 0 is 1 / N, for the rational numbers of a statement; the others are its parameters. *)

Set Warnings "-notation-overridden,-ambiguous-paths".
From mathcomp Require Import ssreflect ssrfun ssrbool eqtype ssrnat seq path bigop ssralg ssrint matrix.
Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.
Import GRing.Theory.
Open Scope ring_scope.

Inductive scalar := Number of int | Param of nat | SSum of scalar & scalar | SProd of scalar & scalar.
Inductive expression :=
  | Letter of nat | Unit | Scaled of scalar & expression | Sum of expression & expression
  | Prod of expression & expression.

(* A term: an integer, the parameters that multiply it, the letters. *)
Definition term : Type := int * seq nat * seq nat.
Notation polynomial := (seq term).
Definition times (x y : term) : term := (x.1.1 * y.1.1, x.1.2 ++ y.1.2, x.2 ++ y.2).
Definition product (p q : polynomial) : polynomial := [seq times x y | x <- p, y <- q].

(* Rows and columns: n is true, 1 is false. *)
Definition shapes := seq (bool * bool).

Section Compute.
Variable shape : shapes.
Definition source a := (nth (true, true) shape a).1.
Definition target a := (nth (true, true) shape a).2.
Fixpoint ends (s : bool) (w : seq nat) : bool := if w is a :: v then ends (target a) v else s.

Fixpoint scalar_form (c : scalar) : polynomial :=
  match c with
  | Number z => [:: (z, [::], [::])]
  | Param i => [:: (1, [:: i], [::])]
  | SSum a b => scalar_form a ++ scalar_form b
  | SProd a b => product (scalar_form a) (scalar_form b)
  end.

(* The expanded form, the columns, and whether the sizes fit. *)
Fixpoint form (e : expression) : polynomial :=
  match e with
  | Letter a => [:: (1, [::], [:: a])]
  | Unit => [:: (1, [::], [::])]
  | Scaled c e => product (scalar_form c) (form e)
  | Sum e f => form e ++ form f
  | Prod e f => product (form e) (form f)
  end.
Fixpoint columns (s : bool) (e : expression) : bool :=
  match e with
  | Letter a => target a
  | Unit => s
  | Scaled _ e | Sum e _ => columns s e
  | Prod e f => columns (columns s e) f
  end.
Definition goes (s t : bool) (p : polynomial) := all (fun x => ends s x.2 == t) p.
Fixpoint fits (s t : bool) (e : expression) : bool :=
  match e with
  | Letter a => target a == t
  | Unit => s == t
  | Scaled _ e => fits s t e
  | Sum e f => fits s t e && fits s t f
  | Prod e f => let m := columns s e in [&& fits s m e, fits m t f & goes s m (form e)]
  end.

(* Two letters, and their product. *)
Variable rules : seq (nat * nat * expression).
Fixpoint image (rules : seq (nat * nat * expression)) (s : bool) (a b : nat) : option polynomial :=
  if rules is (c, d, e) :: rest then
    if [&& c == a, d == b, source a == s, fits s (target b) e & goes s (target b) (form e)]
    then Some (form e) else image rest s a b
  else None.

(* A word after one rule. *)
Fixpoint once (s : bool) (w : seq nat) : option polynomial :=
  if w is a :: v then
    if (if v is b :: u then image rules s a b else None) is Some p then Some [seq (x.1, x.2 ++ behead v) | x <- p]
    else if once (target a) v is Some p then Some [seq (x.1, a :: x.2) | x <- p] else None
  else None.
Definition step (s : bool) (x : term) : polynomial :=
  if once s x.2 is Some p then [seq (x.1.1 * y.1.1, x.1.2 ++ y.1.2, y.2) | y <- p] else [:: x].
Fixpoint reduced (fuel : nat) (s : bool) (p : polynomial) : polynomial :=
  if fuel is k.+1 then reduced k s (flatten [seq step s x | x <- p]) else p.

(* The same multiplied by N ^ k, without parameter 0; equal words together. *)
Variable N : nat.
Definition zeros (x : term) := count_mem 0%N x.1.2.
Definition cleared (k : nat) (x : term) : term :=
  (x.1.1 * (N ^ (k - zeros x))%N%:Z, sort leq [seq i <- x.1.2 | i != 0%N], x.2).
Fixpoint put (x : term) (p : polynomial) : polynomial :=
  if p is y :: q then
    if (x.1.2 == y.1.2) && (x.2 == y.2) then (x.1.1 + y.1.1, y.1.2, y.2) :: q else y :: put x q
  else [:: x].
Definition vanishes (p : polynomial) : bool :=
  let k := foldr maxn 0%N [seq zeros x | x <- p] in
  all (fun x : term => x.1.1 == 0) (foldr put [::] [seq cleared k x | x <- p]).

Definition follows (s t : bool) (entry : expression * expression) : bool :=
  let (left, right) := entry in
  [&& fits s t left, fits s t right &
      vanishes (reduced 40 s (form left ++ product [:: (-1, [::], [::])] (form right)))].
End Compute.

Section Sound.
Variables (R : comRingType) (n : nat).
Definition size (s : bool) : nat := if s then n else 1%N.
Notation mx := (forall s t : bool, 'M[R]_(size s, size t)).

(* A matrix, a column and a row as letters. *)
Definition square (A : 'M[R]_n) : mx := fun s t => match s, t with true, true => A | _, _ => 0 end.
Definition column (v : 'cV[R]_n) : mx := fun s t => match s, t with true, false => v | _, _ => 0 end.
Definition row (v : 'rV[R]_n) : mx := fun s t => match s, t with false, true => v | _, _ => 0 end.
Definition unit_matrix : mx := fun s t => match s, t with true, true => 1%:M | false, false => 1%:M | _, _ => 0 end.

Variables (shape : shapes) (parameters : seq R) (letters : seq mx).
Notation target := (target shape).
Notation ends := (ends shape).
Definition letter (a : nat) : mx := nth (fun s t => 0) letters a.

Fixpoint scalar_value (c : scalar) : R :=
  match c with
  | Number z => z%:~R
  | Param i => nth 0 parameters i
  | SSum a b => scalar_value a + scalar_value b
  | SProd a b => scalar_value a * scalar_value b
  end.
Fixpoint value (e : expression) (s t : bool) : 'M[R]_(size s, size t) :=
  match e with
  | Letter a => letter a s t
  | Unit => unit_matrix s t
  | Scaled c e => scalar_value c *: value e s t
  | Sum e f => value e s t + value f s t
  | Prod e f => let m := columns shape s e in value e s m *m value f m t
  end.

Fixpoint word (w : seq nat) (s t : bool) : 'M[R]_(size s, size t) :=
  if w is a :: v then letter a s (target a) *m word v (target a) t else unit_matrix s t.
Definition number (x : term) : R := x.1.1%:~R * \prod_(i <- x.1.2) nth 0 parameters i.
Definition sum (p : polynomial) (s t : bool) : 'M[R]_(size s, size t) := \sum_(x <- p) number x *: word x.2 s t.

Lemma unit_matrix1 s : unit_matrix s s = 1%:M. Proof. by case: s. Qed.

Lemma word_cat u v s t : word (u ++ v) s t = word u s (ends s u) *m word v (ends s u) t.
Proof. by elim: u s => [|a u IH] s /=; rewrite ?unit_matrix1 ?mul1mx // IH mulmxA. Qed.

Lemma number_times x y : number (times x y) = number x * number y.
Proof. by rewrite /number /= big_cat intrM mulrACA. Qed.

Lemma sum_cat p q s t : sum (p ++ q) s t = sum p s t + sum q s t.
Proof. exact: big_cat. Qed.

Lemma sum_product s m t p q : goes shape s m p -> sum (product p q) s t = sum p s m *m sum q m t.
Proof.
move=> /allP g; rewrite /sum big_allpairs_dep mulmx_suml; apply: eq_big_seq => x /g /eqP e.
rewrite mulmx_sumr; apply: eq_bigr => y _.
by rewrite number_times /= word_cat e -scalemxAl -scalemxAr scalerA.
Qed.

Lemma scalar_form_ok c s t p : sum (product (scalar_form c) p) s t = scalar_value c *: sum p s t.
Proof.
have w0 : all (fun x : term => x.2 == [::]) (scalar_form c).
  elim: c => //= [a IHa b IHb|a /allP IHa b /allP IHb]; first by rewrite all_cat IHa.
  by apply/allP => _ /allpairsP [[x y] /= [/IHa /eqP ex /IHb /eqP ey ->]] /=; rewrite ex ey.
have -> : scalar_value c = \sum_(x <- scalar_form c) number x.
  elim: c {w0} => [z|i|a IHa b IHb|a IHa b IHb] /=.
  - by rewrite big_seq1 /number /= big_nil mulr1.
  - by rewrite big_seq1 /number /= big_seq1 mul1r.
  - by rewrite big_cat IHa IHb.
  rewrite big_allpairs_dep IHa IHb mulr_suml; apply: eq_bigr => x _; rewrite mulr_sumr.
  by apply: eq_bigr => y _; rewrite number_times.
rewrite /sum big_allpairs_dep scaler_suml; apply: eq_big_seq => x /(allP w0) /eqP e.
by rewrite scaler_sumr; apply: eq_bigr => y _; rewrite number_times /= e scalerA.
Qed.

Lemma form_ok e s t : fits shape s t e -> value e s t = sum (form e) s t.
Proof.
elim: e s t => [a|| c e IH|e IHe f IHf|e IHe f IHf] s t /=.
- by move=> /eqP <-; rewrite /sum big_seq1 /number /= big_nil mulr1 scale1r unit_matrix1 mulmx1.
- by move=> _; rewrite /sum big_seq1 /number /= big_nil mulr1 scale1r.
- by move=> /IH ->; rewrite scalar_form_ok.
- by move=> /andP [/IHe -> /IHf ->]; rewrite sum_cat.
by move=> /and3P [/IHe -> /IHf -> g]; rewrite (sum_product _ _ g).
Qed.

Definition rule_says (r : nat * nat * expression) : Prop :=
  let: (a, b, e) := r in
  value (Prod (Letter a) (Letter b)) (source shape a) (target b) = value e (source shape a) (target b).

Variable rules : seq (nat * nat * expression).
Hypothesis rules_hold : foldr (fun r P => rule_says r /\ P) True rules.

Lemma image_ok s a b p : image shape rules s a b = Some p ->
  goes shape s (target b) p /\ sum p s (target b) = letter a s (target a) *m letter b (target a) (target b).
Proof.
elim: rules rules_hold => //= -[[c d] e] rest IH [r /IH {}IH].
case: ifP => // /and5P [/eqP c_a /eqP d_b /eqP s_a f g] [<-]; subst c d s; split=> //.
by rewrite -form_ok // -r.
Qed.

Lemma once_ok s t w p : once shape rules s w = Some p -> sum p s t = word w s t.
Proof.
elim: w s p => //= a v IH s p.
case e: (if v is b :: u then image shape rules s a b else None) => [q|].
  case: v e {IH} => // b u /image_ok [g e] [<-]; rewrite mulmxA -e /sum big_map mulmx_suml.
  by apply: eq_big_seq => x /(allP g) /eqP h; rewrite word_cat h scalemxAl.
case o: (once _ _ _ _) => [q|] // [<-]; rewrite -(IH _ _ o) /sum big_map mulmx_sumr.
by apply: eq_bigr => x _; rewrite /= scalemxAr.
Qed.

Lemma step_ok s t x : sum (step shape rules s x) s t = number x *: word x.2 s t.
Proof.
rewrite /step; case o: (once _ _ _ _) => [p|]; last by rewrite /sum big_seq1.
rewrite -(once_ok t o) /sum big_map scaler_sumr; apply: eq_bigr => y _.
by rewrite -[(_, _, _)]/(times (x.1, [::]) y) number_times scalerA.
Qed.

Lemma reduced_ok k s t p : sum (reduced shape rules k s p) s t = sum p s t.
Proof.
elim: k p => //= k IH p; rewrite IH; elim: p => [|x p IHp] //=.
by rewrite sum_cat IHp step_ok /sum big_cons.
Qed.

Variable N : nat.
Hypothesis inverse : N%:R * nth 0 parameters 0 = 1.

Lemma cleared_ok k x : (zeros x <= k)%N -> number x = nth 0 parameters 0 ^+ k * number (cleared N k x).
Proof.
case: x => [[z p] w]; rewrite /zeros /number /= => le.
have -> : \prod_(i <- sort leq [seq i <- p | i != 0%N]) nth 0 parameters i
    = \prod_(i <- p | i != 0%N) nth 0 parameters i.
  by rewrite -[RHS]big_filter; apply: perm_big; rewrite perm_sort.
rewrite (bigID (fun i => i == 0%N) xpredT) /= intrM.
have -> : \prod_(i <- p | i == 0%N) nth 0 parameters i = nth 0 parameters 0 ^+ count_mem 0%N p.
  elim: p {le} => [|i p IH] /=; first by rewrite big_nil.
  by rewrite big_cons IH; case: eqP => [->|_] //; rewrite add1n exprS.
have <- : nth 0 parameters 0 ^+ k * (N ^ (k - count_mem 0%N p))%N%:~R = nth 0 parameters 0 ^+ count_mem 0%N p.
  by rewrite -{1}(subnK le) exprD -pmulrn natrX mulrAC -exprMn [_ * N%:R]mulrC inverse expr1n mul1r.
set h := _ ^+ k; set m := _%:~R; set q := \prod_(_ <- _ | _) _.
by rewrite -!mulrA mulrCA.
Qed.

Lemma put_ok x p s t : sum (put x p) s t = number x *: word x.2 s t + sum p s t.
Proof.
elim: p => [|y p IH] /=; first by rewrite /sum big_seq1 big_nil addr0.
case: ifP => [/andP [/eqP e1 /eqP e2]|_]; last by rewrite /sum !big_cons addrCA -IH.
by rewrite /sum !big_cons addrA e2 /number /= e1 intrD mulrDl scalerDl.
Qed.

Lemma vanishes_ok p s t : vanishes N p -> sum p s t = 0.
Proof.
rewrite /vanishes; set k := foldr maxn _ _; set q := foldr put _ _ => /allP v.
have le x : x \in p -> (zeros x <= k)%N.
  rewrite /k; elim: p {k q v} => //= y p IH; rewrite inE leq_max => /orP [/eqP <-|/IH ->]; rewrite ?leqnn ?orbT //.
have -> : sum p s t = nth 0 parameters 0 ^+ k *: sum q s t.
  rewrite /q; move: k le {q v} => k; elim: p => [|x p IH] le; first by rewrite /sum !big_nil scaler0.
  rewrite /= put_ok scalerDr -IH => [|y py]; last by apply: le; rewrite inE py orbT.
  by rewrite scalerA -cleared_ok ?le ?mem_head // /sum big_cons.
rewrite /sum big_seq big1 ?scaler0 // => x /v /eqP z; by rewrite /number z mul0r scale0r.
Qed.

Definition entry_says s t (entry : expression * expression) : Prop := value entry.1 s t = value entry.2 s t.

Lemma follows_ok s t entry : follows shape rules N s t entry -> entry_says s t entry.
Proof.
case: entry => l r /and3P [fl fr /vanishes_ok v]; apply/eqP; rewrite -subr_eq0 /= !form_ok //; apply/eqP.
move: (v s t); rewrite reduced_ok sum_cat -[[:: _]]/(scalar_form (Number (-1))) scalar_form_ok /=.
by rewrite scaleN1r.
Qed.
End Sound.

(* What a theorem says: rules, then equations. *)
Fixpoint under (hypotheses : seq Prop) (G : Prop) : Prop := if hypotheses is H :: rest then H -> under rest G else G.
Fixpoint every (parts : seq Prop) : Prop :=
  if parts is G :: rest then if rest is [::] then G else G /\ every rest else True.

Theorem words (shape : shapes) (rules : seq (nat * nat * expression)) (N : nat) (s t : bool) entries :
  all (follows shape rules N s t) entries ->
  forall (R : comRingType) (n : nat) (parameters : seq R) (letters : seq (forall s t, 'M[R]_(size n s, size n t))),
  N%:R * nth 0 parameters 0 = 1 ->
  under [seq rule_says shape parameters letters r | r <- rules]
    (every [seq entry_says shape parameters letters s t e | e <- entries]).
Proof.
move=> f R n p l h.
have : foldr (fun r P => rule_says shape p l r /\ P) True rules -> every [seq entry_says shape p l s t e | e <- entries].
  move=> H; elim: entries f => //= e rest IH /andP [/(follows_ok H h) E /IH {}IH].
  by case: rest IH.
elim: rules {f} => [|r rest IH] /= H; first exact: H.
by move=> Hr; apply: IH => K; apply: H.
Qed.
