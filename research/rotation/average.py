"""The rotation number of a level by weighted Birkhoff averages of the turned angle, and D = 0, where it is exact.

The mean of φ~ - φ is that of any coordinate of the circle, so that no elliptic function is needed.
"""

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, ctx

from chapsym.dynamics import BadInput
from chapsym.files import Data

from .circle import Given, Level, middle, number
from .plateau import decades, levels, text
from .relation import Relation

#: Digits beyond those that are asked for.
SPARE = 10


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


def convergence(tensor: Sequence[Given], D: Given, height: Given, level: Given, counts: list[int], digits: int) -> Data:
    """Averages over growing numbers of steps; errors from 15-euler for D = 0, else from the longest average.

    Raises BadInput where there is no step.
    """
    with ctx.workdps(digits + SPARE):
        at = Level(tensor, D, height, level)
        found = angles(at, counts[-1])
        means = [mean(found, n) for n in counts]
        exact = number(D) == 0
        best = middle(Relation(at).increment(arb(0)) / at.half) if exact else means[-1]
        floor = arb(10) ** (-digits - SPARE)
        errors = [max(abs(x - best), floor) for x in (means if exact else means[:-1])]
        return {
            "tensor": list(map(str, tensor)), "D": str(D), "height": str(height), "level": str(level),
            "digits": digits + SPARE, "steps": counts if exact else counts[:-1], "exact": exact,
            "rotation_number": text(best, digits if exact else min(digits, 1 - decades(errors[-1]))),
            "errors": [text(x, 3) for x in errors],
        }  # fmt: skip


def row(tensor: Sequence[Given], D: Given, height: str, points: int, steps: int, digits: int) -> Data:
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
