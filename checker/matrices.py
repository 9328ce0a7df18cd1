"""Words at matrices of polynomials: what a derivation for every n says in coordinates.

matrix    of a name X of words, by places and cofactors: X with matrices (lists of rows of trees) in the place of its
          letters and trees in that of its parameters, in a quotient ring.  The rules among the letters that have places
          hold of the matrices by the cofactors, entry by entry, and their transposes are the matrices given for these.
entry     of a name of a matrix, by [row, column], counted from 0
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from .algebra import Algebra, all_or_none
from .form import check_shape, names, sized
from .interval import Rejected
from .linear import dot
from .polynomial import Quotient, Ring
from .trees import check_known, check_tree, names_in, value
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

    def vanishes(self, of: Quotient, cofactors: Sequence[Any], where: str) -> bool:
        """Whether the numerator of `of` is Σ cofactor · relation."""
        made = self.ring.number(Fraction(0))
        for cofactor, relation in zip(cofactors, self.relations, strict=True):
            made = made + self.read(cofactor) * relation
        if made.factors:
            raise Rejected(f"{where} has a relation or a cofactor that is no polynomial")
        return of.numerator.times(made.scale).terms == made.numerator.terms


def quotients(data: Mapping[str, Any], ring: Ring) -> Quotients:
    """The quotient ring of an algebra."""
    names = ring.names()
    return Quotients(ring, names, [value(tree, names, ring.number) for tree in data["relations"]])


class Placed(NamedTuple):
    """A matrix of quotients: words at the places of their letters and parameters, which are trees."""

    words: Words
    algebra: Algebra
    places: Mapping[str, Any]
    rows: Rows


class Entry(NamedTuple):
    """An entry of such a matrix."""

    of: Placed
    row: int
    column: int

    @property
    def value(self) -> Quotient:
        """As a quotient."""
        return self.of.rows[self.row][self.column]

    def at(self, point: Mapping[str, Fraction | Matrix], where: str) -> Fraction:
        """At a point: the trees are evaluated there, and then the words."""

        def number(tree: Any) -> Any:
            if missing := names_in(tree) - point.keys():
                raise Rejected(f"{where} has a point without a value for {min(missing)}")
            return value(tree, point, Fraction)

        def entries(rows: Any) -> Matrix:
            return Matrix([list(map(number, row)) for row in rows])

        letters = self.of.algebra.letters
        places = {name: (entries if name in letters else number)(place) for name, place in self.of.places.items()}
        found = words_at(self.of.words, self.of.algebra, places, where)
        return found.rows[self.row][self.column] if isinstance(found, Matrix) else found


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


def placed(words: Words, algebra: Algebra, into: Quotients, by: Sequence[Any], where: str) -> Placed:
    """Words at their places, which are proved to obey the rules."""
    places = dict(by[0])
    matrices = {name: [list(map(into.read, row)) for row in place] for name, place in by[0] if name in algebra.letters}
    numbers = {name: into.read(place) for name, place in by[0] if name not in algebra.letters}
    if nothing := sorted(name for name in numbers.keys() & algebra.divisors if not numbers[name].numerator.terms):
        raise Rejected(f"{where} puts 0 in the place of {nothing[0]}, by which something is divided")
    at = Places(into.ring, matrices, numbers)
    _check_rules(algebra, at, into, by[1], where)
    first = next(iter(words.terms), None)
    if first is None or not first[1]:
        raise Rejected(f"{where} is of no word, and has no size")
    rows, columns = (_known(matrices, first[1][i], where) for i in (0, -1))
    return Placed(words, algebra, places, at.rows(words, algebra, (len(rows), len(columns[0])), where))


def entry(of: Placed, by: Sequence[int], where: str) -> Entry:
    """An entry that there is."""
    if by[0] >= len(of.rows) or by[1] >= len(of.rows[0]):
        raise Rejected(f"{where} is an entry that the matrix does not have")
    return Entry(of, by[0], by[1])


def words_at(of: Words, algebra: Algebra, point: Mapping[str, Fraction | Matrix], where: str) -> Fraction | Matrix:
    """The value of a sum of words at a point."""
    total: Fraction | Matrix = Fraction(0)
    for (exponents, word), c in of.terms.items():
        powers = [(name, e) for name, e in zip(algebra.parameters, exponents, strict=True) if e]
        if missing := {*word, *(name for name, _ in powers)} - point.keys():
            raise Rejected(f"{where} has a point without a value for {min(missing)}")
        if not all(isinstance(point[letter], Matrix) for letter in word):
            raise Rejected(f"{where} has a number where a matrix must stand")
        if not all(isinstance(point[name], Fraction) for name, _ in powers):
            raise Rejected(f"{where} has a matrix where a number must stand")
        algebra.work.spend(100 * len(word))  # about the products of two numbers
        part: Any = c
        for name, e in powers:
            part = part * point[name] ** e
        for letter in word:
            part = part * point[letter]
        total = total + part
    return total


class Places(NamedTuple):
    """What stands for letters and parameters."""

    ring: Ring
    matrices: Mapping[str, Rows]
    numbers: Mapping[str, Quotient]

    def rows(self, of: Words, algebra: Algebra, size: tuple[int, int], where: str) -> Rows:
        """A sum of words of this algebra, as a matrix of that size."""
        total = [[self.ring.number(Fraction(0))] * size[1] for _ in range(size[0])]
        for (exponents, word), c in of.terms.items():
            scalar = self.ring.number(c)
            for name, e in zip(algebra.parameters, exponents, strict=True):
                if e:
                    scalar = scalar * _known(self.numbers, name, where) ** e
            part = self.unit(size[0])
            for letter in word:
                part = _product(part, _known(self.matrices, letter, where), where)
            if (len(part), len(part[0])) != size:
                raise Rejected(f"{where} adds matrices of different sizes")
            total = [[x + y * scalar for x, y in zip(*rows, strict=True)] for rows in zip(total, part, strict=True)]
        return total

    def unit(self, n: int) -> Rows:
        """The unit matrix."""
        return [[self.ring.number(Fraction(int(i == j))) for j in range(n)] for i in range(n)]


def _check_rules(algebra: Algebra, at: Places, into: Quotients, cofactors: Sequence[Any], where: str) -> None:
    """Raises Rejected unless the rules and transposes among the letters that have places hold of these."""
    known = at.matrices.keys()
    for letter, transpose in algebra.transposes.items():
        if all_or_none({letter, *transpose.letters()}, known, where):
            rows = [list(column) for column in zip(*at.matrices[letter], strict=True)]
            made = at.rows(transpose, algebra, (len(rows), len(rows[0])), where)
            if any((x - y).numerator.terms for x, y in _entries(made, rows)):
                raise Rejected(f"{where} has for the transpose of {letter} another matrix than its transpose")
    rules = [
        (a, b, image) for (a, b), image in algebra.rules.items() if all_or_none({a, b, *image.letters()}, known, where)
    ]
    if len(rules) != len(cofactors):
        raise Rejected(f"{where} must have cofactors for {len(rules)} rules")
    for (a, b, image), proofs in zip(rules, cofactors, strict=True):
        product = _product(at.matrices[a], at.matrices[b], where)
        claimed = at.rows(image, algebra, (len(product), len(product[0])), where)
        pairs = _entries(product, claimed)
        if len(pairs) != len(proofs):
            raise Rejected(f"{where} must have cofactors for {len(pairs)} entries of the rule for {a} {b}")
        for (x, y), proof in zip(pairs, proofs, strict=True):
            if not into.vanishes(x - y, proof, where):
                raise Rejected(f"{where} has matrices for which the rule for {a} {b} is not proved")


def _known(among: Mapping[str, Any], name: str, where: str) -> Any:
    if name not in among:
        raise Rejected(f"{where} says nothing of {name}")
    return among[name]


def _product(a: Rows, b: Rows, where: str) -> Rows:
    if len(a[0]) != len(b):
        raise Rejected(f"{where} multiplies matrices whose sizes do not fit")
    return [[dot(row, column) for column in zip(*b, strict=True)] for row in a]


def _entries(a: Rows, b: Rows) -> list[tuple[Quotient, Quotient]]:
    """The entries of two matrices of one size, side by side."""
    return [pair for rows in zip(a, b, strict=True) for pair in zip(*rows, strict=True)]
