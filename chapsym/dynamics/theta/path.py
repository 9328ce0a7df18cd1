"""The motion by theta functions: time and contact point by quadratures, all else in closed form.

Lemma `chaplygin-theta`: with x = x₀ + UT of `curve`, θ = θ[Δ], θ_S = θ[Δ + the branch points S], and numbers Cₛ,
    pᵢ = Cᵢ θᵢ/θ_d,     qᵢ = Cᵢ' θ_{cdi}/θ_d,     √(1 - da) = C θ/θ_d,     b/√(1 - da) = C' θ_{cd}/θ_d,
and the numbers follow from the start.  The time is the integral of
    dt/dT = √det Λ (k₂√(1 - da) + k₁cb/√(1 - da))/(2cH₂).
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from flint import arb, ctx

from chapsym import generated

from ..levels.balls import exact, unit
from ..levels.proved_root import TooWide
from ..levels.start import fraction
from ..principal_axes import quaternions
from .analytic import Analytic, Disc, combined
from .curve import curve
from .functions import Characteristic, Thetas, size
from .reduction import Reduced, Vector, cross, dot, reduced, times

#: A piece is this part of the disc in which its series are bounded; in it θ_d changes by at most this part of itself.
PART, CHANGE = 0.4, 0.8
#: Bits that a term gains, by PART.
BITS_OF_TERM = 1.3


class Piece(NamedTuple):
    """The motion from one T on, on a disc: p and q, dt/dT, and the rate of the contact point along the two axes.

    time, place: at its start, in balls.  length: of the piece, in T.
    """

    p: Sequence[Analytic]
    q: Sequence[Analytic]
    rate: Analytic
    rolling: Sequence[Analytic]
    time: Any
    place: Vector
    length: Any

    def times(self, s: Any) -> Any:
        """The time at s."""
        return self.time + self.rate.integral(s)


class ThetaPath:
    """A motion in balls of `precision` bits, as `flow.path.Path` is one; every method is to be called with that set.

    J, D, K in principal axes, attitude: a unit quaternion, radius: or None.  time: the motion is known until then.
    """

    def __init__(
        self, precision: int, J: Sequence[Any], D: Any, K: Sequence[Any], attitude: Sequence[Any], radius: Any,
        rotor: Sequence[Any] = (0, 0, 0),
    ) -> None:  # fmt: skip
        self.precision, self.steps, self.radius = precision, 0, radius
        self.tick: Callable[[], None] = lambda: None
        self.given: Callable[[dict[str, Vector]], dict[str, Vector]] = lambda frame: frame
        self.contact: Vector = (arb(0), arb(0))
        scale = J[0] + J[1] + J[2] + D
        self.J, self.D, self.scale = tuple(x / scale for x in J), D / scale, scale
        gamma = generated.rotation(*attitude)[6:]
        found = self.found = reduced(self.J, self.D, tuple(x / scale for x in K), gamma)
        self.space = [generated.rotate(*attitude, *v) for v in (found.p, found.q, cross(found.p, found.q))]
        on = curve(found)
        start, direction = on.line(found)
        named: dict[Any, Characteristic] = {
            "": on.characteristic(),
            "d": on.characteristic("d"),
            "cd": on.characteristic("c", "d"),
        }
        for i in range(3):
            named |= {("p", i): on.characteristic(i), ("q", i): on.characteristic("c", "d", i)}
        terms = int(precision / BITS_OF_TERM) + 8
        self.thetas = Thetas(on.Y, start, direction, named, terms)
        self.T = arb(0)
        self.constants = _constants(self.thetas.series(arb(0)), found)
        self.piece = self._piece(arb(0), (arb(0), arb(0)))

    @property
    def time(self) -> Fraction:
        """Until when the motion is known."""
        return fraction(self.piece.times(self.piece.length).lower())

    @property
    def width(self) -> float:
        """The logarithm to base 2 of what the time is off by."""
        off = float(self.piece.time.rad())
        return float(np.log2(off)) if off else -float(self.precision)

    def advance(self, end: Fraction) -> None:
        """Goes on by a piece."""
        self.tick()
        piece, s = self.piece, self.piece.length
        self.T += s
        self.piece = self._piece(
            piece.times(s), tuple(x + f.integral(s) for x, f in zip(piece.place, piece.rolling, strict=True))
        )
        self.steps += 1

    def _piece(self, time: Any, place: Vector) -> Piece:
        polynomials = self.thetas.series(self.T)
        below = polynomials["d"]
        least = abs(below[0]).abs_lower()
        radius = _radius(below, CHANGE * least, self.thetas.radius)
        disc = Disc(radius, self.thetas.terms)
        functions, beyond = self.thetas.on(disc, polynomials)
        least = (least - size(below - below[0], radius) - beyond).abs_lower()
        if not least > 0:
            raise TooWide
        by = functions["d"].inverse(least)
        quotients = {name: f * by * self.constants[name] for name, f in functions.items() if name != "d"}
        p, q = ([quotients[name, i] for i in range(3)] for name in "pq")
        root, mixed, found = quotients[""], quotients["cd"], self.found
        L1, L2, L3 = found.inertia
        whole = (L1 * L2 * L3).sqrt() / 2
        (g1, g2), (k1, k2) = found.gamma, found.K
        rate = combined((k2 * whole / (found.c * found.energy), k1 * whole / found.energy), (root, mixed))
        if not (rate.series[0].is_finite() and rate.bound.is_finite()):
            raise TooWide
        rolling: Sequence[Analytic] = ()
        if self.radius is not None:
            # ω in p, q and r = p × q, times √(1 - da); the ball moves with ω × γ.
            r, weighted = cross(p, q), times(found.inverse, p)
            about = root * dot(times(found.inverse, q), r) + mixed * dot(weighted, r) * found.d
            along = combined((g2, -g1 / found.c), (mixed, root))
            rolling = (along * (whole * self.radius), about * (whole * self.radius))
        return Piece(p, q, rate, rolling, time, place, (PART * radius).mid())

    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""
        piece, found = self.piece, self.found
        s = self._when(exact(time))
        p, q = ([x.at(s) for x in v] for v in (piece.p, piece.q))
        (g1, g2), (k1, k2) = found.gamma, found.K
        axes = np.array([p, q, cross(p, q)], dtype=object)
        attitude = unit(quaternions(np.array(self.space, dtype=object).T @ axes))
        gamma = unit([g1 * x + g2 * y for x, y in zip(p, q, strict=True)])
        K = tuple(k1 * x + k2 * y for x, y in zip(p, q, strict=True))
        omega = generated.angular_velocity(*(*K, *gamma, *self.J, self.D))
        frame = {"gamma": gamma, "angular_momentum": tuple(x * self.scale for x in K), "omega": omega}
        frame["attitude"] = attitude
        if self.radius is not None:
            along, about = (x + f.integral(s) for x, f in zip(piece.place, piece.rolling, strict=True))
            across = [g1 * y - g2 * x for x, y in zip(self.space[0], self.space[1], strict=True)]
            frame["contact"] = tuple(
                x + along * y + about * z for x, y, z in zip(self.contact, self.space[2], across, strict=False)
            )
        if not all(x.is_finite() for vector in frame.values() for x in vector):
            raise TooWide
        return self.given(frame)

    def _when(self, time: Any) -> Any:
        """The s of a time: Newton's iteration, and an interval on which t rises through it."""
        piece = self.piece
        s = arb(0)
        for _ in range(ctx.prec.bit_length() + 4):
            s = (s - (piece.times(s) - time) / piece.rate.at(s)).mid()
        off = (piece.times(s) - time) / piece.rate.at(s)
        around = s + arb(0, (2 * off).abs_upper())
        # The mean value theorem: the root in `around`, if there is one, and there is if this is inside.
        found = s - (piece.times(s) - time) / piece.rate.at(around)
        if not around.contains_interior(found) and not off == 0:
            raise TooWide
        return found


