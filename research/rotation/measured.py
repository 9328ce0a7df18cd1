"""What is measured of the reduced map at many digits: plateaus, displacements, their digits, and rotation numbers.

The reflections γ_a → -γ_a and γ_b → -γ_b, R, reverse G_h: RGR = G⁻¹.  A symmetric q-periodic orbit has multiplier 1, so
that the edges of a plateau are where the symmetric orbits close: for odd q those of u = 0 and u = K, for even q those
of u = 0 and of the chord whose mean is ū = 0.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from statistics import median
from time import process_time

from flint import acb, arb, ctx

from chapsym.dynamics import BadInput
from chapsym.files import Data

from .circle import Given, Level, Relation, Tensor, halved, middle, number, solved

#: Digits by which the level is known better than the plateau is wide, and the fewest digits.
SPARE, FEWEST = 25, 50
#: Digits at which a level is looked for, and the points of the search, more of them next to the separatrix.
COARSE, SEARCHED = 20, 48
#: Starts at which the two routes are compared.
COMPARED = 3
#: Digits above those that the displacement has, from which the search for the fewest goes down; and where it ends.
ABOVE, LEAST = 15, 4
#: Steps that are timed together, and how often.
TIMED, REPEATS = 60, 5
#: Digits of an average beyond those that are asked for.
MORE = 10


# The plateau of a rational rotation number: its edges in l and in h, the displacement in its middle, and the law.


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


def levels(tensor: Tensor, D: Given) -> tuple[arb, arb]:
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


def resonance(tensor: Tensor, D: Given, height: Given, steps: int, turns: int, kick: Given = 0) -> tuple[arb, arb, int]:
    """(l, width by the law, digits to work with) near a resonance, at few digits."""
    with ctx.workdps(COARSE):

        def off(l: arb) -> arb:
            return Level(tensor, D, height, l, kick).displacement(0, steps, turns)

        if (ends := bracket(off, *levels(tensor, D))) is None:
            raise BadInput(f"no level has the rotation number {turns}/{steps} half turns")
        l = solved(off, *ends)
        slope = (off(ends[1]) - off(ends[0])) / (ends[1] - ends[0])
    if number(D) == 0:
        return l, arb(0), FEWEST
    with ctx.workdps(FEWEST):
        width = 2 * Relation(Level(tensor, D, height, l)).law(steps, turns) / abs(slope)
    return l, width, max(FEWEST, SPARE - decades(width))


def plateau(tensor: Tensor, D: Given, height: Given, steps: int, turns: int, in_height: bool = False) -> Data:
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


# The displacement of G^q over the circle at a resonance, and its Fourier coefficients.


def middle_level(tensor: Tensor, D: Given, height: Given, steps: int, turns: int, kick: Given, samples: int) -> arb:
    """The level in the middle of the plateau, to the working digits.

    There the two symmetric orbits are displaced by opposite amounts; a perturbed top, which has no reversor, has the
    mean displacement 0.
    """
    near, _, _ = resonance(tensor, D, height, steps, turns, kick)
    phases = starts(Level(tensor, D, height, near, kick), samples)

    def off(l: arb) -> arb:
        level = Level(tensor, D, height, l, kick)
        of = phases if number(kick) != 0 else symmetric_starts(level, steps)
        return arb(sum(level.displacement(x, steps, turns) for x in of))

    return solved(off, near, number(near) * (1 + arb(10) ** -15))


def starts(level: Level, samples: int) -> list[arb]:
    """The phases of u = 2Ki/n."""
    return [level.amplitude(level.half * i / samples) for i in range(samples)]


def spectrum(values: Sequence[arb]) -> list[tuple[arb, arb]]:
    """(c_j, s_j), j = 0, ..., n/2 of Σ c_j cos 2πji/n + s_j sin 2πji/n."""
    n = len(values)
    sizes = [arb(1) / n if j in (0, n // 2) else arb(2) / n for j in range(n // 2 + 1)]
    whole = acb.dft([acb(x) for x in values])
    return [(middle(x.real * size), middle(-x.imag * size)) for x, size in zip(whole, sizes, strict=False)]


def displacement(
    tensor: Tensor, D: Given, height: Given, steps: int, turns: int, digits: int, samples: int, kick: Given = 0
) -> Data:
    """(G^q(u) - u)/2K - p at u = 2Ki/n, in the middle of the plateau, and its Fourier coefficients in jπu/K.

    values, cosines, sines: decimal strings, in half turns; routes: the greatest difference from the displacement by
    (5.15), a second route without the sphere; chord: how far the chord form is from 0 along a step.
    kick: τ of a perturbed top; that has the first route only.
    """
    with ctx.workdps(digits):
        l = middle_level(tensor, D, height, steps, turns, kick, samples)
        level = Level(tensor, D, height, l, kick)
        phases = starts(level, samples)
        values = [level.displacement(x, steps, turns) for x in phases]
        coefficients = spectrum(values)
        found: Data = {
            "tensor": list(map(str, tensor)), "D": str(D), "height": str(height), "kick": str(kick), "steps": steps,
            "half_turns": turns, "digits": digits, "level": text(l, digits - 5), "values": [text(x) for x in values],
            "cosines": [text(c, 6) for c, _ in coefficients], "sines": [text(s, 6) for _, s in coefficients],
            "modulus": float(level.m.sqrt()), "half_period": text(level.half),
        }  # fmt: skip
        if number(kick) == 0:
            found |= second_route(level, phases, values, steps, turns)
        return found


def second_route(level: Level, phases: list[arb], values: list[arb], steps: int, turns: int) -> Data:
    """The distances of (5.15) and its chord form from the result on the sphere, in half turns."""
    relation = Relation(level)
    chosen = range(0, len(phases), max(1, len(phases) // COMPARED))
    routes = max(abs(values[i] - relation.displacement(phases[i], steps, turns)) for i in chosen)
    chords = []
    for i in chosen:
        u = level.argument(phases[i])
        after = level.argument(level.lift(phases[i], 1))
        chords.append(abs(relation.chord(u, after) / relation.momentum((after - u) / 2 + arb("0.1"))))
    return {"routes": text(routes, 3), "chord": text(max(chords), 3)}


# How many digits a plateau needs, and the cost of a step at a number of digits.


def measured(tensor: Tensor, D: Given, height: Given, steps: int, turns: int, in_height: bool = False) -> Data:
    """`plateau`, with the fewest working digits at which it is seen."""
    found = plateau(tensor, D, height, steps, turns, in_height)
    return {**found, "needed": needed(found)}


def needed(found: Data) -> int:
    """The fewest digits from which on the two displacements are seen: each off by less than half of it."""
    digits = ABOVE - decades(abs(number(found["displacement"][0])))
    while digits > LEAST and seen(found, digits - 1):
        digits -= 1
    return digits


def seen(found: Data, digits: int) -> bool:
    """Whether both symmetric orbits are displaced as they should be, computed with this many digits."""
    with ctx.workdps(digits):
        level = Level(found["tensor"], found["D"], found["height"], found["level"])
        steps, turns = found["steps"], found["half_turns"]
        try:
            got = [level.displacement(x, steps, turns) for x in symmetric_starts(level, steps)]
        except BadInput:  # the secant method has no digits left for the second start
            return False
    true = [number(x) for x in found["displacement"]]
    return all(abs(x - y) < abs(y) / 2 for x, y in zip(got, true, strict=True))


def times(tensor: Tensor, D: Given, height: Given, level: Given, digits: Sequence[int]) -> list[Data]:
    """Seconds of a processor for a step on the sphere at this many digits: the median of some runs."""
    found = []
    for n in digits:
        with ctx.workdps(n):
            at = Level(tensor, D, height, level)
            found.append({"digits": n, "seconds": float(f"{median(_run(at) for _ in range(REPEATS)):.3g}")})
    return found


def _run(level: Level) -> float:
    gamma, start = level.point(arb(1)), process_time()
    for _ in range(TIMED):
        gamma = level.step(gamma)
    return (process_time() - start) / TIMED


# The rotation number of a level by weighted Birkhoff averages of the turned angle, and D = 0, where it is exact.  The
# mean of φ~ - φ is that of any coordinate of the circle, so that no elliptic function is needed.


def weights(steps: int) -> list[arb]:
    """exp(-1/(t(1-t))) at t = 1/(n+1), ..., n/(n+1) (Das and Yorke), of sum 1."""
    t = (arb(i) / (steps + 1) for i in range(1, steps + 1))
    found = [middle((-1 / (x * (1 - x))).exp()) for x in t]
    total = middle(arb(1) / sum(found))
    return [x * total for x in found]


def angles(level: Level, steps: int) -> list[arb]:
    """φ~ - φ of successive steps from φ = 0."""
    gamma, found = level.point(arb(0)), []
    for _ in range(steps):
        after = level.step(gamma)
        found.append(level.turned(gamma, after))
        gamma = after
    return found


def mean(found: list[arb], steps: int) -> arb:
    """The weighted average of the first `steps` angles, in half turns."""
    return middle(sum(w * x for w, x in zip(weights(steps), found, strict=False)) / arb.pi())


def convergence(tensor: Tensor, D: Given, height: Given, level: Given, counts: list[int], digits: int) -> Data:
    """Averages over growing numbers of steps; errors from 15-euler for D = 0, else from the longest average.

    Raises BadInput where there is no step.
    """
    with ctx.workdps(digits + MORE):
        at = Level(tensor, D, height, level)
        found = angles(at, counts[-1])
        means = [mean(found, n) for n in counts]
        exact = number(D) == 0
        best = middle(Relation(at).increment(arb(0)) / at.half) if exact else means[-1]
        floor = arb(10) ** (-digits - MORE)
        errors = [max(abs(x - best), floor) for x in (means if exact else means[:-1])]
        return {
            "tensor": list(map(str, tensor)), "D": str(D), "height": str(height), "level": str(level),
            "digits": digits + MORE, "steps": counts if exact else counts[:-1], "exact": exact,
            "rotation_number": text(best, digits if exact else min(digits, 1 - decades(errors[-1]))),
            "errors": [text(x, 3) for x in errors],
        }  # fmt: skip


def row(tensor: Tensor, D: Given, height: str, points: int, steps: int, digits: int) -> Data:
    """The rotation number in half turns, as text, on levels of equal distance; None where the branch ends.

    With as many digits as the average over half the steps has, which has fewer.
    """
    found: list[str | None] = []
    with ctx.workdps(digits):
        low, high = levels(tensor, D)
        for i in range(points):
            l = low + (high - low) * (2 * i + 1) / (2 * points)
            try:
                turned = angles(Level(tensor, D, height, l), steps)
            except BadInput:
                found.append(None)
                continue
            whole, half = mean(turned, steps), mean(turned, steps // 2)
            found.append(text(whole, max(3, -decades(abs(whole - half)))))
    return {"tensor": list(map(str, tensor)), "D": str(D), "height": str(Fraction(height)), "row": found}
