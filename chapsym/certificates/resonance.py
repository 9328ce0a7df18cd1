"""Search for a circle on which G_h turns by p half turns in q steps: on both sides, or on a given level."""

import math
from dataclasses import dataclass
from fractions import Fraction

from chapsym.checker.document import MOST_DIGITS
from chapsym.checker.measure import tangent
from chapsym.dynamics.errors import BadInput
from chapsym.numbers.precisions import flint_bits

from . import plateau
from .balls import simplest
from .document import Say
from .reduced import Axes, Levels, Reduced, Top

#: The bits beyond the digits, for the growth of the balls in a step, and to decide how numbers round.
STEP_BITS, SPARE_BITS = 4, 64
#: A plateau is resolved if its width is 2^RESOLVED_BITS units in the last place.
RESOLVED_BITS = 40


@dataclass(frozen=True)
class Resonance:
    """A level with p half turns in q steps, and two starts with nearly the most and the fewest half turns.

    arcs: the number of arcs of the half circle that prove the branch; 0 within the bound of lemma `small-branch`.
    """

    axes: Axes
    level: Fraction
    steps: int
    half_turns: int
    starts: tuple[str, str]
    arcs: int = 0


def find(top: Top, steps: int | None, half_turns: int, progress: Say) -> Resonance:
    """The simplest level in the middle of the plateau with this rotation number; by default with the fewest steps.

    Raises BadInput if there is none, or if it is too narrow.
    """
    axes, near, steps = _circle(top, steps, half_turns, progress)
    starts = plateau.starts(top, near[0], axes, steps)
    return Resonance(axes, _middle(top, near, axes, steps, starts, progress), steps, half_turns, starts)


def _circle(top: Top, steps: int | None, half_turns: int, progress: Say) -> tuple[Axes, Levels, int]:
    """The axes of the circle with the larger displacement, two levels near it, and the steps."""
    sides = plateau.staircases(top, steps or plateau.LOOK_STEPS, progress)
    numbers = [steps] if steps else [q for q in range(3, plateau.LOOK_STEPS + 1, 2) if math.gcd(q, half_turns) == 1]
    for q in numbers:
        found = [
            (side.axes, plateau.refined(top, ends, side.axes, q, half_turns))
            for side in sides
            if (ends := side.between(q, half_turns))
        ]
        if found:
            axes, near = max(found, key=lambda x: plateau.nome_power(top, x[1][0], x[0], q))
            return axes, near, q
    raise BadInput(_why(sides, steps, half_turns))


def _why(sides: list[plateau.Staircase], steps: int | None, half_turns: int) -> str:
    """The reason why no circle was found, in one sentence."""
    if not any(side.levels for side in sides):
        return "no step is found on any circle, beyond the bound of lemma small-branch; take a smaller height"
    wanted = f"{turns(half_turns)} in {steps or f'an odd number up to {plateau.LOOK_STEPS}'} steps"
    most = max(counted[-1] / len(counted) for side in sides for counted in side.turns)
    if half_turns < most * (steps or plateau.LOOK_STEPS):
        return f"circles with {wanted} are too near the separatrix; take another number of steps"
    return f"no circle has {wanted}: at this height there are at most about {most:.2g} half turns a step"


def turns(half_turns: int) -> str:
    """This many half turns, in words."""
    return f"{half_turns} half turn{'s' if half_turns > 1 else ''}"


def on_level(top: Top, level: Fraction, steps: int | None, half_turns: int | None) -> Resonance:
    """The resonance on a given level; raises BadInput if the half turns are not the requested or a whole number."""
    axes = top.axes_of(level)
    if steps is None:
        raise BadInput("a level needs the number of steps after which its points return, --steps")
    found = plateau.half_turns(top, level, axes, steps)[-1]
    counted = round(found)
    if counted < 1 or abs(found - counted) > 0.25 or half_turns not in (None, counted):
        wanted = "a whole number" if half_turns is None else half_turns
        raise BadInput(f"on this level {steps} steps turn by {found:.6g} half turns, not by {wanted}")
    check_reduced(steps, counted)
    return Resonance(axes, level, steps, counted, plateau.starts(top, level, axes, steps))


def _middle(top: Top, near: Levels, axes: Axes, steps: int, starts: tuple[str, str], progress: Say) -> Fraction:
    """The simplest level in the middle half of the plateau, at a precision that is doubled until it is resolved."""
    if not math.isfinite(power := plateau.nome_power(top, near[0], axes, steps)):
        raise BadInput("the moments of inertia are too far apart for the search")
    bits = math.ceil(-power) + spare_bits(steps)
    while bits < MOST_DIGITS * 10 // 3:
        progress(f"looking for {steps} steps around axis {axes[2] + 1} with {bits} bits")
        with flint_bits(bits):
            reduced = Reduced(top)
            low, high = sorted(plateau.end_of_plateau(reduced, near, axes, tangent(x), steps, bits) for x in starts)
        if high - low > plateau.unit_in_last_place(low, bits - RESOLVED_BITS):
            return simplest(low, high)
        bits *= 2
    raise BadInput(
        f"{MOST_DIGITS} digits do not distinguish the displacement after {steps} steps from 0; take fewer, or larger D"
    )


def spare_bits(steps: int) -> int:
    """The number of bits that this many steps need beyond those of the numbers."""
    return STEP_BITS * steps + SPARE_BITS


def check_reduced(steps: int, half_turns: int) -> None:
    """Raises BadInput unless p/q is in lowest terms."""
    if math.gcd(steps, half_turns) > 1:
        raise BadInput(
            f"{turns(half_turns)} in {steps} steps are fewer in fewer steps: divide both by the common factor"
        )
