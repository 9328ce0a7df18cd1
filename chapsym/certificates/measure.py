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
from typing import Any

from flint import arb, ctx

from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.precise_ball import TooWide

from . import plateau
from .balls import ball, decimal, inside, outwards, places, rounded, shortest
from .document import sealed
from .reduced import Axes, NotProved, Reduced, Top, Vector, angle, cross

KIND = "no-invariant-measure"
STATEMENT = (
    "For all parameters in the box, the iterate of the reduced map moves one point of the level circle by more, and "
    "another by less, than the given number of half turns."
)
#: Bits that a step costs, by boxes that grow, and those beyond; the most.
STEP_BITS, SPARE_BITS, MOST_BITS = 4, 64, 20_000
#: A plateau is resolved when it is 2^RESOLVED_BITS units in the last place wide.
RESOLVED_BITS = 40


@dataclass(frozen=True)
class Orbit:
    """q steps from the point with γ_a = 0 or γ_b = 0, proved: the Gibbs vectors, the boxes of γ, and δ."""

    start: str
    gibbs: list[list[str]]
    boxes: list[list[list[str]]]
    displacement: list[str]

    def sign(self) -> int:
        """The proved sign of δ; 0 where it may be either."""
        delta = inside(self.displacement)
        return 1 if delta > 0 else -1 if delta < 0 else 0

    def write(self) -> dict[str, Any]:
        """For JSON."""
        steps = [{"u": u, "gamma": box} for u, box in zip(self.gibbs, self.boxes, strict=True)]
        return {"start": self.start, "steps": steps, "displacement": self.displacement}


@dataclass(frozen=True)
class Resonance:
    """A level, and what happens there: p half turns in q steps."""

    axes: Axes
    level: Fraction
    steps: int
    half_turns: int


def no_invariant_measure(
    top: Top, *, steps: int | None = None, half_turns: int | None = None, level: Fraction | None = None,
    bits: int | None = None, radius: Fraction | None = None, progress: Callable[[str], None] = lambda what: None,
) -> dict[str, Any]:  # fmt: skip
    """Finds the certificate that G_h of a top preserves no measure with a positive continuous density.

    steps: q, odd; the least that turns by `half_turns` by default.  half_turns: p; 1, or what the level has.
    level: l; in the middle of the plateau by default.  bits: the precision; as many as needed by default.
    radius: how far the parameters may be off; the largest power of 10 that is proved by default.
    Returns the object of the file (`document`).  Raises BadInput, one sentence, for what has no certificate.
    """
    _check(top, steps, half_turns, bits, radius)
    if level is None:
        axes, near, steps, half_turns = _resonance(top, steps, half_turns or 1, progress)
    else:
        axes = top.axes_of(level)
        steps, half_turns, near = *_turns_at(top, level, axes, steps, half_turns), (level, level)
    size = -plateau.nome_power(top, near[0], axes, steps)
    tried = bits or 32 * math.ceil((size + STEP_BITS * steps + SPARE_BITS) / 32)
    while tried <= MOST_BITS:
        progress(f"{half_turns} half turns in {steps} steps around axis {axes[2] + 1}, with {tried} bits")
        with ctx.workprec(tried):
            middle = _middle(top, near, axes, steps, tried) if level is None else level
            found = middle is not None and _enclosed(
                top, Resonance(axes, middle, steps, half_turns), radius, tried, progress
            )
        if found:
            return found
        if bits is not None:
            raise BadInput(f"{bits} bits do not resolve the displacement; take more, or leave them to chapsym")
        tried *= 2
    raise BadInput(f"the displacement is not resolved with {MOST_BITS} bits; take fewer steps")


def _check(top: Top, steps: int | None, half_turns: int | None, bits: int | None, radius: Fraction | None) -> None:
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
    if bits is not None and not 64 <= bits <= MOST_BITS:
        raise BadInput(f"the precision must be from 64 to {MOST_BITS} bits, not {bits}")
    if radius is not None and radius < 0:
        raise BadInput("the radius must not be negative")


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


