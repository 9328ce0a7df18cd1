(* The claim `measure-iff`, from the equation of a step.  Only this page has to be read: Judged.v has the proof of what stands at its end. *)
Require Import Reals. From mathcomp Require Import all_ssreflect all_algebra. From mathcomp.analysis Require Import Rstruct.
Open Scope R_scope.

Record vec := V { c1 : R; c2 : R; c3 : R }.
Definition add v w := V (c1 v + c1 w) (c2 v + c2 w) (c3 v + c3 w).
Definition scale t v := V (t * c1 v) (t * c2 v) (t * c3 v).
Definition dot v w := c1 v * c1 w + c2 v * c2 w + c3 v * c3 w.
Definition cross v w := V (c2 v * c3 w - c3 v * c2 w) (c3 v * c1 w - c1 v * c3 w) (c1 v * c2 w - c2 v * c1 w).
(* The principal moments of inertia I1, I2, I3 and D = mass * radius^2. *)
Record ball := Ball { I1 : R; I2 : R; I3 : R; D : R }.
Definition rolls b := 0 < I1 b /\ 0 < I2 b /\ 0 < I3 b /\ 0 < D b.
Definition inertia b v := V (I1 b * c1 v) (I2 b * c2 v) (I3 b * c3 v).

(* Momentum K and vertical gamma.  The map is defined for gamma of any length, and keeps it; the direction alone matters.  So the
   determinant of the derivative on the six numbers is that for d^3 K and the area of the sphere |gamma| = 1. *)
Definition state := (vec * vec)%type.

(* The Gibbs vector u of a step: Lambda u - D <gamma, u> gamma + u x I u = (1 + |u|^2) K / 2, |u| < 1, Lambda = I + D. *)
Definition residual b (x : state) u :=
  let (K, g) := x in
  add (add (add (inertia b u) (scale (D b) u)) (scale (- (D b * (dot g u / dot g g))) g))
      (add (cross u (inertia b u)) (scale (- ((1 + dot u u) / 2)) K)).
Definition root b x u := residual b x u = V 0 0 0 /\ dot u u < 1.

(* Omega^T v = (1 + U)^-1 (1 - U) v, U v = u x v: the Cayley transform.  A step goes from (K, gamma) to (Omega^T K, Omega^T gamma). *)
Definition turned u v :=
  scale (/ (1 + dot u u)) (add (add (scale (1 - dot u u) v) (scale (2 * dot u v) u)) (scale (-2) (cross u v))).
Definition steps b (x y : state) := exists u, root b x u /\ y = (turned u (fst x), turned u (snd x)).

(* |K| < r; r is below the bound of `small-branch`: there is an s at which these inequalities hold for all pairs of moments. *)
Definition near r (x : state) := dot (fst x) (fst x) < r * r /\ snd x <> V 0 0 0.
Definition unit_states r (x : state) := near r x /\ dot (snd x) (snd x) = 1.
Definition moment b i := i = I1 b \/ i = I2 b \/ i = I3 b.
Definition bound b r := 0 < r /\ exists s, 0 < s < 1 /\ forall i j, moment b i -> moment b j ->
  r * (1 + s * s) < 2 * s * i /\ s * ((j - i) / 2 + r) < i.

(* L is the derivative of Phi at x, on the column of the six numbers. *)
Definition column v : 'cV[R]_3 := \col_i nth 0 [:: c1 v; c2 v; c3 v] i.
Definition columns (x : state) : 'cV[R]_(3 + 3) := col_mx (column (fst x)) (column (snd x)).
Definition apart v w := Rabs (c1 v - c1 w) + Rabs (c2 v - c2 w) + Rabs (c3 v - c3 w).
Definition distance (x y : state) := apart (fst x) (fst y) + apart (snd x) (snd y).
Definition derivative (Phi : state -> state) x (L : 'M[R]_(3 + 3)) := forall e, 0 < e -> exists d, 0 < d /\
  forall y, distance y x < d -> forall i,
  Rabs ((columns (Phi y) - columns (Phi x) - L *m (columns y - columns x))%R i ord0) <= e * distance y x.

(* rho is continuous and positive, and Phi preserves the measure with the density rho: rho(Phi x) |det Phi'(x)| = rho(x). *)
Definition density Phi r (rho : state -> R) := forall x, unit_states r x ->
  0 < rho x /\
  (forall e, 0 < e -> exists d, 0 < d /\ forall y, unit_states r y -> distance y x < d -> Rabs (rho y - rho x) < e) /\
  exists L, derivative Phi x L /\ rho (Phi x) * Rabs (\det L)%R = rho x.

(* There are such r; each state has one step; the map is a differentiable bijection; and it has a density exactly if the moments are equal. *)
Definition measure_iff := forall b, rolls b -> (exists r, bound b r) /\ forall r, bound b r ->
  (forall x, near r x -> exists! u, root b x u) /\
  forall Phi, (forall x, near r x -> steps b x (Phi x)) ->
  (forall x, near r x -> exists L, derivative Phi x L) /\
  (forall x, unit_states r x -> unit_states r (Phi x)) /\
  (forall y, unit_states r y -> exists! x, unit_states r x /\ Phi x = y) /\
  ((exists rho, density Phi r rho) <-> I1 b = I2 b /\ I2 b = I3 b).
