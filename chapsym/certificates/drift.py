"""Certificate `energy-drift`: a closed orbit of the continuous ball, with the integrals over it of X₃(H) and div_μ X₃.

The search varies one component of the momentum until the solution returns; the return and the integrals are computed by
the enclosures of the checker (checker/drift.py has the proof).
"""

import itertools
import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym import checker
from chapsym.checker.drift import STATE, SYMMETRIES, Orbit
from chapsym.checker.interval import Interval
from chapsym.checker.linear import Vector
from chapsym.checker.taylor import Model
from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.start import decade

from .balls import shortest
from .document import Document, Say, accepted, stated

KIND = "energy-drift"
#: The steps of the secant method; the window of each step for the time of return.
ROUNDS, WINDOW = 12, "1/100"


class Return(Orbit):
    """The starts of a certificate, and their returns; `time`: the approximate time of return."""

    time: Fraction

    def __init__(self, data: Document, progress: Say):
        super().__init__(data)
        step = self.flow.step

        def reported(*given: Any) -> Any:
            """Reports each step: one of many digits takes seconds."""
            progress(f"enclosing the orbit, step {self.flow.steps + 1}")
            return step(*given)

        self.flow.step = reported  # type: ignore[assignment, method-assign]

    def crossing(self, models: Sequence[Model], length: int, wanted: Interval) -> Interval:
        """The return as in `Orbit`, in the last step, which begins at `early`; sets `time`."""
        back = super().crossing(models, length, wanted)
        self.time = (self.early + middle(back) * length) / 2**self.bits
        return back


def energy_drift(
    J: Sequence[Fraction], D: Fraction, momentum: Sequence[Fraction], gamma: Sequence[Fraction], signs: Sequence[int],
    time: Fraction, varied: int, *, digits: int = 20, progress: Say = lambda sentence: None,
) -> Document:  # fmt: skip
    """Finds a closed orbit near a start, by adjusting one component of its momentum, and encloses it.

    Raises BadInput if there is none, or if the checker does not prove it.
    """
    _check(J, D, gamma, signs, time)
    signs = list(map(int, signs))
    try:
        section, along = components(np.array(J, float), float(D), np.array(momentum, float), np.array(gamma, float))
    except (OverflowError, np.linalg.LinAlgError):
        raise BadInput("the search begins in float64, for which the numbers are too large or too far apart") from None
    fields = {
        "ball": {"J": [str(x) for x in J], "D": str(D)},
        "start": {"momentum": [shortest(x) for x in momentum], "gamma": [str(x) for x in gamma]},
        "varied": STATE[varied], "radius": "0", "symmetry": signs, "periods": 1 + (signs != SYMMETRIES[0]),
        "time": shortest(time), "window": WINDOW, "section": STATE[section], "along": STATE[along],
        "bits": 96 + 8 * digits, "order": 24 + 2 * digits,
    }  # fmt: skip
    try:
        fields = refined(fields, digits, progress)
        orbit = Orbit(fields)
        ends = [orbit.returned(end, end, integrals=False) for end in (-1, 1)]
        energy, density = orbit.returned(-1, 1, integrals=True)[2]
        progress("the orbit is enclosed")
        misses = [outward(missed(orbit, start, end)) for start, end, _ in ends]
        fields |= {"misses": misses, "energy": outward(energy), "density": outward(density)}
        return accepted(stated(KIND, **fields))
    except checker.Rejected as error:
        raise BadInput(f"the orbit is not proved with {digits} digits: {error}") from None


def _check(J: Sequence[Fraction], D: Fraction, gamma: Sequence[Fraction], signs: Sequence[int], time: Fraction) -> None:
    if sum(x * x for x in gamma) != 1:
        raise BadInput(f"gamma must be a unit vector of rationals, such as 2/7,3/7,6/7, not {listed(gamma)}")
    if min(J) < 0 or sorted(J)[1] <= 0 or D < 0:
        raise BadInput(f"J = {listed(J)}, D = {D} is no ball")
    if time < 0:
        raise BadInput("the time must not be negative")
    if list(signs) not in SYMMETRIES:
        raise BadInput(f"the signs must be one of {', '.join(map(listed, SYMMETRIES))}, not {listed(signs)}")


def listed(values: Sequence[object]) -> str:
    """Components as the text (a, b, c)."""
    return f"({', '.join(map(str, values))})"


@np.errstate(all="ignore")  # what is beyond float64 is refused
def components(J: np.ndarray, D: float, K: np.ndarray, g: np.ndarray) -> tuple[int, int]:
    """The section and the component along it that separate states best, including the flow across the section."""
    w = np.linalg.solve(np.diag(J.sum() - J + D) - D * np.outer(g, g), K)
    rates = [*np.cross(K, w), *np.cross(g, w)]
    of_energy = [*w, *(D * (g @ w) * w)]
    gradients = [[*(0 * g), *(2 * g)], [*(2 * K), *(0 * K)], [*g, *K], of_energy]  # of |γ|², |K|², ⟨K,γ⟩, H

    def value(pair: tuple[int, int]) -> float:
        return abs(float(np.linalg.det([*gradients, *np.eye(6)[[*pair]]]) * rates[pair[0]]))

    values = {pair: value(pair) for pair in itertools.permutations(range(6), 2)}
    if not np.isfinite(list(values.values())).all():
        raise OverflowError
    return max(values, key=values.__getitem__)


def refined(fields: Document, digits: int, progress: Say) -> Document:
    """The fields with the varied component and the time to this many decimals, by the secant method."""
    unit, varied = Fraction(1, 10**digits), STATE.index(fields["varied"])
    momentum = [Fraction(x) for x in fields["start"]["momentum"]]
    before: tuple[Fraction, Fraction] | None = None
    for _ in range(ROUNDS):
        orbit, here = Return(dict(fields), progress), momentum[varied]
        miss = middle(missed(orbit, *orbit.returned(0, 0, integrals=False)[:2]))
        progress(f"the orbit misses its start by {float(miss):.1e}")
        slope = (miss - before[1]) / (here - before[0]) if before else None
        before = here, miss
        momentum[varied] = round(here - miss / slope if slope else here + Fraction(1, 10**6), digits)
        start = fields["start"] | {"momentum": [shortest(x) for x in momentum]}
        fields = {**fields, "start": start, "time": shortest(round(orbit.time, digits))}
        if slope and abs(momentum[varied] - here) <= unit:
            return {**fields, "radius": shortest(3 * unit), "window": shortest(Fraction(1, 10 ** (digits // 3)))}
    raise BadInput("no closed orbit was found near the start: give a nearer one, or another component to vary")


def missed(orbit: Orbit, start: Vector, found: Vector) -> Interval:
    """The component `along` at the return to the section, minus that at the start."""
    return found[orbit.along] - start[orbit.along]


def middle(x: Interval) -> Fraction:
    """The middle of an interval."""
    return Fraction(x.lo + x.hi, 2 << x.bits)


def outward(x: Interval) -> list[str]:
    """Decimals [centre, radius] of an interval that contains a given one."""
    radius = Fraction(x.width, 2 << x.bits)
    digits = max(2 - decade(radius), 0)
    centre = round(middle(x), digits)
    off = radius + abs(middle(x) - centre)
    return [shortest(centre), shortest(Fraction(math.ceil(off * 10**digits), 10**digits))]
