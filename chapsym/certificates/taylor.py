"""Validated integration of an analytic field: Taylor polynomials, and a bound of how far the solutions are from them.

A step has polynomials p(t) of the state, exact, and balls for what the solutions through the error box differ by.

1. The defect p' - f(p) is analytic where f(p) is, and this is so on a disc |t| ≤ R that is covered by small boxes, on
   each of which f(p) is evaluated; with |f(p)| ≤ M there, its n-th coefficient beyond the polynomials is at most M/Rⁿ
   (Cauchy).  The first ones are computed: they are what rounding has left.
2. If |p' - f(p)| ≤ d on [0, h] and f has the Lipschitz constant L in a tube about p, every solution that starts within
   e of p(0) is within (e + hd)·exp(Lh) of p(t), as long as it is in the tube; and it is, if this bound is less than
   the radius of the tube (Gronwall).  The same holds for t < 0.
3. A density with |g| ≤ M on polydiscs of the radius ϱ about p differs by at most M(e/ϱ)/(1 - e/ϱ) at e < ϱ from p: by
   Cauchy's bound again, on the complex line through the two points.
"""

import itertools
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from flint import acb, acb_poly, arb, arb_poly, arb_series, ctx

from chapsym.dynamics.levels.balls import exact

from .duals import derivative

State = list[Any]
Function = Callable[[Sequence[Any]], State]

#: The step is this part of R; the longest R that is tried.
PART, LONGEST = Fraction(1, 4), Fraction(2)
#: Boxes along the radius, and pieces of a step for which L is bounded apart.
BOXES, PARTS = 6, 6
#: The radius of the tube, beside the weights, and of the complex polydiscs about it for the densities.
TUBE, WIDER = Fraction(1, 2**14), Fraction(1, 2**10)


class NotEnclosed(ArithmeticError):
    """What is to be proved does not follow: the balls are too wide, or it is not true."""


class Piece(NamedTuple):
    """The solutions around one time: polynomials of the state and of the integrals, and radii about them."""

    polynomials: list[Any]
    radii: list[Any]
    length: Any

    def at(self, time: Any) -> State:
        """The state, and then the integrals from here, in balls, at a ball of times from here, |t| ≤ length."""
        if not abs(time) <= self.length:
            raise NotEnclosed("the time is beyond the step")
        return [p(time) + arb(0, r) for p, r in zip(self.polynomials, self.radii, strict=True)]


