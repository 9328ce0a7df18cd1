"""Certificate `no-invariant-measure`: two points of a circle that q steps of G_h move by more and by less than p half
turns.

δ = s(-1)^p(γ_a⁰γ_b^q - γ_b⁰γ_a^q), with s = ±1 the direction of the motion, has the sign of the displacement after q
steps less p half turns, where this is below half a turn.  If G_h preserved a measure with a positive continuous density
on the circle, it would be conjugate to a rotation, and δ would have the same sign everywhere, or be 0 everywhere.
"""

import contextlib
import math
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from fractions import Fraction

from flint import arb

from chapsym import checker
from chapsym.checker.branch import MOST_ARCS
from chapsym.checker.circle import Circle
from chapsym.checker.document import MOST_DIGITS, MOST_STEPS
from chapsym.checker.measure import branch_of, tangent
from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.levels.start import decade, fraction
from chapsym.numbers.precisions import flint_bits

from . import resonance
from .balls import NotProved, decimals, rounded, shortest
from .document import Document, Say, accepted, stated, widest
from .reduced import Reduced, Top, Vector, cross
from .resonance import Resonance, spare_bits

KIND = "no-invariant-measure"
#: The least number of significant digits of the smaller displacement, and the extra digits that are tried if a number
#: happens to lie between two decimals.
SIGNIFICANT, MORE = 3, 3
#: Decimals by which a radius must shrink for each step; boxes grow by less.
LOST = 3
#: The first trial number of arcs of a half circle.
FEWEST_ARCS = 32


@dataclass(frozen=True)
class Orbit:
    """q steps from a start: the Gibbs vectors, γ after each step, and δ."""

    start: str
    gibbs: list[Vector]
    gammas: list[Vector]
    displacement: arb

    def write(self, digits: int) -> Document:
        """The orbit for JSON, rounded."""
        steps = [
            {name: [rounded(x, digits) for x in v] for name, v in (("u", u), ("gamma", gamma))}
            for u, gamma in zip(self.gibbs, self.gammas, strict=True)
        ]
        return {"start": self.start, "steps": steps, "displacement": rounded(self.displacement, digits)}


def no_invariant_measure(
    top: Top, *, steps: int | None = None, half_turns: int | None = None, level: Fraction | None = None,
    digits: int | None = None, radius: Fraction | None = None, progress: Say = lambda what: None,
) -> Document:  # fmt: skip
    """Finds the certificate that G_h of a top preserves no measure with a positive continuous density.

    steps: q; by default the least odd one that turns by `half_turns`.  half_turns: p; by default 1, or that of the
    level.
    level: l; by default in the middle of the plateau.  digits: decimals of the file; by default as needed for the
    displacement.
    radius: of J, D, h and l; by default the largest power of 10 that is proved, and 0 if a component of J is 0, as J
    must not be negative.
    Returns the object of the file (`document`), which `chapsym.checker` accepts.
    Raises BadInput if there is no certificate.
    """
    _check(top, steps, half_turns, digits, radius)
    try:
        if level is None:
            at = resonance.find(top, steps, half_turns or 1, progress)
        else:
            at = resonance.on_level(top, level, steps, half_turns)
        progress("following both orbits")
        least = _least_digits(top, at)
    except NotProved:
        raise BadInput(
            f"beyond the bound of lemma small-branch, at |h| = {abs(top.height)}, a step is not found; take a smaller "
            "height"
        ) from None
    if digits is not None and digits < least:
        raise BadInput(f"{digits} digits are too few for this displacement and level; take {least} or more")
    if not Reduced(top).is_small:
        at = replace(at, arcs=_arcs(top, at, least, progress))
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
    if steps is not None and not 3 <= steps <= MOST_STEPS:
        raise BadInput(f"the number of steps must be from 3 to {MOST_STEPS}, not {steps}")
    if half_turns is not None and half_turns < 1:
        raise BadInput(f"the number of half turns must be at least 1, not {half_turns}")
    if steps is not None and half_turns is not None:
        resonance.check_reduced(steps, half_turns)
    if digits is not None and not 1 <= digits <= MOST_DIGITS:
        raise BadInput(f"the number of digits must be from 1 to {MOST_DIGITS}, not {digits}")
    if radius is not None and radius < 0:
        raise BadInput("the radius must not be negative")
    if radius is not None and min(top.J) < radius:
        raise BadInput(f"within the radius {shortest(radius)} the least component of J, {min(top.J)}, may be negative")


