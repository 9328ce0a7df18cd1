(* The equations of a step to first order: slope is dG/du, tilt is -dG/dgamma. *)
From Coq Require Import Reals Lra Psatz ClassicalEpsilon.
From Coquelicot Require Import Rcomplements.
Require Import Statement Branch Expansion.
Open Scope R_scope.

Definition weight u := (1 + dot u u) / 2.
Definition slope1 b (x : state) u := let (K, g) := x in let p := D b / dot g g in
  V (I1 b + D b - p * c1 g * c1 g - c1 u * c1 K) ((I3 b - I2 b) * c3 u - p * c1 g * c2 g - c2 u * c1 K)
    ((I3 b - I2 b) * c2 u - p * c1 g * c3 g - c3 u * c1 K).
Definition slope2 b (x : state) u := let (K, g) := x in let p := D b / dot g g in
  V ((I1 b - I3 b) * c3 u - p * c2 g * c1 g - c1 u * c2 K) (I2 b + D b - p * c2 g * c2 g - c2 u * c2 K)
    ((I1 b - I3 b) * c1 u - p * c2 g * c3 g - c3 u * c2 K).
Definition slope3 b (x : state) u := let (K, g) := x in let p := D b / dot g g in
  V ((I2 b - I1 b) * c2 u - p * c3 g * c1 g - c1 u * c3 K) ((I2 b - I1 b) * c1 u - p * c3 g * c2 g - c2 u * c3 K)
    (I3 b + D b - p * c3 g * c3 g - c3 u * c3 K).
Definition tilt b (t : R) (e g u : vec) := let q := dot g g in
  scale (D b / q) (add (add (scale t u) (scale (dot g u) e)) (scale (-2 * dot g u * t / q) g)).
Definition tilt1 b g u := tilt b (c1 g) (V 1 0 0) g u.
Definition tilt2 b g u := tilt b (c2 g) (V 0 1 0) g u.
Definition tilt3 b g u := tilt b (c3 g) (V 0 0 1) g u.

Lemma square_nonzero g : g <> V 0 0 0 -> dot g g <> 0.
Proof. intros G E; apply G, dot_zero, E. Qed.

Section At.
Variables (x : state) (b : ball).

Lemma distance_self : distance x x = 0.
Proof. unfold distance, apart; rewrite !Rminus_eq_0, Rabs_R0; ring. Qed.
Lemma close_here P : close x P -> P x.
Proof. intros [d [d0 A]]; apply A; rewrite distance_self; assumption. Qed.

Lemma tiny_opp f l : expands x f l -> close x (fun y => f y = 0) -> tiny x l.
Proof.
intros [A _] Z; assert (Zx := close_here _ Z).
apply order_ext with (fun y => -1 * (f y - f x - l y)); [|apply order_scale; assumption].
revert Z; apply close_mono; intros y Zy; simpl in *; rewrite Zx, Zy; ring.
Qed.

Lemma linearised (u k g : state -> vec) : follows x u -> follows x k -> follows x g ->
  g x <> V 0 0 0 -> close x (fun y => residual b (k y, g y) (u y) = V 0 0 0) ->
  let at_ row := row b (k x, g x) (u x) in
  let left row tilt y := dot (at_ row) (sub (u y) (u x)) - dot (tilt b (g x) (u x)) (sub (g y) (g x)) in
  tiny x (fun y => left slope1 tilt1 y - weight (u x) * (c1 (k y) - c1 (k x))) /\
  tiny x (fun y => left slope2 tilt2 y - weight (u x) * (c2 (k y) - c2 (k x))) /\
  tiny x (fun y => left slope3 tilt3 y - weight (u x) * (c3 (k y) - c3 (k x))).
