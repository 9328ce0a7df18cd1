"""Certificates of kind heteroclinic: offsets at the ends of orbits of the reduced map between the unstable rotations.

The map.  Let I1 > I2 > I3 > 0, D > 0, Λ = I + D, ϰ² = (Λ1 - Λ2)(Λ2 - Λ3)/(Λ1Λ3), ϰ > 0, and h > 0 below the bound of
check_small_branch.  Claim separatrix-map of the register says that on the arcs of |γ| = 1, ⟨γ, Λ⁻¹γ⟩ = 1/Λ2 between the
rotations about ±e2 the reduced map is u ↦ ũ, with tanh u = γ2 where C1C3 < 0, and -u for u on the other arcs,
    F(X) = D(tanh ũ - tanh u),   F(X) = hϰX² - 2I2 X + h/ϰ,   X = coth ½(ũ - u) > X₀,                              (1)
X₀ the larger root of F.  The proofs here are about (1).  With x = e^2u, s = e^(ũ - u) = (X + 1)/(X - 1), x̃ = s²x,
    tanh ũ - tanh u = 8xX/((x + 1)Q),   Q = x(X + 1)² + (X - 1)²,   with the derivative 8x(1 - X²)/Q² in X.         (2)
It decreases for X > 1, F increases for X > X₀; F is less at X₀ and more for large X: (1) has one root X > X₀.

The ends.  Let s₀ = (X₀ + 1)/(X₀ - 1), c = log s₀.  Along an orbit u₀, u₁, ..., u_n - nc = u₀ + Σ log(s_i/s₀), i < n.
As F is convex with F(X₀) = 0, F′(X₀)(X_i - X₀) ≤ F(X_i) ≤ D(1 - tanh u_i) < 2D/x_i; and log s has the derivative
-2/(X² - 1).  So 0 < log(s₀/s_i) < 4D/(F′(X₀)(X₀² - 1)x_i).  The x_i grow: x_(i+1) = s_i²x_i, and s_i ≥ ŝ for i ≥ n,
where ŝ is s at X = X₀ + 2D/(F′(X₀)x_n).  So Σ 1/x_i, i ≥ n, is at most 1/(x_n(1 - ŝ⁻²)), and u_n - nc has a limit
h₊(u).  Let Δ(u) = h₊(u) + h₊(-u): e^Δ is the product of all s_i/s₀ along the orbits of x and 1/x, enclosed at two
starts.  By lemma separatrix-limit, if Δ is not constant, no finite invariant measure of the reduced map has a density
that is positive almost everywhere.
"""

from dataclasses import dataclass
from fractions import Fraction

from .document import DIGITS, Data, check_rounded, check_work, decimal, exact, scale
from .form import HEAD, check_shape
from .interval import Interval, Rejected
from .linear import newton
from .step import Ball, check_small_branch

#: The most steps of a half orbit; Newton iterations for the first root.
MOST_STEPS, FIRST = 10_000, 64
ORBIT = {"start": exact, "steps": range(1, MOST_STEPS + 1), "end": exact}
FORM = HEAD | {
    "ball": {"J": (exact,) * 3, "D": exact, "height": exact}, "radius": exact, "digits": DIGITS,
    "orbits": (ORBIT, ORBIT),
}  # fmt: skip


def statement(data: Data) -> str:
    """The theorem, with the numbers of the file."""
    ball, starts = data["ball"], [one["start"] for one in data["orbits"]]
    return (
        f"For every ball with J = ({', '.join(ball['J'])}), D = {ball['D']}, h = {ball['height']}, every number within "
        f"{data['radius']}: of the map u ↦ ũ, h(ϰX² + 1/ϰ) = 2I2 X + D(tanh ũ - tanh u), X = coth ½(ũ - u) > X₀, "
        f"ϰ² = (Λ1 - Λ2)(Λ2 - Λ3)/(Λ1Λ3), X₀ the greater with h(ϰX₀² + 1/ϰ) = 2I2 X₀, the orbits from "
        f"e^2u = {starts[0]} and {starts[1]} have two different Δ(u) = h₊(u) + h₊(-u), h₊ = lim(u_n - nc), "
        f"c = log((X₀ + 1)/(X₀ - 1)); so Δ is not constant."
    )


def check_form(data: Data) -> None:
    """Raises Rejected unless the file has all its numbers, in their form."""
    check_shape(data, FORM)
    for one in data["orbits"]:
        if not exact(one["start"], "start") > 0:
            raise Rejected("the start x = e^2u of an orbit must be positive")
        decimal(one["end"], data["digits"], "end")


