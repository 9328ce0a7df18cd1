"""Corrections of a motion's polynomials that gain more bits each time, in series: nothing that is proved rests on them.

Neighbours of the motion have ξ' = Aξ (see `deviation`).  With Φ' = AΦ, Φ(0) = 1 and Ψ = Φ⁻¹ the defects e and κ of p
and w are taken away, to the first order, by ξ = -½Φ∫Ψ(B⁻¹κ + ε): a correction gains as many bits as Φ has.  Φ is mended
in the same way, by -Φ∫Ψ(Φ' - AΦ), and then has twice as many bits.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
from flint import arb, arb_poly, arb_series, ctx

from chapsym import generated

from .deviation import Body, Defects, exact
from .series import Floats, Series, cross, linear

Row = Sequence[Any]
Rows = Sequence[Row]


class Neighbours:
    """Φ and Ψ of a step, exact polynomials; to be called with the precision of what is gained."""

    def __init__(self, series: Series, body: Body) -> None:
        back = linear(-np.transpose(series.A, (0, 2, 1)), np.zeros((len(series.A) - 1, 3, 3)), np.eye(3))
        self.body, self.phi, self.psi = body, _rows(series.Phi), _rows(np.transpose(back, (0, 2, 1)))

    def mend(self, p: Row, w: Row, terms: int) -> None:
        """Gives Φ and Ψ twice as many bits, if p and w have as many."""
        with capped(terms):
            gamma, omega, phi, psi = generated.rotation(*_series(p))[6:], _series(w), *map(_all, (self.phi, self.psi))
            off = []
            for column in zip(*phi, strict=True):
                turned = self._solved(self.body.bent(omega, column), gamma)
                off.append([x.derivative() - y for x, y in zip(column, turned, strict=True)])
            mixed = _product(psi, list(zip(*off, strict=True)))
            less = _product(phi, [[x.integral() for x in row] for row in mixed])
            phi = _all([[x - y for x, y in zip(*rows, strict=True)] for rows in zip(phi, less, strict=True)])
            one = _product(phi, psi)
            twice = [[2 * (i == j) - x for j, x in enumerate(row)] for i, row in enumerate(one)]
            self.phi, self.psi = ([_exact(row) for row in x] for x in (phi, _product(psi, twice)))

    def correction(self, p: Row, w: Row, found: Defects, terms: int) -> tuple[list[Any], list[Any]]:
        """What takes away the defects of p and w to the first order, if it is added."""
        with capped(terms):
            a, omega = _series(p), _series(w)
            e, kappa, (off,) = map(_series, (found.e, found.kappa, [found.off]))
            gamma = generated.rotation(*a)[6:]
            # κ is that of |p|²R in place of R; what this is off by is taken away with the rest.
            central = generated.contact_momentum(*(*omega, *gamma, *self.body.J, -self.body.D))
            whole = [x + y for x, y in zip(central, self.body.rotor, strict=True)]
            b = self._solved([x + off * y for x, y in zip(kappa, whole, strict=True)], gamma)
            away = generated.compose(a[0], -a[1], -a[2], -a[3], *e)
            rest = _product(_all(self.psi), [[x + 2 * y] for x, y in zip(b, away[1:], strict=True)])
            xi = [arb(-0.5) * x for (x,) in _product(_all(self.phi), [[x.integral()] for (x,) in rest])]
            move = generated.compose(*(*a, -away[0].integral(), *xi))  # the scalar brings |p| to 1
            turn = cross(omega, xi)
            change = [2 * (x + y + z.derivative()) for x, y, z in zip(turn, away[1:], xi, strict=True)]
            return _exact(move), _exact(change)

    def _solved(self, v: Row, gamma: Row) -> Row:
        """B⁻¹v."""
        return generated.angular_velocity(*(*v, *gamma, *self.body.J, self.body.D))


@contextmanager
def capped(terms: int) -> Iterator[None]:
    """Cuts series to so many terms."""
    before, ctx.cap = ctx.cap, terms
    try:
        yield
    finally:
        ctx.cap = before


def _series(polynomials: Any) -> list[Any]:
    """The middles, rounded, as series."""
    return [arb_series(exact(exact(x) * arb(1))) for x in polynomials]


def _all(rows: Rows) -> Rows:
    return [_series(row) for row in rows]


def _exact(series: Row) -> list[Any]:
    return [exact(x) for x in series]


def _rows(matrices: Floats) -> Rows:
    """A matrix of polynomials, from that of each term."""
    return [[arb_poly(matrices[:, i, j].tolist()) for j in range(3)] for i in range(3)]


def _product(left: Rows, right: Rows) -> Rows:
    """The product of two matrices."""
    columns = list(zip(*right, strict=True))
    return [[sum(x * y for x, y in zip(row, column, strict=True)) for column in columns] for row in left]
