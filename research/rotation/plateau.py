"""The plateau of a rational rotation number: its edges in l and in h, the displacement in its middle, and the law.

The reflections γ_a → -γ_a and γ_b → -γ_b, R, reverse G_h: RGR = G⁻¹.  A symmetric q-periodic orbit has multiplier 1, so
that the edges of a plateau are where the symmetric orbits close: for odd q those of u = 0 and u = K, for even q those
of u = 0 and of the chord whose mean is ū = 0.
"""

from collections.abc import Callable, Sequence
from functools import partial

from flint import arb, ctx

from chapsym.dynamics import BadInput
from chapsym.files import Data

from .circle import Given, Level, halved, middle, number, solved
from .relation import Relation

#: Digits by which the level is known better than the plateau is wide, and the fewest digits.
SPARE, FEWEST = 25, 50
#: Digits at which a level is looked for, and the points of the search, more of them next to the separatrix.
COARSE, SEARCHED = 20, 48


def text(x: arb, digits: int = 12) -> str:
    """A number in decimal."""
    return str(middle(x).str(digits, radius=False))


def decades(x: arb) -> int:
    """The decimal logarithm of a positive number, rounded down."""
    return int(float(x.log()) // 2.302585092994046)


def symmetric_starts(level: Level, steps: int) -> tuple[arb, arb]:
    """The phases of the two symmetric orbits of q steps."""
    if steps % 2:
        return arb(0), middle(arb.pi() / 2)

    def closed(phase: arb) -> arb:
        return level.lift(phase, 1) + phase

    guess = -level.lift(arb(0), 1) / 2
    return arb(0), solved(closed, guess, guess * arb("0.99"))


def levels(tensor: Sequence[Given], D: Given) -> tuple[arb, arb]:
    """The range of l around the outer axis: (1/Λ_b, greatest 1/Λ)."""
    J = [number(x) for x in tensor]
    _, low, high = sorted((1 / (sum(J) - x + number(D)) for x in J), key=float)
    return low, high


def bracket(off: Callable[[arb], arb], low: arb, high: arb) -> tuple[arb, arb] | None:
    """Two levels near each other between which the rotation number passes p/q, found at few digits; None if there are
    none.
    """
    before: tuple[arb, bool] | None = None
    for i in range(1, SEARCHED):
        l = low + (high - low) * i * i / SEARCHED**2
        try:
            sign = off(l) > 0
        except BadInput:  # the branch has ended, or the step turns too far
            before = None
            continue
        if before is not None and before[1] != sign:
            return halved(lambda c, end=sign: (off(c) > 0) != end, before[0], l, 8)  # type: ignore[misc]
        before = l, sign
    return None


def resonance(
    tensor: Sequence[Given], D: Given, height: Given, steps: int, turns: int, kick: Given = 0
) -> tuple[arb, arb, int]:
    """(l, width by the law, digits to work with) near a resonance, at few digits."""
    with ctx.workdps(COARSE):

        def off(l: arb) -> arb:
            return Level(tensor, D, height, l, kick).displacement(0, steps, turns)

        ends = bracket(off, *levels(tensor, D))
        if ends is None:
            raise BadInput(f"no level has the rotation number {turns}/{steps} half turns")
        l = solved(off, *ends)
        slope = (off(ends[1]) - off(ends[0])) / (ends[1] - ends[0])
    if number(D) == 0:
        return l, arb(0), FEWEST
    with ctx.workdps(FEWEST):
        width = 2 * Relation(Level(tensor, D, height, l)).law(steps, turns) / abs(slope)
    return l, width, max(FEWEST, SPARE - decades(width))


def plateau(tensor: Sequence[Given], D: Given, height: Given, steps: int, turns: int, in_height: bool = False) -> Data:
    """Edges, middle, displacement and law of one plateau; numbers as decimal strings.

    width: in l; width_in_height: in h at the middle level; displacement: that of the symmetric orbits in the middle, in
    half turns, (even q: of u = 0 and of the mean chord); law: the width that the law predicts; digits: worked with.
    """
    near, _, digits = resonance(tensor, D, height, steps, turns)
    with ctx.workdps(digits):

        def off(which: int, l: arb, h: Given = height) -> arb:
            level = Level(tensor, D, h, l)
            return level.displacement(symmetric_starts(level, steps)[which], steps, turns)

        nudge = number(near) * (1 + arb(10) ** (5 - COARSE))
        edges = [solved(partial(off, which), near, nudge) for which in (0, 1)]
        width, centre = abs(edges[1] - edges[0]), middle((edges[0] + edges[1]) / 2)
        far = centre * (1 + arb(10) ** (-digits // 3))
        slope = (off(0, far) - off(0, centre)) / (far - centre)
        level = Level(tensor, D, height, centre)
        law = 2 * Relation(level).law(steps, turns) / abs(slope)
        found = {
            "tensor": list(map(str, tensor)), "D": str(D), "height": str(height), "outer": True, "steps": steps,
            "half_turns": turns, "digits": digits, "level": text(centre, digits - 5), "width": text(width),
            "displacement": [text(off(w, centre)) for w in (0, 1)], "slope": text(slope), "law": text(law),
            "ratio": float(width / law) if law > 0 else None, "modulus": float(level.m.sqrt()),
            "eta": float(arb.pi() * level.complement / level.K),
        }  # fmt: skip
        if in_height:
            h = number(height)
            higher = h * (1 + arb(10) ** (5 - COARSE))
            there = [solved(partial(off, which, centre), h, higher) for which in (0, 1)]
            found["width_in_height"] = text(abs(there[1] - there[0]))
    return found
