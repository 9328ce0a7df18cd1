(* The proof of Statement.measure_iff. *)
From Coq Require Import Reals Lra Lia Psatz.
From Coquelicot Require Import Rcomplements.
Require Import Statement Branch Expansion Linear Derivative Circle.
From mathcomp Require ssralg matrix.
From mathcomp.analysis Require Import Rstruct.
Open Scope R_scope.

(* Three equal moments: (1 + |u|^2) det A = (1 - |u|^2) I (I + D)^2. *)
Lemma equal_moments i d K g u : let b := Ball i i i d in g <> V 0 0 0 -> residual b (K, g) u = V 0 0 0 ->
  slope_det b (K, g) u * (1 + dot u u) = (1 - dot u u) * (i * ((i + d) * (i + d))).
Proof.
intros b G E; assert (Q := square_nonzero _ G); assert (P := one_plus u).
assert (K_ : K = scale (2 / (1 + dot u u)) (add (scale (i + d) u) (scale (- (d * (dot g u / dot g g))) g))).
{ unfold residual in E; injection E; clear E; unfold b, add, scale, cross, inertia; cbn [c1 c2 c3 I1 I2 I3 D]; intros E3 E2 E1.
  set (q := dot u u) in *; set (t := dot g u / dot g g) in *.
  apply vec_eq; cbn [c1 c2 c3]; apply Rmult_eq_reg_l with ((1 + q) / 2); try lra; field_simplify; lra. }
rewrite K_; clear K_ E; unfold b, slope_det, slope1, slope2, slope3, scale, add, cross, dot in *; cbn [c1 c2 c3 I1 I2 I3 D] in *.
destruct u as [u1 u2 u3], g as [g1 g2 g3]; cbn [c1 c2 c3] in *.
field; lra.
Qed.

