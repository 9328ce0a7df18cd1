(* The step of a state exists and is unique: the force is monotone on |u| <= s, and a projected iteration contracts. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
Require Import Statement.
Open Scope R_scope.

Definition sub v w := add v (scale (-1) w).
Definition norm v := sqrt (dot v v).

Lemma vec_eq v w : c1 v = c1 w -> c2 v = c2 w -> c3 v = c3 w -> v = w.
Proof. destruct v, w; simpl; congruence. Qed.

Ltac coordinates := repeat match goal with v : vec |- _ => destruct v end; unfold sub, add, scale, dot, cross, inertia in *; simpl in *.

Lemma dot_pos v : 0 <= dot v v.
Proof. coordinates; nra. Qed.
Lemma dot_zero v : dot v v = 0 -> v = V 0 0 0.
Proof. intros; apply vec_eq; coordinates; nra. Qed.
Lemma norm_pos v : 0 <= norm v.
Proof. apply sqrt_pos. Qed.
Lemma norm_square v : norm v * norm v = dot v v.
Proof. apply sqrt_sqrt, dot_pos. Qed.
Lemma norm_le v t : 0 <= t -> dot v v <= t * t -> norm v <= t.
Proof. intros; unfold norm; rewrite <- (sqrt_square t) by assumption; apply sqrt_le_1_alt; assumption. Qed.
Lemma norm_lt v t : 0 < t -> dot v v < t * t -> norm v < t.
Proof. intros; unfold norm; rewrite <- (sqrt_square t) by lra; apply sqrt_lt_1_alt; split; [apply dot_pos | assumption]. Qed.

Lemma schwarz v w : dot v w * dot v w <= dot v v * dot w w.
Proof.
enough (dot v v * dot w w - dot v w * dot v w = dot (cross v w) (cross v w)) by (generalize (dot_pos (cross v w)); lra).
coordinates; ring.
Qed.
Lemma dot_norm v w : Rabs (dot v w) <= norm v * norm w.
Proof.
assert (H := schwarz v w); rewrite <- (norm_square v), <- (norm_square w) in H.
apply Rsqr_incr_0_var; [unfold Rsqr | apply Rmult_le_pos; apply norm_pos].
rewrite <- Rabs_mult, Rabs_pos_eq by nra; lra.
Qed.
Lemma norm_cross v w : norm (cross v w) <= norm v * norm w.
Proof.
apply norm_le; [apply Rmult_le_pos; apply norm_pos |].
replace (norm v * norm w * (norm v * norm w)) with ((norm v * norm v) * (norm w * norm w)) by ring.
rewrite !norm_square.
enough (dot (cross v w) (cross v w) = dot v v * dot w w - dot v w * dot v w) by (generalize (Rle_0_sqr (dot v w)); unfold Rsqr; lra).
coordinates; ring.
Qed.
Lemma norm_scale t v : norm (scale t v) = Rabs t * norm v.
Proof.
unfold norm; replace (dot (scale t v) (scale t v)) with (t * t * dot v v) by (coordinates; ring).
rewrite sqrt_mult_alt by nra; f_equal; apply sqrt_Rsqr_abs.
Qed.
Lemma norm_add v w : norm (add v w) <= norm v + norm w.
Proof.
apply norm_le; [generalize (norm_pos v), (norm_pos w); lra |].
replace (dot (add v w) (add v w)) with (dot v v + dot w w + 2 * dot v w) by (coordinates; ring).
rewrite <- !norm_square; generalize (dot_norm v w), (Rle_abs (dot v w)); lra.
Qed.
Lemma norm_positive v : v <> V 0 0 0 -> 0 < norm v.
Proof.
intros H; destruct (norm_pos v) as [|E]; trivial; contradict H; apply dot_zero; rewrite <- norm_square, <- E; ring.
Qed.
Lemma sub_zero v w : sub v w = V 0 0 0 -> v = w.
Proof. destruct v, w; unfold sub, add, scale; simpl; intros E; injection E; intros; f_equal; lra. Qed.
Lemma norm_zero v : norm v = 0 -> v = V 0 0 0.
Proof. intros E; apply dot_zero; rewrite <- norm_square, E; ring. Qed.

(* The radius s of the ball of Gibbs vectors, as `bound` has it, with the least and the greatest moment m and M. *)
Record within b r s m M : Prop := {
  least : forall v, m * dot v v <= dot v (inertia b v);
  spread : forall v, let w := sub (inertia b v) (scale ((M + m) / 2) v) in norm w <= (M - m) / 2 * norm v;
  positive : 0 < m <= M; rolling : 0 < D b; radius : 0 < s < 1; momentum : 0 < r;
  inward : r * (1 + s * s) < 2 * s * m; slope : s * ((M - m) / 2 + r) < m }.

Lemma extremes b : rolls b -> exists m M, moment b m /\ moment b M /\ 0 < m <= M /\ forall i, moment b i -> m <= i <= M.
Proof.
intros [A [B [C _]]]; set (m := Rmin (I1 b) (Rmin (I2 b) (I3 b))); set (M := Rmax (I1 b) (Rmax (I2 b) (I3 b))).
assert (In : forall i, moment b i -> m <= i <= M).
{ intros i I; unfold moment, m, M, Rmin, Rmax in *; repeat destruct (Rle_dec _ _); destruct I as [-> | [-> | ->]]; lra. }
assert (Hm : moment b m) by (unfold moment, m, Rmin; repeat destruct (Rle_dec _ _); tauto).
assert (HM : moment b M) by (unfold moment, M, Rmax; repeat destruct (Rle_dec _ _); tauto).
exists m, M; split; [assumption | split; [assumption | split; [|assumption]]].
split; [repeat apply Rmin_pos; assumption | apply (In M HM)].
Qed.

Lemma bound_within b r : rolls b -> bound b r -> exists s m M, within b r s m M.
Proof.
intros B [F [s [G H]]]; destruct (extremes b B) as [m [M [Hm [HM [m0 In]]]]]; destruct B as [_ [_ [_ E]]].
destruct (In (I1 b)) as [m1 M1]; [unfold moment; tauto |].
destruct (In (I2 b)) as [m2 M2]; [unfold moment; tauto |].
destruct (In (I3 b)) as [m3 M3]; [unfold moment; tauto |].
destruct (H m M Hm HM); exists s, m, M; split; try assumption; try lra.
- intros v; coordinates; nra.
- intros v w; apply norm_le; [apply Rmult_le_pos; [lra | apply norm_pos] |].
  replace ((M - m) / 2 * norm v * ((M - m) / 2 * norm v)) with (((M - m) / 2) * ((M - m) / 2) * (norm v * norm v)) by ring.
  rewrite norm_square.
  assert (Q : forall i, m <= i <= M -> (i - (M + m) / 2) * (i - (M + m) / 2) <= (M - m) / 2 * ((M - m) / 2)) by (intros; nra).
  assert (Q1 := Q (I1 b) (conj m1 M1)); assert (Q2 := Q (I2 b) (conj m2 M2)); assert (Q3 := Q (I3 b) (conj m3 M3)).
  assert (P : forall p q t, p <= q -> p * (t * t) <= q * (t * t)) by (intros; apply Rmult_le_compat_r; [nra | assumption]).
  unfold w; clear - Q1 Q2 Q3 P; destruct v as [x y z]; coordinates.
  generalize (P _ _ x Q1), (P _ _ y Q2), (P _ _ z Q3); lra.
Qed.

(* Below the bound of the claim `small-branch`, `bound` holds: s is a little more than rho. *)
Lemma small_branch b r : rolls b -> 0 < r ->
  (forall i j, moment b i -> moment b j ->
    let x := r / i in let rho := x / (1 + sqrt (1 - x * x)) in r < i /\ rho * ((j - i) / 2 + r) < i) -> bound b r.
Proof.
intros B r0 H; destruct (extremes b B) as [m [M [Hm [HM [m0 In]]]]]; destruct (H m M Hm HM) as [rm L]; clear H.
set (x := r / m) in *; assert (x0 : 0 < x < 1).
{ split; [apply Rdiv_lt_0_compat; lra |]; apply Rmult_lt_reg_r with m; [lra |]; unfold x, Rdiv; rewrite Rmult_assoc, Rinv_l; lra. }
assert (w0 : 0 < sqrt (1 - x * x)) by (apply sqrt_lt_R0; nra).
assert (w2 : sqrt (1 - x * x) * sqrt (1 - x * x) = 1 - x * x) by (apply sqrt_sqrt; nra).
set (w := sqrt (1 - x * x)) in *; set (rho := x / (1 + w)) in *.
assert (R1 : rho * (1 + w) = x) by (unfold rho; field; lra).
assert (p0 : 0 < rho) by (apply Rdiv_lt_0_compat; lra).
assert (p1 : rho < 1) by nra.
assert (E : r * (1 + rho * rho) = 2 * rho * m).
{ assert (xm : r = x * m) by (unfold x; field; lra); rewrite xm, <- R1.
  replace (1 - x * x) with (1 - rho * (1 + w) * (rho * (1 + w))) in w2 by (rewrite R1; reflexivity).
  assert (rho * rho * (1 + w) = 1 - w) by (apply Rmult_eq_reg_r with (1 + w); lra).
  replace (rho * (1 + w) * m * (1 + rho * rho)) with (rho * m * (1 + w + rho * rho * (1 + w))) by ring; rewrite H; ring. }
clearbody rho w; set (c := (M - m) / 2 + r) in *; assert (c0 : 0 < c) by (unfold c; lra).
set (e := Rmin ((1 - rho) / 2) ((m - rho * c) / (2 * c))).
assert (e0 : 0 < e) by (apply Rmin_pos; [lra | apply Rdiv_lt_0_compat; lra]).
assert (e1 : e <= (1 - rho) / 2) by apply Rmin_l.
assert (e2 : e * c <= (m - rho * c) / 2).
{ apply Rle_trans with ((m - rho * c) / (2 * c) * c); [apply Rmult_le_compat_r; [lra | apply Rmin_r] | right; field; lra]. }
clearbody e; split; [assumption |]; exists (rho + e); split; [lra |].
intros i j I J; destruct (In i I), (In j J).
assert (r * (2 * rho + e) < 2 * m) by nra.
assert (0 < e * (2 * m - r * (2 * rho + e))) by (apply Rmult_lt_0_compat; lra).
assert ((rho + e) * m <= (rho + e) * i) by (apply Rmult_le_compat_l; lra).
assert ((rho + e) * ((j - i) / 2 + r) <= (rho + e) * c) by (apply Rmult_le_compat_l; unfold c; lra).
split; nra.
Qed.

Section Monotone.
Variables (b : ball) (r s m M : R) (H : within b r s m M).

Definition mu := m - s * ((M - m) / 2 + r).
Lemma mu_pos : 0 < mu.
Proof. destruct H; unfold mu; lra. Qed.

Lemma contact g d : g <> V 0 0 0 ->
  m * dot d d <= dot d (inertia b d) + D b * dot d d - D b * (dot g d / dot g g) * dot g d.
Proof.
intros G; assert (P := norm_positive _ G).
assert (Q : 0 < dot g g) by (rewrite <- norm_square; nra).
assert (C := schwarz g d); assert (L := least _ _ _ _ _ H d); assert (F := rolling _ _ _ _ _ H).
enough (dot g d / dot g g * dot g d <= dot d d) by nra.
apply Rmult_le_reg_l with (dot g g); [assumption |].
replace (dot g g * (dot g d / dot g g * dot g d)) with (dot g d * dot g d) by (field; lra); assumption.
Qed.

(* The force is quadratic in u: its difference is its derivative half way. *)
Lemma difference x u v : snd x <> V 0 0 0 -> let d := sub u v in let w := scale (/2) (add u v) in
  dot d (sub (residual b x u) (residual b x v)) =
  dot d (inertia b d) + D b * dot d d - D b * (dot (snd x) d / dot (snd x) (snd x)) * dot (snd x) d
  + dot w (cross (sub (inertia b d) (scale ((M + m) / 2) d)) d) - dot w d * dot (fst x) d.
Proof.
intros G d w; unfold d, w; destruct x as [K g]; simpl in *.
assert (Q : dot g g <> 0) by (contradict G; apply dot_zero; assumption).
coordinates; field; assumption.
Qed.

Lemma norm_half u v : norm u <= s -> norm v <= s -> norm (scale (/2) (add u v)) <= s.
Proof. intros; rewrite norm_scale, Rabs_pos_eq by lra; generalize (norm_add u v); lra. Qed.

Lemma monotone x u v : near r x -> norm u <= s -> norm v <= s -> let d := sub u v in
  mu * dot d d <= dot d (sub (residual b x u) (residual b x v)).
Proof.
intros [K G] U W d; unfold d; rewrite difference by assumption; fold d; set (w := scale _ _).
assert (N : norm w <= s) by (apply norm_half; assumption).
assert (C := contact _ d G).
set (e := sub _ _); assert (S := spread _ _ _ _ _ H d); fold e in S; simpl in S; fold e in S.
assert (T1 : Rabs (dot w (cross e d)) <= s * ((M - m) / 2) * (norm d * norm d)).
{ eapply Rle_trans; [apply dot_norm |].
  assert (E := norm_cross e d); assert (P := norm_pos d).
  assert (norm (cross e d) <= (M - m) / 2 * (norm d * norm d)) by nra.
  destruct H; generalize (norm_pos w), (norm_pos (cross e d)); nra. }
assert (T2 : Rabs (dot w d * dot (fst x) d) <= s * r * (norm d * norm d)).
{ rewrite Rabs_mult.
  assert (R := norm_lt _ _ (momentum _ _ _ _ _ H) K).
  assert (E1 := dot_norm w d); assert (E2 := dot_norm (fst x) d); assert (P := norm_pos d).
  assert (Rabs (dot w d) <= s * norm d) by nra.
  assert (Rabs (dot (fst x) d) <= r * norm d) by nra.
  replace (s * r * (norm d * norm d)) with ((s * norm d) * (r * norm d)) by ring.
  apply Rmult_le_compat; auto using Rabs_pos. }
apply Rabs_le_between in T1; apply Rabs_le_between in T2.
rewrite norm_square in T1, T2; unfold mu; lra.
Qed.

(* A root with |u| < 1 has |u| < s, and there is one at most. *)
Lemma root_within x u : near r x -> root b x u -> norm u < s.
Proof.
intros [K G] [E F]; destruct (Rlt_le_dec (norm u) s) as [|S]; [assumption | exfalso].
assert (C := contact _ u G).
assert (Z : dot u (residual b x u) = 0) by (rewrite E; coordinates; ring).
assert (N : norm u < 1) by (apply norm_lt; lra).
assert (R := norm_lt _ _ (momentum _ _ _ _ _ H) K).
assert (I : dot u (inertia b u) + D b * dot u u - D b * (dot (snd x) u / dot (snd x) (snd x)) * dot (snd x) u
  = (1 + dot u u) / 2 * dot (fst x) u).
{ apply Rminus_diag_uniq; rewrite <- Z; destruct x as [k g]; simpl in *.
  assert (Q : dot g g <> 0) by (contradict G; apply dot_zero; assumption).
  coordinates; field; assumption. }
rewrite I in C.
assert (T := dot_norm (fst x) u); apply Rabs_le_between in T.
rewrite <- norm_square in C; set (n := norm u) in *; set (k := norm (fst x)) in *.
assert (k0 : 0 <= k) by apply norm_pos.
assert (n0 : 0 <= n) by apply norm_pos.
assert (dot (fst x) u <= r * n) by nra.
assert (m * n * n <= (1 + n * n) / 2 * (r * n)).
{ rewrite Rmult_assoc; eapply Rle_trans; [exact C | apply Rmult_le_compat_l; [nra | assumption]]. }
destruct H; assert (0 < n) by lra.
assert (2 * m * n <= (1 + n * n) * r) by (apply Rmult_le_reg_r with n; [assumption | lra]).
assert (r * (1 + s * s) < 2 * s * m) by assumption.
assert (r < m).
{ apply Rmult_lt_reg_r with (1 + s * s); [nra |]. assert (0 <= (1 - s) * (1 - s) * m) by (apply Rmult_le_pos; nra); lra. }
assert (0 <= r * ((1 - s) * ((n - s) * (1 - n)))) by (repeat apply Rmult_le_pos; lra).
assert (0 < (1 - n) * (2 * s * m - r * (1 + s * s))) by (apply Rmult_lt_0_compat; lra).
assert (0 <= (n - s) * (m - r)) by (apply Rmult_le_pos; lra).
assert (0 <= (1 - s) * ((1 + n * n) * r - 2 * m * n)) by (apply Rmult_le_pos; lra).
lra.
Qed.

Lemma root_unique x u v : near r x -> root b x u -> root b x v -> u = v.
Proof.
intros N U W; assert (A := root_within _ _ N U); assert (B := root_within _ _ N W).
assert (C := monotone x u v N (Rlt_le _ _ A) (Rlt_le _ _ B)); simpl in C.
destruct U as [U _], W as [W _]; rewrite U, W in C.
assert (Z : dot (sub u v) (sub u v) = 0).
{ generalize (dot_pos (sub u v)), mu_pos; intros.
  replace (dot (sub u v) (sub (V 0 0 0) (V 0 0 0))) with 0 in C by (coordinates; ring); nra. }
apply sub_zero, dot_zero, Z.
Qed.

(* The nearest point of the ball |v| <= s. *)
Definition projection a := if Rle_dec (norm a) s then a else scale (s / norm a) a.

Lemma projection_norm a : norm (projection a) <= s.
Proof.
destruct (radius _ _ _ _ _ H); unfold projection; destruct (Rle_dec _ _) as [|L]; [assumption |].
assert (P := norm_pos a); rewrite norm_scale, Rabs_pos_eq by (apply Rdiv_le_0_compat; lra).
right; field; lra.
Qed.

Lemma projection_nearest a v : norm v <= s -> dot (sub a (projection a)) (sub v (projection a)) <= 0.
Proof.
intros N; destruct (radius _ _ _ _ _ H); unfold projection; destruct (Rle_dec _ _) as [|L].
- right; coordinates; ring.
- assert (0 < norm a) by lra; assert (S := norm_square a); set (n := norm a) in *.
  replace (dot _ _) with ((1 - s / n) * (dot a v - s / n * dot a a)) by (coordinates; ring).
  rewrite <- S; replace (s / n * (n * n)) with (s * n) by (field; lra).
  assert (C := dot_norm a v); apply Rabs_le_between in C; fold n in C.
  assert (s / n < 1) by (apply Rmult_lt_reg_r with n; [assumption |]; replace (s / n * n) with s by (field; lra); lra).
  assert (dot a v - s * n <= 0) by nra.
  assert (0 <= (1 - s / n) * (s * n - dot a v)) by (apply Rmult_le_pos; lra); lra.
Qed.

Lemma projection_contracts a c : norm (sub (projection a) (projection c)) <= norm (sub a c).
Proof.
assert (A := projection_nearest a _ (projection_norm c)); assert (C := projection_nearest c _ (projection_norm a)).
set (p := projection a) in *; set (q := projection c) in *.
assert (E : dot (sub p q) (sub p q) <= dot (sub p q) (sub a c)) by (coordinates; lra).
assert (F := dot_norm (sub p q) (sub a c)); apply Rabs_le_between in F.
rewrite <- norm_square in E; generalize (norm_pos (sub p q)), (norm_pos (sub a c)); intros.
destruct (Rle_lt_dec (norm (sub p q)) (norm (sub a c))); [assumption | nra].
Qed.

Lemma norm_inertia v : norm (inertia b v) <= M * norm v.
Proof.
assert (S := spread _ _ _ _ _ H v); simpl in S; assert (P := positive _ _ _ _ _ H).
replace (inertia b v) with (add (sub (inertia b v) (scale ((M + m) / 2) v)) (scale ((M + m) / 2) v))
  by (apply vec_eq; coordinates; ring).
eapply Rle_trans; [apply norm_add |]; rewrite norm_scale, Rabs_pos_eq by lra; lra.
Qed.

Definition slope_bound := M + D b + D b + s * M + s * M + s * r.

Lemma lipschitz x u v : near r x -> norm u <= s -> norm v <= s ->
  norm (sub (residual b x u) (residual b x v)) <= slope_bound * norm (sub u v).
Proof.
intros [K G] U W; assert (N := norm_half u v U W).
set (d := sub u v); set (w := scale (/2) (add u v)) in *.
replace (sub (residual b x u) (residual b x v)) with
  (add (add (add (inertia b d) (scale (D b) d)) (scale (- (D b * (dot (snd x) d / dot (snd x) (snd x)))) (snd x)))
    (add (add (cross w (inertia b d)) (cross d (inertia b w))) (scale (- dot w d) (fst x)))).
2: { unfold d, w; clear - G; destruct x as [K g]; simpl in *.
  assert (Q : dot g g <> 0) by (contradict G; apply dot_zero; assumption).
  apply vec_eq; coordinates; field; assumption. }
assert (P := norm_pos d); destruct (radius _ _ _ _ _ H); assert (m0 := positive _ _ _ _ _ H); assert (D0 := rolling _ _ _ _ _ H).
assert (r0 := momentum _ _ _ _ _ H); assert (Kr := norm_lt _ _ r0 K).
assert (A1 := norm_inertia d).
assert (A2 : norm (scale (D b) d) <= D b * norm d) by (rewrite norm_scale, Rabs_pos_eq by lra; lra).
assert (A3 : norm (scale (- (D b * (dot (snd x) d / dot (snd x) (snd x)))) (snd x)) <= D b * norm d).
{ rewrite norm_scale, Rabs_Ropp, Rabs_mult, (Rabs_pos_eq (D b)) by lra.
  assert (g0 := norm_positive _ G); rewrite <- norm_square.
  assert (C := dot_norm (snd x) d); set (g := norm (snd x)) in *.
  unfold Rdiv; rewrite Rabs_mult, (Rabs_pos_eq (/ (g * g))) by (left; apply Rinv_0_lt_compat; nra).
  rewrite Rmult_assoc; apply Rmult_le_compat_l; [lra |].
  apply Rmult_le_reg_r with g; [assumption |].
  replace (Rabs (dot (snd x) d) * / (g * g) * g * g) with (Rabs (dot (snd x) d)) by (field; lra); lra. }
assert (A4 : norm (cross w (inertia b d)) <= s * M * norm d).
{ eapply Rle_trans; [apply norm_cross |]; rewrite Rmult_assoc; apply Rmult_le_compat; auto using norm_pos. }
assert (A5 : norm (cross d (inertia b w)) <= s * M * norm d).
{ eapply Rle_trans; [apply norm_cross |]; rewrite Rmult_comm.
  apply Rmult_le_compat_r; [assumption |]; eapply Rle_trans; [apply norm_inertia | rewrite Rmult_comm; apply Rmult_le_compat_r; lra]. }
assert (A6 : norm (scale (- dot w d) (fst x)) <= s * r * norm d).
{ rewrite norm_scale, Rabs_Ropp; replace (s * r * norm d) with (s * norm d * r) by ring.
  apply Rmult_le_compat; auto using Rabs_pos, norm_pos; [|lra].
  eapply Rle_trans; [apply dot_norm | apply Rmult_le_compat_r; assumption]. }
unfold slope_bound.
assert (T : forall a c p q, norm a <= p * norm d -> norm c <= q * norm d -> norm (add a c) <= (p + q) * norm d)
  by (intros a c p q Ha Hc; generalize (norm_add a c); lra).
replace (M + D b + D b + s * M + s * M + s * r) with (M + D b + D b + (s * M + s * M + s * r)) by ring.
auto 7.
Qed.

(* The iteration and its limit. *)
Definition step x u := projection (sub u (scale (mu / (slope_bound * slope_bound)) (residual b x u))).
Definition factor := sqrt (1 - mu / slope_bound * (mu / slope_bound)).

Lemma slope_bound_pos : mu <= slope_bound /\ 0 < slope_bound.
Proof.
assert (P := mu_pos); destruct H as [? ? ? ? [? ?] ? ? ?]; unfold mu, slope_bound in *.
assert (0 <= s * M) by nra; assert (0 <= s * r) by nra; assert (0 <= s * ((M - m) / 2 + r)) by nra; lra.
Qed.
Lemma factor_bound : 0 <= factor < 1.
Proof.
split; [apply sqrt_pos |].
destruct slope_bound_pos as [A B]; assert (P := mu_pos); unfold factor; rewrite <- sqrt_1 at 2.
assert (0 < mu / slope_bound) by (apply Rdiv_lt_0_compat; assumption).
assert (mu / slope_bound <= 1) by (apply Rmult_le_reg_r with slope_bound; [assumption | field_simplify; lra]).
apply sqrt_lt_1_alt; nra.
Qed.

Lemma step_contracts x u v : near r x -> norm u <= s -> norm v <= s ->
  norm (sub (step x u) (step x v)) <= factor * norm (sub u v).
Proof.
intros N U W; eapply Rle_trans; [apply projection_contracts |].
destruct slope_bound_pos as [A B]; assert (P := mu_pos).
assert (F := factor_bound); assert (Q := norm_pos (sub u v)).
apply norm_le; [nra |].
assert (E := monotone x u v N U W); assert (L := lipschitz x u v N U W); simpl in E.
set (d := sub u v) in *; set (f := sub (residual b x u) (residual b x v)) in *.
set (l := mu / (slope_bound * slope_bound)).
replace (dot _ _) with (dot d d - 2 * l * dot d f + l * l * dot f f) by (unfold d, f, sub, add, scale, dot; simpl; ring).
replace (factor * norm d * (factor * norm d)) with (factor * factor * (norm d * norm d)) by ring.
unfold factor; rewrite sqrt_sqrt, norm_square.
2: { assert (mu / slope_bound <= 1) by (apply Rmult_le_reg_r with slope_bound; [assumption | field_simplify; lra]).
  assert (0 < mu / slope_bound) by (apply Rdiv_lt_0_compat; assumption); nra. }
assert (l0 : 0 < l) by (apply Rdiv_lt_0_compat; nra).
assert (dot f f <= slope_bound * slope_bound * dot d d).
{ rewrite <- !norm_square; replace (slope_bound * slope_bound * (norm d * norm d)) with (slope_bound * norm d * (slope_bound * norm d)) by ring.
  apply Rmult_le_compat; auto using norm_pos. }
assert (l * (mu * dot d d) <= l * dot d f) by (apply Rmult_le_compat_l; lra).
assert (l * l * dot f f <= l * l * (slope_bound * slope_bound * dot d d)) by (apply Rmult_le_compat_l; nra).
replace (l * l * (slope_bound * slope_bound * dot d d)) with (l * (mu * dot d d)) in * by (unfold l; field; lra).
replace (mu / slope_bound * (mu / slope_bound)) with (l * mu) by (unfold l; field; lra).
lra.
Qed.

Lemma converges (a : nat -> R) B q : 0 <= q < 1 -> (forall n, Rabs (a (S n) - a n) <= B * q ^ n) -> exists l : R, is_lim_seq a l.
Proof.
intros Q E.
assert (Sum : ex_series (fun n => a (S n) - a n)).
{ apply (@ex_series_le R_AbsRing R_CompleteNormedModule _ (fun n => B * q ^ n)); [exact E |].
  apply (@ex_series_scal R_AbsRing R_NormedModule B (fun n => q ^ n)); apply ex_series_geom; rewrite Rabs_pos_eq; lra. }
destruct Sum as [l Sum]; exists (l + a O)%R.
apply is_lim_seq_incr_1.
apply is_lim_seq_ext with (fun n => sum_n (fun n => a (S n) - a n) n + a O).
- intros n; induction n as [|n IH]; [rewrite sum_O; ring | rewrite sum_Sn; unfold plus; simpl; lra].
- apply is_lim_seq_plus with l (a O); [exact Sum | apply is_lim_seq_const | reflexivity].
Qed.

Lemma component v : Rabs (c1 v) <= norm v /\ Rabs (c2 v) <= norm v /\ Rabs (c3 v) <= norm v.
Proof.
assert (P : forall t, t * t <= dot v v -> Rabs t <= norm v).
{ intros t T; rewrite <- sqrt_Rsqr_abs; apply sqrt_le_1_alt; exact T. }
repeat split; apply P; coordinates; nra.
Qed.
Lemma norm_components v : norm v <= Rabs (c1 v) + Rabs (c2 v) + Rabs (c3 v).
Proof.
assert (A := Rabs_pos (c1 v)); assert (B := Rabs_pos (c2 v)); assert (C := Rabs_pos (c3 v)).
apply norm_le; [lra |]; unfold dot.
assert (S : forall t, t * t = Rabs t * Rabs t) by (intros; rewrite <- Rabs_mult, Rabs_pos_eq; nra).
rewrite (S (c1 v)), (S (c2 v)), (S (c3 v)); nra.
Qed.

Lemma root_exists x : near r x -> exists u, root b x u.
Proof.
intros N; assert (F := factor_bound); destruct (radius _ _ _ _ _ H) as [s0 s1].
set (u := fun n => Nat.iter n (step x) (V 0 0 0)).
assert (U : forall n, norm (u n) <= s).
{ destruct n; [apply norm_le; [lra |]; simpl; unfold dot; simpl; nra | apply projection_norm]. }
assert (E : forall n, norm (sub (u (S n)) (u n)) <= norm (sub (u 1%nat) (u O)) * factor ^ n).
{ induction n as [|n IH]; [simpl; lra |].
  eapply Rle_trans; [exact (step_contracts x (u (S n)) (u n) N (U _) (U _)) |].
  change (factor ^ S n) with (factor * factor ^ n); apply (Rmult_le_compat_l factor) in IH; [lra | apply F]. }
destruct (converges (fun n => c1 (u n)) (norm (sub (u 1%nat) (u O))) factor F) as [l1 L1].
{ intros n; eapply Rle_trans; [|apply E]; eapply Rle_trans; [|apply (proj1 (component _))]; right; f_equal; generalize (u (S n)) (u n); intros; coordinates; ring. }
destruct (converges (fun n => c2 (u n)) (norm (sub (u 1%nat) (u O))) factor F) as [l2 L2].
{ intros n; eapply Rle_trans; [|apply E]; eapply Rle_trans; [|apply (proj1 (proj2 (component _)))]; right; f_equal; generalize (u (S n)) (u n); intros; coordinates; ring. }
destruct (converges (fun n => c3 (u n)) (norm (sub (u 1%nat) (u O))) factor F) as [l3 L3].
{ intros n; eapply Rle_trans; [|apply E]; eapply Rle_trans; [|apply (proj2 (proj2 (component _)))]; right; f_equal; generalize (u (S n)) (u n); intros; coordinates; ring. }
set (l := V l1 l2 l3).
set (e := fun n => Rabs (c1 (u n) - l1) + Rabs (c2 (u n) - l2) + Rabs (c3 (u n) - l3)).
assert (Z : is_lim_seq e 0).
{ assert (Z : forall a c, is_lim_seq a (Finite c) -> is_lim_seq (fun n => Rabs (a n - c)) 0).
  { intros a c A; replace 0 with (Rabs (c - c)) by (rewrite Rminus_eq_0; apply Rabs_R0).
    apply (is_lim_seq_abs _ (Finite (c - c))); apply is_lim_seq_minus'; [assumption | apply is_lim_seq_const]. }
  replace 0 with (0 + 0 + 0) by ring; unfold e.
  apply is_lim_seq_plus'; [apply is_lim_seq_plus' |]; apply Z; assumption. }
assert (D : forall n, norm (sub (u n) l) <= e n).
{ intros n; eapply Rle_trans; [apply norm_components |]; right; unfold e, l; destruct (u n); unfold sub, add, scale; simpl.
  replace (-1 * l1) with (- l1) by ring; replace (-1 * l2) with (- l2) by ring; replace (-1 * l3) with (- l3) by ring; reflexivity. }
assert (D' : forall n, norm (sub l (u n)) <= e n).
{ intros n; replace (norm (sub l (u n))) with (norm (sub (u n) l)); [apply D |].
  unfold norm; f_equal; clear; destruct (u n), l; unfold dot, sub, add, scale; simpl; ring. }
assert (small : forall t c, 0 <= c -> (forall n, t <= c * e n + e (S n)) -> t <= 0).
{ intros t c C T; apply (is_lim_seq_le (fun _ => t) (fun n => c * e n + e (S n)) t 0).
  - exact T.
  - apply is_lim_seq_const.
  - replace (Finite 0) with (Finite (c * 0 + 0)) by (f_equal; ring).
    apply is_lim_seq_plus'; [exact (is_lim_seq_scal_l e c 0 Z) | exact (proj1 (is_lim_seq_incr_1 e 0) Z)]. }
assert (Ls : norm l <= s).
{ enough (norm l - s <= 0) by lra; apply small with 0; [lra |]; intros n.
  assert (T := norm_add (sub l (u (S n))) (u (S n))).
  replace (add (sub l (u (S n))) (u (S n))) with l in T by (apply vec_eq; unfold sub, add, scale; simpl; ring).
  generalize (D' (S n)), (U (S n)); lra. }
assert (Fixed : step x l = l).
{ assert (Q : norm (sub (step x l) l) = 0).
  { apply Rle_antisym; [|apply norm_pos]; apply small with factor; [apply F |]; intros n.
    assert (T := norm_add (sub (step x l) (u (S n))) (sub (u (S n)) l)).
    replace (add (sub (step x l) (u (S n))) (sub (u (S n)) l)) with (sub (step x l) l) in T
      by (apply vec_eq; unfold sub, add, scale; simpl; ring).
    assert (C := step_contracts x l (u n) N Ls (U n)); change (step x (u n)) with (u (S n)) in C.
    assert (factor * norm (sub l (u n)) <= factor * e n) by (apply Rmult_le_compat_l; [apply F | apply D']).
    generalize (D (S n)); lra. }
  apply sub_zero, norm_zero, Q. }
clearbody l; clear - N H Ls Fixed s0 s1.
assert (P := mu_pos); destruct slope_bound_pos as [A B].
unfold step, projection in Fixed; set (t := mu / (slope_bound * slope_bound)) in *.
assert (t0 : 0 < t) by (apply Rdiv_lt_0_compat; nra).
exists l; split.
2: { rewrite <- norm_square; generalize (norm_pos l); nra. }
set (f := residual b x l) in *; destruct (Rle_dec _ _) as [|C].
- assert (forall p q, q + -1 * (t * p) = q -> p = 0) by (intros p q E; apply Rmult_eq_reg_l with t; lra).
  clearbody f; destruct l as [a1 a2 a3], f as [f1 f2 f3]; unfold sub, add, scale in Fixed; simpl in Fixed; injection Fixed; intros.
  f_equal; eauto.
- exfalso; set (a := sub l (scale t f)) in *; assert (n0 : 0 < norm a) by lra.
  assert (Sc : l = scale (s / norm a) a) by congruence.
  assert (Sn : norm l = s).
  { rewrite Sc, norm_scale, Rabs_pos_eq by (apply Rdiv_le_0_compat; lra); field; lra. }
  assert (Down : dot l f < 0).
  { assert (E : a = scale (norm a / s) l).
    { rewrite Sc; apply vec_eq; unfold scale; simpl; field; split; lra. }
    assert (T : t * dot l f = (1 - norm a / s) * dot l l).
    { replace (t * dot l f) with (dot l l - dot l a) by (unfold a, dot, sub, add, scale; simpl; ring).
      rewrite E at 1; unfold dot, scale; simpl; ring. }
    rewrite <- norm_square, Sn in T.
    assert (1 < norm a / s) by (apply Rmult_lt_reg_r with s; [assumption | field_simplify; lra]).
    assert (0 < (norm a / s - 1) * (s * s)) by (apply Rmult_lt_0_compat; nra).
    apply Rmult_lt_reg_l with t; [assumption | lra]. }
  destruct N as [K G].
  assert (I : dot l f = dot l (inertia b l) + D b * dot l l - D b * (dot (snd x) l / dot (snd x) (snd x)) * dot (snd x) l
    - (1 + dot l l) / 2 * dot (fst x) l).
  { unfold f; clear - G; destruct x as [k g]; simpl in *.
    assert (Q : dot g g <> 0) by (contradict G; apply dot_zero; assumption).
    coordinates; field; assumption. }
  assert (E := contact _ l G); assert (W := dot_norm (fst x) l); apply Rabs_le_between in W.
  assert (R := norm_lt _ _ (momentum _ _ _ _ _ H) K); assert (In := inward _ _ _ _ _ H).
  rewrite <- norm_square, Sn in E; rewrite Sn in W.
  assert (L : dot l l = s * s) by (rewrite <- norm_square, Sn; ring); rewrite L in I.
  assert (dot (fst x) l <= r * s) by nra.
  assert ((1 + s * s) / 2 * dot (fst x) l <= (1 + s * s) / 2 * (r * s)) by (apply Rmult_le_compat_l; nra).
  assert (0 < s * (2 * s * m - r * (1 + s * s))) by (apply Rmult_lt_0_compat; lra).
  lra.
Qed.
End Monotone.
