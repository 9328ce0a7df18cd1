"""The search for a closed orbit of the continuous ball near a start, and the certificate of its energy drift."""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat, ctx

from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.balls import exact
from chapsym.dynamics.levels.start import fraction

from .balls import decade, shortest
from .document import stated
from .drift import NAMES, SYMMETRIES, Enclosures, Orbit, enclose, flow_of, told_apart
from .taylor import LONGEST, Flow, NotEnclosed

KIND = "energy-drift"


def energy_drift(
    J: Sequence[Fraction],
    D: Fraction,
    momentum: Sequence[Fraction],
    gamma: Sequence[Fraction],
    signs: tuple[int, ...],
    time: Fraction,
    varied: int,
    *,
    digits: int = 20,
    progress: Callable[[str], None] = lambda sentence: None,
) -> dict[str, Any]:
    """Finds the closed orbit near a start, one component of its momentum adjusted, and encloses it.

    Raises BadInput where there is none, or where the balls do not prove it.
    """
    near = Orbit(tuple(J), D, tuple(momentum), tuple(gamma), varied, Fraction(0), tuple(signs), time, Fraction(0), 0, 1)
    section, along = components(near)
    order, bits = 24 + 2 * digits, 96 + 8 * digits
    try:
        orbit = refined(replace(near, section=section, along=along), digits, order, progress)
        progress("the orbit is enclosed")
        return document(orbit, enclose(orbit, bits, order), bits, order)
    except NotEnclosed as error:
        raise BadInput(f"the orbit is not proved with {digits} digits: {error}") from None


def components(orbit: Orbit) -> tuple[int, int]:
    """The section and the component along it that tell states best apart, the flow across the section taken in."""
    start = orbit.start(0)
    tensor, contact = [exact(x) for x in orbit.J], exact(orbit.D)
    rates = flow_of(orbit.J, orbit.D, 2, orbit.size).field(start)

    def value(pair: tuple[int, int]) -> float:
        return abs(float(arb_mat(told_apart(start, tensor, contact, *pair)).det().mid()) * float(rates[pair[0]].mid()))

    return max(itertools.permutations(range(6), 2), key=value)


def refined(orbit: Orbit, digits: int, order: int, tell: Callable[[str], None] = lambda sentence: None) -> Orbit:
    """The orbit with its varied component and its time to so many decimals, by the secant method from a near one."""
    unit = Fraction(1, 10**digits)
    before: tuple[Fraction, Fraction] | None = None
    with ctx.workprec(int(digits * 3.33) + 128):
        flow = flow_of(orbit.J, orbit.D, order, orbit.size)._replace(densities=lambda state: [])
        for _ in range(12):
            miss, late = _missed(orbit, flow)
            tell(f"the orbit misses its start by {float(miss):.1e}")
            here = orbit.momentum[orbit.varied]
            slope = (miss - before[1]) / (here - before[0]) if before else None
            step = -miss / slope if slope else Fraction(1, 10**6)
            before = here, miss
            there = rounded(here + step, digits)
            momentum = tuple(there if i == orbit.varied else x for i, x in enumerate(orbit.momentum))
            orbit = replace(orbit, momentum=momentum, time=rounded(orbit.time + late, digits))
            if slope and abs(there - here) <= unit:
                return replace(orbit, radius=3 * unit, window=Fraction(1, 10 ** (digits // 3)))
    raise BadInput("no closed orbit was found near the start: give a nearer one, or another component to vary")


def _missed(orbit: Orbit, flow: Flow) -> tuple[Fraction, Fraction]:
    """By how much the component `along` misses its start on the section, and how late the return is; not proved."""
    start = [arb(x.mid()) for x in orbit.start(0)]
    piece, *_ = flow.piece([arb(x.mid()) for x in flow.run(start, orbit.time)], LONGEST, Fraction(1, 100))
    late, sign = arb(0), orbit.signs[orbit.section % 3]
    for _ in range(8):
        state = piece.at(late)
        missed = state[orbit.section] * sign - start[orbit.section]
        late = arb((late - missed / (flow.field(state[:6])[orbit.section] * sign)).mid())
    miss = piece.at(late)[orbit.along] * orbit.signs[orbit.along % 3] - start[orbit.along]
    return fraction(miss), fraction(late)


def document(orbit: Orbit, found: Enclosures, bits: int, order: int) -> dict[str, Any]:
    """The certificate as it is written; numbers are strings, exact rationals or decimals."""
    return stated(
        KIND,
        ball={"J": [str(x) for x in orbit.J], "D": str(orbit.D)},
        start={"momentum": [shortest(x) for x in orbit.momentum], "gamma": [str(x) for x in orbit.gamma]},
        varied=NAMES[orbit.varied], radius=shortest(orbit.radius),
        symmetry=list(orbit.signs), periods=1 if tuple(orbit.signs) == SYMMETRIES[0] else 2,
        time=shortest(orbit.time), window=shortest(orbit.window),
        section=NAMES[orbit.section], along=NAMES[orbit.along], bits=bits, order=order,
        misses=[_outward(x) for x in found.misses],
        energy=_outward(found.energy), density=_outward(found.density),
    )  # fmt: skip


def _outward(x: Any) -> list[str]:
    """A ball [centre, radius] in decimals, which contains it; twice as wide, for what other bits and terms find."""
    middle, radius = fraction(x.mid()), 2 * fraction(x.rad())
    digits = max(2 - decade(radius), 0) if radius else 60
    centre = rounded(middle, digits)
    return [shortest(centre), shortest(Fraction(math.ceil((radius + abs(middle - centre)) * 10**digits), 10**digits))]


def rounded(x: Fraction, digits: int) -> Fraction:
    """To so many decimals."""
    return round(x * 10**digits) / Fraction(10**digits)
