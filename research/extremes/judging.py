"""The precisions as columns of the matrix, and one comparison: an error, in ulps of the precision, and its promise."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

import flint
from mpmath import MPContext, mpf
from numpy import ndarray

from chapsym.dynamics import Step, Trajectory
from chapsym.numbers import Digits, Double, DoubleDouble, Enclosure, Pair, Precision, Single

#: The digits with which everything is compared.
mp = MPContext()
mp.dps = 140
#: The truth is known to this, relatively, and better.
KNOWN = mp.mpf(10) ** -80
#: A number of a precision, or an exact one.
Number: TypeAlias = flint.arb | Pair | mpf | float | Fraction
WITHIN, REFUSED, FAILED = "within", "refused", "failed"
#: From bad to worse.
ORDER = (WITHIN, REFUSED, FAILED)
#: Ulps that are promised, times what the condition asks for; as in `check`: 8 roundings of half an ulp.
BUDGET = 4.0
#: An error above this, relatively, leaves no digit: then a refusal would be right.
NO_DIGIT = 0.1


@dataclass(frozen=True)
class Level:
    """A precision, one column.

    key: its name in JSON.  unit: an ulp relative to the size of a vector; least: the smallest number, below which
    nothing is resolved; digits: the decimal digits that its numbers have.
    long: steps of a long run, quick and full.
    guarded: whether guard digits absorb the condition number, so that the promise does not know it.
    compensated: whether the sums of a run are, so that only the roundings of increments add up.
    """

    name: str
    key: str
    precision: Precision
    unit: Fraction
    least: Fraction
    digits: float
    long: tuple[int, int]
    guarded: bool = False
    compensated: bool = False

    def spacing(self, size: mpf) -> mpf:
        """An ulp of numbers of this size, as an mpf."""
        return max(number(self.unit) * abs(size), number(self.least))


SINGLE = Level(
    "single", "single", Single(), Fraction(1, 2**23), Fraction(1, 2**149), 7.2,
    long=(100_000, 100_000_000), compensated=True,
)  # fmt: skip
DOUBLE = Level(
    "double", "double", Double(), Fraction(1, 2**52), Fraction(1, 2**1074), 16.0,
    long=(100_000, 100_000_000), compensated=True,
)  # fmt: skip
DOUBLE_DOUBLE = Level(
    "double-double", "quad", DoubleDouble(), Fraction(1, 2**104), Fraction(1, 2**1074), 31.3, long=(10_000, 10_000_000)
)
DIGITS = Level(
    "Digits(50)", "Digits(50)", Digits(50), Fraction(1, 10**49), Fraction(0), 50.0, long=(100, 10_000), guarded=True
)
ENCLOSURE = Level(
    "Enclosure(200)", "Ball(200)", Enclosure(200), Fraction(1, 2**199), Fraction(0), 60.2,
    long=(100, 1000), guarded=True,
)  # fmt: skip
LEVELS = (SINGLE, DOUBLE, DOUBLE_DOUBLE, DIGITS, ENCLOSURE)


def number(value: Number) -> mpf:
    """The exact value of a number of any precision, as an mpf; of an enclosure its centre."""
    if isinstance(value, Fraction):
        return mp.mpf(value.numerator) / value.denominator
    if isinstance(value, flint.arb):
        mantissa, exponent = value.mid().man_exp()
        return mp.ldexp(mp.mpf(int(mantissa)), int(exponent))
    if isinstance(value, Pair):
        return mp.mpf(value.high) + value.low
    return mp.make_mpf(value._mpf_) if hasattr(value, "_mpf_") else mp.mpf(float(value))


def whole(found: Step | Trajectory, name: str) -> ndarray:
    """An array of a step or a run; with both halves of each number of double-double."""
    high = getattr(found, name)
    if found.low is None:
        return high
    pairs = [Pair(float(a), float(b)) for a, b in zip(high.flat, getattr(found.low, name).flat, strict=True)]
    whole = high.astype(object)
    whole.flat = pairs
    return whole


@dataclass(frozen=True)
class Judged:
    """One comparison, or the worst of several; but for the condition, its fields are those of a cell in JSON.

    ulps: the error in ulps of the precision; promised: how many were; digits: correct decimal digits, relative.
    condition_number: κ of the state, or of what was computed from it.  reason: one line, for all but `within`.
    """

    verdict: str
    ulps: float | None = None
    promised: float | None = None
    digits: float | None = None
    condition_number: float | None = None
    reason: str = ""


#: Judges one thing at a precision, quickly or in full; what it raises of BadInput and StepNotTaken is a refusal.
Judge = Callable[[Level, bool], Judged]


def worst(found: Sequence[Judged]) -> Judged:
    """The worst verdict, and of the same the one that comes nearest to its promise."""

    def badness(one: Judged) -> tuple[int, float]:
        share = one.ulps / one.promised if one.ulps is not None and one.promised else 0.0
        return ORDER.index(one.verdict), share

    return max(found, key=badness)


def refused(sentence: str, kappa: float | None = None) -> Judged:
    """A refusal; one without a sentence is a failure."""
    verdict = REFUSED if len(sentence.split()) >= 4 else FAILED
    return Judged(verdict, condition_number=kappa, reason=sentence or "refused without a reason")


def compared(
    level: Level, kappa: float | None, name: str, found: Iterable[Number], truth: Sequence[mpf], promised: float,
    size: mpf | None = None,
) -> Judged:  # fmt: skip
    """A vector compared with the truth: an enclosure must contain it, and its radius is its error.

    promised: in ulps of its size, which is its largest component unless it is said.
    """
    found = [*found]
    if not all(x.is_finite() if isinstance(x, flint.arb) else mp.isfinite(number(x)) for x in found):
        return Judged(FAILED, reason=f"{name} is not finite, and no reason is given")
    size = max((abs(x) for x in truth), default=mp.zero) if size is None else size
    away = [abs(number(x) - t) for x, t in zip(found, truth, strict=True)]
    radii = [number(x.rad()) if isinstance(x, flint.arb) else mp.zero for x in found]
    error, spacing = max([*away, *radii]), level.spacing(size)
    ulps = float(error / spacing) if spacing else 0.0 if error == 0 else float("inf")
    digits = float(-mp.log10(error / size)) if error and size else None
    reason = ""
    if any(r and a > r + KNOWN * size for a, r in zip(away, radii, strict=True)):
        reason = f"the ball of {name} excludes the truth"
    elif ulps > promised:
        reason = f"{name} is wrong by {ulps:.3g} ulps; {promised:.3g} are promised"
    elif error > number(NO_DIGIT) * size and error > spacing:
        reason = f"no digit of {name} is right, as {promised:.3g} ulps are all that is promised"
    return Judged(FAILED if reason else WITHIN, ulps, promised, digits, kappa, reason)


def state(
    level: Level, kappa: float | None, found: Sequence[ndarray], exact: Sequence[list[mpf]], ulps: float, *more: Judged
) -> Judged:
    """𝒦 and γ compared with the truth, with one promise, and what more is judged."""
    momentum = compared(level, kappa, "the momentum", found[0], exact[0], ulps)
    return worst([*more, momentum, compared(level, kappa, "gamma", found[1], exact[1], ulps, 1)])
