"""K fixed in the body's equations alone: Euler's top, in theta functions of genus one, its angle by a quadrature.

Lemma `euler-top`: for D = 0, and for K parallel to γ, ω = κΛ⁻¹q with q = K/|K| and a constant κ = |K|/(1 - Dl),
l = ⟨q,Λ⁻¹q⟩.  With Λ⁻¹ = A, f the axis that q goes round, m that of the middle moment and s the third,
    q_m ~ sn u,  q_s ~ cn u,  q_f ~ dn u,  u'² = κ²(l - A_s)(A_f - A_m),  k² = κ²(A_f - l)(A_m - A_s)/u'²,
and the axis f turns about K in space with χ' = κ(A_m q_m² + A_s q_s²)/(1 - q_f²).
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import acb, arb, arb_mat, arb_poly, arb_series

from chapsym import generated

from ..flow.newton import capped
from ..flow.series import cross
from ..levels.balls import exact, unit
from ..levels.proved_root import TooWide
from ..levels.start import fraction
from .analytic import Analytic, Disc, size
from .functions import Characteristic, Thetas
from .pieces import CHANGE, PART, SMALLER, Piece, Pieces, constants, radius_of
from .reduction import Vector, dot, times

#: θ₄ below, and θ₁, θ₂, θ₃ of sn, cn, dn.
BELOW = Characteristic((0,), (1,))
ABOVE = Characteristic((1,), (1,)), Characteristic((1,), (0,)), Characteristic((0,), (0,))


class Top(Pieces):
    """A motion with D = 0 or K parallel to γ, and three different moments, neither steady nor on the separatrix.

    The parameter is κt.
    """

    def __init__(
        self, precision: int, J: Sequence[Any], D: Any, K: Sequence[Any], attitude: Sequence[Any], radius: Any,
        rotor: Sequence[Any] = (0, 0, 0),
    ) -> None:  # fmt: skip
        super().__init__(precision, J, D, attitude, radius)
        own = tuple(x / self.scale for x in K)
        self.size = dot(own, own).sqrt()
        if not self.size > 0:
            raise TooWide
        q = unit(own)
        J1, J2, J3 = self.J
        self.A = (1 / (J2 + J3 + self.D), 1 / (J1 + J3 + self.D), 1 / (J1 + J2 + self.D))
        self.level = dot(times(self.A, q), q)
        self.rate = self.size / (1 - self.D * self.level)
        self.axes = self._order()
        speed, start, Y = self._curve(q)
        named: dict[Any, Characteristic] = {"": BELOW} | dict(zip(self.axes, ABOVE, strict=True))
        self.thetas = Thetas(Y, [start], [speed], named, self.terms)
        rates = cross(q, times(self.A, q))
        told = {i: (q[i], rates[i]) for i in range(3)}
        self.constants = constants(self.thetas.start_series(), "", told)
        E = self._leaning(q)
        self.space = [generated.rotate(*attitude, *v) for v in (q, E, cross(q, E))]
        self.piece = self._piece((arb(0),) * (1 if radius is None else 3))

    def _order(self) -> tuple[int, int, int]:
        """The axes m, s and f."""
        low, middle, high = sorted(range(3), key=lambda i: fraction(self.A[i].mid()))
        A = self.A
        if not (A[low] < A[middle] < A[high]):
            raise TooWide
        if A[middle] < self.level < A[high]:
            return middle, low, high
        if A[low] < self.level < A[middle]:
            return middle, high, low
        raise TooWide

    def _curve(self, q: Vector) -> tuple[Any, Any, Any]:
        """u'/2K, u/2K at the start, and K'/K."""
        m, s, f = self.axes
        A, l = self.A, self.level
        first, second = (A[f] - l) / (A[f] - A[m]), (A[f] - l) / (A[f] - A[s])
        scale = (l - A[s]) * (A[f] - A[m])
        parameter = (A[f] - l) * (A[m] - A[s]) / scale
        amplitude = arb.atan2(q[m] / first.sqrt(), q[s] / second.sqrt())
        quarter, other = (acb(x).elliptic_k().real for x in (parameter, 1 - parameter))
        u = acb.elliptic_f(acb(amplitude), acb(parameter)).real
        turns = -1 if (f - m) % 3 == 1 else 1  # whether m, f, s are in their cyclic order
        speed = abs(scale).sqrt() * turns * (1 if A[f] > A[s] else -1)
        return (speed if q[f].mid() > 0 else -speed) / (2 * quarter), u / (2 * quarter), arb_mat([[other / quarter]])

    def _leaning(self, q: Sequence[Any]) -> Vector:
        """The unit vector normal to q in the plane of it and the axis f."""
        f = self.axes[2]
        return unit([(1 if i == f else 0) - q[f] * x for i, x in enumerate(q)])

    def _after(self) -> Any:
        return (self.parameter + self.piece.length) / self.rate

    def _piece(self, values: Vector) -> Piece:
        quotients = self._quotients("", self.constants)
        m, s, _ = self.axes
        q = [quotients[i] for i in range(3)]
        square = q[m] * q[m] + q[s] * q[s]
        disc, least = _where_large(square)
        q, square = [x.on(disc) for x in q], square.on(disc)
        by = square.inverse(least)
        turning = (q[m] * q[m] * self.A[m] + q[s] * q[s] * self.A[s]) * by
        disc = Disc((SMALLER * disc.radius).mid(), disc.terms)
        q, square, turning = [x.on(disc) for x in q], square.on(disc), turning.on(disc)
        rates = [turning]
        if self.radius is not None:
            rates += self._rolling(q, turning, square, least, values[0])
        return Piece(q, rates, values, (PART * disc.radius).mid())

    def _rolling(
        self, q: Sequence[Analytic], turning: Analytic, square: Analytic, least: Any, angle: Any
    ) -> list[Analytic]:
        """What of ω in space is normal to K, along E and N at the start: κ(α + iβ)G, G = exp(iχ)/√(1 - q_f²).

        E and N = q × E of the body have the components κα/√(1 - q_f²) and κβ/√(1 - q_f²) of ω, α = q_f(A_f - l) and
        β = -(q × Aq)_f.  `square`: 1 - q_f², at least `least` in size.
        """
        f, disc = self.axes[2], turning.disc
        moved = cross(q, times(self.A, q))[f]
        most = (disc.radius * turning.bound).exp() / least.sqrt()
        with capped(disc.terms):
            angles = arb_series(turning.series.integral().coeffs()[: disc.terms]) + angle
            size = arb_series(square.series.coeffs()).rsqrt()
            waves = [arb_poly((size * wave).coeffs()) for wave in (angles.cos(), angles.sin())]
        cosine, sine = (Analytic(wave, most, disc) for wave in waves)
        alpha = q[f] * (self.A[f] - self.level)
        return [alpha * cosine + moved * sine, alpha * sine - moved * cosine]

    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""
        piece = self.piece
        s = exact(time) * self.rate - self.parameter
        q, angle = unit([x.at(s) for x in piece.functions]), piece.integral(0, s)
        E = self._leaning(q)
        cosine, sine = angle.cos(), angle.sin()
        along, across = self.space[1:]
        space = [
            self.space[0],
            [cosine * x + sine * y for x, y in zip(along, across, strict=True)],
            [cosine * y - sine * x for x, y in zip(along, across, strict=True)],
        ]
        body = [q, E, cross(q, E)]
        gamma = unit([sum((v[2] * w[i] for v, w in zip(space, body, strict=True)), arb(0)) for i in range(3)])
        frame = self._frame((space, body), gamma, tuple(self.size * x for x in q))
        if self.radius is not None:
            turned = (self.rate * self.level * exact(time), piece.integral(1, s), piece.integral(2, s))
            x, y = (sum((w * v[i] for w, v in zip(turned, self.space, strict=True)), arb(0)) for i in range(2))
            frame["contact"] = (self.contact[0] + self.radius * y, self.contact[1] - self.radius * x)
        return self._told(frame)


def _where_large(f: Analytic) -> tuple[Disc, Any]:
    """A smaller disc on which |f| is bounded from below, and this bound."""
    start = abs(f.series[0]).abs_lower()
    radius = radius_of(f.series, CHANGE * start, (SMALLER * f.disc.radius).mid())
    least = start - size(f.series - f.series[0], radius) - f.beyond(radius)
    if not (radius > 0 and least > 0):
        raise TooWide
    return Disc(radius, f.disc.terms), least.abs_lower()