Proof.
intros [U1 [U2 U3]] [K1 [K2 K3]] [G1 [G2 G3]] G Z at_ left; assert (Q := square_nonzero _ G).
assert (step_ : forall c l l', expands x (fun y => c (residual b (k y, g y) (u y))) l -> c (V 0 0 0) = 0 ->
  (forall y, l y = l' y) -> tiny x l').
{ intros c l l' E c0 L; apply order_ext with l; [apply close_all; exact L |].
  apply (tiny_opp _ _ E); revert Z; apply close_mono; intros y ->; exact c0. }
cbv beta delta [dot] in Q.
Ltac first_order := cbv beta iota delta [residual inertia add scale cross dot]; cbn [c1 c2 c3]; expand; try assumption; try lra.
Ltac compare left at_ := intros y; unfold left, at_; cbv beta iota zeta delta
  [slope1 slope2 slope3 tilt1 tilt2 tilt3 tilt weight sub add scale dot]; cbn [c1 c2 c3]; field; assumption.
split; [|split].
- eapply (step_ c1); [first_order | reflexivity | compare left at_].
- eapply (step_ c2); [first_order | reflexivity | compare left at_].
- eapply (step_ c3); [first_order | reflexivity | compare left at_].
Qed.
End At.

(* The Cayley transform, and the step backwards: by -u, from (-K~, gamma~). *)
Lemma one_plus u : 0 < 1 + dot u u.
Proof. generalize (dot_pos u); lra. Qed.

Lemma cayley u v : add (turned u v) (cross u (turned u v)) = sub v (cross u v).
Proof.
assert (P := one_plus u); apply vec_eq; unfold turned, sub, add, scale, cross, dot in *; cbn [c1 c2 c3]; field; lra.
Qed.
Lemma turned_dot u v w : dot (turned u v) (turned u w) = dot v w.
Proof. assert (P := one_plus u); unfold turned, add, scale, cross, dot in *; cbn [c1 c2 c3]; field; lra. Qed.
Lemma turned_self u : turned u u = u.
Proof.
assert (P := one_plus u); apply vec_eq; unfold turned, add, scale, cross, dot in *; cbn [c1 c2 c3]; field; lra.
Qed.
Lemma turned_nonzero u v : v <> V 0 0 0 -> turned u v <> V 0 0 0.
Proof.
intros Z E; apply Z, dot_zero; rewrite <- (turned_dot u), E; unfold dot; simpl; ring.
Qed.

Lemma backwards b K g u : residual b (K, g) u = V 0 0 0 ->
  residual b (scale (-1) (turned u K), turned u g) (scale (-1) u) = V 0 0 0.
Proof.
intros E; assert (P := one_plus u); unfold residual in *.
assert (A : dot (turned u g) (scale (-1) u) = - dot g u).
{ rewrite <- (turned_self u) at 2; rewrite <- (turned_dot u g u); unfold dot, scale; cbn [c1 c2 c3]; ring. }
rewrite A, turned_dot; set (t := dot g u / dot g g) in *; replace (- dot g u / dot g g) with (- t) by (unfold t, Rdiv; ring).
clearbody t; clear A.
injection E; clear E; unfold add, scale, cross, inertia, dot in *; cbn [c1 c2 c3] in *; intros E3 E2 E1.
set (q := c1 u * c1 u + c2 u * c2 u + c3 u * c3 u) in *.
assert (K1 : c1 K = 2 / (1 + q) * (I1 b * c1 u + D b * c1 u - D b * t * c1 g + (c2 u * (I3 b * c3 u) - c3 u * (I2 b * c2 u)))).
{ apply Rmult_eq_reg_l with ((1 + q) / 2); [|lra]; field_simplify; lra. }
assert (K2 : c2 K = 2 / (1 + q) * (I2 b * c2 u + D b * c2 u - D b * t * c2 g + (c3 u * (I1 b * c1 u) - c1 u * (I3 b * c3 u)))).
{ apply Rmult_eq_reg_l with ((1 + q) / 2); [|lra]; field_simplify; lra. }
assert (K3 : c3 K = 2 / (1 + q) * (I3 b * c3 u + D b * c3 u - D b * t * c3 g + (c1 u * (I2 b * c2 u) - c2 u * (I1 b * c1 u)))).
{ apply Rmult_eq_reg_l with ((1 + q) / 2); [|lra]; field_simplify; lra. }
unfold turned, add, scale, cross, dot; cbn [c1 c2 c3]; rewrite K1, K2, K3; clear E1 E2 E3 K1 K2 K3; unfold q in *; clear q.
apply vec_eq; cbn [c1 c2 c3]; field; lra.
Qed.

(* A vector of rational functions of vectors that follow. *)
Ltac follow := split; [|split]; lazymatch goal with |- order ?x _ (fun y => @?h y - _) => eapply (expands_small x h) end;
  unfold residual, turned, inertia, add, scale, cross, dot; cbn [c1 c2 c3]; expand; try assumption; try lra.

Section Branch.
Variables (b : ball) (r s m M : R) (H : within b r s m M).

Definition gibbs y := epsilon (inhabits (V 0 0 0)) (root b y).
Lemma gibbs_root y : near r y -> root b y (gibbs y).
Proof. intros N; unfold gibbs; apply epsilon_spec; exact (root_exists _ _ _ _ _ H y N). Qed.

Lemma near_close x : near r x -> close x (near r).
Proof.
intros [K G]; destruct (small_coordinates x) as [[A1 [A2 A3]] [B1 [B2 B3]]].
assert (FK : small x (fun y => dot (fst y) (fst y) - dot (fst x) (fst x))).
{ eapply (expands_small x (fun y => dot (fst y) (fst y))); unfold dot; expand; assumption. }
assert (FG : small x (fun y => dot (snd y) (snd y) - dot (snd x) (snd x))).
{ eapply (expands_small x (fun y => dot (snd y) (snd y))); unfold dot; expand; assumption. }
assert (g0 : 0 < dot (snd x) (snd x)) by (destruct (dot_pos (snd x)) as [|E]; [assumption | contradict G; apply dot_zero; auto]).
generalize (close_and _ _ _ (small_bounded _ _ FK ((r * r - dot (fst x) (fst x)) / 2) ltac:(lra))
  (small_bounded _ _ FG (dot (snd x) (snd x) / 2) ltac:(lra))).
apply close_mono; intros y [P Q]; apply Rabs_le_between in P; apply Rabs_le_between in Q; split; [lra |].
intros E; assert (Z : dot (V 0 0 0) (V 0 0 0) = 0) by (unfold dot; simpl; ring); rewrite E, Z in Q; lra.
Qed.

Lemma gibbs_follows x : near r x -> follows x gibbs.
Proof.
intros N; assert (G := proj2 N); assert (Q := square_nonzero _ G); assert (P := mu_pos _ _ _ _ _ H).
destruct (small_coordinates x) as [[A1 [A2 A3]] [B1 [B2 B3]]].
set (u := gibbs x); assert (Ru := gibbs_root x N); fold u in Ru.
set (f := fun y => residual b (fst y, snd y) u).
assert (Z : f x = V 0 0 0) by (destruct x as [K g]; apply Ru).
unfold dot in Q.
assert (F : follows x f) by (unfold f; follow); destruct F as [F1 [F2 F3]].
rewrite Z in F1, F2, F3; cbn [c1 c2 c3] in F1, F2, F3.
set (F := fun y => / mu r s m M * (Rabs (c1 (f y) - 0) + Rabs (c2 (f y) - 0) + Rabs (c3 (f y) - 0))).
assert (FS : small x F).
{ assert (T : forall p, small x p -> small x (fun y => Rabs (p y))).
  { intros p [C [c0 A]]; exists C; split; [assumption |]; revert A; apply close_mono; intros y; rewrite Rabs_Rabsolu; trivial. }
  apply order_scale; apply order_plus; [apply order_plus |]; apply T; assumption. }
assert (B : close x (fun y => norm (sub (gibbs y) u) <= F y)).
{ generalize (near_close x N); apply close_mono; intros y Ny; assert (Ry := gibbs_root y Ny).
  assert (Wy := root_within _ _ _ _ _ H _ _ Ny Ry); assert (Wu := root_within _ _ _ _ _ H _ _ N Ru).
  assert (E := monotone _ _ _ _ _ H y (gibbs y) u Ny (Rlt_le _ _ Wy) (Rlt_le _ _ Wu)); simpl in E.
  destruct Ry as [Ry _]; rewrite Ry in E.
  assert (Fy : residual b y u = f y) by (destruct y; reflexivity); rewrite Fy in E.
  set (d := sub (gibbs y) u) in *.
  assert (T := dot_norm d (sub (V 0 0 0) (f y))); apply Rabs_le_between in T.
  assert (S : norm (sub (V 0 0 0) (f y)) <= Rabs (c1 (f y) - 0) + Rabs (c2 (f y) - 0) + Rabs (c3 (f y) - 0)).
  { eapply Rle_trans; [apply norm_components |]; right; unfold sub, add, scale; cbn [c1 c2 c3].
    rewrite <- (Rabs_Ropp (c1 (f y) - 0)), <- (Rabs_Ropp (c2 (f y) - 0)), <- (Rabs_Ropp (c3 (f y) - 0)); f_equal; [f_equal |]; f_equal; ring. }
  rewrite <- norm_square in E; unfold F; set (R0 := Rabs _ + _ + _) in *.
  assert (n0 := norm_pos d); destruct n0 as [n0 | <-].
  - apply Rmult_le_reg_l with (mu r s m M); [assumption |]; rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l by lra.
    apply Rmult_le_reg_r with (norm d); [assumption |]; nra.
  - apply Rmult_le_pos; [left; apply Rinv_0_lt_compat; assumption |].
    eapply Rle_trans; [apply norm_pos | exact S]. }
destruct FS as [C [c0 FC]].
assert (W : forall c, (forall v, Rabs (c v) <= norm v) -> (forall v w, c (sub v w) = c v - c w) -> small x (fun y => c (gibbs y) - c u)).
{ intros c Nc Sc; exists C; split; [assumption |]; generalize (close_and _ _ _ B FC); apply close_mono; intros y [By Cy].
  rewrite <- Sc; generalize (Nc (sub (gibbs y) u)), (Rle_abs (F y)); lra. }
repeat split; (apply W; [intros v; apply (component v) | intros v w; unfold sub, add, scale; cbn [c1 c2 c3]; ring]).
Qed.

Lemma turned_follows x (u v : state -> vec) : follows x u -> follows x v -> follows x (fun y => turned (u y) (v y)).
Proof.
intros [A1 [A2 A3]] [B1 [B2 B3]]; assert (P : 1 + dot (u x) (u x) <> 0) by (generalize (one_plus (u x)); lra).
unfold dot in P; follow.
Qed.
End Branch.
