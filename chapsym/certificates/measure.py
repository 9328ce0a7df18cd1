"""Certificate `no-invariant-measure`: two points of a circle that q steps of G_h move by more and by less than p half
turns.

δ = s(-1)^p(γ_a⁰γ_b^q - γ_b⁰γ_a^q), with s = ±1 the direction of the motion, has the sign of the displacement after q
steps less p half turns, where this is below half a turn.  If G_h preserved a measure with a positive continuous density
on the circle, it would be conjugate to a rotation, and δ would have one sign, or be 0, everywhere.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from flint import arb, ctx

from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.precise_ball import TooWide
from chapsym.dynamics.precise_start import fraction

from . import plateau
from .balls import NotProved, ball, decade, decimals, rounded, shortest
from .document import sealed
from .reduced import Axes, Reduced, Top, Vector, angle, cross

KIND = "no-invariant-measure"
#: The precision beyond the digits: for what a step may widen the balls, and to decide how numbers round.
STEP_BITS, SPARE_BITS = 4, 64
#: A plateau is resolved when it is 2^RESOLVED_BITS units in the last place wide.
RESOLVED_BITS = 40
#: Significant digits that the smaller displacement has at least, and how many more are tried where a number happens to
#: lie between two decimals; the most decimals that a checker takes.
SIGNIFICANT, MORE, MOST_DIGITS = 3, 3, 2000


@dataclass(frozen=True)
class Orbit:
    """q steps from the point with γ_a = 0 or γ_b = 0, enclosed: the Gibbs vectors, γ after each step, and δ."""

    start: str
    gibbs: list[Vector]
    gammas: list[Vector]
    displacement: Any

    def sign(self) -> int:
        """The proved sign of δ; 0 where it may be either."""
        return 1 if self.displacement > 0 else -1 if self.displacement < 0 else 0

    def write(self, digits: int) -> dict[str, Any]:
        """For JSON, rounded; raises NotProved where the numbers of a ball do not round alike."""
        steps = [
            {name: [rounded(x, digits, _wider(k)) for x in v] for name, v in (("u", u), ("gamma", gamma))}
            for k, (u, gamma) in enumerate(zip(self.gibbs, self.gammas, strict=True), 1)
        ]
        moved = rounded(self.displacement, digits, _wider(len(steps)))
        return {"start": self.start, "steps": steps, "displacement": moved}


def _wider(steps: int) -> int:
    """How much wider the intervals of a checker may be after so many steps; those of ours are, by 2^(0.7 steps + 1)."""
    return 2 ** (steps + 2)


@dataclass(frozen=True)
class Resonance:
    """A level, and what happens there: p half turns in q steps."""

    axes: Axes
    level: Fraction
    steps: int
    half_turns: int


def no_invariant_measure(
    top: Top, *, steps: int | None = None, half_turns: int | None = None, level: Fraction | None = None,
    digits: int | None = None, radius: Fraction | None = None, progress: Callable[[str], None] = lambda what: None,
) -> dict[str, Any]:  # fmt: skip
    """Finds the certificate that G_h of a top preserves no measure with a positive continuous density.

    steps: q, odd; the least that turns by `half_turns` by default.  half_turns: p; 1, or what the level has.
    level: l; in the middle of the plateau by default.  digits: decimals of the file; what the displacement needs.
    radius: how far each of J, D, h and l may be off; the largest power of 10 that is proved by default, and 0 where a
    component of J is 0, as it must not be negative.
    Returns the object of the file (`document`).  Raises BadInput, one sentence, for what has no certificate.
    """
    _check(top, steps, half_turns, digits, radius)
    if level is None:
        axes, near, steps, half_turns = _resonance(top, steps, half_turns or 1, progress)
        size = -plateau.nome_power(top, near[0], axes, steps)
        level = _middle(top, near, axes, steps, size, progress)
    else:
        axes = top.axes_of(level)
        steps, half_turns = _turns_at(top, level, axes, steps, half_turns)
    at = Resonance(axes, level, steps, half_turns)
    progress("enclosing both orbits")
    least = _least_digits(top, at)
    if digits is not None and digits < least:
        raise BadInput(f"{digits} digits are too few for this displacement and level; take {least} or more")
    return _largest(top, at, least if digits is None else digits, digits is not None, radius, progress)


def _check(top: Top, steps: int | None, half_turns: int | None, digits: int | None, radius: Fraction | None) -> None:
    if top.D == 0:
        raise BadInput(
            "for D = 0 there is nothing to find: G_h is a rotation on every circle, and its displacement vanishes"
        )
    if len(set(top.J)) < 3:
        raise BadInput(
            "the three entries of J must differ: else G_h commutes with all rotations about an axis, and its "
            "displacement vanishes"
        )
    if top.height == 0:
        raise BadInput("for the height 0 the map moves nothing")
    if steps is not None and (steps < 3 or steps % 2 == 0):
        raise BadInput(f"the number of steps must be odd and at least 3, so that both starts are extreme, not {steps}")
    if half_turns is not None and half_turns < 1:
        raise BadInput(f"the number of half turns must be at least 1, not {half_turns}")
    if steps and half_turns and math.gcd(steps, half_turns) > 1:
        raise BadInput(
            f"{half_turns} half turns in {steps} steps are fewer in fewer steps: divide by the common factor"
        )
    if digits is not None and not 1 <= digits <= MOST_DIGITS:
        raise BadInput(f"the number of digits must be from 1 to {MOST_DIGITS}, not {digits}")
    if radius is not None and radius < 0:
        raise BadInput("the radius must not be negative")
    if radius is not None and min(top.J) < radius:
        raise BadInput(f"with the radius {radius} the least component of J, {min(top.J)}, may be negative")


def _resonance(
    top: Top, steps: int | None, half_turns: int, progress: Callable[[str], None]
) -> tuple[Axes, tuple[Fraction, Fraction], int, int]:
    """The circles with this rotation number where the displacement is largest, and two levels near by."""
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
            return axes, near, q, half_turns
    most = max(side.fastest() for side in sides)
    wanted = f"{half_turns} in {steps}" if steps else f"{half_turns} in an odd number up to {plateau.LOOK_STEPS}"
    raise BadInput(
        f"no circle turns by half turns {wanted} steps: at this height there are up to about {most:.3f} a step"
    )


def _turns_at(top: Top, level: Fraction, axes: Axes, steps: int | None, half_turns: int | None) -> tuple[int, int]:
    """q and p of a level that was given."""
    if steps is None:
        raise BadInput("a level needs the number of steps after which its points return, --steps")
    found = plateau.half_turns(top, level, axes, steps)[-1]
    counted = round(found)
    if counted < 1 or abs(found - counted) > 0.25 or half_turns not in (None, counted):
        wanted = "a whole number" if half_turns is None else half_turns
        raise BadInput(f"on this level {steps} steps turn by {found:.6g} half turns, not by {wanted}")
    if math.gcd(steps, counted) > 1:
        raise BadInput(f"{counted} half turns in {steps} steps are fewer in fewer steps: divide by the common factor")
    return steps, counted


def _middle(
    top: Top, near: tuple[Fraction, Fraction], axes: Axes, steps: int, size: float, progress: Callable[[str], None]
) -> Fraction:
    """The simplest level in the middle half of the plateau, with twice the precision until it is resolved."""
    bits = math.ceil(size) + _spare(steps)
    while bits < MOST_DIGITS * 10 // 3:
        progress(f"looking for {steps} steps around axis {axes[2] + 1} with {bits} bits")
        with ctx.workprec(bits):
            reduced = Reduced(top)
            low, high = sorted(plateau.end_of_plateau(reduced, near, axes, zero, steps, bits) for zero in "ab")
        if high - low > plateau.unit_in_last_place(low, bits - RESOLVED_BITS):
            return plateau.simplest(low + (high - low) / 4, high - (high - low) / 4)
        bits *= 2
    raise BadInput(f"the displacement after {steps} steps is not resolved with {MOST_DIGITS} digits; take fewer steps")


def _spare(steps: int) -> int:
    return STEP_BITS * steps + SPARE_BITS


def _least_digits(top: Top, at: Resonance) -> int:
    """Decimals for the level, and SIGNIFICANT digits of both displacements; raises BadInput off the plateau."""
    bits = _spare(at.steps)
    while bits < MOST_DIGITS * 10 // 3:
        bits *= 2
        with ctx.workprec(bits):
            try:
                found = _orbits(top, at, Fraction(0))
            except (NotProved, TooWide):
                continue
            signs = [x.sign() for x in found]
            if signs[0] == signs[1] != 0:
                raise BadInput(
                    f"both displacements are {'positive' if signs[0] > 0 else 'negative'}: the level is outside of the "
                    f"plateau of {at.half_turns} half turns in {at.steps} steps"
                )
            if 0 not in signs:
                least = min(fraction(abs(x.displacement)) for x in found)
                return max(SIGNIFICANT - 1 - decade(least), decimals(at.level) or 0)
    raise BadInput(f"the displacement on this level is not told from 0 with {MOST_DIGITS} digits")


def _largest(
    top: Top, at: Resonance, least: int, only: bool, radius: Fraction | None, progress: Callable[[str], None]
) -> dict[str, Any]:
    """The certificate with the largest radius, and the fewest digits for it."""
    candidates = [least] if only else range(least, least + MORE + 1)
    most = candidates[-1]
    radii = [Fraction(1, 10**n) for n in range(least, least + 2 * at.steps + 20)] if radius is None else [radius]
    if radius is None and min(top.J) == 0:
        radii = [Fraction(0)]
    with ctx.workprec(math.ceil(most * 10 / 3) + _spare(at.steps)):
        for tried in radii:
            progress(f"trying the radius {shortest(tried)}")
            try:
                orbits = _orbits(top, at, tried)
            except (NotProved, TooWide, BadInput):  # such a radius may be beyond the bound of small-branch
                continue
            for digits in candidates:
                try:
                    return _document(top, at, tried, orbits, digits)
                except NotProved:
                    continue
    raise BadInput(
        f"the numbers do not round to {least} digits alike for all parameters within {shortest(radii[-1])}; "
        f"take a smaller radius, or another number of digits"
    )


def _orbits(top: Top, at: Resonance, radius: Fraction) -> list[Orbit]:
    reduced = Reduced(top, radius)
    return [_orbit(reduced, at, reduced.start(ball(at.level, radius), at.axes, zero), zero) for zero in "ab"]


def _orbit(reduced: Reduced, at: Resonance, start: Vector, zero: str) -> Orbit:
    """Every step, proved; raises NotProved."""
    gibbs, gammas = [], [start]
    for _ in range(at.steps):
        u, gamma = reduced.image(reduced.root(gammas[-1]), gammas[-1])
        gibbs.append(u)
        gammas.append(gamma)
    angles = [_turn(x, y, at.axes) for x, y in pairwise(gammas)]
    direction = 1 if angles[0] > 0 else -1
    if not (all(direction * x > 0 for x in angles) and abs(sum(angles) / arb.pi() - direction * at.half_turns) < 0.5):
        raise NotProved("the half turns are not proved")
    delta = direction * (-1) ** at.half_turns * cross(start, gammas[-1], at.axes)
    return Orbit(zero, gibbs, gammas[1:], delta)


def _turn(before: Vector, after: Vector, axes: Axes) -> Any:
    """The angle of one step, not 0 and less than half a turn; raises NotProved."""
    if not cross(before, after, axes) != 0:
        raise NotProved("a step may turn by no angle or by half a turn")
    return angle(before, after, axes)


def _document(top: Top, at: Resonance, radius: Fraction, orbits: list[Orbit], digits: int) -> dict[str, Any]:
    if orbits[0].sign() * orbits[1].sign() >= 0:
        raise NotProved("the signs of the displacements are not proved")
    J, axes = [str(x) for x in top.J], [i + 1 for i in at.axes]
    level, within = shortest(at.level), shortest(radius)
    statement = (
        f"For every ball with J = ({', '.join(J)}), D = {top.D} and momentum {top.height} γ: on the circle "
        f"⟨γ, Λ⁻¹γ⟩ = {level}, γ_{axes[2]} > 0, every number within {within}, some points are back after "
        f"{at.steps} steps and {at.half_turns} half turns and others are not, so the map leaves no finite "
        f"measure invariant that is positive on every arc."
    )
    return sealed(
        KIND,
        statement,
        ball={"J": J, "D": str(top.D), "height": str(top.height), "level": level},
        radius=within,
        axes=axes,
        steps=at.steps,
        half_turns=at.half_turns,
        digits=digits,
        orbits=[x.write(digits) for x in orbits],
    )