def _least_digits(top: Top, at: Resonance) -> int:
    """Decimals of the level, and SIGNIFICANT digits of both displacements; raises BadInput off the plateau."""
    spare = spare_bits(at.steps)
    bits = spare
    while bits < MOST_DIGITS * 10 // 3:
        bits *= 2
        with flint_bits(bits):
            found = [fraction(x.displacement) for x in _orbits(top, at)]
        if (least := min(map(abs, found))) < Fraction(2) ** (spare - bits):
            continue
        if (found[0] > 0) == (found[1] > 0):
            raise BadInput(
                f"both displacements are {'positive' if found[0] > 0 else 'negative'}: the level is outside of the "
                f"plateau of {resonance.turns(at.half_turns)} in {at.steps} steps"
            )
        if (digits := max(SIGNIFICANT - 1 - decade(least), decimals(at.level) or 0)) <= MOST_DIGITS:
            return digits
    raise BadInput(f"{MOST_DIGITS} digits do not distinguish the displacement on this level from 0")


def _arcs(top: Top, at: Resonance, digits: int, progress: Say) -> int:
    """The least power of 2 of arcs for which the checker accepts the branch; raises BadInput if none is found."""
    arcs, reason = FEWEST_ARCS, ""
    while arcs <= MOST_ARCS:
        progress(f"proving the branch over the whole circle, in {arcs} arcs")
        try:
            fields = _fields(top, replace(at, arcs=arcs), Fraction(0), digits)
            branch_of(Circle(fields), fields)
        except checker.Rejected as error:
            arcs, reason = 2 * arcs, str(error)
        else:
            return arcs
    raise BadInput(f"the branch is not proved over the whole circle with {MOST_ARCS} arcs: {reason}")


def _largest(top: Top, at: Resonance, least: int, only: bool, radius: Fraction | None, progress: Say) -> Document:
    """The certificate with the largest radius, and the fewest digits for it."""
    candidates = [least] if only else list(range(least, min(least + MORE, MOST_DIGITS) + 1))
    radii = _radii(top, at, least) if radius is None else [radius]
    with _precise(at, candidates[-1]):
        orbits = _orbits(top, at)

    def found(off: Fraction) -> Document:
        for n in candidates:
            written = [x.write(n) for x in orbits]
            with contextlib.suppress(checker.Rejected):
                return accepted(stated(KIND, **_fields(top, at, off, n), orbits=written))
        raise NotProved("the checker accepts none of these")

    try:
        return widest(radii, found, progress)
    except NotProved:
        raise BadInput(
            f"the numbers do not round to {least} digits alike for all parameters within {shortest(radii[-1])}; "
            f"take a smaller radius, or another number of digits"
        ) from None


def _radii(top: Top, at: Resonance, digits: int) -> list[Fraction]:
    """Trial powers of 10, down to one for boxes that grow in each step, for parameters of any size; 0 if a J is 0."""
    if min(top.J) == 0:
        return [Fraction(0)]
    scales = [abs(decade(abs(x))) for x in (*top.J, top.D, top.height, at.level)]
    return [Fraction(1, 10**n) for n in range(digits, digits + LOST * at.steps + 2 * max(scales) + 20)]


def _precise(at: Resonance, digits: int) -> AbstractContextManager[None]:
    """The working precision for this many decimals after the steps."""
    return flint_bits(math.ceil(digits * 10 / 3) + spare_bits(at.steps))


def _orbits(top: Top, at: Resonance) -> list[Orbit]:
    """The orbits from both starts, and δ if all steps turn in the direction of the first."""
    reduced, found = Reduced(top), list[Orbit]()
    for name in at.starts:
        gibbs, gammas = reduced.orbit(at.level, at.axes, tangent(name), at.steps)
        sign = (-1) ** at.half_turns * (1 if cross(gammas[0], gammas[1], at.axes) > 0 else -1)
        found.append(Orbit(name, gibbs, gammas[1:], (sign * cross(gammas[0], gammas[-1], at.axes)).mid()))
    return found


def _fields(top: Top, at: Resonance, radius: Fraction, digits: int) -> Document:
    """All fields but the orbits."""
    fields = {
        "ball": {"J": [str(x) for x in top.J], "D": str(top.D), "height": str(top.height), "level": shortest(at.level)},
        "radius": shortest(radius),
        "axes": [i + 1 for i in at.axes],
        "steps": at.steps,
        "half_turns": at.half_turns,
        "digits": digits,
    }
    if at.arcs:
        reduced = Reduced(top)
        with _precise(at, digits):
            u = reduced.root(reduced.start(at.level, at.axes, Fraction(0)))
            fields["branch"] = {"arcs": at.arcs, "u": [rounded(x, digits) for x in u]}
    return fields
