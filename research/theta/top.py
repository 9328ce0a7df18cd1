"""K fixed in the body's equations alone: Euler's top, in theta functions of genus one.

Lemma `euler-top`: for D = 0, and for K parallel to γ, ω = κΛ⁻¹q with q = K/|K| and a constant κ = |K|/(1 - Dl),
l = ⟨q,Λ⁻¹q⟩.  With Λ⁻¹ = A, f the axis that q goes round, m that of the middle moment and s the third,
    q_m = c_m sn u,  q_s = c_s cn u,  q_f = c_f dn u,  u'² = κ²(l - A_s)(A_f - A_m),  k² = κ²(A_f - l)(A_m - A_s)/u'²,
    c_m² = (A_f - l)/(A_f - A_m),  c_s² = (A_f - l)/(A_f - A_s),  c_f² = (l - A_s)/(A_f - A_s),
and the axis f turns about K in space with χ' = κ(A_m q_m² + A_s q_s²)/(1 - q_f²).

The angle (by hand).  With u = 2Kz, ν = √(1 - q_f²)exp(iχ) = C exp(λt) θ₁(z - α)/θ₄(z): a null vector that is fixed in
space has the component ν on the axis f.  ν'/ν = -q_f q_f'/(1 - q_f²) + iχ' is an elliptic function of z with the
periods 1 and iK'/K.  Its poles are simple: iK'/2K, the pole of q_f, where χ' is finite (residue -1), and the zeros
±α of 1 - q_f², where the two terms have the residues ½ and ±½, so that one of them stays.  The quotient's is the same,
and their difference is a constant, λ, imaginary as |ν| and |θ₁(z - α)/θ₄(z)| have the period 1.  At a zero
q_m/q_s = ±i, and the residue there is 1 where q_m/q_s = -iεq_f, ε = 1 if m, s, f are in their cyclic order, else -1.
As q_m/q_s = ic_m sn(y,k')/c_s and q_f has the sign of c_f at u = iy, sn(y,k') = c_s/c_m in size, of the sign -εc_f.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import acb, arb

from chapsym import generated
from chapsym.dynamics.flow.series import cross, dot
from chapsym.dynamics.levels.balls import exact, unit
from chapsym.dynamics.levels.proved_root import TooWide
from chapsym.dynamics.levels.start import fraction

from .motion import Motion
from .reduction import Vector, times

I = acb(0, 1)


class Top(Motion):
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
        self.turning = self.size / (1 - self.D * self.level)
        self.axes = self._order()
        E = self._leaning(q)
        self.space = [generated.rotate(*attitude, *v) for v in (q, E, cross(q, E))]
        self._solve(q)

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

    def _solve(self, q: Vector) -> None:
        """The line of z, the period iK'/K, and what the functions are multiplied with."""
        (m, s, f), A, l = self.axes, self.A, self.level
        up = 1 if q[f].mid() > 0 else -1
        cyclic = -1 if (f - m) % 3 == 1 else 1
        c_m, c_s = ((A[f] - l) / (A[f] - A[m])).sqrt(), ((A[f] - l) / (A[f] - A[s])).sqrt()
        c_f = ((l - A[s]) / (A[f] - A[s])).sqrt() * up
        scale = (l - A[s]) * (A[f] - A[m])
        parameter, other = (A[f] - l) * (A[m] - A[s]) / scale, (A[f] - A[s]) * (l - A[m]) / scale
        quarter, second = (acb(x).elliptic_k().real for x in (parameter, other))
        amplitude = arb.atan2(q[m] / c_m, q[s] / c_s)
        self.origin = acb.elliptic_f(acb(amplitude), acb(parameter)).real / (2 * quarter)
        self.speed = abs(scale).sqrt() / (2 * quarter)
        self.way = up * cyclic * (1 if A[f] > A[s] else -1)
        self.tau = acb(0, second / quarter)
        zero = acb.elliptic_f(acb((c_s / c_m).asin()), acb(other)).real / (2 * quarter)
        self.alpha = acb(0, -up * cyclic * zero)
        _, t2, t3, t4 = (x.real for x in acb.modular_theta(acb(0), self.tau))
        # sn, cn and dn are these times θ₁/θ₄, θ₂/θ₄ and θ₃/θ₄.
        self.factors = (c_m * t3 / t2, c_s * t4 / t2, c_f * t4 / t3)
        self._wind(q)

    def _wind(self, q: Vector) -> None:
        """λ, and C so that χ = 0 at the start."""
        m, s, _ = self.axes
        square = q[m] * q[m] + q[s] * q[s]
        angle = (self.A[m] * q[m] * q[m] + self.A[s] * q[s] * q[s]) / square
        z = acb(self.origin)
        first, first_rate = ((z - self.alpha).modular_theta(self.tau, r)[0] for r in (0, 1))
        fourth, fourth_rate = (z.modular_theta(self.tau, r)[3] for r in (0, 1))
        self.winding = acb(0, angle - (first_rate / first - fourth_rate / fourth).imag * self.speed * self.way)
        self.factor = fourth / first * square.sqrt()

    def _functions(self, s: Any) -> tuple[Vector, Any, Any]:
        """q, 1 - q_f² and ν."""
        z = self.origin + self.speed * self.way * acb(s)
        *above, below = z.modular_theta(self.tau)
        q: list[Any] = [None] * 3
        for i, x, factor in zip(self.axes, above, self.factors, strict=True):
            q[i] = x / below * factor
        nu = self.factor * (self.winding * s).exp() * (z - self.alpha).modular_theta(self.tau)[0] / below
        middle, third, _ = self.axes
        return tuple(q), q[middle] * q[middle] + q[third] * q[third], nu

    def _leaning(self, q: Sequence[Any]) -> Vector:
        """The unit vector normal to q in the plane of it and the axis f."""
        f = self.axes[2]
        return unit([(1 if i == f else 0) - q[f] * x for i, x in enumerate(q)])

    def rate(self, s: Any) -> Any:
        """dt/ds, constant."""
        return acb(1 / self.turning)

    def later(self, s: Any) -> Any:
        """The time at s."""
        return s / self.turning

    def when(self, time: Any) -> Any:
        """The s of a time."""
        return time * self.turning

    def rolling(self, s: Any) -> Any:
        """What of ω in space is normal to K, along E and i times along N at the start: (α + iβ)ν/(1 - q_f²) by s.

        E and N = q × E of the body have the components κα/√(1 - q_f²) and κβ/√(1 - q_f²) of ω, α = q_f(A_f - l) and
        β = -(q × Aq)_f.
        """
        (q, square, nu), f = self._functions(s), self.axes[2]
        return (q[f] * (self.A[f] - self.level) - cross(q, times(self.A, q))[f] * I) * nu / square

    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""
        s = self.when(exact(time))
        every, _, nu = self._functions(s)
        q = unit([x.real for x in every])
        cosine, sine = unit((nu.real, nu.imag))
        E, (axis, along, across) = self._leaning(q), self.space
        space = [
            axis,
            [cosine * x + sine * y for x, y in zip(along, across, strict=True)],
            [cosine * y - sine * x for x, y in zip(along, across, strict=True)],
        ]
        body = [q, E, cross(q, E)]
        gamma = unit([sum((v[2] * w[i] for v, w in zip(space, body, strict=True)), arb(0)) for i in range(3)])
        rolled = self.rolled(s)
        turned = (self.turning * self.level * exact(time), rolled.real, rolled.imag)
        x, y = (sum((w * v[i] for w, v in zip(turned, self.space, strict=True)), arb(0)) for i in range(2))
        return self._told((space, body), gamma, tuple(self.size * x for x in q), (y, -x))