class Flow(NamedTuple):
    """A field and densities, functions of the state, to be integrated with polynomials of so many coefficients.

    weights: the sizes of the state's components; an error e is one of e·weight in each.
    """

    field: Function
    densities: Function
    order: int
    weights: list[Any]

    def run(self, state: State, end: Fraction) -> State:
        """The state at the time `end`, and the integrals from 0 to there, from all states in balls.

        Raises NotEnclosed.
        """
        now, size = Fraction(0), len(state)
        totals = [arb(0) for _ in self.densities(state)]
        reach = LONGEST
        while now < end:
            piece, length, reach = self.piece(state, min(reach * 3 / 2, LONGEST), end - now)
            found = piece.at(exact(length))
            state, now = found[:size], now + length
            totals = [x + y for x, y in zip(totals, found[size:], strict=True)]
        return [*state, *totals]

    def piece(self, state: State, reach: Fraction, most: Fraction) -> tuple[Piece, Fraction, Fraction]:
        """One step of at most the length `most` from all states in balls; its length, and its R, at most `reach`."""
        middle = [arb(x.mid()) for x in state]
        error = _largest((x.rad() / w for x, w in zip(state, self.weights, strict=True)))
        if not error < exact(TUBE):
            raise NotEnclosed("no step can be enclosed: the balls are too wide")
        exactly, integrals = self._polynomials(middle)
        for _ in range(40):
            bounds = self._on_disc(exactly, exact(reach))
            if bounds is not None:
                length = min(reach * PART, most)
                limit = (exact(length) * (1 + exact(TUBE))).abs_upper()
                radii = self._radii(exactly, error, limit, exact(reach), *bounds)
                if radii is not None:
                    return Piece([*map(arb_poly, exactly), *integrals], radii, limit), length, reach
            reach = reach * 3 / 4
        raise NotEnclosed("no step can be enclosed: the balls are too wide")

    def _polynomials(self, start: State) -> tuple[list[list[Any]], list[Any]]:
        """Coefficients of the state, exact, by Picard's iteration; and polynomials in balls of the integrals."""
        cap = ctx.cap
        ctx.cap = self.order
        try:
            known = [arb_series([x], 1) for x in start]
            for _ in range(1, self.order):
                known = [rate.integral() + x for x, rate in zip(start, self.field(known), strict=True)]
            exactly = [[arb(series[i].mid()) for i in range(self.order)] for series in known]
            densities = self.densities([arb_series(x, self.order) for x in exactly])
        finally:
            ctx.cap = cap
        return exactly, [arb_poly([density[i] for i in range(self.order)]).integral() for density in densities]

    def _radii(
        self, p: list[list[Any]], error: Any, length: Any, reach: Any, rates: State, sizes: State
    ) -> State | None:
        """How far the solutions and the integrals are from their polynomials within a step; None if beyond the tube."""
        defect = self._defect(p, length, reach, rates)
        error = error + length * defect
        growth, near = [], []
        for k in range(PARTS):
            inside = length / PARTS * arb(k + 0.5, 0.5)
            for time in (inside, -inside):
                middle = [arb_poly(x)(time) for x in p]
                near.append(list(map(abs, self.densities(self._around(middle)))))
                tube = [x + arb(0, exact(TUBE) * w) for x, w in zip(middle, self.weights, strict=True)]
                growth.append(self._slope(tube) * length / PARTS)
        exponent = _largest(sum(growth[i::2], arb(0)) for i in (0, 1))
        error = (error * exponent.exp()).abs_upper()
        if not error < exact(TUBE):
            return None
        part = error / exact(WIDER)
        tail = (length / reach) ** self.order / (1 - length / reach)
        beside = [_largest(x) * part / (1 - part) for x in zip(*near, strict=True)]
        found = [error * w for w in self.weights]
        found += [length * (tail * size + off) for size, off in zip(sizes, beside, strict=True)]
        return [x.abs_upper() for x in found] if all(x.is_finite() for x in found) else None

    def _around(self, state: State) -> State:
        """Polydiscs about a state, in complex boxes."""
        radii = [exact(WIDER) * w for w in self.weights]
        return [acb(x + arb(0, r), arb(0, r)) for x, r in zip(state, radii, strict=True)]

    def _defect(self, p: list[list[Any]], length: Any, reach: Any, rates: State) -> Any:
        """A bound of |p' - f(p)|, beside the weights, for |t| ≤ length."""
        cap = ctx.cap
        ctx.cap = last = self.order - 1
        try:
            found = self.field([arb_series(x, self.order) for x in p])
            sums = [
                sum((abs(x[i + 1] * (i + 1) - rate[i]) * length**i for i in range(last)), arb(0))
                for x, rate in zip(p, found, strict=True)
            ]
        finally:
            ctx.cap = cap
        tail = (length / reach) ** last / (1 - length / reach)
        return _largest((x + tail * y) / w for x, y, w in zip(sums, rates, self.weights, strict=True))

    def _on_disc(self, p: list[list[Any]], reach: Any) -> tuple[State, State] | None:
        """Bounds of the field and the densities on p(t), |t| ≤ reach; None where they may not be analytic."""
        polynomials = [acb_poly(x) for x in p]
        side = reach / BOXES
        rates, sizes = [], []
        for i, j in itertools.product(range(-BOXES, BOXES), repeat=2):
            if min(i * i, (i + 1) ** 2) + min(j * j, (j + 1) ** 2) >= BOXES**2:
                continue
            time = acb((i + arb(0.5, 0.5)) * side, (j + arb(0.5, 0.5)) * side)
            state = [x(time) for x in polynomials]
            rates.append([abs(x) for x in self.field(state)])
            sizes.append([abs(x) for x in self.densities(state)])
            if not all(x.is_finite() for x in (*rates[-1], *sizes[-1])):
                return None
        return [_largest(x) for x in zip(*rates, strict=True)], [_largest(x) for x in zip(*sizes, strict=True)]

    def _slope(self, box: State) -> Any:
        """The Lipschitz constant of the field on a box, beside the weights."""
        size = len(box)
        columns = [
            derivative(self.field, box, [weight if i == j else 0 for i in range(size)])
            for j, weight in enumerate(self.weights)
        ]
        rows = [sum((abs(x) for x in row), arb(0)) for row in zip(*columns, strict=True)]
        return _largest(x / w for x, w in zip(rows, self.weights, strict=True))


def _largest(values: Any) -> Any:
    """The largest upper bound."""
    best = arb(0)
    for x in values:
        best = best.max(arb(x).abs_upper())
    return best
