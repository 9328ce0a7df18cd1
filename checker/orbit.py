"""Certificates of kind periodic-orbit: a periodic point of q steps, and the derivative of these steps there.

Existence.  The step turns 𝒦 and γ by the same rotation, so |γ|², |𝒦|² and ⟨𝒦, γ⟩ are integrals.  If γ and 𝒦 are not
parallel, their level M is the set of all (R𝒦, Rγ), R in SO(3): of dimension 3, with tangent vectors (w × 𝒦, w × γ).
With (𝒦₀, γ₀) from the file let P(𝒦, γ) = 𝒦₀ × 𝒦 + γ₀ × γ.  Newton's test in the six unknowns x = (𝒦, γ) proves a
root of
    |γ|² = 1,  |𝒦|² and ⟨𝒦, γ⟩ as given,  P(G^q(x) - x) = 0.
Then x and G^q(x) have the same integrals and the same P.  The derivative of (integrals, P) is regular on a box that
contains both, so this map is injective there (as in linear.isolated): G^q(x) = x.  The step is evaluated for all 𝒦 and
γ of a box, also with |γ| ≠ 1, and each time the root u is found again.  It is proved to be the only root with |u| < 1
for all of them (`check_branch`), so these are values of one function.  At the root |γ| = 1: it is the small branch.
With a `radius`, all this holds for all J, D, |𝒦|² and ⟨𝒦, γ⟩ within this distance of those of the file.

The derivative.  Let W be the derivative of G^q on M, in the basis V of tangent vectors at x with w = e1, e2, e3:
DG^q·V = V·W, as G^q(x) = x; so W = (PV)⁻¹ P·DG^q·V.  If det W ≠ 1, no measure with a continuous positive density near
the orbit on M is invariant.  If det(1 - W) ≠ 0, no eigenvalue of W is 1: an integral F of class C¹ has dF·W = dF at x,
so dF = 0 there on M: to first order F depends on the momentum integrals alone.
"""

from fractions import Fraction

from .document import DIGITS, STEPS, Data, check_rounded, check_work, decimal, decimals, exact, scale, sized
from .form import HEAD, check_shape
from .interval import Interval, Rejected
from .linear import Matrix, Vector, cross, determinant, dot, minus, newton, plus, solve, times, transposed, units
from .step import Ball, Pair, check_small_branch, gibbs_vector, moved, tangents

ATTRACTING = " All its eigenvalues are inside the unit circle: the orbit attracts what starts near it on the level."
#: The invariants of W; "trace" only if the statement says that the orbit is attracting.
MULTIPLIERS = ("determinant", "unit_eigenvalue", "trace")
INTEGRALS = ("momentum.momentum", "momentum.gamma")
NUMBERS = (exact,) * 3
FORM = HEAD | {
    "ball": {"J": NUMBERS, "D": exact}, "radius?": exact, "integrals": dict.fromkeys(INTEGRALS, exact), "steps": STEPS,
    "digits": DIGITS, "start": {"momentum": NUMBERS, "gamma": NUMBERS}, "orbit": [{"u": NUMBERS}],
    "determinant": exact, "unit_eigenvalue": exact, "trace?": exact,
}  # fmt: skip


def statement(data: Data) -> str:
    """The theorem, with the numbers of the file."""
    size, height = (data["integrals"][name] for name in INTEGRALS)
    the, within = ("every", f", every number within {data['radius']},") if "radius" in data else ("the", "")
    return (
        f"For {the} ball with J = ({', '.join(data['ball']['J'])}), D = {data['ball']['D']}: "
        f"with ⟨𝒦, 𝒦⟩ = {size}, ⟨𝒦, γ⟩ = {height}{within} a point is back after {data['steps']} steps, "
        f"and the derivative of these steps on the "
        f"level of the integrals there has a determinant other than 1 and no eigenvalue 1."
        f"{ATTRACTING if 'trace' in data else ''}"
    )


def check_form(data: Data) -> None:
    """Raises Rejected unless the file has all its numbers, in their form."""
    check_shape(data, FORM)
    if exact(data.get("radius", "0"), "radius") < 0:
        raise Rejected("the radius must not be negative")


