"""Words evaluated at matrices of polynomials: a derivation for every n, in coordinates.

matrix    of a name X of words, by places and cofactors: X in a quotient ring, with matrices (lists of rows of trees)
          substituted for its letters and trees for its parameters.  The matrices satisfy the rules among their letters,
          entry by entry by the cofactors, and their transposes are those that the algebra gives.
entry     of a name of a matrix, by [row, column], counted from 0
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from .algebra import Algebra, about
from .document import Data
from .form import anything, check_rows, check_shape, names, sized
from .interval import Rejected
from .polynomial import Polynomial, Quotient, Ring
from .trees import Tree, check_known, check_name, check_tree, value
from .words import Matrix


class Quotients(NamedTuple):
    """A quotient ring: the polynomial ring, the variables by name, and the relations."""

    ring: Ring
    names: Mapping[str, Quotient]
    relations: Sequence[Quotient]

    def read(self, tree: Tree, more: Mapping[str, Quotient] | None = None) -> Quotient:
        """The quotient of a tree."""
        found: Quotient = value(tree, {**self.names, **(more or {})}, self.ring.number)
        return found

    def is_value(self, tree: Tree, of: Quotient) -> bool:
        """Whether a tree in the variables equals a quotient, without use of the relations."""
        return not (of - self.read(tree)).numerator.terms

    def vanishes(self, numerator: Polynomial, cofactors: Sequence[Tree], where: str) -> bool:
        """Whether a numerator is Σ cofactor · relation."""
        sized(cofactors, len(self.relations), f"the cofactors of {where}")
        made = self.ring.number(Fraction(0))
        for cofactor, relation in zip(cofactors, self.relations, strict=True):
            made = made + self.read(cofactor) * relation
        if made.factors:
            raise Rejected(f"{where} has a relation or a cofactor that is no polynomial")
        return numerator.times(made.scale).terms == made.numerator.terms


def quotients(data: Data, ring: Ring) -> Quotients:
    """The quotient ring of an algebra."""
    names = ring.names()
    return Quotients(ring, names, [value(tree, names, ring.number) for tree in data["relations"]])


def check_places(data: Any, where: str) -> None:
    """Raises Rejected unless these are [name, place]... and, for each rule, lists of cofactors for each entry."""
    check_shape(data, ([(check_name, anything)], [[[check_tree]]]), where)
    names([name for name, _ in data[0]], where)


def placed(tree: Tree, algebra: Algebra, into: Quotients, by: Sequence[Any], where: str) -> Matrix:
    """The matrix of a tree of words at these places, which are proved to satisfy the rules."""
    check_known([name for name, _ in by[0]], algebra.names, where)
    point = dict[str, Any]()
    for name, place in by[0]:
        if name in algebra.letters:
            check_rows(place, check_tree, where)
            point[name] = Matrix([list(map(into.read, row)) for row in place])
        else:
            check_tree(place, where)
            point[name] = into.read(place)
    if nothing := [name for name in sorted(point.keys() & algebra.divisors) if not point[name].numerator.terms]:
        raise Rejected(f"{where} replaces {nothing[0]}, by which something is divided, by 0")
    _check_rules(algebra, point, into, by[1], where)
    made = value(tree, point, into.ring.number)
    if not isinstance(made, Matrix):
        raise Rejected(f"{where} has no letter, and therefore no size")
    return made


def entry(of: Matrix, by: Sequence[int], where: str) -> Quotient:
    """The entry of a matrix; raises Rejected if it does not exist."""
    row, column = by
    if row >= of.shape[0] or column >= of.shape[1]:
        raise Rejected(f"{where} is an entry that the matrix does not have")
    found: Quotient = of.rows[row][column]
    return found


def _check_rules(
    algebra: Algebra, point: Mapping[str, Any], into: Quotients, cofactors: Sequence[Any], where: str
) -> None:
    """Raises Rejected unless the places satisfy the rules and transposes among their letters."""

    def beyond(matrix: Matrix, claimed: Tree) -> list[Polynomial]:
        less = matrix - value(claimed, point, into.ring.number)
        return [x.numerator for row in less.rows for x in row]

    rules, transposes = about(algebra.data, point, where)
    for letter, transpose in transposes:
        if any(x.terms for x in beyond(point[letter].transposed, transpose)):
            raise Rejected(f"{where} has for the transpose of {letter} another matrix than its transpose")
    sized(cofactors, len(rules), f"the cofactors of {where}")
    for (a, b, image), proofs in zip(rules, cofactors, strict=True):
        differences = beyond(point[a] * point[b], image)
        sized(proofs, len(differences), f"the cofactors of {where} for {a} {b}")
        if not all(into.vanishes(x, proof, where) for x, proof in zip(differences, proofs, strict=True)):
            raise Rejected(f"{where} has matrices for which the rule for {a} {b} is not proved")
