"""What carries a kernel: the side of a statement that a claim has decided, and what is made of it step by step.

The checker judges it (`chapsym.checker.kernels`): it makes the same of the statement in the claim's certificate, and
compares that with the text of the kernel.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from chapsym.checker import kernels as binding
from chapsym.prove.cofactors import Ideal, ideal, trees
from chapsym.prove.trees import NotAlgebra, tree

Places = Mapping[sp.Symbol, Any]


@dataclass(frozen=True)
class Carrier:
    """Entries that a decided statement has on one side, and steps from there; `left` and `right` make it.

    Parameters
    ----------
    claim : str
        The id of the claim whose proof decides the statement.
    statement : str
        The text of the statement, an equation in a quotient ring whose sides differ.
    side : str
        "left" or "right".
    steps : tuple
        What is done to the entries, in order; the methods add to it.
    """

    claim: str
    statement: str
    side: str
    steps: tuple[tuple[str, Any], ...] = ()

    def at(self, places: Places) -> "Carrier":
        """With expressions in the place of variables."""
        return self._then("at", dict(places))

    def along(self, *moves: Places) -> "Carrier":
        """The derivatives of each entry in directions, in which the variables have these rates.

        The statement's relations must stay true along each direction.
        """
        return self._then("along", [dict(move) for move in moves])

    def solved(self, matrix: "Carrier") -> "Carrier":
        """The x with matrix · x = these entries; the matrix has its entries row by row."""
        return self._then("solved", matrix)

    def entries(self, *numbers: int) -> "Carrier":
        """Some of the entries, counted from 0, in this order."""
        return self._then("entries", list(numbers))

    def _then(self, step: str, by: Any) -> "Carrier":
        return replace(self, steps=(*self.steps, (step, by)))

    @property
    def claims(self) -> list[str]:
        """The claims whose statements it needs."""
        return [self.claim, *(id for step, by in self.steps if step == "solved" for id in by.claims)]

    def data(self, digest: Callable[[str], str]) -> dict[str, Any]:
        """As the checker reads it, with the digest of the certificate of each claim; raises NotAlgebra."""
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


def _trees(by: Any) -> Any:
    if isinstance(by, Mapping):
        return [[symbol.name, tree(sp.sympify(value, strict=True))] for symbol, value in by.items()]
    return [_trees(one) if isinstance(one, Mapping) else one for one in by]


def with_cofactors(
    row: dict[str, Any], text: str, certificates: binding.Certificates, where: str
) -> list[dict[str, Any]]:
    """The carriers of a row, with cofactors for the entries that a text equals by the relations of the ring alone.

    Where there are none, the checker will say so.
    """
    carriers, ideals = [dict(one) for one in row["carriers"]], dict[int, Ideal]()
    for one in binding.differences(row, text, certificates, where):
        if one.value.numerator.terms and one.ring.relations:
            if one.carrier not in ideals:
                ideals[one.carrier] = ideal(one.ring)
            if (found := trees(ideals[one.carrier], one.value)) is not None:
                carriers[one.carrier].setdefault("cofactors", []).append([one.entry, found])
    return carriers


__all__ = ["Carrier", "NotAlgebra", "left", "right"]
