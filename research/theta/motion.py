"""The motion in theta functions: the parameter of a time, and what has no closed form, by Arb's quadrature.

Lemma `chaplygin-theta`: with x = x₀ + UT of `curve`, θ = θ[Δ], θ_S = θ[Δ + the branch points S], and numbers Cₛ,
    pᵢ = Cᵢ θᵢ/θ_d,     qᵢ = Cᵢ' θ_{cdi}/θ_d,     √(1 - da) = C θ/θ_d,     b/√(1 - da) = C' θ_{cd}/θ_d,
and the numbers follow from the start.  The time is the integral of
    dt/dT = √det Λ (k₂√(1 - da) + k₁cb/√(1 - da))/(2cH₂).
"""

import itertools
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from flint import acb, arb, ctx

from chapsym import generated
from chapsym.dynamics.flow.series import cross, dot
from chapsym.dynamics.levels.balls import exact, unit
from chapsym.dynamics.levels.proved_root import TooWide
from chapsym.dynamics.levels.start import fraction
from chapsym.dynamics.principal_axes import quaternions

from .curve import curve
from .functions import Thetas
from .reduction import Reduced, Vector, reduced, times

#: A piece is at most this part of a period, and goes beyond the time that is asked for by this factor.
PIECE, BEYOND = 0.5, 1.1
#: The precision in which the parameter of a time is first looked for.
FIRST_BITS = 64
#: The most values of a function for one integral, for each bit; and how many there are between two calls of `tick`.
MOST_VALUES, VALUES_OF_TICK = 64, 64


class Reached(NamedTuple):
    """A value of the parameter, the time there, and the integral of `rolling` until there."""

    parameter: Any
    time: Any
    rolled: Any


class Motion(ABC):
    """A motion in balls of `precision` bits, as `flow.path.Path` is one; every method is to be called with that set.

    J, D, K in principal axes, attitude: a unit quaternion, radius: or None.  speed: of the parameter, in periods.
    """

    speed: Any

    def __init__(self, precision: int, J: Sequence[Any], D: Any, attitude: Sequence[Any], radius: Any) -> None:
        self.precision, self.steps, self.radius = precision, 0, radius
        self.tick: Callable[[], None] = lambda: None
        self.given: Callable[[dict[str, Vector]], dict[str, Vector]] = lambda frame: frame
        self.contact: Vector = (arb(0), arb(0))
        self.scale = J[0] + J[1] + J[2] + D
        self.J, self.D = tuple(x / self.scale for x in J), D / self.scale
        self.gamma: Vector = generated.rotation(*attitude)[6:]
        self.start = self.end = Reached(arb(0), arb(0), acb(0))

    @abstractmethod
    def rate(self, s: Any) -> Any:
        """dt/ds, for s in a complex ball."""

    @abstractmethod
    def rolling(self, s: Any) -> Any:
        """How the contact point goes, one component and i times another for real s, in a complex ball."""

    @abstractmethod
    def when(self, time: Any) -> Any:
        """The parameter at a time in the last piece."""

    @abstractmethod
    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""

    @property
    def time(self) -> Fraction:
        """Until when the motion is known."""
        return fraction(self.end.time.lower())

    @property
    def width(self) -> float:
        """The logarithm to base 2 of how far what is integrated may be off."""
        off = float(max(self.end.time.rad(), self.end.rolled.real.rad(), self.end.rolled.imag.rad()))
        return float(np.log2(off)) if off else -float(self.precision)

    def advance(self, end: Fraction) -> None:
        """Goes on by a piece, which may end a little after `end`."""
        self.tick()
        s, longest = self.end.parameter, PIECE / self.speed
        length = BEYOND * (exact(end) - self.end.time) / self.rate(acb(s)).real
        length = length.max(longest / 64).min(longest).mid()
        if not (length.is_finite() and length > 0):
            raise TooWide
        self.start, s = self.end, s + length
        self.end = Reached(s, self.later(s), self.rolled(s))
        self.steps += 1

    def later(self, s: Any) -> Any:
        """The time at s, in the last piece."""
        return self.start.time + self._integral(self.rate, s).real

    def rolled(self, s: Any) -> Any:
        """The integral of `rolling` until s, in the last piece."""
        return self.start.rolled + (self._integral(self.rolling, s) if self.radius is not None else 0)

    def _integral(self, function: Callable[[Any], Any], s: Any) -> Any:
        """From the start of the piece to s.  What `tick` raises must not pass through Arb, so it waits."""
        first, count, raised = acb(self.start.parameter), itertools.count(), []

        def value(x: Any, analytic: bool) -> Any:
            try:
                if next(count) % VALUES_OF_TICK == 0:
                    self.tick()
            except Exception as error:
                raised.append(error)
            return acb("nan") if raised else function(x)

        if not (s.is_finite() and function(first).is_finite()):
            raise TooWide
        found = acb.integral(value, first, acb(s), eval_limit=MOST_VALUES * ctx.prec)
        if raised:
            raise raised[0]
        if not found.is_finite():
            raise TooWide
        return found

    def _told(self, turn: tuple[Any, Any], gamma: Vector, K: Vector, moved: Vector) -> dict[str, Vector]:
        """A frame from three vectors in space and the same in the body, in rows, from γ and from K in units of it."""
        space, body = (np.array(rows, dtype=object) for rows in turn)
        attitude = unit(quaternions(space.T @ body))
        omega = generated.angular_velocity(*(*K, *gamma, *self.J, self.D))
        momentum = tuple(x * self.scale for x in K)
        frame: dict[str, Vector] = {"gamma": gamma, "angular_momentum": momentum, "omega": omega, "attitude": attitude}
        if self.radius is not None:
            frame["contact"] = tuple(x + self.radius * y for x, y in zip(self.contact, moved, strict=True))
        if not all(x.is_finite() for vector in frame.values() for x in vector):
            raise TooWide
        return self.given(frame)