def _middle(top: Top, near: tuple[Fraction, Fraction], axes: Axes, steps: int, bits: int) -> Fraction | None:
    """The simplest level in the middle half of the plateau; None where so many bits do not resolve it."""
    reduced = Reduced(top)
    low, high = sorted(plateau.end_of_plateau(reduced, near, axes, zero, steps, bits) for zero in "ab")
    width = high - low
    if width < plateau.unit_in_last_place(low, bits - RESOLVED_BITS):
        return None
    return plateau.simplest(low + width / 4, high - width / 4)[0]


def _enclosed(
    top: Top, at: Resonance, radius: Fraction | None, bits: int, progress: Callable[[str], None]
) -> dict[str, Any] | None:
    """The certificate with the largest radius; None where it takes more bits.  Raises BadInput off the plateau."""
    try:
        exactly = _orbits(top, at, Fraction(0), bits)
    except (NotProved, TooWide):
        return None
    if exactly[0].sign() == exactly[1].sign() != 0:
        raise BadInput(
            f"both displacements are {'positive' if exactly[0].sign() > 0 else 'negative'}: the level is outside of "
            f"the plateau of {at.half_turns} half turns in {at.steps} steps"
        )
    if 0 in (exactly[0].sign(), exactly[1].sign()):
        return None
    if radius is not None:
        radii = [radius]
    else:
        least = min(abs(Fraction(x.displacement[0])) for x in exactly)
        radii = [Fraction(1, 10**n) for n in range(math.floor(-math.log10(least)), places(bits))]
    for tried in radii:
        progress(f"displacements {' and '.join(f'{float(Fraction(x.displacement[0])):.1e}' for x in exactly)};"
                 f" trying the radius {float(tried):.0e}")  # fmt: skip
        try:
            orbits = _orbits(top, at, tried, bits)
        except (NotProved, TooWide, BadInput):
            continue
        if orbits[0].sign() * orbits[1].sign() < 0:
            return _document(top, at, tried, orbits, bits)
    if radius is not None:
        raise BadInput(f"with the radius {radius} the signs of the displacements are not proved; take a smaller one")
    return None


def _orbits(top: Top, at: Resonance, radius: Fraction, bits: int) -> list[Orbit]:
    reduced, centre = Reduced(top, radius), Reduced(top)
    return [_orbit(reduced, centre, at, radius, zero, bits) for zero in "ab"]


def _orbit(reduced: Reduced, centre: Reduced, at: Resonance, radius: Fraction, zero: str, bits: int) -> Orbit:
    """Every step from the box that the file has after the step before; raises NotProved."""
    digits = places(bits)
    first = gamma = reduced.start(ball(at.level, radius), at.axes, zero)
    point = centre.start(ball(at.level), at.axes, zero)
    gibbs, boxes, angles = [], [], []
    for _ in range(at.steps):
        u = [rounded(x, digits) for x in centre.root(point)]
        pairs = [outwards(x, bits) for x in reduced.image(tuple(map(ball, u)), gamma)]
        after = tuple(map(inside, pairs))
        angles.append(_turn(gamma, after, at.axes))
        gibbs.append([decimal(x, digits) for x in u])
        boxes.append(pairs)
        gamma, point = after, tuple(ball(Fraction(centre)) for centre, _ in pairs)
    direction = 1 if angles[0] > 0 else -1
    if not (all(direction * x > 0 for x in angles) and abs(sum(angles) / arb.pi() - direction * at.half_turns) < 0.5):
        raise NotProved("the half turns are not proved")
    delta = direction * (-1) ** at.half_turns * cross(first, gamma, at.axes)
    return Orbit(zero, gibbs, boxes, outwards(delta, bits))


def _turn(before: Vector, after: Vector, axes: Axes) -> Any:
    """The angle of one step, not 0 and less than half a turn; raises NotProved."""
    if not cross(before, after, axes) != 0:
        raise NotProved("a step may turn by no angle or by half a turn")
    return angle(before, after, axes)


def _document(top: Top, at: Resonance, radius: Fraction, orbits: list[Orbit], bits: int) -> dict[str, Any]:
    return sealed(
        KIND,
        STATEMENT,
        ball={"J": [str(x) for x in top.J], "D": str(top.D), "height": str(top.height), "level": shortest(at.level)},
        radius=shortest(radius),
        axes=[i + 1 for i in at.axes],
        steps=at.steps,
        half_turns=at.half_turns,
        bits=bits,
        orbits=[x.write() for x in orbits],
    )
