"""Search for a plateau: the levels on which G_h turns by p half turns in q steps, for some points of the circle.

The displacement after q steps is nearly extreme at two `starts`: for odd q the points with γ_a = 0 and γ_b = 0, which
reflections fix.  So the levels on which one of them has p half turns are the ends of the plateau.  Its width, relative
to the range of levels, is about the q-th power of the nome.  Nothing here is proved: the checker proves it.
"""

import contextlib
import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from flint import acb, arb

from chapsym.checker.measure import ZEROS
from chapsym.dynamics.levels.balls import exact
from chapsym.dynamics.levels.start import exponent_of, fraction
from chapsym.numbers.precisions import flint_bits

from .balls import NotProved
from .document import Say
from .reduced import Axes, Levels, Reduced, Top, angle, cross

#: The trial levels have x/(1 - x) = e^t for this many t up to ±REACH, x from the separatrix to the axis.
LEVELS, REACH = 29, 14.0
#: The bits and steps of this search, and its accuracy for the level, in half turns.
LOOK_BITS, LOOK_STEPS, LOOK_NEAR = 64, 63, 1e-3
MOST_SECANTS = 60
#: Steps of the iteration for the start of a symmetric step.
MIDDLE_STEPS = 30


@dataclass(frozen=True)
class Staircase:
    """Half turns after 1, 2, ... steps from the point γ_b = 0 of circles around an axis, from the separatrix on."""

    axes: Axes
    levels: list[Fraction]
    turns: list[list[float]]

    def between(self, steps: int, half_turns: int) -> Levels | None:
        """Two levels with fewer and with more half turns in this many steps."""
        found = [turns[steps - 1] for turns in self.turns]
        for (x, a), (y, b) in pairwise(zip(found, self.levels, strict=True)):
            if (x < half_turns) != (y < half_turns):
                return (a, b) if x < half_turns else (b, a)
        return None


def staircases(top: Top, steps: int, progress: Say) -> list[Staircase]:
    """The circles around both axes, except those without a step."""
    found = []
    shares = [1.0 / (1.0 + math.exp(REACH * (1.0 - 2.0 * i / (LEVELS - 1)))) for i in range(LEVELS)]
    for axes in top.sides():
        _, b, c = axes
        inner, outer = 1 / top.moments[b], 1 / top.moments[c]
        levels = [inner + (outer - inner) * Fraction(x) for x in shares]
        counted = {}
        for number, level in enumerate(levels):
            progress(f"looking for the level: circle {number + 1} of {LEVELS} around axis {c + 1}")
            with contextlib.suppress(NotProved):
                counted[level] = half_turns(top, level, axes, steps)
        found.append(Staircase(axes, list(counted), list(counted.values())))
    return found


def half_turns(top: Top, level: Fraction, axes: Axes, steps: int) -> list[float]:
    """Half turns after 1, 2, ... steps from the point with γ_b = 0, in the direction of the motion."""
    with flint_bits(LOOK_BITS):
        _, orbit = Reduced(top).orbit(level, axes, ZEROS["b"], steps)
        total, found = 0.0, []
        for before, after in pairwise(orbit):
            total += float(angle(before, after, axes)) / math.pi
            found.append(abs(total))
        return found


def refined(top: Top, ends: Levels, axes: Axes, steps: int, turns: int) -> Levels:
    """Bisects two levels, one with fewer turns, until q steps from both turn nearly the same."""
    (low, high), off = ends, [math.inf, math.inf]
    for _ in range(LOOK_BITS):
        middle = (low + high) / 2
        if (found := half_turns(top, middle, axes, steps)[-1] - turns) < 0:
            low, off[0] = middle, -found
        else:
            high, off[1] = middle, found
        if max(off) < LOOK_NEAR:
            break
    return low, high


def starts(top: Top, level: Fraction, axes: Axes, steps: int) -> tuple[str, str]:
    """The starts with extreme displacement after q steps, as named in a certificate: on lines that reversors fix.

    For odd q γ_a = 0 and γ_b = 0; for even q γ_b = 0, and the start of a step that ends at its reflection, nearly.
    """
    if steps % 2:
        return "a", "b"
    t = 0.0
    with flint_bits(LOOK_BITS):
        reduced = Reduced(top)
        for _ in range(MIDDLE_STEPS):
            _, (before, after) = reduced.orbit(level, axes, Fraction(t), 1)
            t = math.tan(-float(angle(before, after, axes)) / 4)
    return "b", str(Fraction(f"{t:.3g}"))


def end_of_plateau(reduced: Reduced, near: Levels, axes: Axes, t: Fraction, steps: int, bits: int) -> Fraction:
    """The level near two others on which a start returns to its line through 0, by the secant method."""

    def off(level: Fraction) -> Fraction:
        _, orbit = reduced.orbit(level, axes, t, steps)
        return fraction(cross(orbit[0], orbit[-1], axes))

    (x, y), limit = near, unit_in_last_place(near[0], bits)
    before, now = off(x), off(y)
    for _ in range(MOST_SECANTS):
        if before == now:
            break
        step = now * (y - x) / (now - before)
        x, y = y, Fraction(round((y - step) / limit)) * limit
        before, now = now, off(y)
        if abs(step) < 64 * limit:
            break
    return y


def unit_in_last_place(x: Fraction, bits: int) -> Fraction:
    """2^-bits times a power of 2 about the size of x."""
    return Fraction(2) ** (exponent_of(x) - bits)


def nome_power(top: Top, level: Fraction, axes: Axes, steps: int) -> float:
    """The logarithm to base 2 of nome^q, the size of the displacement up to a factor: -q·πK'/K, over log 2."""
    La, Lb, Lc = (top.moments[i] for i in axes)
    k2 = (Lc * level - 1) * (La - Lb) / ((La * level - 1) * (Lc - Lb))  # the modulus² of (5.8), between 0 and 1
    with flint_bits(LOOK_BITS):
        nome = (-arb.pi() * _quarter(1 - k2) / _quarter(k2)).exp()
        return steps * float(nome.log()) / math.log(2)


def _quarter(k2: Fraction) -> arb:
    return acb(exact(k2)).elliptic_k().real