class General(Motion):
    """A motion with three different moments, D > 0 and K not vertical, neither steady nor on the separatrix."""

    def __init__(
        self, precision: int, J: Sequence[Any], D: Any, K: Sequence[Any], attitude: Sequence[Any], radius: Any,
        rotor: Sequence[Any] = (0, 0, 0),
    ) -> None:  # fmt: skip
        super().__init__(precision, J, D, attitude, radius)
        found = self.found = reduced(self.J, self.D, tuple(x / self.scale for x in K), self.gamma)
        self.space = [generated.rotate(*attitude, *v) for v in (found.p, found.q, cross(found.p, found.q))]
        on = curve(found)
        line = on.line(found)
        named = [(), ("c", "d"), *((i,) for i in range(3)), *(("c", "d", i) for i in range(3))]
        every = [on.characteristic(*names) for names in (("d",), *named)]
        self.timing, self.thetas = (Thetas(on.Y, *line, some) for some in (every[:3], every))
        self.speed = self.thetas.speed
        self.constants = _constants(self.thetas, _told(found))
        L1, L2, L3 = found.inertia
        self.whole = (L1 * L2 * L3).sqrt() / 2
        if not self.rate(acb(0)).real > 0:
            raise TooWide

    def _quotients(self, thetas: Thetas, s: Any) -> list[Any]:
        below, *above = thetas.at(s)
        by = 1 / below
        return [x * by * y for x, y in zip(above, self.constants, strict=False)]

    def rate(self, s: Any) -> Any:
        """dt/dT."""
        root, mixed = self._quotients(self.timing, s)
        k1, k2 = self.found.K
        return (root * (k2 / self.found.c) + mixed * k1) * (self.whole / self.found.energy)

    def rolling(self, s: Any) -> Any:
        """ω along what is normal to γ in the plane of p and q, and i times ω along r = p × q: by T."""
        found, (g1, g2) = self.found, self.found.gamma
        root, mixed, *vectors = self._quotients(self.thetas, s)
        p, q = vectors[:3], vectors[3:]
        r = cross(p, q)
        about = root * dot(times(found.inverse, q), r) + mixed * dot(times(found.inverse, p), r) * found.d
        along = mixed * g2 - root * (g1 / found.c)
        return (along + about * acb(0, 1)) * self.whole

    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The motion at a time in the last piece."""
        s, (g1, g2), (k1, k2) = self.when(exact(time)), self.found.gamma, self.found.K
        _, _, *every = (x.real for x in self._quotients(self.thetas, s))
        p, q = every[:3], every[3:]
        gamma = unit([g1 * x + g2 * y for x, y in zip(p, q, strict=True)])
        K = tuple(k1 * x + k2 * y for x, y in zip(p, q, strict=True))
        across = [g1 * y - g2 * x for x, y in zip(self.space[0], self.space[1], strict=True)]
        rolled = self.rolled(s)
        moved = tuple(rolled.real * self.space[2][i] + rolled.imag * across[i] for i in range(2))
        return self._told((self.space, [p, q, cross(p, q)]), gamma, K, moved)

    def when(self, time: Any) -> Any:
        """Newton's iteration, with twice as many bits each time, and an interval that it maps into itself."""
        first, last = self.start, self.end
        part = (time - first.time) / (last.time - first.time) if last is not first else 0
        s, bits = (first.parameter + part * (last.parameter - first.parameter)).mid(), FIRST_BITS
        for i in range(ctx.prec.bit_length() + 4):
            with ctx.workprec(min(bits, ctx.prec)):
                s = (s - (self.later(s) - time) / self.rate(acb(s)).real).mid()
            bits *= 2 if i > 4 else 1
        late = self.later(s) - time
        around = s + arb(0, (2 * late / self.rate(acb(s)).real).abs_upper())
        found = s - late / self.rate(acb(around)).real
        if not around.contains_interior(found) and not late == 0:
            raise TooWide
        return found


def _constants(thetas: Thetas, told: Sequence[tuple[Any, Any]]) -> list[Any]:
    """What to multiply quotients with, from their values at the start, or from their rates, whichever tells more."""
    (below, *values), (falling, *changes) = ([x.real for x in row] for row in (thetas.at(0), thetas.change(0)))
    found = []
    for (value, rate), above, rising in zip(told, values, changes, strict=True):
        quotient = above / below
        risen = (rising - quotient * falling) / below
        both = [x / y for x, y in ((value, quotient), (rate, risen)) if not y.contains(0)]
        if not both:
            raise TooWide
        found.append(min(both, key=lambda x: float(x.rad())))
    return found


def _told(found: Reduced) -> list[tuple[Any, Any]]:
    """The values and the rates at the start of all that the theta functions give."""
    (dp, dq), p = found.rates(), times(found.inverse, found.p)
    root = (1 - found.d * found.a).sqrt()
    root_rate, b_rate = -found.d * dot(p, dp) / root, dot(times(found.inverse, dp), found.q) + dot(p, dq)
    return [
        (root, root_rate), (found.b / root, (b_rate - found.b * root_rate / root) / root),
        *zip(found.p, dp, strict=True), *zip(found.q, dq, strict=True),
    ]  # fmt: skip