@dataclass(frozen=True)
class Separatrix:
    """The map (1) for every parameter of a box."""

    D: Interval
    middle: Interval
    height: Interval
    kappa: Interval
    last: Interval
    slope: Interval

    @classmethod
    def of(cls, data: Data) -> "Separatrix":
        """The map of a file; raises Rejected unless its hypotheses hold in the whole box."""
        radius = Fraction(data["radius"])
        if radius < 0:
            raise Rejected("the radius must not be negative")
        J = [Fraction(x) for x in data["ball"]["J"]]
        D, h = (Fraction(data["ball"][name]) for name in ("D", "height"))
        bits = scale(data["digits"], FIRST, [*J, D, h])
        check_work(sum(one["steps"] for one in data["orbits"]), bits)
        ball = Ball.within(J, D, radius, bits)
        height = Interval.about(h, bits, radius)
        first, middle, third = ball.inertia
        if not (first > middle and middle > third):
            raise Rejected("I1 > I2 > I3, that is J1 < J2 < J3, is not proved")
        if not height > 0:
            raise Rejected("the height must be positive: that of a negative one is the inverse map")
        check_small_branch(ball, height)
        contact = ball.contact
        kappa = ((first - middle) * (middle - third) / (contact[0] * contact[2])).sqrt()
        root = (middle * middle - height * height).sqrt()
        last = (middle + root) / (height * kappa)
        if not last > 1:
            raise Rejected("X₀ > 1 is not proved")
        return cls(ball.D, middle, height, kappa, last, 2 * root)

    def residual(self, x: Interval, X: Interval) -> Interval:
        """F(X) - D(tanh ũ - tanh u)."""
        plain = self.height * self.kappa * X * X - 2 * self.middle * X + self.height / self.kappa
        return plain - self.D * (8 * x * X / ((x + 1) * self.below(x, X)))

    def derivative(self, x: Interval, X: Interval) -> Interval:
        """The derivative of the residual in X."""
        Q = self.below(x, X)
        return 2 * (self.height * self.kappa * X - self.middle) - self.D * (8 * x * (1 - X * X) / (Q * Q))

    def below(self, x: Interval, X: Interval) -> Interval:
        """Q of (2)."""
        return x * ((X + 1) * (X + 1)) + (X - 1) * (X - 1)

    def half_orbit(self, start: Interval, steps: int) -> Interval:
        """The product of all s_i/s₀ from x = `start` on: the first `steps` factors, and an enclosure of the others."""
        x, product, X = start, 1 + 0 * start, self.first(start)
        for _ in range(steps):
            X = self.root(x, X)
            growth = self.growth(X)
            product = product * (growth / self.growth(self.last))
            x = growth * growth * x
        return product * (1 - self.rest(x)).hull(1 + 0 * x)

    def root(self, x: Interval, near: Interval) -> Interval:
        """X > X₀ of the step from x."""
        (X,) = newton(lambda v: [self.residual(x, v[0])], lambda v: [[self.derivative(x, v[0])]], [near.point()])
        if not self.last < X:
            raise Rejected("the root of a step is not proved to be beyond X₀")
        return X

    def first(self, x: Interval) -> Interval:
        """A point near the root of the first step, by Newton's iteration from X₀."""
        at, X = x.point(), self.last.point()
        for _ in range(FIRST):
            X = (X - self.residual(at, X) / self.derivative(at, X)).point()
        return X

    def growth(self, X: Interval) -> Interval:
        """s at X."""
        return (X + 1) / (X - 1)

    def rest(self, x: Interval) -> Interval:
        """A bound for the sum of log(s₀/s_i) from x on."""
        least = self.growth(self.last + 2 * self.D / (self.slope * x))
        bound = 4 * self.D / (self.slope * (self.last * self.last - 1))
        return bound / (x * (1 - 1 / (least * least)))


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless the two e^Δ prove the statement; returns them."""
    digits, found = data["digits"], []
    separatrix = Separatrix.of(data)
    for one in data["orbits"]:
        start = Fraction(one["start"])
        halves = [Interval.about(x, separatrix.D.bits) for x in (start, 1 / start)]
        end = separatrix.half_orbit(halves[0], one["steps"])
        end = end * (end if start == 1 else separatrix.half_orbit(halves[1], one["steps"]))
        check_rounded([end], [decimal(one["end"], digits, "end")], digits, "end")
        found.append(end)
    if not (found[0] < found[1] or found[1] < found[0]):
        raise Rejected("the two ends are not proved to be different")
    return {"exp Δ": " and ".join(one["end"] for one in data["orbits"])}
