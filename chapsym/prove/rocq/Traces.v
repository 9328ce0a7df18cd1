(* Traces of sums of words: words that are rotations of one another have one trace, and so have transposes.

   `traced` computes whether tr left - tr right becomes 0 by the rules, by rotations and, where 2 divides N, by
   transposes: half the sum of two words with one trace.  `traces` says what follows. *)

Set Warnings "-notation-overridden,-ambiguous-paths".
From mathcomp Require Import ssreflect ssrfun ssrbool eqtype ssrnat seq path bigop ssralg ssrint matrix.
Require Import Words.
Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.
Import GRing.Theory.
Open Scope ring_scope.

Notation polynomial := (seq term).
(* A letter, and the letter that is its transpose, or minus its transpose. *)
Notation transpose := (nat * nat * bool)%type.
(* A matrix, and whether it is of size n (or 1); None is 0. *)
Notation side := (option (bool * expression)).

Section Compute.
Variables (shape : shapes) (rules : seq (nat * nat * expression)) (turns : seq transpose) (N : nat).
Notation source := (source shape).
Notation target := (target shape).

(* Whether sizes fit in a word from s to t; a word that can be rotated, and its size. *)
Fixpoint walks (s : bool) (w : seq nat) (t : bool) : bool :=
  if w is a :: v then (source a == s) && walks (target a) v t else s == t.
Definition closed (s : bool) (w : seq nat) := (w != [::]) && walks s w s.
Definition base (w : seq nat) := source (head 0%N w).

(* After one rule, or after one rotation and one rule. *)
Definition led (w : seq nat) := if once shape rules (base w) w is Some _ then w else rotr 1 w.
Definition round (x : term) : polynomial :=
  let w := led x.2 in
  let p := step shape rules (base w) (x.1, w) in
  if closed (base x.2) x.2 && all (fun y : term => closed (base w) y.2) p then p else [:: x].
Fixpoint rounds (fuel : nat) (p : polynomial) : polynomial :=
  if fuel is k.+1 then rounds k (flatten [seq round x | x <- p]) else p.

Fixpoint turn (ts : seq transpose) (a : nat) : option (nat * bool) :=
  if ts is (b, c, minus) :: rest then
    if [&& source b == target c & target b == source c] then
      if a == b then Some (c, minus) else if a == c then Some (b, minus) else turn rest a
    else turn rest a
  else None.
Fixpoint turned (w : seq nat) : option (seq nat * bool) :=
  if w is a :: v then
    if (turn turns a, turned v) is (Some (b, m), Some (u, k)) then Some (rcons u b, m (+) k) else None
  else Some ([::], false).
(* A term with the same trace. *)
Definition flip (x : term) : term :=
  if turned x.2 is Some (w, minus) then
    if closed (base x.2) x.2 then ((if minus then - x.1.1 else x.1.1), x.1.2, w) else x
  else x.

Fixpoint put_rotated (x : term) (p : polynomial) : polynomial :=
  if p is y :: q then
    if [&& x.1.2 == y.1.2, closed (base x.2) x.2 & has (fun i => rot i x.2 == y.2) (iota 0 (seq.size x.2))]
    then (x.1.1 + y.1.1, y.1.2, y.2) :: q else y :: put_rotated x q
  else [:: x].
Definition vanish (p : polynomial) : bool :=
  let k := foldr maxn 0%N [seq zeros x | x <- p] in
  all (fun x : term => x.1.1 == 0) (foldr put_rotated [::] [seq cleared N k x | x <- p]).

Definition terms (a : side) : polynomial := if a is Some (_, e) then form e else [::].
Definition proper (a : side) : bool :=
  if a is Some (s, e) then fits shape s s e && all (fun x : term => closed s x.2) (form e) else true.
Definition traced (entry : side * side) : bool :=
  let p := terms entry.1 ++ product [:: (-1, [::], [::])] (terms entry.2) in
  [&& proper entry.1, proper entry.2 &
      vanish (rounds 40 (if odd N then p else p ++ map flip p))].
