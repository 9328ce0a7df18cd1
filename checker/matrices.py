"""Words at matrices of polynomials: what a derivation for every n says in coordinates.

matrix    of a name X of words, by places and cofactors: X with matrices (lists of rows of trees) in the place of its
          letters and trees in that of its parameters, in a quotient ring.  The rules among the letters that have places
          hold of the matrices by the cofactors, entry by entry, and their transposes are the matrices given for these.
entry     of a name of a matrix, by [row, column], counted from 0
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from operator import mul
from typing import Any, NamedTuple

from .algebra import Algebra
from .form import check_shape, names, sized
from .interval import Rejected
from .polynomial import Polynomial, Quotient, Ring
from .trees import check_known, check_tree, value
from .words import Matrix, Words

Rows = list[list[Quotient]]
#: Rows and columns.
MOST_ROWS = 5


class Quotients(NamedTuple):
    """A quotient ring: its polynomials, its variables as such, and its relations."""

    ring: Ring
    names: Mapping[str, Quotient]
    relations: Sequence[Quotient]

    def read(self, tree: Any, more: Mapping[str, Quotient] | None = None) -> Quotient:
        """The quotient that a tree is."""
        found: Quotient = value(tree, {**self.names, **(more or {})}, self.ring.number)
        return found

    def vanishes(self, numerator: Polynomial, cofactors: Sequence[Any], where: str) -> bool:
        """Whether a numerator is Σ cofactor · relation."""
        made = self.ring.number(Fraction(0))
        for cofactor, relation in zip(cofactors, self.relations, strict=True):
            made = made + self.read(cofactor) * relation
        if made.factors:
            raise Rejected(f"{where} has a relation or a cofactor that is no polynomial")
        return numerator.times(made.scale).terms == made.numerator.terms


def quotients(data: Mapping[str, Any], ring: Ring) -> Quotients:
    """The quotient ring of an algebra."""
    names = ring.names()
    return Quotients(ring, names, [value(tree, names, ring.number) for tree in data["relations"]])


class Entry(NamedTuple):
    """An entry of a matrix of words at their places."""

    value: Quotient


def check_places(by: Any, source: Mapping[str, Any], into: Mapping[str, Any], where: str) -> None:
    """The form of places, trees in the variables of a quotient ring for names of an algebra of words; of cofactors."""
    named = [name for name, _ in by[0]]
    names(named, where)
    check_known(named, [*source["letters"], *source["parameters"]], where)
    for name, place in by[0]:
        rows = place if name in source["letters"] else [[place]]
        check_shape(rows, [[check_tree]], where)
        if not 1 <= min(map(len, rows), default=0) == max(map(len, rows)) <= MOST_ROWS or len(rows) > MOST_ROWS:
            raise Rejected(f"{where} has a matrix whose rows are not of one length, or more than {MOST_ROWS}")
        check_known([tree for row in rows for tree in row], into["variables"], where)
    for proof in (proof for rule in by[1] for proof in rule):
        sized(proof, len(into["relations"]), where)
        check_known(proof, into["variables"], where)


def placed(words: Words, algebra: Algebra, into: Quotients, by: Sequence[Any], where: str) -> Rows:
    """Words at their places, which are proved to obey the rules."""
    point = dict[str, Any]()
    for name, place in by[0]:
        rows = [list(map(into.read, row)) for row in place] if name in algebra.letters else None
        point[name] = Matrix(rows) if rows else into.read(place)
    if nothing := [name for name in sorted(point.keys() & algebra.divisors) if not point[name].numerator.terms]:
        raise Rejected(f"{where} puts 0 in the place of {nothing[0]}, by which something is divided")
    _check_rules(algebra, point, into, by[1], where)
    made = words_at(words, algebra, point, where, into.ring.number)
    if not isinstance(made, Matrix):
        raise Rejected(f"{where} is of no word, and has no size")
    return made.rows


def entry(of: Rows, by: Sequence[int], where: str) -> Entry:
    """An entry that there is."""
    if by[0] >= len(of) or by[1] >= len(of[0]):
        raise Rejected(f"{where} is an entry that the matrix does not have")
    return Entry(of[by[0]][by[1]])


def words_at(
    of: Words, algebra: Algebra, point: Mapping[str, Any], where: str, number: Callable[[Fraction], Any] = Fraction
) -> Any:
    """The value of a sum of words at a point, in matrices of these numbers; or a number."""
    total: Any = None
    for (exponents, word), c in sorted(of.terms.items(), key=lambda term: not term[0][1]):  # numbers last
        powers = [(name, e) for name, e in zip(algebra.parameters, exponents, strict=True) if e]
        if missing := {*word, *(name for name, _ in powers)} - point.keys():
            raise Rejected(f"{where} has a point without a value for {min(missing)}")
        if not all(isinstance(point[letter], Matrix) for letter in word):
            raise Rejected(f"{where} has a number where a matrix must stand")
        if any(isinstance(point[name], Matrix) for name, _ in powers):
            raise Rejected(f"{where} has a matrix where a number must stand")
        algebra.work.spend(100 * len(word))  # about the products of two numbers
        part = reduce(mul, (point[name] ** e for name, e in powers), number(Fraction(c)))
        if word:
            part = reduce(mul, (point[letter] for letter in word)) * part
        total = part if total is None else total + part
    return Fraction(0) if total is None else total


def _check_rules(
    algebra: Algebra, point: Mapping[str, Any], into: Quotients, cofactors: Sequence[Any], where: str
) -> None:
    """Raises Rejected unless the rules and transposes among the letters that have places hold of these."""
    known = point.keys() & algebra.letters

    def beyond(matrix: Matrix, claimed: Words) -> list[Polynomial]:
        less = matrix - words_at(claimed, algebra, point, where, into.ring.number)
        return [x.numerator for row in less.rows for x in row]

    rules, transposes = algebra.about(known, where)
    for letter, transpose in transposes:
        if any(x.terms for x in beyond(point[letter].transposed, transpose)):
            raise Rejected(f"{where} has for the transpose of {letter} another matrix than its transpose")
    if len(rules) != len(cofactors):
        raise Rejected(f"{where} must have cofactors for {len(rules)} rules")
    for (a, b, image), proofs in zip(rules, cofactors, strict=True):
        differences = beyond(point[a] * point[b], image)
        if len(differences) != len(proofs):
            raise Rejected(f"{where} must have cofactors for {len(differences)} entries of the rule for {a} {b}")
        if not all(into.vanishes(x, proof, where) for x, proof in zip(differences, proofs, strict=True)):
            raise Rejected(f"{where} has matrices for which the rule for {a} {b} is not proved")
