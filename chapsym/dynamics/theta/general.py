"""The general motion: time and contact point by quadratures, all else in theta functions of genus two.

Lemma `chaplygin-theta`: with x = x₀ + UT of `curve`, θ = θ[Δ], θ_S = θ[Δ + the branch points S], and numbers Cₛ,
    pᵢ = Cᵢ θᵢ/θ_d,     qᵢ = Cᵢ' θ_{cdi}/θ_d,     √(1 - da) = C θ/θ_d,     b/√(1 - da) = C' θ_{cd}/θ_d,
and the numbers follow from the start.  The time is the integral of
    dt/dT = √det Λ (k₂√(1 - da) + k₁cb/√(1 - da))/(2cH₂).
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import arb, ctx

from chapsym import generated

from ..flow.series import cross
from ..levels.balls import exact, unit
from ..levels.proved_root import TooWide
from .analytic import combined
from .curve import curve
from .functions import Characteristic, Thetas
from .pieces import PART, Piece, Pieces, constants
from .reduction import Reduced, Vector, dot, reduced, times


class General(Pieces):
    """A motion with three different moments, D > 0 and K not vertical, neither steady nor on the separatrix."""

    def __init__(
        self, precision: int, J: Sequence[Any], D: Any, K: Sequence[Any], attitude: Sequence[Any], radius: Any,
        rotor: Sequence[Any] = (0, 0, 0),
    ) -> None:  # fmt: skip
        super().__init__(precision, J, D, attitude, radius)
        found = self.found = reduced(self.J, self.D, tuple(x / self.scale for x in K), self.gamma)
        self.space = [generated.rotate(*attitude, *v) for v in (found.p, found.q, cross(found.p, found.q))]
        on = curve(found)
        named: dict[Any, Characteristic] = {
            "": on.characteristic(), "d": on.characteristic("d"), "cd": on.characteristic("c", "d")
        }  # fmt: skip
        for i in range(3):
            named |= {("p", i): on.characteristic(i), ("q", i): on.characteristic("c", "d", i)}
        self.thetas = Thetas(on.Y, *on.line(found), named, self.terms)
        self.constants = constants(self.thetas.start_series(), "d", _told(found))
        self.piece = self._piece((arb(0),) * (1 if radius is None else 3))

    def _piece(self, values: Vector) -> Piece:
        quotients, found = self._quotients("d", self.constants), self.found
        p, q = ([quotients[name, i] for i in range(3)] for name in "pq")
        root, mixed = quotients[""], quotients["cd"]
        L1, L2, L3 = found.inertia
        whole = (L1 * L2 * L3).sqrt() / 2
        (g1, g2), (k1, k2) = found.gamma, found.K
        rates = [combined((k2 * whole / (found.c * found.energy), k1 * whole / found.energy), (root, mixed))]
        if not rates[0].series[0] > 0:
            raise TooWide
        if self.radius is not None:
            # ω in p, q and r = p × q, times √(1 - da); the ball moves with ω × γ.
            r, weighted = cross(p, q), times(found.inverse, p)
            about = root * dot(times(found.inverse, q), r) + mixed * dot(weighted, r) * found.d
            along = combined((g2, -g1 / found.c), (mixed, root))
            rates += [along * (whole * self.radius), about * (whole * self.radius)]
        return Piece([*p, *q], rates, values, (PART * root.disc.radius).mid())

    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""
        piece, found = self.piece, self.found
        s = self._when(exact(time))
        every = [x.at(s) for x in piece.functions]
        p, q = every[:3], every[3:]
        (g1, g2), (k1, k2) = found.gamma, found.K
        gamma = unit([g1 * x + g2 * y for x, y in zip(p, q, strict=True)])
        K = tuple(k1 * x + k2 * y for x, y in zip(p, q, strict=True))
        frame = self._frame((self.space, [p, q, cross(p, q)]), gamma, K)
        if self.radius is not None:
            across = [g1 * y - g2 * x for x, y in zip(self.space[0], self.space[1], strict=True)]
            moved = zip(self.contact, self.space[2], across, strict=False)
            frame["contact"] = tuple(x + piece.integral(1, s) * y + piece.integral(2, s) * z for x, y, z in moved)
        return self._told(frame)

    def _when(self, time: Any) -> Any:
        """The s of a time, which rises with s: Newton's iteration, and an interval that it maps into itself."""
        piece, s = self.piece, arb(0)
        rate = piece.rates[0]
        for _ in range(ctx.prec.bit_length() + 4):
            s = (s - (piece.integral(0, s) - time) / rate.at(s)).mid()
        late = piece.integral(0, s) - time
        around = s + arb(0, (2 * late / rate.at(s)).abs_upper())
        found = s - late / rate.at(around)
        if not around.contains_interior(found) and not late == 0:
            raise TooWide
        return found


def _told(found: Reduced) -> dict[Any, tuple[Any, Any]]:
    """The values and the rates at the start of all that the theta functions give."""
    (dp, dq), p = found.rates(), times(found.inverse, found.p)
    root = (1 - found.d * found.a).sqrt()
    root_rate, b_rate = -found.d * dot(p, dp) / root, dot(times(found.inverse, dp), found.q) + dot(p, dq)
    told: dict[Any, tuple[Any, Any]] = {
        "": (root, root_rate), "cd": (found.b / root, (b_rate - found.b * root_rate / root) / root)
    }  # fmt: skip
    for name, vector, rates in (("p", found.p, dp), ("q", found.q, dq)):
        told |= {(name, i): pair for i, pair in enumerate(zip(vector, rates, strict=True))}
    return told