class Search:
    """The equations of the periodic orbit and their derivatives, in intervals."""

    def __init__(self, data: Data):
        self.digits, q = data["digits"], data["steps"]
        sized(data["orbit"], q, "orbit")
        J, D = [Fraction(x) for x in data["ball"]["J"]], Fraction(data["ball"]["D"])
        integrals = [Fraction(data["integrals"][name]) for name in INTEGRALS]
        bits = scale(self.digits, q, [*J, D, *integrals])
        check_work(6 * q, bits)
        radius = Fraction(data.get("radius", "0"))
        self.ball = Ball.within(J, D, radius, bits)
        self.size, self.height = (Interval.about(x, bits, radius) for x in integrals)
        check_small_branch(self.ball, self.size.sqrt())
        self.gibbs = []
        for i, given in enumerate(data["orbit"], 1):
            self.gibbs.append(decimals(given["u"], self.digits, f"u of step {i}"))
        self.near = [[Interval.about(x, bits).point() for x in u] for u in self.gibbs]
        self.given = [decimals(data["start"][name], self.digits, name) for name in ("momentum", "gamma")]
        self.stated = {name: decimal(data[name], self.digits, name) for name in MULTIPLIERS if name in data}
        self.centre = [Interval.about(x, bits).point() for v in self.given for x in v]
        self.units = units(3, self.size)

    def after(self, x: Vector, vectors: list[Pair]) -> tuple[Vector, list[Pair], list[Vector]]:
        """G^q(x), its derivative applied to tangent vectors, and the Gibbs vectors of the steps."""
        self.check_branch(x)
        state, gibbs = (x[:3], x[3:]), []
        for near in self.near:
            u = gibbs_vector(self.ball, state, near)
            vectors = tangents(self.ball, state, u, vectors) if vectors else []
            state = moved(u, state)
            gibbs.append(u)
        return [*state[0], *state[1]], vectors, gibbs

    def check_branch(self, x: Vector) -> None:
        """Raises Rejected unless (1) of step.py has one root with |u| < 1 for all 𝒦 and γ of the box, and after steps.

        The steps preserve |𝒦| and |γ|.  As ⟨u, Λu - D⟨γ, u⟩γ⟩ ≥ ⟨u, Iu⟩ - D(|γ|² - 1)|u|², the proof in
        check_small_branch holds for every |γ| if I - D(|γ|² - 1) replaces I.
        """
        momentum, gamma = x[:3], x[3:]
        off = self.ball.D * (dot(gamma, gamma) - 1)
        check_small_branch(Ball([I - off for I in self.ball.inertia], self.ball.D), dot(momentum, momentum).sqrt())

    def projection(self, x: Vector) -> Vector:
        """P(x)."""
        return plus(cross(self.centre[:3], x[:3]), cross(self.centre[3:], x[3:]))

    def residual(self, x: Vector) -> Vector:
        """The residuals of the six equations."""
        momentum, gamma = x[:3], x[3:]
        integrals = [dot(gamma, gamma) - 1, dot(momentum, momentum) - self.size, dot(momentum, gamma) - self.height]
        return [*integrals, *self.projection(minus(self.after(x, [])[0], x))]

    def gradients(self, x: Vector) -> Matrix:
        """The derivatives of the three integrals."""
        momentum, gamma = x[:3], x[3:]
        zero = times(0, gamma)
        return [[*zero, *times(2, gamma)], [*times(2, momentum), *zero], [*gamma, *momentum]]

    def basis(self) -> list[Pair]:
        """The six unit vectors of (𝒦, γ)."""
        zero = times(0, self.units[0])
        return [(e, zero) for e in self.units] + [(zero, e) for e in self.units]

    def jacobian(self, x: Vector) -> Matrix:
        """The derivative of the six residuals."""
        basis = self.basis()
        moved_basis = self.after(x, basis)[1]
        columns = [self.projection(minus(_flat(v), _flat(e))) for v, e in zip(moved_basis, basis, strict=True)]
        return [*self.gradients(x), *transposed(columns)]

    def check_injective(self, x: Vector) -> None:
        """Raises Rejected unless (integrals, P) is injective on the box x: its derivative is regular there."""
        matrix = [*self.gradients(x), *transposed([self.projection(_flat(e)) for e in self.basis()])]
        solve(matrix, [[y] for y in x])

    def return_map(self, x: Vector) -> tuple[Matrix, list[Vector]]:
        """W, and the Gibbs vectors of the orbit."""
        before = [(cross(e, x[:3]), cross(e, x[3:])) for e in self.units]
        after, gibbs = self.after(x, before)[1:]
        left, right = (transposed([self.projection(_flat(v)) for v in vectors]) for vectors in (before, after))
        return solve(left, right), gibbs


def _flat(v: Pair) -> Vector:
    return [*v[0], *v[1]]


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless the orbit exists and its derivative is as stated; returns the proved numbers."""
    search = Search(data)
    digits = search.digits
    x = newton(search.residual, search.jacobian, search.centre)
    end = search.after(x, [])[0]
    search.check_injective([y.hull(z) for y, z in zip(x, end, strict=True)])
    check_rounded(x, [*search.given[0], *search.given[1]], digits, "start")
    W, gibbs = search.return_map(x)
    for i, (u, near) in enumerate(zip(gibbs, search.gibbs, strict=True), 1):
        check_rounded(u, near, digits, f"u of step {i}")
    one_less = [minus(e, row) for e, row in zip(search.units, W, strict=True)]
    proved = dict(zip(MULTIPLIERS, (determinant(W), determinant(one_less), W[0][0] + W[1][1] + W[2][2]), strict=True))
    for name, number in search.stated.items():
        check_rounded([proved[name]], [number], digits, name)
    if not (proved["determinant"] - 1).sign or not proved["unit_eigenvalue"].sign:
        raise Rejected("the determinant is not proved to differ from 1, or an eigenvalue may be 1")
    if "trace" in data and not attracts(*proved.values()):
        raise Rejected("the eigenvalues are not all proved to be inside the unit circle")
    return {name: data[name] for name in search.stated}


def attracts(det: Interval, chi: Interval, trace: Interval) -> bool:
    """Whether all eigenvalues of W are inside the unit circle, by Jury's criterion for χ(λ) = λ³ - tλ² + mλ - d.

    χ(1) > 0, χ(-1) < 0, |d| < 1, |m - td| < 1 - d², where m = χ(1) - 1 + t + d.
    """
    minors = chi - 1 + trace + det
    rest, room = minors - trace * det, 1 - det * det
    return chi > 0 and 1 + trace + minors + det > 0 and room > 0 and rest < room and -rest < room