def _radius(poly: Any, most: Any, largest: Any) -> Any:
    """About the R with Σ|cₖ|Rᵏ = most, k from 1, but no more than the largest: a short number."""
    sizes = np.array([float(abs(x).mid()) for x in poly.coeffs()[1:]])
    powers, low, high = np.arange(1, len(sizes) + 1), 0.0, 1.0
    sizes *= float(largest) ** powers
    for _ in range(16):
        middle = (low + high) / 2
        low, high = (middle, high) if (sizes * middle**powers).sum() < float(most) else (low, middle)
    return arb(float(np.float32(low * float(largest))))


def _constants(series: dict[Any, Any], found: Reduced) -> dict[Any, Any]:
    """Cₛ from the values at the start, or where these are near 0 from the rates, whichever tells more."""
    dp, dq = found.rates()
    root, slope = (1 - found.d * found.a).sqrt(), found.inverse
    below = series["d"]
    rate_of_root = -found.d * dot(times(slope, found.p), dp) / root
    rate_of_b = dot(times(slope, dp), found.q) + dot(times(slope, found.p), dq)
    told = {
        "": (root, rate_of_root),
        "cd": (found.b / root, (rate_of_b - found.b * rate_of_root / root) / root),
    } | {(name, i): (v[i], rate[i]) for name, v, rate in (("p", found.p, dp), ("q", found.q, dq)) for i in range(3)}
    constants = {}
    for name, (value, rate) in told.items():
        quotient = series[name][0] / below[0]
        risen = (series[name][1] - quotient * below[1]) / below[0]
        both = [x / y for x, y in ((value, quotient), (rate, risen)) if not y.contains(0)]
        if not both:
            raise TooWide
        constants[name] = min(both, key=lambda x: float(x.rad()))
    return constants
