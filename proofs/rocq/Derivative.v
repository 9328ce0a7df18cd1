(* The map is differentiable, and det Phi' = det A(-u, gamma~) / det A(u, gamma), A = dG/du. *)
Require Import Reals Lra Statement Branch Expansion Linear.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp.analysis Require Import Rstruct.
Open Scope R_scope.

Definition rows (r1 r2 r3 : vec) : 'M[R]_3 := \matrix_(i, j) column (nth r1 [:: r1; r2; r3] i) j ord0.

Lemma column_rows r1 r2 r3 v : (rows r1 r2 r3 *m column v)%R = column (V (dot r1 v) (dot r2 v) (dot r3 v)).
Proof.
apply/matrixP => i j; rewrite !mxE !big_ord_recl big_ord0 /=; rewrite !mxE /=.
case: i => [[|[|[|i]]] Hi] //=; by rewrite /dot GRing.addr0 GRing.addrA.
Qed.

Lemma det_rows r1 r2 r3 : (\det (rows r1 r2 r3))%R = dot r1 (cross r2 r3).
Proof.
rewrite (expand_det_row _ ord0) !big_ord_recl big_ord0 /cofactor.
rewrite !(expand_det_row _ ord0) !big_ord_recl !big_ord0 /cofactor !det_mx11 !mxE /=.
rewrite /bump /= !GRing.addr0 !GRing.expr0 !GRing.expr1 !GRing.sqrrN ?GRing.expr1n !GRing.mul1r !GRing.mulN1r.
rewrite /dot /cross /= -?RplusE -?RmultE -?RoppE -?RmultE -?RoppE; ring.
Qed.

Lemma column_add v w : column (add v w) = (column v + column w)%R.
Proof. by apply/matrixP => i j; rewrite !mxE; case: i => [[|[|[|i]]] Hi]. Qed.
Lemma column_scale t v : column (scale t v) = (t *: column v)%R.
Proof. by apply/matrixP => i j; rewrite !mxE; case: i => [[|[|[|i]]] Hi]. Qed.
Lemma column_sub v w : column (sub v w) = (column v - column w)%R.
Proof. by rewrite column_add column_scale GRing.scaleN1r. Qed.
Lemma column_zero : column (V 0 0 0) = 0%R.
Proof. by apply/matrixP => i j; rewrite !mxE; case: i => [[|[|[|i]]] Hi]. Qed.

Section At.
Variable x : state.

(* Columns of n numbers that depend on the state. *)
Definition tinyc n (f : state -> 'cV[R]_n) := forall i, tiny x (fun y => f y i ord0).
Arguments tinyc {n} f.
Lemma tinyc_ext n (f g : state -> 'cV[R]_n) : close x (fun y => f y = g y) -> tinyc f -> tinyc g.
Proof. by move=> E F i; apply: (order_ext x _ _ _ _ (F i)); move: E; apply: close_mono => y ->. Qed.
Lemma tinyc_add n (f g : state -> 'cV[R]_n) : tinyc f -> tinyc g -> tinyc (fun y => f y + g y)%R.
Proof.
move=> F G i; apply: (order_ext x _ (fun y => f y i ord0 + g y i ord0)); last exact: order_plus.
by apply: close_all => y; rewrite mxE.
Qed.
Lemma tiny_sum n (F : 'I_n -> state -> R) : (forall j, tiny x (F j)) -> tiny x (fun y => \sum_j F j y)%R.
Proof.
elim: n F => [F _ | n IH F T].
  by apply: (order_ext x _ (fun _ => 0)); [apply: close_all => y; rewrite big_ord0 | exact: order_zero].
apply: (order_ext x _ (fun y => F ord0 y + (\sum_j F (lift ord0 j) y)%R)).
  by apply: close_all => y; rewrite big_ord_recl.
by apply: order_plus => //; apply: IH.
Qed.
Lemma tinyc_mul m n (A : 'M[R]_(m, n)) (f : state -> 'cV[R]_n) : tinyc f -> tinyc (fun y => A *m f y)%R.
Proof.
move=> F i; apply: (order_ext x _ (fun y => \sum_j (A i j * f y j ord0))%R); first by apply: close_all => y; rewrite mxE.
by apply: (tiny_sum _ (fun j y => A i j * f y j ord0)) => j; apply: order_scale.
Qed.
Lemma tinyc_opp n (f : state -> 'cV[R]_n) : tinyc f -> tinyc (fun y => - f y)%R.
Proof.
move=> F; apply: (tinyc_ext _ (fun y => (- 1%:M) *m f y)%R); last exact: tinyc_mul.
by apply: close_all => y; rewrite mulNmx mul1mx.
Qed.
Lemma tinyc_columns (k g : state -> vec) :
  (tiny x (fun y => c1 (k y)) /\ tiny x (fun y => c2 (k y)) /\ tiny x (fun y => c3 (k y))) ->
  (tiny x (fun y => c1 (g y)) /\ tiny x (fun y => c2 (g y)) /\ tiny x (fun y => c3 (g y))) ->
  tinyc (fun y => col_mx (column (k y)) (column (g y))).
Proof.
have C v i : tiny x (fun y => c1 (v y)) /\ tiny x (fun y => c2 (v y)) /\ tiny x (fun y => c3 (v y)) ->
    tiny x (fun y => column (v y) i ord0).
  move=> [A [B E]]; case: i => [[|[|[|i]]] Hi] //.
  - by apply: (order_ext x _ _ _ _ A); apply: close_all => y; rewrite mxE.
  - by apply: (order_ext x _ _ _ _ B); apply: close_all => y; rewrite mxE.
  - by apply: (order_ext x _ _ _ _ E); apply: close_all => y; rewrite mxE.
move=> K G i; rewrite -(splitK i); case: (split i) => j /=.
- by apply: (order_ext x _ _ _ _ (C _ j K)); apply: close_all => y; rewrite col_mxEu.
- by apply: (order_ext x _ _ _ _ (C _ j G)); apply: close_all => y; rewrite col_mxEd.
Qed.
Lemma tiny_rate f e : tiny x f -> 0 < e -> close x (fun y => Rabs (f y) <= e * distance y x).
Proof.
move=> [C [c0 A]] e0; have p : 0 < e / (C + 1) by apply: Rdiv_lt_0_compat; lra.
move: (close_and _ _ _ A (close_within _ _ p)); apply: close_mono => y [B E].
apply: Rle_trans B _; rewrite -Rmult_assoc; apply: Rmult_le_compat_r; first exact: distance_pos.
have d0 := distance_pos x y.
apply: Rle_trans (_ : _ <= (C + 1) * (e / (C + 1))) _; last by right; field; lra.
by apply: Rmult_le_compat; lra.
Qed.
Lemma close_forall n (P : 'I_n -> state -> Prop) : (forall i, close x (P i)) -> close x (fun y => forall i, P i y).
Proof.
elim: n P => [P _ | n IH P A]; first by apply: close_all => y [].
move: (close_and _ _ _ (A ord0) (IH (fun j => P (lift ord0 j)) (fun j => A _))).
by apply: close_mono => y [B E] i; case: (unliftP ord0 i) => [j ->|->].
Qed.
End At.

Arguments tinyc x {n} f.

(* The derivative is unique. *)
Definition unit_vec (k : 'I_3) := nth (V 0 0 0) [:: V 1 0 0; V 0 1 0; V 0 0 1] k.
Definition moved (x : state) t (j : 'I_(3 + 3)) : state :=
  match split j with inl k => (add (fst x) (scale t (unit_vec k)), snd x) | inr k => (fst x, add (snd x) (scale t (unit_vec k))) end.
Lemma column_moved v t k : (column (add v (scale t (unit_vec k))) - column v = t *: delta_mx k ord0)%R.
Proof.
apply/matrixP => i j; rewrite !mxE ord1 eqxx andbT.
case: k => [[|[|[|k]]] Hk] //; case: i => [[|[|[|i]]] Hi] //=; rewrite ?GRing.mulr1n ?GRing.mulr0n -?RplusE -?RoppE -?RmultE;
  try change (GRing.one R_ringType) with 1; try change (@GRing.zero _) with 0; ring.
Qed.
Lemma columns_moved x t j : (columns (moved x t j) - columns x = t *: delta_mx j ord0)%R.
Proof.
rewrite -{2}(splitK j) /moved /columns; case: (split j) => k /=; rewrite opp_col_mx add_col_mx GRing.subrr column_moved.
- by rewrite delta_mx_ushift scale_col_mx GRing.scaler0.
- by rewrite delta_mx_dshift scale_col_mx GRing.scaler0.
Qed.
Lemma distance_moved x t j : 0 < t -> distance (moved x t j) x = t.
Proof.
move=> t0; rewrite /moved /distance /apart; case: (split j) => k /=; rewrite !Rminus_eq_0 !Rabs_R0;
by case: k => [[|[|[|k]]] Hk] //=; rewrite ?Rmult_1_r ?Rmult_0_r ?Rplus_0_r ?Rminus_eq_0 ?Rabs_R0;
  match goal with |- context [Rabs (?a + t - ?a)] => replace (a + t - a) with t by ring end; rewrite Rabs_pos_eq; lra.
Qed.

Lemma derivative_unique Phi x L L' : derivative Phi x L -> derivative Phi x L' -> L = L'.
Proof.
move=> A A'; apply/matrixP => i j; apply: Rminus_diag_uniq.
have small_ : forall e, 0 < e -> Rabs (L i j - L' i j) <= 2 * e.
{ move=> e e0; have [d [d0 B]] := A e e0; have [d' [d0' B']] := A' e e0.
  set t := Rmin d d' / 2; have t0 : 0 < t by have := Rmin_pos _ _ d0 d0'; rewrite /t; lra.
  have := Rmin_l d d'; have := Rmin_r d d'; have := Rmin_pos _ _ d0 d0' => m0 m1 m2.
  have D := distance_moved x t j t0.
  have T : distance (moved x t j) x < d by rewrite D /t; lra.
  have T' : distance (moved x t j) x < d' by rewrite D /t; lra.
  move: (B _ T i) (B' _ T' i); rewrite columns_moved D.
  move: (columns (Phi _) - columns (Phi x))%R => F.
  have E M : ((F - M *m (t *: delta_mx j ord0)) i ord0 = F i ord0 - t * M i j)%R.
    by rewrite -scalemxAr -colE !mxE.
  rewrite !E -?RmultE -?RoppE -?RplusE -?RoppE => P Q.
  apply: (Rmult_le_reg_l t) => //; rewrite -{1}(Rabs_pos_eq t); last lra.
  rewrite -Rabs_mult; replace (t * (L i j - L' i j)) with ((F i ord0 - t * L' i j) - (F i ord0 - t * L i j)) by ring.
  apply: Rle_trans (Rabs_triang _ _) _; rewrite Rabs_Ropp.
  by apply: Rle_trans (Rplus_le_compat _ _ _ _ Q P) _; right; ring. }
case: (Req_dec (L i j - L' i j) 0) => // /Rabs_pos_lt N.
have := small_ (Rabs (L i j - L' i j) / 4); lra.
Qed.

(* A = dG/du, and its regularity where the force is monotone. *)
Definition slope b x u := rows (slope1 b x u) (slope2 b x u) (slope3 b x u).
Definition slope_det b x u := dot (slope1 b x u) (cross (slope2 b x u) (slope3 b x u)).
Definition image b x u d := V (dot (slope1 b x u) d) (dot (slope2 b x u) d) (dot (slope3 b x u) d).

(* The difference of the Cayley transform at two arguments. *)
Lemma cayley_difference p q v o y x : add p (cross v p) = sub y (cross v y) -> add q (cross o q) = sub x (cross o x) ->
  let w := add x q in let D := sub p q in
  cross (add D (sub y x)) (sub v o) =
  sub (V (dot (V 1 (- c3 o) (c2 o)) D) (dot (V (c3 o) 1 (- c1 o)) D) (dot (V (- c2 o) (c1 o) 1) D))
    (add (V (dot (V 0 (- c3 w) (c2 w)) (sub v o)) (dot (V (c3 w) 0 (- c1 w)) (sub v o)) (dot (V (- c2 w) (c1 w) 0) (sub v o)))
         (V (dot (V 1 (c3 o) (- c2 o)) (sub y x)) (dot (V (- c3 o) 1 (c1 o)) (sub y x)) (dot (V (c2 o) (- c1 o) 1) (sub y x)))).
Proof.
case: p q v o y x => [p1 p2 p3] [q1 q2 q3] [v1 v2 v3] [o1 o2 o3] [y1 y2 y3] [x1 x2 x3].
rewrite /dot /sub /add /scale /cross; cbn [c1 c2 c3]; case=> A1 A2 A3; case=> B1 B2 B3.
by apply vec_eq; cbn [c1 c2 c3]; lra.
Qed.

Section Map.
Variables (b : ball) (r s m M : R) (H : within b r s m M) (Phi : state -> state).
Hypothesis Steps : forall x, near r x -> steps b x (Phi x).
Local Notation u_ := (gibbs b).

Lemma midpoint x u d : snd x <> V 0 0 0 ->
  sub (residual b x (add u d)) (residual b x (sub u d)) = scale 2 (image b x u d).
Proof.
destruct x as [K g] => /square_nonzero Q; unfold dot in Q; simpl in Q.
by apply vec_eq; unfold image, slope1, slope2, slope3, residual, inertia, sub, add, scale, cross, dot; cbn [c1 c2 c3 fst snd]; field.
Qed.

Lemma slope_positive x u d : near r x -> norm u < s -> d <> V 0 0 0 -> 0 < dot d (image b x u d).
Proof.
move=> N U Z; have d0 := norm_positive _ Z; have P := mu_pos _ _ _ _ _ H.
set t := (s - norm u) / norm d; have t0 : 0 < t by apply: Rdiv_lt_0_compat; lra.
have W : norm (scale t d) = s - norm u by rewrite norm_scale Rabs_pos_eq; [rewrite /t; field; lra | lra].
clearbody t.
have A : norm (add u (scale t d)) <= s by apply: Rle_trans (norm_add _ _) _; rewrite W; lra.
have A' : norm (sub u (scale t d)) <= s.
{ by apply: Rle_trans (norm_add _ _) _; rewrite (norm_scale (-1)) W Rabs_left; lra. }
have := monotone _ _ _ _ _ H x _ _ N A A'; rewrite /= (midpoint _ _ _ (proj2 N)).
replace (sub (add u (scale t d)) (sub u (scale t d))) with (scale (2 * t) d)
  by (apply vec_eq; unfold sub, add, scale; cbn [c1 c2 c3]; ring).
replace (image b x u (scale t d)) with (scale t (image b x u d))
  by (apply vec_eq; unfold image, dot, scale; cbn [c1 c2 c3]; ring).
replace (dot (scale (2 * t) d) (scale (2 * t) d)) with (4 * t * t * (norm d * norm d))
  by (rewrite norm_square; unfold dot, scale; cbn [c1 c2 c3]; ring).
replace (dot (scale (2 * t) d) (scale 2 (scale t (image b x u d)))) with (4 * t * t * dot d (image b x u d))
  by (unfold dot, scale; cbn [c1 c2 c3]; ring).
set n := norm d in d0 *; set q := dot d _ => E.
have Q : 0 < mu r s m M * (4 * t * t * (n * n)) by repeat apply: Rmult_lt_0_compat; lra.
apply: (Rmult_lt_reg_l (4 * t * t)); [by repeat apply: Rmult_lt_0_compat; lra | lra].
Qed.

Lemma slope_regular x u : near r x -> norm u < s -> slope_det b x u <> 0.
Proof.
move=> N U E; have : (\det (slope b x u) == 0)%R by rewrite /slope det_rows; apply/eqP.
move/det0P => [v v0 Ev].
set d := V (v ord0 ord0) (v ord0 (lift ord0 ord0)) (v ord0 (lift ord0 (lift ord0 ord0))).
have Z : d <> V 0 0 0.
{ case=> e1 e2 e3; move/eqP: v0; apply; apply/matrixP => i j; rewrite ord1 mxE.
  by case: (unliftP ord0 j) => [j' ->|->] //; case: (unliftP ord0 j') => [j'' ->|->] //; rewrite (ord1 j''). }
have := slope_positive x u d N U Z.
have F : forall j, v ord0 ord0 * column (slope1 b x u) j ord0 + v ord0 (lift ord0 ord0) * column (slope2 b x u) j ord0
   + v ord0 (lift ord0 (lift ord0 ord0)) * column (slope3 b x u) j ord0 = 0.
{ move=> j; move/matrixP: Ev => /(_ ord0 j); rewrite !mxE !big_ord_recl big_ord0 !mxE /= GRing.addr0 GRing.addrA; exact. }
move: (F ord0) (F (lift ord0 ord0)) (F (lift ord0 (lift ord0 ord0))); rewrite !mxE /= => F1 F2 F3.
suff -> : dot d (image b x u d) = 0 by lra.
rewrite /image /dot /d; cbn [c1 c2 c3].
set p := v ord0 ord0 in F1 F2 F3 *; set q := v ord0 (lift ord0 ord0) in F1 F2 F3 *; set w := v ord0 _ in F1 F2 F3 *.
transitivity (p * (p * c1 (slope1 b x u) + q * c1 (slope2 b x u) + w * c1 (slope3 b x u))
  + q * (p * c2 (slope1 b x u) + q * c2 (slope2 b x u) + w * c2 (slope3 b x u))
  + w * (p * c3 (slope1 b x u) + q * c3 (slope2 b x u) + w * c3 (slope3 b x u))); first by ring.
by rewrite F1 F2 F3; ring.
Qed.

Lemma Phi_step x : near r x -> Phi x = (turned (u_ x) (fst x), turned (u_ x) (snd x)).
Proof.
move=> N; have [u [R ->]] := Steps x N.
by rewrite (root_unique _ _ _ _ _ H x u (u_ x) N R (gibbs_root _ _ _ _ _ H x N)).
Qed.

Definition back (y : state) : state := (scale (-1) (fst y), snd y).
Definition opposite u := scale (-1) u.

Lemma map_derivative x : near r x ->
  exists L, derivative Phi x L /\ (\det L)%R = slope_det b (back (Phi x)) (opposite (u_ x)) / slope_det b x (u_ x) :> R.
Proof.
move=> N; have NC := near_close r x N.
set u := u_ x; set K := fst x; set g := snd x; set K' := turned u K; set g' := turned u g.
have Px : Phi x = (K', g') by rewrite (Phi_step _ N).
have Z : g <> V 0 0 0 by case: N.
have Z' : g' <> V 0 0 0 by apply: turned_nonzero.
have Fu : follows x u_ := gibbs_follows _ _ _ _ _ H x N.
have FK := follows_fst x; have Fg := follows_snd x.
have FK' : follows x (fun y => turned (u_ y) (fst y)) by apply: turned_follows.
have Fg' : follows x (fun y => turned (u_ y) (snd y)) by apply: turned_follows.
have Fm v : follows x v -> follows x (fun y => opposite (v y)).
{ move=> [A [B C]]; rewrite /follows /opposite /scale; cbn [c1 c2 c3].
  have T f : small x (fun y => f y - f x) -> small x (fun y => -1 * f y - -1 * f x).
    move=> F; apply: (order_ext x _ (fun y => -1 * (f y - f x))); [by apply: close_all => y; ring | exact: order_scale].
  by split; [|split]; apply: T. }
have Roots : close x (fun y => residual b (fst y, snd y) (u_ y) = V 0 0 0).
{ move: NC; apply: close_mono => y Ny; have [R _] := gibbs_root _ _ _ _ _ H y Ny; by rewrite -surjective_pairing. }
have Backs : close x (fun y => residual b (opposite (turned (u_ y) (fst y)), turned (u_ y) (snd y)) (opposite (u_ y)) = V 0 0 0).
{ by move: Roots; apply: close_mono => y; apply: backwards. }
have E1 := linearised x b u_ fst snd Fu FK Fg Z Roots.
have E3 := linearised x b _ _ _ (Fm _ Fu) (Fm _ FK') Fg' Z' Backs.
set a := slope b x u; set a' := slope b (opposite K', g') (opposite u); set c := weight u.
set z := rows (tilt1 b g u) (tilt2 b g u) (tilt3 b g u).
set z' := rows (tilt1 b g' (opposite u)) (tilt2 b g' (opposite u)) (tilt3 b g' (opposite u)).
set P := rows (V 1 (- c3 u) (c2 u)) (V (c3 u) 1 (- c1 u)) (V (- c2 u) (c1 u) 1).
set Q := rows (V 1 (c3 u) (- c2 u)) (V (- c3 u) 1 (c1 u)) (V (c2 u) (- c1 u) 1).
set w := add g g'; set W := rows (V 0 (- c3 w) (c2 w)) (V (c3 w) 0 (- c1 w)) (V (- c2 w) (c1 w) 0).
pose d_ := fun y : state => sub (u_ y) u; pose k_ := fun y : state => sub (fst y) K; pose g_ := fun y : state => sub (snd y) g.
pose k'_ := fun y : state => sub (turned (u_ y) (fst y)) K'; pose g'_ := fun y : state => sub (turned (u_ y) (snd y)) g'.
have C d k : [/\ tiny x (fun y => c1 (d y)), tiny x (fun y => c2 (d y)) & tiny x (fun y => c3 (d y))] ->
    [/\ tiny x (fun y => c1 (k y)), tiny x (fun y => c2 (k y)) & tiny x (fun y => c3 (k y))] ->
    tinyc x (fun y => col_mx (column (d y)) (column (k y))).
{ by move=> [A1 A2 A3] [B1 B2 B3]; apply: tinyc_columns. }
have O : [/\ tiny x (fun y : state => c1 (V 0 0 0)), tiny x (fun y : state => c2 (V 0 0 0)) & tiny x (fun y : state => c3 (V 0 0 0))].
{ by split; apply: order_zero. }
set N0 : 'M[R]_(3 + 3) := block_mx c%:M z 0 1%:M; set N1 : 'M[R]_(3 + 3) := block_mx a 0 0 1%:M.
set M2 : 'M[R]_(3 + 3) := block_mx 1%:M 0 W Q; set P2 : 'M[R]_(3 + 3) := block_mx 1%:M 0 0 P.
set M3 : 'M[R]_(3 + 3) := block_mx a' z' 0 1%:M; set C3 : 'M[R]_(3 + 3) := block_mx c%:M 0 0 1%:M.
pose v_ := fun y : state => col_mx (column (k_ y)) (column (g_ y)); pose w_ := fun y : state => col_mx (column (d_ y)) (column (g_ y)).
pose w2_ := fun y : state => col_mx (column (d_ y)) (column (g'_ y)); pose w3_ := fun y : state => col_mx (column (k'_ y)) (column (g'_ y)).
have T1 : tinyc x (fun y => N1 *m w_ y - N0 *m v_ y)%R.
{ pose e := fun y : state => sub (sub (image b x u (d_ y)) (scale c (k_ y))) (V (dot (tilt1 b g u) (g_ y)) (dot (tilt2 b g u) (g_ y)) (dot (tilt3 b g u) (g_ y))).
  apply: (tinyc_ext x _ (fun y => col_mx (column (e y)) (column (V 0 0 0)))).
  - apply: close_all => y; rewrite /N1 /N0 /w_ /v_ !mul_block_col !column_rows !mul0mx !mul1mx mul_scalar_mx GRing.addr0 !GRing.add0r.
    rewrite opp_col_mx add_col_mx GRing.subrr -column_zero -column_scale -column_add -column_sub; congr (col_mx (column _) _).
    by apply vec_eq; rewrite /e /image /sub /add /scale; cbn [c1 c2 c3]; ring.
  - move: E1 => [A1 [A2 A3]]; apply: C => //.
    split; [apply: (order_ext x _ _ _ _ A1) | apply: (order_ext x _ _ _ _ A2) | apply: (order_ext x _ _ _ _ A3)]; apply: close_all => y;
    rewrite -surjective_pairing /e /image /d_ /k_ /g_ -/u -/K -/g /c /sub /add /scale; cbn [c1 c2 c3]; ring. }
have T2 : tinyc x (fun y => P2 *m w2_ y - M2 *m w_ y)%R.
{ pose e := fun y : state => cross (add (g'_ y) (g_ y)) (d_ y).
  apply: (tinyc_ext x _ (fun y => col_mx (column (V 0 0 0)) (column (e y)))).
  - apply: close_all => y; rewrite /P2 /M2 /w_ /w2_ !mul_block_col !column_rows !mul0mx !mul1mx !GRing.addr0 !GRing.add0r.
    rewrite opp_col_mx add_col_mx GRing.subrr -column_zero -column_add -column_sub; congr (col_mx _ (column _)).
    exact: cayley_difference (cayley _ _) (cayley _ _).
  - move: Fu Fg Fg' => [F1 [F2 F3]] [G1 [G2 G3]] [I1 [I2 I3]].
    have S f h : small x (fun y => f y - f x) -> small x (fun y => h y - h x) ->
      small x (fun y => (f y + -1 * f x) + (h y + -1 * h x)).
    { by move=> A B; apply: (order_ext x _ (fun y => (f y - f x) + (h y - h x))); [apply: close_all => y; ring | apply: order_plus]. }
    have S' f : small x (fun y => f y - f x) -> small x (fun y => f y + -1 * f x).
    { by move=> A; apply: (order_ext x _ (fun y => f y - f x)); [apply: close_all => y; ring | ]. }
    have D f h f' h' : small x f -> small x h -> small x f' -> small x h' -> tiny x (fun y => f y * h y - f' y * h' y).
    { move=> A B A' B'; apply: (order_ext x _ (fun y => f y * h y + -1 * (f' y * h' y))); first by apply: close_all => y; ring.
      by apply: order_plus; [|apply: order_scale]; apply: order_mult. }
    by apply: C => //; split; rewrite /e /cross /add /d_ /g_ /g'_ /sub /scale; cbn [c1 c2 c3]; apply: D;
      (apply: S || apply: S'). }
have T3 : tinyc x (fun y => C3 *m w3_ y - M3 *m w2_ y)%R.
{ pose e := fun y : state => sub (scale c (k'_ y)) (add (image b (opposite K', g') (opposite u) (d_ y))
    (V (dot (tilt1 b g' (opposite u)) (g'_ y)) (dot (tilt2 b g' (opposite u)) (g'_ y)) (dot (tilt3 b g' (opposite u)) (g'_ y)))).
  apply: (tinyc_ext x _ (fun y => col_mx (column (e y)) (column (V 0 0 0)))).
  - apply: close_all => y; rewrite /C3 /M3 /w3_ /w2_ !mul_block_col !column_rows !mul0mx !mul1mx mul_scalar_mx !GRing.addr0 !GRing.add0r.
    by rewrite opp_col_mx add_col_mx GRing.subrr -column_zero -column_scale -column_add -column_sub.
  - move: E3 => [A1 [A2 A3]]; apply: C => //.
    split; [apply: (order_ext x _ _ _ _ A1) | apply: (order_ext x _ _ _ _ A2) | apply: (order_ext x _ _ _ _ A3)]; apply: close_all => y;
    rewrite /e /image /d_ /k'_ /g'_ -/u -/K -/g -/K' -/g' /c /weight;
    set s1 := slope1 _ _ _; set s2 := slope2 _ _ _; set s3 := slope3 _ _ _; set i1 := tilt1 _ _ _; set i2 := tilt2 _ _ _; set i3 := tilt3 _ _ _;
    rewrite /dot /opposite /sub /add /scale; cbn [c1 c2 c3]; field. }
have c0 : c <> 0 by have := one_plus u; rewrite /c /weight; lra.
have dP : (\det P)%R = 1 + dot u u :> R.
{ rewrite /P det_rows /dot /cross; cbn [c1 c2 c3]; ring. }
have dQ : (\det Q)%R = 1 + dot u u :> R.
{ rewrite /Q det_rows /dot /cross; cbn [c1 c2 c3]; ring. }
have p0 : 1 + dot u u <> 0 by have := one_plus u; lra.
have a0 : slope_det b x u <> 0.
{ exact: (slope_regular _ _ N (root_within _ _ _ _ _ H _ _ N (gibbs_root _ _ _ _ _ H x N))). }
have da : (\det a)%R = slope_det b x u by rewrite /a /slope det_rows.
have da' : (\det a')%R = slope_det b (opposite K', g') (opposite u) by rewrite /a' /slope det_rows.
have dN1 : (\det N1 = \det a)%R by rewrite /N1 det_ublock det1 GRing.mulr1.
have dN0 : (\det N0 = c ^+ 3)%R by rewrite /N0 det_ublock det1 GRing.mulr1 det_scalar.
have dM2 : (\det M2 = \det Q)%R by rewrite /M2 det_lblock det1 GRing.mul1r.
have dP2 : (\det P2 = \det P)%R by rewrite /P2 det_ublock det1 GRing.mul1r.
have dM3 : (\det M3 = \det a')%R by rewrite /M3 det_ublock det1 GRing.mulr1.
have dC3 : (\det C3 = c ^+ 3)%R by rewrite /C3 det_ublock det1 GRing.mulr1 det_scalar.
have Ua : N1 \in unitmx by rewrite unitmxE dN1 da GRing.unitfE; apply/eqP.
have UP : P2 \in unitmx by rewrite unitmxE dP2 dP GRing.unitfE; apply/eqP.
have UC : C3 \in unitmx by rewrite unitmxE dC3 GRing.unitfE; apply: GRing.expf_neq0; apply/eqP.
exists (invmx C3 *m (M3 *m (invmx P2 *m (M2 *m (invmx N1 *m N0)))))%R; split.
- set L := (_ *m _)%R.
  have T : tinyc x (fun y => w3_ y - L *m v_ y)%R.
  { apply: (tinyc_ext x _ (fun y => invmx C3 *m ((C3 *m w3_ y - M3 *m w2_ y) + M3 *m (invmx P2 *m ((P2 *m w2_ y - M2 *m w_ y)
      + M2 *m (invmx N1 *m (N1 *m w_ y - N0 *m v_ y))))))%R).
    - apply: close_all => y; rewrite mulmxBr (mulKmx Ua) mulmxBr GRing.addrA GRing.subrK mulmxBr (mulKmx UP) mulmxBr.
      by rewrite GRing.addrA GRing.subrK mulmxBr (mulKmx UC) /L !mulmxA.
    - apply: tinyc_mul; apply: tinyc_add => //; apply: tinyc_mul; apply: tinyc_mul; apply: tinyc_add => //.
      by apply: tinyc_mul; apply: tinyc_mul. }
  move=> e e0.
  have E := close_forall _ _ _ (fun i => tiny_rate _ _ e (T i) e0).
  have [d [d0 B]] := close_and _ _ _ NC E; exists d; split => // y Dy i.
  have [Ny By] := B y Dy.
  have -> : (columns (Phi y) - columns (Phi x))%R = w3_ y.
    by rewrite Px (Phi_step _ Ny) /columns /w3_ /k'_ /g'_ !column_sub /= opp_col_mx add_col_mx.
  have -> : (columns y - columns x)%R = v_ y by rewrite /columns /v_ /k_ /g_ !column_sub opp_col_mx add_col_mx.
  exact: By.
- rewrite !det_mulmx !det_inv dC3 dM3 dP2 dM2 dN1 dN0 dP dQ da da' Px /back /=.
  set t := slope_det b _ (opposite u); rewrite -/(opposite K') -/t.
  have n3 : (c ^+ 3 != 0)%R by apply: GRing.expf_neq0; apply/eqP.
  have np : (1 + dot u u)%R != 0%R by apply/eqP.
  rewrite (GRing.mulKf np) RdivE; last by apply/eqP.
  by rewrite GRing.mulrCA; congr (_ * _)%R; rewrite GRing.mulrCA GRing.mulVf // GRing.mulr1.
Qed.
End Map.
