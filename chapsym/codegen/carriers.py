"""The carriers of kernels: a side of a statement that a claim has decided, and further steps.

The checker (`chapsym.checker.kernels`) repeats the steps on the statement in the certificate of the claim, and compares
the result with the text of the kernel.
"""

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import sympy as sp

from chapsym.checker import kernels as binding
from chapsym.checker.rational import number_at
from chapsym.derive.quotient import Quotient, in_sympy
from chapsym.files import Data
from chapsym.prove import Examples
from chapsym.prove.cofactors import Ideal, expression, ideal, trees
from chapsym.prove.points import Exact, some
from chapsym.prove.trees import NotAlgebra, tree

Places = Mapping[sp.Symbol, sp.Expr | int]
#: The number of points at which a text is compared with its carrier before the search for cofactors.
MOST_POINTS = 8


@dataclass(frozen=True)
class Carrier:
    """Entries of one side of a decided statement, and further steps; `left` and `right` make it.

    Parameters
    ----------
    claim : str
        The id of the claim whose proof decides the statement.
    statement : str
        The text of the statement, an equation in a quotient ring whose sides differ.
    side : str
        "left" or "right".
    steps : tuple, optional
        The operations on the entries, in order; the methods add to them.
    """

    claim: str
    statement: str
    side: str
    steps: tuple[tuple[str, Any], ...] = ()

    def at(self, places: Places) -> "Carrier":
        """The carrier with its variables replaced by expressions."""
        return self._then("at", _places(places))

    def along(self, *moves: Places) -> "Carrier":
        """The derivatives of each entry in directions, in which the variables have these rates.

        The statement's relations must stay true along each direction.
        """
        return self._then("along", [_places(move) for move in moves])

    def solved(self, matrix: "Carrier") -> "Carrier":
        """The x with matrix · x = these entries; the matrix is given row by row."""
        if not isinstance(matrix, Carrier):
            raise TypeError(f"the matrix of a linear system is another carrier, not {matrix!r:.40}")
        return self._then("solved", matrix)

    def entries(self, *numbers: int) -> "Carrier":
        """Some of the entries, counted from 0, in this order."""
        return self._then("entries", list(numbers))

    def _then(self, step: str, by: object) -> "Carrier":
        return replace(self, steps=(*self.steps, (step, by)))

    @property
    def claims(self) -> list[str]:
        """The claims whose statements it needs."""
        return [self.claim, *(id for step, by in self.steps if step == "solved" for id in by.claims)]

    def data(self, digest: Callable[[str], str]) -> Data:
        """The carrier as the checker reads it, with the digest of the certificate of each claim; raises NotAlgebra."""
        steps = [[step, by.data(digest) if isinstance(by, Carrier) else _trees(by)] for step, by in self.steps]
        return {
            "claim": self.claim, "certificate": digest(self.claim), "statement": self.statement, "side": self.side,
            "steps": steps,
        }  # fmt: skip


def left(claim: str, statement: str) -> Carrier:
    """The left side of a statement that a claim decides."""
    return Carrier(claim, statement, "left")


def right(claim: str, statement: str) -> Carrier:
    """The right side of a statement that a claim decides."""
    return Carrier(claim, statement, "right")


def _places(by: object) -> Places:
    if not isinstance(by, Mapping) or not all(isinstance(x, sp.Symbol) for x in by):
        raise TypeError(f"what is put or moved is given as {{symbol: expression}}, not {by!r:.40}")
    return dict(by)


def _trees(by: Any) -> Any:
    if isinstance(by, Mapping):
        return [[symbol.name, tree(in_sympy(value))] for symbol, value in by.items()]
    return [_trees(one) if isinstance(one, Mapping) else one for one in by]


def completed(row: Data, text: str, certificates: binding.Certificates, where: str) -> list[Data]:
    """The carriers of a row, with the data that the checker needs for a text.

    These are cofactors for the entries that are equal only by the relations of the ring, and a point at which the
    relations hold and nothing divides by 0.  If there are none, the checker reports it.
    """
    one = binding.carried(row, text, certificates, where)
    carriers, ideals = [dict(carrier) for carrier in row["carriers"]], dict[int, Ideal]()
    points = [_points(one, i, _given(carrier, certificates), where) for i, carrier in enumerate(carriers)]
    for carrier, those in zip(carriers, points, strict=True):
        carrier |= {"point": those[0]} if those else {}
    for each in binding.differences(one, where):
        if any(_differs(each, point, where) for point in points[each.carrier]):
            continue  # it is not in the ideal, which the search below would show only slowly
        if each.value.numerator.terms and each.ring.relations:
            if each.carrier not in ideals:
                ideals[each.carrier] = ideal(each.ring)
            if (found := trees(ideals[each.carrier], each.value)) is not None:
                carriers[each.carrier].setdefault("cofactors", []).append([each.entry, found])
    return carriers


def _given(carrier: Data, certificates: binding.Certificates) -> Exact:
    """The numbers at the points of a carrier's certificate."""
    points = certificates.get(f"{carrier['claim']} {carrier['certificate']}", {}).get("points", [])
    return {sp.Symbol(x): sp.Rational(v) for point in points for x, v in point.items() if isinstance(v, int | str)}


def _differs(one: binding.Difference, point: Data, where: str) -> bool:
    """Whether a result and the entry of its carrier differ at a point, if both have values there."""
    with suppress(binding.Rejected):
        return number_at(one.value, {x: Fraction(v) for x, v in point.items()}, where) != 0
    return False


def _points(one: binding.Carried, i: int, given: Exact, where: str) -> list[Data]:
    """Points of a carrier, as in the checker."""
    of, found = one.rings[i], list[Data]()
    ring = Quotient([sp.Symbol(name) for name in of.ring.variables], [expression(r) for r in of.relations])
    for exact in some(ring, Examples(given)):
        point = {x.name: int(v) if v.is_Integer else str(v) for x, v in exact.items()}
        with suppress(binding.Rejected):
            binding.check_point(one, i, point, where)
            found.append(point)
        if len(found) == MOST_POINTS:
            break
    return found


__all__ = ["Carrier", "NotAlgebra", "left", "right"]