(* A change of axes that takes the ball b' to b. *)
Record axes (a : vec -> vec) b b' : Prop := {
  axes_residual : forall K g u, residual b (a K, a g) (a u) = a (residual b' (K, g) u);
  axes_turned : forall u v, turned (a u) (a v) = a (turned u v);
  axes_slope : forall K g u, slope_det b (a K, a g) (a u) = slope_det b' (K, g) u;
  axes_scale : forall t v, scale t (a v) = a (scale t v);
  axes_dot : forall v w, dot (a v) (a w) = dot v w;
  axes_zero : a (V 0 0 0) = V 0 0 0 }.

Definition cycle v := V (c3 v) (c1 v) (c2 v).
Definition cycled b := Ball (I2 b) (I3 b) (I1 b) (D b).
Lemma axes_id b : axes (fun v => v) b b.
Proof. split; reflexivity. Qed.
Lemma axes_cycle a b b' : axes a b b' -> axes (fun v => a (cycle v)) b (cycled b').
Proof.
assert (dot_cycle : forall v w, dot (cycle v) (cycle w) = dot v w) by (intros; unfold dot, cycle; cbn [c1 c2 c3]; ring).
intros [A B C E F G]; split; intros.
- rewrite A; f_equal; unfold residual; rewrite !dot_cycle.
  apply vec_eq; unfold cycled, cycle, inertia, add, scale, cross; cbn [c1 c2 c3 I1 I2 I3 D]; ring.
- rewrite B; f_equal; unfold turned; rewrite !dot_cycle; apply vec_eq; unfold cycle, add, scale, cross; cbn [c1 c2 c3]; ring.
- rewrite C; unfold slope_det, slope1, slope2, slope3; rewrite !dot_cycle.
  unfold cycled, cycle, dot, cross; cbn [c1 c2 c3 I1 I2 I3 D]; ring.
- rewrite E; f_equal.
- rewrite F; apply dot_cycle.
- rewrite <- G at 2; f_equal.
Qed.

(* Rotations about the third axis, with gamma on the equator. *)
Definition spin b t := 2 * t / (1 + t * t) * (I3 b + D b).
Definition mean b t := (I1 b + D b) * (I2 b + D b) - D b * (I1 b + I2 b + 2 * D b) / 2 + t * t * (I3 b - I1 b) * (I3 b - I2 b).
Lemma circle_slope b c s t : c * c + s * s = 1 ->
  slope_det b (V 0 0 (spin b t), V c s 0) (V 0 0 t) =
  (I3 b + D b) * (1 - t * t) / (1 + t * t) * (mean b t + D b / 2 * (I1 b - I2 b) * (c * c - s * s + t * (2 * s * c))).
Proof.
intros E; assert (P : 0 < 1 + t * t) by nra.
transitivity ((I3 b + D b) * (1 - t * t) / (1 + t * t) * ((I1 b + D b) * (I2 b + D b) - D b * (I1 b + D b) * (s * s)
  - D b * (I2 b + D b) * (c * c) + t * t * (I3 b - I1 b) * (I3 b - I2 b) + D b / 2 * (I1 b - I2 b) * (t * (2 * s * c)))).
- assert (Q : dot (V c s 0) (V c s 0) = 1) by (unfold dot; cbn [c1 c2 c3]; lra).
  unfold slope_det, slope1, slope2, slope3; rewrite Q; unfold spin, dot, cross; cbn [c1 c2 c3]; field; lra.
- replace (s * s) with (1 - c * c) by lra; unfold mean; field; lra.
Qed.
Lemma circle_residual b c s t : residual b (V 0 0 (spin b t), V c s 0) (V 0 0 t) = V 0 0 0.
Proof.
assert (P : 0 < 1 + t * t) by nra.
assert (Z : dot (V c s 0) (V 0 0 t) = 0) by (unfold dot; cbn [c1 c2 c3]; ring).
unfold residual; rewrite Z; unfold Rdiv at 1; rewrite Rmult_0_l.
apply vec_eq; unfold spin, inertia, add, scale, cross, dot; cbn [c1 c2 c3]; field; lra.
Qed.
Lemma circle_turned x psi : cos x <> 0 -> turned (V 0 0 (tan x)) (V (cos psi) (sin psi) 0) = V (cos (psi - 2 * x)) (sin (psi - 2 * x)) 0.
Proof.
intros Z; assert (S := sin2_cos2 x); unfold Rsqr in S.
assert (P : 1 + tan x * tan x = / (cos x * cos x)) by (unfold tan; field_simplify_eq; [lra | assumption]).
assert (Q : 1 - tan x * tan x = (cos x * cos x - sin x * sin x) / (cos x * cos x)) by (unfold tan; field; assumption).
rewrite cos_minus, sin_minus, sin_2a, cos_2a.
unfold turned; replace (dot (V 0 0 (tan x)) (V 0 0 (tan x))) with (tan x * tan x) by (unfold dot; cbn [c1 c2 c3]; ring).
rewrite P, Q; unfold tan; apply vec_eq; unfold add, scale, cross, dot; cbn [c1 c2 c3]; field; assumption.
Qed.
Lemma circle_turned_axis t k : turned (V 0 0 t) (V 0 0 k) = V 0 0 k.
Proof.
assert (P : 0 < 1 + t * t) by nra.
unfold turned; apply vec_eq; unfold add, scale, cross, dot; cbn [c1 c2 c3]; field; lra.
Qed.
Lemma combine x y : cos x <> 0 -> cos y + tan x * sin y = cos (y - x) / cos x.
Proof. intros; rewrite cos_minus; unfold tan; field; assumption. Qed.

(* theta / 2 = x = PI / 2^(k + 1), as small as one likes. *)
Lemma small_angle e : 0 < e -> exists k, let x := PI * (/2) ^ k / 2 in 0 < x < PI / 2 /\ 0 < tan x < e.
Proof.
intros e0; set (d := Rmin (e / 8) (/8)).
assert (d0 : 0 < d) by (apply Rmin_pos; lra).
destruct (pow_lt_1_zero (/2) ltac:(rewrite Rabs_pos_eq; lra) d d0) as [k A]; specialize (A k (le_n k)); exists k.
assert (p0 : 0 < (/2) ^ k) by (apply pow_lt; lra); rewrite Rabs_pos_eq in A by lra.
assert (d1 : d <= e / 8 /\ d <= /8) by (split; [apply Rmin_l | apply Rmin_r]); clearbody d.
assert (pi0 := PI_RGT_0); assert (pi4 := PI_4); assert (pi3 : 3 < PI) by (generalize PI2_3_2; lra).
intros x; assert (x0 : 0 < x) by (unfold x; nra); assert (x1 : x < 2 * d) by (unfold x; nra).
assert (C : / 2 <= cos x) by (generalize (cos_decr_1 x (PI / 3)), cos_PI3; lra).
assert (S : 0 < sin x) by (apply sin_gt_0; lra).
assert (S' : sin x < x) by (apply sin_lt_x; assumption).
split; [lra |]; unfold tan; split; [apply Rdiv_lt_0_compat; lra |].
apply Rmult_lt_reg_r with (cos x); [lra |]; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra; nra.
Qed.

Section Converse.
Variables (b b' : ball) (a : vec -> vec) (A : axes a b b') (r s m M : R) (H : within b r s m M) (Phi : state -> state) (rho : state -> R).
Hypotheses (Rolls : rolls b') (Differ : I1 b' <> I2 b') (Steps : forall x, near r x -> steps b x (Phi x)).
Hypothesis Density : density Phi r rho.

Lemma density_ratio x : unit_states r x -> 0 < rho x /\
  rho (Phi x) * Rabs (slope_det b (back (Phi x)) (opposite (gibbs b x))) = rho x * Rabs (slope_det b x (gibbs b x)).
Proof.
intros N; destruct (Density x N) as [p [_ [L [B E]]]]; split; [assumption |].
destruct (map_derivative b r s m M H Phi Steps x (proj1 N)) as [L' [B' E']].
rewrite (derivative_unique _ _ _ _ B B'), E' in E; rewrite <- E.
assert (Z : slope_det b x (gibbs b x) <> 0).
{ apply (slope_regular b r s m M H _ _ (proj1 N)), (root_within b r s m M H _ _ (proj1 N)), (gibbs_root b r s m M H x (proj1 N)). }
unfold Rdiv; rewrite Rabs_mult, Rabs_Rinv by assumption.
field; apply Rabs_no_R0; assumption.
Qed.

Variables (k : nat).
Let x := PI * (/2) ^ k / 2.
Let t := tan x.
Hypotheses (x_range : 0 < x < PI / 2) (t_range : 0 < t < 1) (t_small : 2 * t * (I3 b' + D b') < r).

Definition circle psi : state := (a (V 0 0 (spin b' t)), a (V (cos psi) (sin psi) 0)).
Let root_ := a (V 0 0 t).

Lemma circle_in psi : unit_states r (circle psi).
Proof.
assert (S := sin2_cos2 psi); unfold Rsqr in S; destruct Rolls as [_ [_ [i3 d0]]].
assert (U : dot (snd (circle psi)) (snd (circle psi)) = 1).
{ simpl; rewrite (axes_dot _ _ _ A); unfold dot; cbn [c1 c2 c3]; lra. }
split; [split |]; trivial.
- simpl; rewrite (axes_dot _ _ _ A); unfold dot; cbn [c1 c2 c3].
  assert (P : 0 < 1 + t * t) by nra.
  assert (0 <= spin b' t <= 2 * t * (I3 b' + D b')).
  { unfold spin; split; [apply Rmult_le_pos; [apply Rdiv_le_0_compat |]; lra |].
    apply Rmult_le_compat_r; [lra |]; apply Rmult_le_reg_r with (1 + t * t); [assumption |].
    unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; nra. }
  nra.
- intros E; rewrite E in U; unfold dot in U; simpl in U; lra.
Qed.
Lemma circle_root psi : root b (circle psi) root_.
Proof.
split; unfold root_, circle.
- rewrite (axes_residual _ _ _ A), circle_residual; apply (axes_zero _ _ _ A).
- rewrite (axes_dot _ _ _ A); unfold dot; cbn [c1 c2 c3]; nra.
Qed.
Lemma circle_gibbs psi : gibbs b (circle psi) = root_.
Proof.
assert (N := proj1 (circle_in psi)).
exact (root_unique b r s m M H _ _ _ N (gibbs_root b r s m M H _ N) (circle_root psi)).
Qed.
Lemma cos_x : 0 < cos x.
Proof. apply cos_gt_0; lra. Qed.
Lemma circle_step psi : Phi (circle psi) = circle (psi - 2 * x).
Proof.
rewrite (Phi_step b r s m M H Phi Steps _ (proj1 (circle_in psi))), circle_gibbs; unfold circle, root_; simpl.
rewrite !(axes_turned _ _ _ A), circle_turned_axis; unfold t; rewrite circle_turned by (generalize cos_x; lra); reflexivity.
Qed.

Definition kappa := (I3 b' + D b') * (1 - t * t) / (1 + t * t).
Definition wave := D b' / 2 * (I1 b' - I2 b') / cos x.
Lemma kappa_pos : 0 < kappa.
Proof. destruct Rolls as [_ [_ [i3 d0]]]; unfold kappa; apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat |]; nra. Qed.
Lemma wave_nonzero : wave <> 0.
Proof.
destruct Rolls as [_ [_ [_ d0]]]; assert (C := cos_x); unfold wave, Rdiv.
repeat apply Rmult_integral_contrapositive_currified; try lra; apply Rinv_neq_0_compat; lra.
Qed.
Lemma slope_forward psi : slope_det b (circle psi) root_ = kappa * (mean b' t + wave * cos (2 * psi - x)).
Proof.
assert (S := sin2_cos2 psi); unfold Rsqr in S; assert (C := cos_x).
unfold circle, root_; rewrite (axes_slope _ _ _ A), circle_slope by lra.
rewrite <- cos_2a, <- sin_2a.
replace (cos (2 * psi) + t * sin (2 * psi)) with (cos (2 * psi - x) / cos x) by (symmetry; apply combine; lra).
unfold wave, kappa; field.
assert (0 < 1 + t * t) by nra; split; lra.
Qed.
Lemma slope_back psi : slope_det b (back (circle psi)) (opposite root_) = kappa * (mean b' t + wave * cos (2 * psi + x)).
Proof.
assert (S := sin2_cos2 psi); unfold Rsqr in S; assert (C := cos_x).
unfold back, opposite, circle, root_; simpl; rewrite !(axes_scale _ _ _ A).
replace (scale (-1) (V 0 0 (spin b' t))) with (V 0 0 (spin b' (- t)))
  by (unfold spin; apply vec_eq; unfold scale; cbn [c1 c2 c3]; field; nra).
replace (scale (-1) (V 0 0 t)) with (V 0 0 (- t)) by (apply vec_eq; unfold scale; cbn [c1 c2 c3]; ring).
rewrite (axes_slope _ _ _ A), circle_slope by lra.
rewrite <- cos_2a, <- sin_2a; replace (2 * psi + x) with (2 * psi - - x) by ring.
replace (- t * sin (2 * psi)) with (tan (- x) * sin (2 * psi)) by (rewrite tan_neg; reflexivity).
rewrite combine by (rewrite cos_neg; lra); rewrite cos_neg; unfold wave, kappa, mean; field.
assert (0 < 1 + t * t) by nra; split; lra.
Qed.

Lemma wave_small : Rabs wave < Rabs (mean b' t).
Proof.
destruct (Rlt_le_dec (Rabs wave) (Rabs (mean b' t))) as [|L]; [assumption | exfalso].
assert (W := wave_nonzero); assert (W' := Rabs_pos_lt _ W).
assert (R1 : -1 <= - mean b' t / wave <= 1).
{ apply Rabs_le_between; unfold Rdiv; rewrite Rabs_mult, Rabs_Ropp, Rabs_Rinv by assumption.
  apply Rmult_le_reg_r with (Rabs wave); [assumption |]; rewrite Rmult_assoc, Rinv_l by lra; lra. }
assert (C := cos_acos _ R1); set (y := acos _) in C.
set (psi := (y + x) / 2); assert (N := proj1 (circle_in psi)).
apply (slope_regular b r s m M H _ root_ N (root_within b r s m M H _ _ N (circle_root psi))).
rewrite slope_forward; replace (2 * psi - x) with y by (unfold psi; field); rewrite C; field; assumption.
Qed.

Lemma no_density : False.
Proof.
set (psi := fun j => x / 2 - 2 * x * INR j).
set (G := fun j : nat => mean b' t + wave * cos (- (2 * INR j * (PI * (/2) ^ k)))).
set (G' := fun j : nat => mean b' t + wave * cos (- (PI * (/2) ^ k) - 2 * INR j * (PI * (/2) ^ k))).
assert (X : PI * (/2) ^ k = 2 * x) by (unfold x; field).
assert (R1 : forall j, 0 < rho (circle (psi j)) /\ rho (circle (psi (S j))) * Rabs (G' j) = rho (circle (psi j)) * Rabs (G j)).
{ intros j; destruct (density_ratio _ (circle_in (psi j))) as [p E]; split; [assumption |].
  rewrite circle_gibbs, circle_step, slope_back, slope_forward, !Rabs_mult in E.
  replace (psi j - 2 * x) with (psi (S j)) in E by (unfold psi; rewrite S_INR; ring).
  assert (K := kappa_pos); rewrite (Rabs_pos_eq kappa) in E by lra.
  replace (2 * psi (S j) + x) with (- (PI * (/2) ^ k) - 2 * INR j * (PI * (/2) ^ k)) in E
    by (rewrite X; unfold psi; rewrite S_INR; field).
  replace (2 * psi j - x) with (- (2 * INR j * (PI * (/2) ^ k))) in E by (rewrite X; unfold psi; field).
  fold (G j) (G' j) in E; apply Rmult_eq_reg_l with kappa; lra. }
assert (R2 : forall n, rho (circle (psi n)) * Rabs (product n G') = rho (circle (psi O)) * Rabs (product n G)).
{ induction n as [|n IH]; [reflexivity |]; simpl; rewrite !Rabs_mult.
  transitivity (rho (circle (psi (S n))) * Rabs (G' n) * Rabs (product n G')); [ring |].
  rewrite (proj2 (R1 n)); transitivity (rho (circle (psi n)) * Rabs (product n G') * Rabs (G n)); [ring | rewrite IH; ring]. }
assert (E := R2 (2 ^ k + 2 ^ k)%nat).
assert (Closed : circle (psi (2 ^ k + 2 ^ k)%nat) = circle (psi O)).
{ unfold circle; replace (psi (2 ^ k + 2 ^ k)%nat) with (psi O - 2 * PI).
  - rewrite cos_minus, sin_minus, cos_2PI, sin_2PI, !Rmult_1_r, !Rmult_0_r, Rplus_0_r, Rminus_0_r; reflexivity.
  - unfold psi, x; rewrite plus_INR; simpl (INR 0).
    replace (2 * (PI * (/ 2) ^ k / 2) * (INR (2 ^ k) + INR (2 ^ k))) with (2 * PI * (INR (2 ^ k) * (/2) ^ k)) by field.
    rewrite power_half; ring. }
rewrite Closed in E; apply (two_turns k _ _ wave_small wave_nonzero); symmetry.
apply Rmult_eq_reg_l with (rho (circle (psi O))); [exact E | generalize (proj1 (R1 O)); lra].
Qed.
End Converse.

(* What Statement.v says of gamma of any length: the equation does not see it, and a step keeps it. *)
Lemma any_length b K g u t : t <> 0 -> g <> V 0 0 0 -> residual b (K, scale t g) u = residual b (K, g) u.
Proof.
intros T G; assert (Q := square_nonzero _ G); unfold residual.
replace (dot (scale t g) u) with (t * dot g u) by (unfold dot, scale; cbn [c1 c2 c3]; ring).
replace (dot (scale t g) (scale t g)) with (t * t * dot g g) by (unfold dot, scale; cbn [c1 c2 c3]; ring).
f_equal; f_equal; apply vec_eq; unfold scale; cbn [c1 c2 c3]; field; split; assumption.
Qed.
Lemma length_kept u v : dot (turned u v) (turned u v) = dot v v.
Proof. apply turned_dot. Qed.
Lemma turned_scale u t v : turned u (scale t v) = scale t (turned u v).
Proof. assert (P := one_plus u); apply vec_eq; unfold turned, add, scale, cross, dot in *; cbn [c1 c2 c3]; field; lra. Qed.

(* The map backwards: by the root of (-K~, gamma~). *)
Lemma turned_back u v : turned (opposite u) (turned u v) = v.
Proof.  (* As u x (u x (u x v)) = - |u|^2 u x v, what is left to ring has few letters: the coordinates would take it 25 s. *)
set (n := dot u u); set (k := 2 / (1 + n)); set (a := cross u).
assert (E : k * (1 + n) = 2) by (assert (P := one_plus u); unfold k, n; field; lra).
assert (T : turned u v = add v (scale k (sub (a (a v)) (a v)))).
{ assert (P := one_plus u); unfold k, n, a, turned, sub, add, scale, cross, dot in *; apply vec_eq; cbn [c1 c2 c3] in *; field; lra. }
assert (B : forall w, turned (opposite u) w = add w (scale k (add (a (a w)) (a w)))).
{ intros w; assert (P := one_plus u); unfold k, n, a, opposite, turned, add, scale, cross, dot in *.
  apply vec_eq; cbn [c1 c2 c3] in *; field; nra. }
assert (L : forall t p q r, a (add p (scale t (sub q r))) = add (a p) (scale t (sub (a q) (a r)))).
{ intros; unfold a, sub, add, scale, cross; apply vec_eq; cbn [c1 c2 c3]; ring. }
assert (N : forall w, a (a (a w)) = scale (- n) (a w)).
{ intros; unfold n, a, scale, cross, dot; apply vec_eq; cbn [c1 c2 c3]; ring. }
rewrite T, B, !L, !N; clear T B L N; clearbody k n a.
transitivity (add v (scale (k * (2 - k * (1 + n))) (a (a v)))); [|rewrite E];
  unfold sub, add, scale; apply vec_eq; cbn [c1 c2 c3]; ring.
Qed.
Lemma opposite_twice u : scale (-1) (scale (-1) u) = u.
Proof. apply vec_eq; unfold scale; cbn [c1 c2 c3]; ring. Qed.

Section Bijection.
Variables (b : ball) (r s m M : R) (H : within b r s m M) (Phi : state -> state).
Hypothesis Steps : forall x, near r x -> steps b x (Phi x).

Lemma back_in y : unit_states r y -> unit_states r (back y).
Proof.
intros [[K G] U]; split; [split |]; trivial; simpl.
replace (dot (scale (-1) (fst y)) (scale (-1) (fst y))) with (dot (fst y) (fst y)) by (unfold dot, scale; cbn [c1 c2 c3]; ring).
exact K.
Qed.
Lemma image_in x : unit_states r x -> unit_states r (Phi x).
Proof.
intros [N U]; destruct (Steps x N) as [u [_ ->]]; destruct N as [K G]; split; [split |]; simpl; rewrite ?turned_dot; trivial.
apply turned_nonzero, G.
Qed.
Lemma back_root x u : near r x -> root b x u -> root b (back (turned u (fst x), turned u (snd x))) (opposite u).
Proof.
intros N [E L]; destruct x as [K g]; split; [exact (backwards b K g u E) |].
replace (dot (opposite u) (opposite u)) with (dot u u) by (unfold opposite, dot, scale; cbn [c1 c2 c3]; ring); exact L.
Qed.
Lemma bijective y : unit_states r y -> exists! x, unit_states r x /\ Phi x = y.
Proof.
intros Y; assert (B := back_in y Y); set (v := gibbs b (back y)).
assert (V := gibbs_root b r s m M H _ (proj1 B)); fold v in V.
set (x := back (turned v (fst (back y)), turned v (snd (back y)))).
assert (X : unit_states r x).
{ apply back_in; destruct B as [[K G] U]; split; [split |]; simpl; rewrite ?turned_dot; trivial; apply turned_nonzero, G. }
assert (Z := back_root _ _ (proj1 B) V); fold x in Z.
exists x; split; [split; [exact X |] |].
- destruct (Steps x (proj1 X)) as [u [U ->]].
  rewrite (root_unique b r s m M H x u (opposite v) (proj1 X) U Z); destruct y as [K g]; unfold x, back; simpl.
  rewrite !turned_scale, opposite_twice, !turned_back; reflexivity.
- intros w [W E]; destruct (Steps w (proj1 W)) as [u [U F]]; rewrite E in F.
  assert (T := back_root w u (proj1 W) U); rewrite <- F in T.
  assert (R1 := root_unique b r s m M H (back y) v (opposite u) (proj1 B) V T).
  unfold x; rewrite R1; destruct w as [K g]; simpl in F; rewrite F; unfold back; simpl.
  rewrite !turned_scale, opposite_twice, !turned_back; reflexivity.
Qed.
End Bijection.

Theorem measure_iff_holds : measure_iff.
Proof.
intros b B; assert (Q := B); destruct Q as [p1 [p2 [p3 d0]]]; split.
- (* s = m / (M + m), r = s m / 2 *)
  destruct (extremes b B) as [m [M [_ [_ [[m0 mM] In]]]]].
  set (s := m / (M + m)); assert (s0 : 0 < s) by (apply Rdiv_lt_0_compat; lra).
  assert (sM : s * (M + m) = m) by (unfold s; field; lra); clearbody s.
  assert (sm : 0 < s * m) by (apply Rmult_lt_0_compat; assumption).
  assert (s1 : s < 1) by nra; assert (ss : 0 < s * s < 1) by nra.
  exists (s * m / 2); split; [lra |]; exists s; split; [lra |].
  intros i j I J; destruct (In i I), (In j J).
  assert (s * m <= s * i) by (apply Rmult_le_compat_l; lra).
  assert (s * m * (s * s) < s * m) by nra.
  assert (s * (j - i) <= s * (M - m)) by (apply Rmult_le_compat_l; lra).
  assert (s * s * m < m) by nra; split; lra.
- intros r Br; destruct (bound_within b r B Br) as [s [m [M H]]]; split.
  { intros x N; destruct (root_exists b r s m M H x N) as [u U]; exists u; split; [assumption |].
    intros v W; exact (root_unique b r s m M H x u v N U W). }
  intros Phi Steps; split; [|split; [exact (image_in b r Phi Steps) | split; [exact (bijective b r s m M H Phi Steps) |]]].
  { intros x N; destruct (map_derivative b r s m M H Phi Steps x N) as [L [A _]]; exists L; exact A. }
  split.
  + intros [rho Rho].
    assert (C : forall a b', axes a b b' -> rolls b' -> I1 b' = I2 b').
    { intros a b' A B'; destruct (Req_dec (I1 b') (I2 b')) as [|N]; [assumption | exfalso].
      assert (r0 := momentum _ _ _ _ _ H); assert (q := B'); destruct q as [_ [_ [i3 d3]]].
      set (e := Rmin 1 (r / (2 * (I3 b' + D b')))).
      assert (e0 : 0 < e) by (apply Rmin_pos; [lra | apply Rdiv_lt_0_compat; lra]).
      assert (e1 : e <= 1 /\ e * (2 * (I3 b' + D b')) <= r).
      { split; [apply Rmin_l |]; apply Rle_trans with (r / (2 * (I3 b' + D b')) * (2 * (I3 b' + D b')));
          [apply Rmult_le_compat_r; [lra | apply Rmin_r] | right; field; lra]. }
      destruct (small_angle e e0) as [k [x0 t0]].
      apply (no_density b b' a A r s m M H Phi rho B' N Steps Rho k x0); [lra | nra]. }
    split.
    * exact (C _ _ (axes_id b) B).
    * exact (C _ _ (axes_cycle _ _ _ (axes_id b)) (conj p2 (conj p3 (conj p1 d0)))).
  + intros [E1 E2]; exists (fun _ => 1); intros x N; split; [lra |]; split.
    { intros e e0; exists 1; split; [lra |]; intros; rewrite Rminus_eq_0, Rabs_R0; assumption. }
    destruct (map_derivative b r s m M H Phi Steps x (proj1 N)) as [L [A E]]; exists L; split; [assumption |].
    enough (T : slope_det b (back (Phi x)) (opposite (gibbs b x)) = slope_det b x (gibbs b x)).
    { rewrite E, T; assert (Z : slope_det b x (gibbs b x) <> 0).
      { apply (slope_regular b r s m M H _ _ (proj1 N)), (root_within b r s m M H _ _ (proj1 N)), (gibbs_root b r s m M H x (proj1 N)). }
      unfold Rdiv; rewrite Rinv_r, Rabs_R1 by assumption; ring. }
    destruct (gibbs_root b r s m M H x (proj1 N)) as [Rt _].
    rewrite (Phi_step b r s m M H Phi Steps x (proj1 N)); set (u := gibbs b x) in *.
    destruct x as [K g], N as [[_ G] _]; simpl in G; unfold back; simpl.
    assert (Bi : b = Ball (I3 b) (I3 b) (I3 b) (D b)) by (destruct b; simpl in *; congruence).
    assert (Bk := backwards b K g u Rt); rewrite Bi in Rt, Bk |- *.
    assert (F := equal_moments _ _ _ _ _ G Rt); assert (F' := equal_moments _ _ _ _ _ (turned_nonzero u g G) Bk).
    simpl in F, F'.
    replace (dot (scale (-1) u) (scale (-1) u)) with (dot u u) in F' by (unfold dot, scale; cbn [c1 c2 c3]; ring).
    apply Rmult_eq_reg_r with (1 + dot u u); [|generalize (one_plus u); lra].
    unfold opposite; simpl in *; rewrite F; exact F'.
Qed.
