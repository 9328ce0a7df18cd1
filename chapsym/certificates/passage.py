"""q steps of the whole map in Arb's balls: their rotation of the body, and its derivative.

A step turns 𝒦 and γ by the same rotation.  If 𝒦 and γ are not parallel, the level M of |γ|, |𝒦| and ⟨𝒦, γ⟩ is the set
of all (R𝒦, Rγ), R in SO(3); a tangent vector is (w × 𝒦, w × γ); and a point returns after q steps if and only if the
product T of their rotations is 1.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, arb_mat, ctx

from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.levels.balls import cross_matrix, exact
from chapsym.dynamics.levels.proved_root import certified, inverse_slope, newton_enclosure, upper
from chapsym.dynamics.loops.vectors import cross, dot
from chapsym.generated import compose, gibbs_residual

from .balls import NotProved, near_root

Vector = Sequence[arb]


@dataclass(frozen=True)
class Level:
    """A ball and the level M: J, D, |𝒦|² and ⟨𝒦, γ⟩, exact."""

    J: tuple[Fraction, Fraction, Fraction]
    D: Fraction
    size: Fraction
    height: Fraction


@dataclass(frozen=True)
class Passage:
    """A passage of q steps: the product T of their rotations, and its change with the start.

    quaternion: of T, which maps the start to the end.  turned: T, (3, 3).  change: the ω of dT = [ω]×T for four
    variations of the start, (3, 4): (w × 𝒦, w × γ) for w = e1, e2, e3, and ((𝒦 × γ) × 𝒦, 0), which turns only 𝒦, and
    changes ⟨𝒦, γ⟩ by |𝒦 × γ|².  gibbs: the Gibbs vectors of the steps.
    """

    quaternion: Vector
    turned: arb_mat
    change: arb_mat
    gibbs: list[Vector]

    def error(self) -> arb_mat:
        """The vector part of the quaternion, which is 0 if and only if the point returns."""
        return column(self.quaternion[1:])

    def slope(self) -> arb_mat:
        """The derivative of `error` by the four variations: dp = ½ω∘p."""
        return (self.quaternion[0] * identity() - cross_matrix(self.quaternion[1:])) * self.change / 2

    def derivative(self) -> arb_mat:
        """W, with DG^q(w × 𝒦, w × γ) = (Ww × 𝒦', Ww × γ') at the end (𝒦', γ')."""
        return self.turned + columns(self.change, 3)


class Map:
    """The steps of a ball at fixed |𝒦|², for all parameters in Arb balls; for use at a single precision."""

    def __init__(self, J: Vector, D: arb, size: arb) -> None:
        self.inertia, self.D = (J[1] + J[2], J[0] + J[2], J[0] + J[1]), D
        if (bound := certified(size.sqrt(), self.inertia)) is None:
            raise BadInput("|momentum| is beyond the bound of the lemma small-branch, so no step is certified")
        self.radius, self.monotone = bound

    @classmethod
    def of(cls, level: Level) -> "Map":
        """The map of an exact level."""
        return cls([exact(x) for x in level.J], exact(level.D), exact(level.size))

    def passage(self, momentum: Vector, gamma: Vector, steps: int) -> Passage:
        """`steps` steps from 𝒦 and γ.  Raises NotProved or TooWide if the balls are too wide."""
        K, g = column(momentum), column(gamma)
        dK, dg, change = self._variations(momentum, gamma)
        turned, quaternion, gibbs = identity(), (arb(1), arb(0), arb(0), arb(0)), []
        for _ in range(steps):
            k, v = [x / 2 for x in K.entries()], g.entries()
            u, inverse = self.root(k, v)
            U, norm = cross_matrix(u), 1 + dot(u, u)
            step = identity() + (U * U - U) * (2 / norm)
            # Differential of G(u) = 0, |γ| = 1: ∂G du = ½(1 + |u|²)d𝒦 + D(⟨dγ, u⟩γ + ⟨γ, u⟩dγ); then dΩᵀΩ = [ω]×.
            du = inverse * (dK * (norm / 2) + (g * (column(u).transpose() * dg) + dg * dot(v, u)) * self.D)
            omega = (U - identity()) * du * (2 / norm)
            K, g, turned, change = step * K, step * g, step * turned, step * change + omega
            dK, dg = step * dK - cross_matrix(K.entries()) * omega, step * dg - cross_matrix(g.entries()) * omega
            length = norm.sqrt()
            quaternion = compose(*(*(x / length for x in (arb(1), *(-y for y in u))), *quaternion))
            gibbs.append(u)
        return Passage(quaternion, turned, change, gibbs)

    def root(self, k: Vector, g: Vector) -> tuple[Vector, arb_mat]:
        """The root |u| < 1 of G for all k and γ in their balls, by lemma `small-branch`, and (∂G/∂u)⁻¹ there."""
        if not upper(near := near_root(k, g, self.inertia, self.D)) <= self.radius:
            raise NotProved("a step is not near its root")
        state = (*k, *g, *self.inertia, self.D)
        u = newton_enclosure(near, gibbs_residual(*(*near, *state)), self.monotone, state, ctx.prec)
        return u, inverse_slope(u, arb(0), state)

    def _variations(self, momentum: Vector, gamma: Vector) -> tuple[arb_mat, arb_mat, arb_mat]:
        """d𝒦, dγ and ω of the four variations at the start."""
        towards: Vector = cross(cross(momentum, gamma), momentum)
        dK, dg = (
            arb_mat([[*row, x] for row, x in zip((-1 * cross_matrix(v)).tolist(), last, strict=True)])
            for v, last in ((momentum, towards), (gamma, [arb(0)] * 3))
        )
        return dK, dg, arb_mat(3, 4)


def column(v: Vector) -> arb_mat:
    """A vector as a matrix of one column."""
    return arb_mat(len(v), 1, v)


def columns(m: arb_mat, count: int) -> arb_mat:
    """The first columns of a matrix."""
    return arb_mat([row[:count] for row in m.tolist()])


def identity() -> arb_mat:
    """The unit matrix."""
    return arb_mat([[int(i == j) for j in range(3)] for i in range(3)])
