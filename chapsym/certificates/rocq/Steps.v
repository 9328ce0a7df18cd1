(* Steps of the discrete Chaplygin ball with momentum h gamma, over the real numbers (checker/step.py, checker/measure.py).

   `root` says where the Gibbs vector u of a step is, from bounds of the residual at a number near it: for a force that
   is monotone on the small branch, and then by Newton's formula.  That there is such a u is not said here. *)

From Coq Require Import Reals Psatz.
From Interval Require Import Tactic.
Open Scope R_scope.

Record vector := V { x1 : R; x2 : R; x3 : R }.
Definition zero := V 0 0 0.
Definition plus v w := V (x1 v + x1 w) (x2 v + x2 w) (x3 v + x3 w).
Definition minus v w := V (x1 v - x1 w) (x2 v - x2 w) (x3 v - x3 w).
Definition times s v := V (s * x1 v) (s * x2 v) (s * x3 v).
Definition each v w := V (x1 v * x1 w) (x2 v * x2 w) (x3 v * x3 w).
Definition dot v w := x1 v * x1 w + x2 v * x2 w + x3 v * x3 w.
Definition cross v w := V (x2 v * x3 w - x3 v * x2 w) (x3 v * x1 w - x1 v * x3 w) (x1 v * x2 w - x2 v * x1 w).

(* The moments I, and Lambda = I + D. *)
Definition inertia J := V (x2 J + x3 J) (x3 J + x1 J) (x1 J + x2 J).
Definition contact J D := plus (inertia J) (V D D D).
Definition weights J D := V (/ x1 (contact J D)) (/ x2 (contact J D)) (/ x3 (contact J D)).

(* (1) of checker/step.py with the momentum h g, and (2). *)
Definition force J D h g u :=
  minus (plus (minus (each (contact J D) u) (times (D * dot g u) g)) (cross u (each (inertia J) u)))
    (times ((1 + dot u u) / 2 * h) g).
Definition turned u v := minus v (times (2 / (1 + dot u u)) (minus (cross u v) (cross u (cross u v)))).
Definition step J D h g u g' := force J D h g u = zero /\ dot u u < 1 /\ g' = turned u g.

(* The force is quadratic: F(c + d) - F(c) is this at w = c + d/2. *)
Definition derivative J D h g w d :=
  minus (plus (minus (each (contact J D) d) (times (D * dot g d) g))
      (plus (cross d (each (inertia J) w)) (cross w (each (inertia J) d))))
    (times (dot w d * h) g).

(* A row times the derivative. *)
Definition entries J D h g v row :=
  minus (plus (minus (each (contact J D) row) (times (D * dot g row) g))
      (plus (cross (each (inertia J) v) row) (each (inertia J) (cross row v))))
    (times (dot g row * h) v).

Definition near r c v := Rabs (x1 v - x1 c) <= r /\ Rabs (x2 v - x2 c) <= r /\ Rabs (x3 v - x3 c) <= r.

Definition within lo hi v := x1 lo <= x1 v <= x1 hi /\ x2 lo <= x2 v <= x2 hi /\ x3 lo <= x3 v <= x3 hi.

(* Bounds within which the small branch is proved. *)
Definition tame J D h a b k rho m :=
  0 < D /\ (a <= x1 (inertia J) <= b /\ a <= x2 (inertia J) <= b /\ a <= x3 (inertia J) <= b) /\
  Rabs h <= k /\ k < a /\ 0 < rho < 1 /\ k * (1 + rho * rho) < 2 * a * rho /\
  0 < m <= a - rho * ((b - a) / 2 + k).

Lemma extensional v w : x1 v = x1 w -> x2 v = x2 w -> x3 v = x3 w -> v = w.
Proof. destruct v, w; simpl; congruence. Qed.

Lemma dot_pos v : 0 <= dot v v. Proof. unfold dot; nra. Qed.

Lemma lagrange v w : dot (cross v w) (cross v w) = dot v v * dot w w - dot v w * dot v w.
Proof. unfold dot, cross; simpl; ring. Qed.

Lemma cauchy v w : dot v w * dot v w <= dot v v * dot w w.
Proof. assert (H := lagrange v w). assert (P := dot_pos (cross v w)). lra. Qed.

Lemma abs_of_square x y : 0 <= y -> x * x <= y * y -> Rabs x <= y.
Proof. intros Y H. apply Rsqr_le_abs_0 in H. now rewrite (Rabs_right y) in H by lra. Qed.

Lemma of_abs x r : Rabs x <= r -> - r <= x <= r.
Proof. intros H. unfold Rabs in H. destruct (Rcase_abs x); lra. Qed.

Lemma step_unit J D h g u g' : step J D h g u g' -> dot g g = 1 -> dot g' g' = 1.
Proof.
  intros [_ [_ ->]] <-. unfold turned. assert (H := dot_pos u).
  set (s := dot u u) in *. unfold dot, minus, times, cross; simpl.
  replace (2 / (1 + s)) with (2 * / (1 + s)) by reflexivity. set (t := / (1 + s)).
  assert (E : t * (1 + s) = 1) by (unfold t; field; lra). unfold s, dot in E.
  clearbody t. clear s H.
  assert (E2 : t * (x1 u * x1 u + x2 u * x2 u + x3 u * x3 u) = 1 - t) by lra.
  set (u1 := x1 u) in *; set (u2 := x2 u) in *; set (u3 := x3 u) in *; set (g1 := x1 g); set (g2 := x2 g); set (g3 := x3 g).
  match goal with |- ?l = ?r => replace l with (r + 4 * t *
    ((u1 * u1 + u2 * u2 + u3 * u3) * (g1 * g1 + g2 * g2 + g3 * g3) - (u1 * g1 + u2 * g2 + u3 * g3) * (u1 * g1 + u2 * g2 + u3 * g3))
    * (t * (1 + (u1 * u1 + u2 * u2 + u3 * u3)) - 1)) by ring end.
  rewrite E. ring.
Qed.

Lemma quadratic J D h g c d :
  minus (force J D h g (plus c d)) (force J D h g c) = derivative J D h g (plus c (times (1 / 2) d)) d.
Proof. destruct J, g, c, d. apply extensional; unfold force, derivative, dot; simpl; field. Qed.

Lemma by_rows J D h g v row d : dot row (derivative J D h g v d) = dot (entries J D h g v row) d.
Proof. destruct J, g, v, row, d. unfold derivative, entries, dot; simpl; ring. Qed.

Section Root.
Variables (J : vector) (D h a b k rho m : R) (g u : vector).
Hypothesis is_tame : tame J D h a b k rho m.
Hypothesis unit_g : dot g g = 1.
Hypothesis is_root : force J D h g u = zero.
Hypothesis below_1 : dot u u < 1.
Let I := inertia J.

Lemma inertial v : a * dot v v <= dot v (each I v).
Proof.
  destruct is_tame as [_ [[H1 [H2 H3]] _]]. unfold I, each, dot. simpl in *.
  assert (S1 := Rle_0_sqr (x1 v)). assert (S2 := Rle_0_sqr (x2 v)). assert (S3 := Rle_0_sqr (x3 v)). unfold Rsqr in *. nra.
Qed.

Lemma small : dot u u <= rho * rho.
Proof.
  destruct is_tame as [HD [_ [Hh [Hk [[R0 R1] [HR _]]]]]]. set (s := sqrt (dot u u)).
  assert (S0 : 0 <= s) by apply sqrt_pos. assert (S2 : s * s = dot u u) by (apply sqrt_sqrt, dot_pos).
  assert (P : Rabs (dot g u) <= s).
  { apply abs_of_square; trivial. rewrite S2. generalize (cauchy g u). rewrite unit_g. lra. }
  assert (E : dot u (each I u) + D * (dot u u - dot g u * dot g u) = (1 + dot u u) / 2 * (h * dot g u)).
  { apply Rminus_diag_uniq. transitivity (dot u (force J D h g u)).
    - unfold force, contact, I, dot, each, minus, plus, times, cross; simpl; field.
    - rewrite is_root. unfold dot; simpl; ring. }
  assert (C := cauchy g u). rewrite unit_g in C.
  assert (Q : h * dot g u <= k * s).
  { apply Rle_trans with (1 := Rle_abs _). rewrite Rabs_mult. apply Rmult_le_compat; trivial; apply Rabs_pos. }
  assert (A := inertial u). change (each (inertia J) u) with (each I u) in E.
  assert (B : 2 * (a * (s * s)) <= (1 + s * s) * (k * s)).
  { assert (0 <= D * (dot u u - dot g u * dot g u)) by (apply Rmult_le_pos; lra).
    assert ((1 + dot u u) / 2 * (h * dot g u) <= (1 + dot u u) / 2 * (k * s)).
    { apply Rmult_le_compat_l; trivial. rewrite <- S2. generalize (Rle_0_sqr s). unfold Rsqr. lra. }
    rewrite S2. lra. }
  destruct (Rle_or_lt s rho) as [L|L]; [rewrite <- S2; apply Rmult_le_compat; lra | exfalso].
  assert (S1 : s < 1) by (apply Rsqr_incrst_0; unfold Rsqr; lra).
  assert (B' : 2 * a * s <= k * (1 + s * s)) by (apply Rmult_le_reg_r with s; lra).
  assert (K : 0 <= k) by (apply Rle_trans with (2 := Hh), Rabs_pos).
  assert (P1 : 0 < (1 - s) * (2 * a * rho - k * (1 + rho * rho))) by (apply Rmult_lt_0_compat; lra).
  assert (P2 : 0 < (s - rho) * (2 * a - 2 * k)) by (apply Rmult_lt_0_compat; lra).
  assert (P3 : 0 <= k * ((s - rho) * (1 - s) * (1 - rho))) by (repeat apply Rmult_le_pos; lra).
  assert (P4 : (1 - rho) * (2 * a * s) <= (1 - rho) * (k * (1 + s * s))) by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

Variables (c : vector) (f delta : R).
Hypothesis small_c : dot c c <= rho * rho.
Let d := minus u c.
Let w := plus c (times (1 / 2) d).

Lemma difference v : dot v (derivative J D h g w d) = - dot v (force J D h g c).
Proof.
  unfold w. rewrite <- quadratic. replace (plus c d) with u; [rewrite is_root; unfold dot; simpl; ring | ].
  apply extensional; unfold d; simpl; ring.
Qed.

Lemma small_w : dot w w <= rho * rho.
Proof.
  assert (H := small). assert (P := dot_pos (minus u c)).
  assert (E : dot w w = (dot u u + dot c c) / 2 - dot (minus u c) (minus u c) / 4).
  { unfold w, d, dot, plus, minus, times; simpl; field. }
  rewrite E. lra.
Qed.

Lemma monotone : m * dot d d <= dot d (derivative J D h g w d).
Proof.
  destruct is_tame as [HD [[H1 [H2 H3]] [Hh [Hk [[R0 R1] [HR is_m]]]]]]. set (n := dot d d). assert (N := dot_pos d). fold n in N.
  assert (W := small_w). assert (A := inertial d). fold n in A.
  set (z := (a + b) / 2). set (e := minus (each I d) (times z d)).
  assert (E : dot d (derivative J D h g w d) = dot d (each I d) + D * (n - dot g d * dot g d)
      + dot d (cross w e) - h * (dot w d * dot g d)).
  { unfold derivative, n, e, contact, I, dot, each, minus, plus, times, cross; simpl; ring. }
  assert (C : dot g d * dot g d <= n) by (generalize (cauchy g d); rewrite unit_g; fold n; lra).
  assert (e2 : dot e e <= ((b - a) / 2) * ((b - a) / 2) * n).
  { assert (T : forall i x, a <= i <= b -> (i * x - z * x) * (i * x - z * x) <= ((b - a) / 2) * ((b - a) / 2) * (x * x)).
    { intros i x Hi. replace ((i * x - z * x) * (i * x - z * x)) with ((i - z) * (i - z) * (x * x)) by ring.
      apply Rmult_le_compat_r; [apply Rle_0_sqr | ]. unfold z. nra. }
    unfold n, e, I, dot, each, minus, times; simpl.
    assert (T1 := T _ (x1 d) H1). assert (T2 := T _ (x2 d) H2). assert (T3 := T _ (x3 d) H3). simpl in *. lra. }
  assert (X : Rabs (dot d (cross w e)) <= rho * ((b - a) / 2) * n).
  { assert (G : 0 <= (b - a) / 2) by lra.
    apply abs_of_square; [apply Rmult_le_pos; trivial; apply Rmult_le_pos; lra | ].
    apply Rle_trans with (1 := cauchy d (cross w e)). rewrite lagrange. fold n.
    apply Rle_trans with (n * (dot w w * dot e e)).
    { apply Rmult_le_compat_l; trivial. generalize (Rle_0_sqr (dot w e)). unfold Rsqr. lra. }
    replace (rho * ((b - a) / 2) * n * (rho * ((b - a) / 2) * n))
      with (n * (rho * rho * ((b - a) / 2 * ((b - a) / 2) * n))) by ring.
    apply Rmult_le_compat_l; trivial. apply Rmult_le_compat; trivial; apply dot_pos. }
  assert (Y : Rabs (h * (dot w d * dot g d)) <= k * (rho * n)).
  { rewrite Rabs_mult. apply Rmult_le_compat; trivial; try apply Rabs_pos.
    apply abs_of_square; [apply Rmult_le_pos; lra | ].
    replace (dot w d * dot g d * (dot w d * dot g d)) with (dot w d * dot w d * (dot g d * dot g d)) by ring.
    replace (rho * n * (rho * n)) with (rho * rho * n * n) by ring.
    apply Rmult_le_compat; try apply Rle_0_sqr; trivial.
    apply Rle_trans with (1 := cauchy w d). fold n. apply Rmult_le_compat_r; trivial. }
  apply of_abs in X. apply of_abs in Y. rewrite E. nra.
Qed.

Hypothesis residual : near f zero (force J D h g c).
Hypothesis enough : 2 * f <= m * delta.

Lemma close : near delta c u.
Proof.
  assert (m0 : 0 < m) by apply is_tame. set (F := force J D h g c) in *. assert (M := monotone). rewrite difference in M. fold F in M.
  assert (f0 : 0 <= f) by (apply Rle_trans with (2 := proj1 residual), Rabs_pos).
  assert (F2 : dot F F <= 3 * (f * f)).
  { destruct residual as [A [B C]].
    assert (T : forall x, Rabs (x - 0) <= f -> x * x <= f * f).
    { intros x H. rewrite Rminus_0_r in H. rewrite <- (Rabs_right f) in H by lra. now apply Rsqr_le_abs_1. }
    apply T in A. apply T in B. apply T in C. unfold dot. lra. }
  assert (C := cauchy d F). set (n := dot d d) in *. assert (N : 0 <= n) by apply dot_pos.
  assert (Q : m * n * (m * n) <= n * (3 * (f * f))).
  { apply Rle_trans with (dot d F * dot d F); [ | apply Rle_trans with (1 := C), Rmult_le_compat_l; lra].
    replace (dot d F * dot d F) with (- dot d F * - dot d F) by ring.
    assert (0 <= m * n) by (apply Rmult_le_pos; lra). apply Rmult_le_compat; trivial. }
  assert (n2 : n <= delta * delta).
  { destruct (Req_dec n 0) as [-> | n0]; [apply Rle_0_sqr | ].
    assert (m * m * n <= 3 * (f * f)) by (apply Rmult_le_reg_l with n; lra).
    assert (2 * f * (2 * f) <= m * delta * (m * delta)) by (apply Rmult_le_compat; lra).
    assert (0 <= f * f) by apply Rle_0_sqr.
    apply Rmult_le_reg_l with (m * m); [apply Rmult_lt_0_compat; lra | lra]. }
  assert (d0 : 0 <= delta) by (apply Rmult_le_reg_l with m; lra).
  unfold n, d, dot, minus in n2; simpl in n2.
  assert (S1 := Rle_0_sqr (x1 u - x1 c)). assert (S2 := Rle_0_sqr (x2 u - x2 c)). assert (S3 := Rle_0_sqr (x3 u - x3 c)).
  unfold Rsqr in *. repeat split; apply abs_of_square; trivial; lra.
Qed.

(* Newton's formula with a row of a matrix near the inverse of the derivative. *)
Definition size v := Rabs (x1 v) + Rabs (x2 v) + Rabs (x3 v).

Lemma newton kappa e row unit :
  (forall v, near delta c v -> let N := minus (entries J D h g v row) unit in dot N N <= kappa * kappa) ->
  0 <= kappa -> size row * f + 2 * kappa * delta <= e -> Rabs (dot unit d) <= e.
Proof.
  intros K K0 H. destruct close as [D1 [D2 D3]].
  change (Rabs (x1 d) <= delta) in D1. change (Rabs (x2 d) <= delta) in D2. change (Rabs (x3 d) <= delta) in D3.
  assert (W : near delta c w).
  { unfold near, w, plus, times; simpl. apply of_abs in D1. apply of_abs in D2. apply of_abs in D3.
    change (x1 u - x1 c) with (x1 d). change (x2 u - x2 c) with (x2 d). change (x3 u - x3 c) with (x3 d).
    repeat split; apply Rabs_le; lra. }
  specialize (K w W). set (N := minus (entries J D h g w row) unit) in K. simpl in K.
  assert (E : dot unit d = - dot row (force J D h g c) - dot N d).
  { rewrite <- difference, by_rows. unfold N, dot, minus; simpl; ring. }
  rewrite E. clear E. destruct residual as [F1 [F2 F3]]. change (x1 zero) with 0 in F1. change (x2 zero) with 0 in F2.
  change (x3 zero) with 0 in F3. rewrite Rminus_0_r in F1, F2, F3.
  assert (P : forall x y p q, Rabs x <= p -> Rabs y <= q -> Rabs (x * y) <= p * q).
  { intros. rewrite Rabs_mult. apply Rmult_le_compat; trivial; apply Rabs_pos. }
  assert (B1 := P _ _ _ _ (Rle_refl (Rabs (x1 row))) F1). assert (B2 := P _ _ _ _ (Rle_refl (Rabs (x2 row))) F2).
  assert (B3 := P _ _ _ _ (Rle_refl (Rabs (x3 row))) F3). clear F1 F2 F3.
  assert (Q : Rabs (dot N d) <= 2 * kappa * delta).
  { assert (d0 : 0 <= delta) by (apply Rle_trans with (2 := D1), Rabs_pos).
    apply abs_of_square; [repeat apply Rmult_le_pos; lra | ]. apply Rle_trans with (1 := cauchy N d).
    assert (d2 : dot d d <= 4 * (delta * delta)).
    { rewrite <- (Rabs_right delta) in D1, D2, D3 by lra. apply Rsqr_le_abs_1 in D1. apply Rsqr_le_abs_1 in D2.
      apply Rsqr_le_abs_1 in D3. unfold dot, Rsqr in *. assert (S := Rle_0_sqr delta). unfold Rsqr in S. lra. }
    replace (2 * kappa * delta * (2 * kappa * delta)) with (kappa * kappa * (4 * (delta * delta))) by ring.
    apply Rmult_le_compat; trivial; apply dot_pos. }
  apply of_abs in B1. apply of_abs in B2. apply of_abs in B3. apply of_abs in Q.
  apply Rabs_le. unfold size in H. unfold dot at 1 3. lra.
Qed.
End Root.

(* Where a step leads, from what can be computed of it. *)
Lemma advance J D h a b k rho m f delta kappa e g u g' c lo hi row1 row2 row3 :
  tame J D h a b k rho m -> dot c c <= rho * rho ->
  (forall v, within c c v -> near f zero (force J D h g v)) -> 2 * f <= m * delta ->
  (forall v w1 w2 w3, near delta c v -> within row1 row1 w1 -> within row2 row2 w2 -> within row3 row3 w3 ->
    let N1 := minus (entries J D h g v w1) (V 1 0 0) in
    let N2 := minus (entries J D h g v w2) (V 0 1 0) in
    let N3 := minus (entries J D h g v w3) (V 0 0 1) in
    dot N1 N1 + dot N2 N2 + dot N3 N3 <= kappa * kappa) -> 0 <= kappa ->
  size row1 * f + 2 * kappa * delta <= e /\ size row2 * f + 2 * kappa * delta <= e /\
    size row3 * f + 2 * kappa * delta <= e ->
  (near e c u -> within lo hi (turned u g)) ->
  dot g g = 1 -> step J D h g u g' -> near e c u /\ within lo hi g' /\ dot g' g' = 1.
Proof.
  intros T C F G K K0 [E1 [E2 E3]] R U S.
  assert (U' := step_unit _ _ _ _ _ _ S U). destruct S as [Z [L ->]].
  assert (W : forall v, within v v v) by (intros; unfold within; lra).
  assert (N := newton J D h a b k rho m g u T U Z L c f delta C (F c (W c)) G kappa e).
  assert (Q : forall v, 0 <= dot v v) by apply dot_pos.
  assert (A : near e c u).
  { assert (K' := fun v H => K v row1 row2 row3 H (W _) (W _) (W _)). simpl in K'.
    set (M1 := fun v => minus (entries J D h g v row1) (V 1 0 0)) in *.
    set (M2 := fun v => minus (entries J D h g v row2) (V 0 1 0)) in *.
    set (M3 := fun v => minus (entries J D h g v row3) (V 0 0 1)) in *.
    assert (H : forall v, near delta c v -> dot (M1 v) (M1 v) + dot (M2 v) (M2 v) + dot (M3 v) (M3 v) <= kappa * kappa)
      by exact K'.
    assert (N1 : Rabs (dot (V 1 0 0) (minus u c)) <= e).
    { apply (N row1); trivial. intros v Hv. generalize (H v Hv) (Q (M2 v)) (Q (M3 v)). unfold M1. simpl. lra. }
    assert (N2 : Rabs (dot (V 0 1 0) (minus u c)) <= e).
    { apply (N row2); trivial. intros v Hv. generalize (H v Hv) (Q (M1 v)) (Q (M3 v)). unfold M2. simpl. lra. }
    assert (N3 : Rabs (dot (V 0 0 1) (minus u c)) <= e).
    { apply (N row3); trivial. intros v Hv. generalize (H v Hv) (Q (M1 v)) (Q (M2 v)). unfold M3. simpl. lra. }
    unfold dot, minus in N1, N2, N3; simpl in N1, N2, N3.
    repeat split; [replace (x1 u - x1 c) with (1 * (x1 u - x1 c) + 0 * (x2 u - x2 c) + 0 * (x3 u - x3 c)) by ring
      | replace (x2 u - x2 c) with (0 * (x1 u - x1 c) + 1 * (x2 u - x2 c) + 0 * (x3 u - x3 c)) by ring
      | replace (x3 u - x3 c) with (0 * (x1 u - x1 c) + 0 * (x2 u - x2 c) + 1 * (x3 u - x3 c)) by ring]; trivial. }
  auto.
Qed.

(* The circle around the axis c, where x is the weight 1 / Lambda, and the level l. *)
Definition circle (a b c : vector -> R) x l :=
  a x <> b x /\ (c x < l /\ l < a x /\ l < b x \/ l < c x /\ a x < l /\ b x < l).

(* For |momentum| = k and moments I, J below: check_small_branch of checker/step.py. *)
Definition small_branch_of k (I J : R) :=
  let x := k / I in k < I /\ x / (1 + sqrt (1 - x * x)) * ((J - I) / 2 + k) < I.
Definition small_branch k (I : vector) :=
  let each_pair i := small_branch_of k i (x1 I) /\ small_branch_of k i (x2 I) /\ small_branch_of k i (x3 I) in
  each_pair (x1 I) /\ each_pair (x2 I) /\ each_pair (x3 I).

(* The point of the circle with gamma_a = 0, the other two positive. *)
Definition start (a b c : vector -> R) J D l g :=
  a g = 0 /\ 0 < b g /\ 0 < c g /\ dot g g = 1 /\ dot g (each (weights J D) g) = l.
Definition share (b c : vector -> R) J D l := (l - c (weights J D)) / (b (weights J D) - c (weights J D)).

(* q steps from there. *)
Definition orbit q J D h (g u : nat -> vector) := forall k, (k < q)%nat -> step J D h (g k) (u (S k)) (g (S k)).

(* A positive multiple of the sine of the angle from v to w in the plane (a, b). *)
Definition sine (a b : vector -> R) v w := a v * b w - b v * a w.

Definition rounded half n v := Rabs (x1 v - x1 n) < half /\ Rabs (x2 v - x2 n) < half /\ Rabs (x3 v - x3 n) < half.

Lemma start_roots a b c J D l g :
  (forall v w, dot v w = a v * a w + b v * b w + c v * c w) ->
  (forall v w, b (each v w) = b v * b w /\ c (each v w) = c v * c w) ->
  b (weights J D) - c (weights J D) <> 0 -> start a b c J D l g ->
  b g = sqrt (share b c J D l) /\ c g = sqrt (1 - share b c J D l).
Proof.
  intros Hd He N [A [B [C [U L]]]]. rewrite Hd, A in U, L. rewrite (proj1 (He _ _)), (proj2 (He _ _)) in L.
  unfold share. set (p := b (weights J D)) in *. set (q := c (weights J D)) in *.
  assert (E : (l - q) / (p - q) = b g * b g).
  { replace (l - q) with (b g * b g * (p - q)); [field; trivial | ].
    rewrite <- L. replace (c g * (q * c g)) with (q * (1 - b g * b g)) by (rewrite <- U; ring). ring. }
  rewrite E. split; [symmetry; apply sqrt_square; lra | ].
  replace (1 - b g * b g) with (c g * c g) by (rewrite <- U; ring). symmetry. apply sqrt_square. lra.
Qed.

Lemma between x c r : Rabs (x - c) <= r -> c - r <= x <= c + r.
Proof. intros H. apply of_abs in H. lra. Qed.

(* Inequalities between what is computed from numbers in known boxes; bits is the precision. *)
Ltac by_intervals bits :=
  cbv beta iota zeta delta [near within rounded tame circle small_branch small_branch_of share sine force turned entries derivative
    size weights contact inertia zero plus minus times each dot cross x1 x2 x3] in *;
  repeat match goal with H : _ /\ _ |- _ => destruct H end;
  repeat match goal with H : Rabs (_ - _) <= _ |- _ => apply between in H end;
  repeat match goal with |- _ /\ _ => split end;
  (interval with (i_prec bits)) || (apply Rminus_lt; interval with (i_prec bits)).

(* The same of one vector, or of two, of which it is known where they are. *)
Ltac known v := match goal with A : near _ _ v |- _ => revert A | A : within _ _ v |- _ => revert A end.
Ltac by_box bits v := known v; clear; generalize v; intros [? ? ?] ?; by_intervals bits.
Ltac by_boxes bits v w := known v; known w; clear; generalize v w; intros [? ? ?] [? ? ?] ? ?; by_intervals bits.