End Compute.

Section Sound.
Variables (R : comRingType) (n : nat) (shape : shapes) (parameters : seq R).
Variable letters : seq (forall s t : bool, 'M[R]_(size n s, size n t)).
Notation source := (source shape).
Notation target := (target shape).
Notation word := (word shape letters).
Notation number := (number parameters).
Notation value := (value shape parameters letters).

Definition trace (w : seq nat) : R := \tr (word w (base shape w) (base shape w)).
Definition trace_sum (p : polynomial) : R := \sum_(x <- p) number x * trace x.2.

Lemma trace_sum_cat p q : trace_sum (p ++ q) = trace_sum p + trace_sum q.
Proof. exact: big_cat. Qed.

Lemma closed_base s w : closed shape s w -> base shape w = s.
Proof. by case: w => // a v /andP [_ /= /andP [/eqP]]. Qed.

Lemma walks_ends s w t : walks shape s w t -> ends shape s w = t.
Proof. by elim: w s => [|a v IH] s /= => [/eqP|/andP [_ /IH]]. Qed.

Lemma walks_cat s u v t : walks shape s (u ++ v) t = walks shape s u (ends shape s u) && walks shape (ends shape s u) v t.
Proof. by elim: u s => [|a u IH] s /=; rewrite ?eqxx // IH andbA. Qed.

Lemma sum_trace s p : all (fun x : term => closed shape s x.2) p ->
  \tr (sum shape parameters letters p s s) = trace_sum p.
Proof.
move=> /allP c; rewrite /sum raddf_sum; apply: eq_big_seq => x /c /closed_base e.
by rewrite /= mxtraceZ /trace e.
Qed.

Lemma trace_cat u v : closed shape (base shape (u ++ v)) (u ++ v) ->
  closed shape (base shape (v ++ u)) (v ++ u) /\ trace (v ++ u) = trace (u ++ v).
Proof.
case: (eqVneq u [::]) => [->|u0]; first by rewrite cats0.
case: (eqVneq v [::]) => [->|v0]; first by rewrite cats0.
move=> /andP [_]; move E: (base shape (u ++ v)) => s; rewrite walks_cat => /andP [wu wv].
have bv : base shape (v ++ u) = ends shape s u by case: (v) v0 wv => // a v' _ /= /andP [/eqP].
rewrite /closed /trace bv E walks_cat (walks_ends wv) wv wu; split; first by case: (v) v0.
by rewrite !word_cat (walks_ends wv) mxtrace_mulC.
Qed.

Lemma trace_rot i w : closed shape (base shape w) w ->
  closed shape (base shape (rot i w)) (rot i w) /\ trace (rot i w) = trace w.
Proof. by rewrite -{1 2 6}(cat_take_drop i w) => /trace_cat. Qed.

Variable rules : seq (nat * nat * expression).
Hypothesis rules_hold : foldr (fun r P => rule_says shape parameters letters r /\ P) True rules.

Lemma round_ok x : trace_sum (round shape rules x) = number x * trace x.2.
Proof.
rewrite /round; case: ifP => [/andP [c a]|_]; last by rewrite /trace_sum big_seq1.
have -> : trace x.2 = trace (led shape rules x.2) by rewrite /led; case: once => //; rewrite (trace_rot _ c).2.
by rewrite -(sum_trace a) (step_ok rules_hold) mxtraceZ.
Qed.

Lemma rounds_ok k p : trace_sum (rounds shape rules k p) = trace_sum p.
Proof.
elim: k p => //= k IH p; rewrite IH; elim: p => [|x p IHp] //=.
by rewrite trace_sum_cat IHp round_ok /trace_sum big_cons.
Qed.

Definition turn_says (t : transpose) : Prop :=
  let: (a, b, minus) := t in
  let B := letter letters b (target a) (source a) in
  (letter letters a (source a) (target a))^T = if minus then - B else B.

Variable turns : seq transpose.
Hypothesis turns_hold : foldr (fun t P => turn_says t /\ P) True turns.

Lemma turn_ok a b (minus : bool) : turn shape turns a = Some (b, minus) ->
  [/\ source b = target a, target b = source a &
      (letter letters a (source a) (target a))^T = (-1) ^+ minus *: letter letters b (target a) (source a)].
Proof.
elim: turns turns_hold => //= -[[c d] m] rest IH [h /IH {}IH].
case: ifP => // /andP [/eqP e1 /eqP e2]; case: eqP => [-> [<- <-]|_].
  by split=> //; rewrite h; case: (m); rewrite ?expr1 ?scaleN1r ?expr0 ?scale1r.
case: eqP => [-> [<- <-]|_ //]; split=> //; rewrite -e1 -e2.
move: h => /(congr1 trmx); rewrite trmxK.
by case: (m) => -> /=; rewrite ?linearN /= ?expr1 ?scaleN1r ?opprK ?expr0 ?scale1r.
Qed.

Lemma turned_ok w v (minus : bool) s t : turned shape turns w = Some (v, minus) -> walks shape s w t ->
  walks shape t v s /\ (word w s t)^T = (-1) ^+ minus *: word v t s.
Proof.
elim: w v minus s => [|a w IH] v minus s /=.
  by move=> [<- <-] /eqP <- /=; rewrite !unit_matrix1 trmx1 scale1r.
case e: (turn _ _ _) => [[b m]|] //; case f: (turned _ _ _) => [[u k]|] // [<- <-] /andP [/eqP es ww].
have [wu h] := IH _ _ _ f ww; have [sb tb g] := turn_ok e; subst s; rewrite -cats1 walks_cat (walks_ends wu) wu /=.
split; first by rewrite sb tb !eqxx.
rewrite word_cat (walks_ends wu) /= tb unit_matrix1 mulmx1 trmx_mul h g -scalemxAl -scalemxAr scalerA.
by rewrite signr_addb mulrC.
Qed.

Lemma flip_ok x : number (flip shape turns x) * trace (flip shape turns x).2 = number x * trace x.2.
Proof.
rewrite /flip; case e: (turned _ _ _) => [[w m]|] //; case: ifP => // /andP [x0 c].
have [c' f] := turned_ok e c.
have b : base shape w = base shape x.2.
  apply: closed_base; rewrite /closed c' andbT; case: (x.2) x0 e => //= a v _.
  by case: turn => [[? ?]|] //; case: turned => [[u ?]|] // [<- _]; rewrite -size_eq0 size_rcons.
rewrite /trace /= b -[in RHS]mxtrace_tr f mxtraceZ mulrA; congr (_ * _).
by rewrite /number /=; case: (m); rewrite ?expr1 ?mulrN1 ?expr0 ?mulr1 // rmorphN mulNr.
Qed.

Lemma put_rotated_ok x p : trace_sum (put_rotated shape x p) = number x * trace x.2 + trace_sum p.
Proof.
elim: p => [|y p IH] /=; first by rewrite /trace_sum big_seq1 big_nil addr0.
case: ifP => [/and3P [/eqP e c /hasP [i _ /eqP r]]|_]; last by rewrite /trace_sum !big_cons addrCA -IH.
rewrite /trace_sum !big_cons addrA -r /= -(trace_rot i c).2 r; congr (_ + _).
by rewrite /number /= e intrD mulrDl mulrDl.
Qed.

Variable N : nat.
Hypothesis inverse : N%:R * nth 0 parameters 0 = 1.

Lemma vanish_ok p : vanish shape N p -> trace_sum p = 0.
Proof.
rewrite /vanish; set k := foldr maxn _ _; set q := foldr (put_rotated _) _ _ => /allP v.
have le x : x \in p -> (zeros x <= k)%N.
  by rewrite /k; elim: p {k q v} => //= y p IH; rewrite inE leq_max => /orP [/eqP <-|/IH ->]; rewrite ?leqnn ?orbT.
have -> : trace_sum p = nth 0 parameters 0 ^+ k * trace_sum q.
  rewrite /q; move: k le {q v} => k; elim: p => [|x p IH] le; first by rewrite /trace_sum !big_nil mulr0.
  rewrite /= put_rotated_ok mulrDr -IH => [|y py]; last by apply: le; rewrite inE py orbT.
  by rewrite mulrA -(cleared_ok inverse) ?le ?mem_head // /trace_sum big_cons.
rewrite /trace_sum big_seq big1 ?mulr0 // => x /v /eqP z; by rewrite /number z !mul0r.
Qed.

Definition side_value (a : side) : R := if a is Some (s, e) then \tr (value e s s) else 0.
Definition traced_says (entry : side * side) : Prop := side_value entry.1 = side_value entry.2.

Lemma side_ok a : proper shape a -> side_value a = trace_sum (terms a).
Proof.
case: a => [[s e]|_] /=; last by rewrite /trace_sum big_nil.
by case/andP => f c; rewrite (form_ok _ _ f) (sum_trace c).
Qed.

Lemma traced_ok entry : traced shape rules turns N entry -> traced_says entry.
Proof.
case: entry => l r /and3P [/side_ok L /side_ok M]; set p := _ ++ _ => /vanish_ok v.
rewrite /traced_says L M; have -> : trace_sum (terms l) = trace_sum (terms r) + trace_sum p.
  rewrite /p trace_sum_cat addrCA; set q := product _ _; suff -> : trace_sum q = - trace_sum (terms r).
    by rewrite subrr addr0.
  rewrite /q /trace_sum /product /= cats0 big_map -sumrN; apply: eq_bigr => x _.
  by rewrite number_times /= {1}/number big_nil mulr1 mulN1r mulNr.
move: v; rewrite rounds_ok; case: ifP => [_ ->|even]; first by rewrite addr0.
rewrite trace_sum_cat.
have -> : trace_sum (map (flip shape turns) p) = trace_sum p.
  by rewrite /trace_sum big_map; apply: eq_bigr => x _; rewrite flip_ok.
rewrite -mulr2n => z; suff -> : trace_sum p = 0 by rewrite addr0.
have N2 : N%:R = 2%:R * (N./2)%:R :> R by rewrite -{1}(odd_double_half N) even -mul2n natrM.
by rewrite -[LHS]mul1r -inverse N2 -!mulrA mulr_natl -!mulrnAr z !mulr0.
Qed.
End Sound.

Theorem traces (shape : shapes) (rules : seq (nat * nat * expression)) (turns selves : seq transpose) (N : nat) entries :
  all (traced shape rules (turns ++ selves) N) entries ->
  forall (R : comRingType) (n : nat) (parameters : seq R) (letters : seq (forall s t, 'M[R]_(size n s, size n t))),
  N%:R * nth 0 parameters 0 = 1 ->
  foldr (fun t P => turn_says shape letters t /\ P) True turns ->
  under [seq rule_says shape parameters letters r | r <- rules]
    (under [seq turn_says shape letters t | t <- selves]
      (every [seq traced_says shape parameters letters e | e <- entries])).
Proof.
move=> f R n p l h T.
have under_intro hs (G : Prop) : (foldr (fun H P => H /\ P) True hs -> G) -> under hs G.
  by elim: hs => [|H hs IH] /= g; [exact: g | move=> Hh; apply: IH => rest; exact: g].
apply: (under_intro) => rules_hold; apply: (under_intro) => S.
have {}rules_hold : foldr (fun r P => rule_says shape p l r /\ P) True rules by move: rules_hold; rewrite foldr_map.
have turns_hold : foldr (fun t P => turn_says shape l t /\ P) True (turns ++ selves).
  by move: S; rewrite foldr_map; elim: turns T {f} => //= t ts IH [Ht /IH {}IH] /IH.
elim: entries f => //= e rest IH /andP [/(traced_ok rules_hold turns_hold h) E /IH {}IH].
by case: rest IH.
Qed.
