"""Sums of words in non-commuting letters, rewritten by rules; and matrices, the values of letters.

A rule gives the product of two letters.  If a sum of words becomes 0 by the rules, it is 0 for all matrices of any size
that satisfy the rules.  Another order of the rules may fail to give 0; this does not matter.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import reduce
from itertools import pairwise
from operator import add, mul
from typing import Any

from .interval import Arithmetic, Rejected
from .polynomial import Work
from .trees import bounded

#: The most letters of a word and terms of a sum, and the greatest exponent of a parameter.
MOST_LETTERS, MOST_WORDS, MOST_EXPONENT = 60, 20_000, 1_000
#: A term: the exponents of the parameters, and the letters.
Term = tuple[tuple[int, ...], tuple[str, ...]]
Number = Fraction | int


class Words(Arithmetic):
    """A sum of terms {(exponents of the parameters, letters): coefficient}, none of them 0."""

    __slots__ = ("terms", "work")

    def __init__(self, terms: Mapping[Term, Number], work: Work):
        self.terms, self.work = {term: bounded(c) for term, c in terms.items() if c}, work
        if len(self.terms) > MOST_WORDS or any(
            len(word) > MOST_LETTERS or any(abs(e) > MOST_EXPONENT for e in exponents) for exponents, word in self.terms
        ):
            raise Rejected("the certificate has a sum of words too large to be checked")

    def __add__(self, other: Words) -> Words:
        self.work.spend(len(self.terms) + len(other.terms))
        terms = dict(self.terms)
        for term, c in other.terms.items():
            terms[term] = terms.get(term, 0) + c
        return Words(terms, self.work)

    def __neg__(self) -> Words:
        return Words({term: -c for term, c in self.terms.items()}, self.work)

    def __mul__(self, other: Words) -> Words:
        self.work.spend(1 + len(self.terms) * len(other.terms) * (1 + len(next(iter(self.terms), ((), ()))[0]) // 8))
        terms: dict[Term, Number] = {}
        for (a, left), c in self.terms.items():
            for (b, right), d in other.terms.items():
                term = (tuple(map(add, a, b)), left + right)
                terms[term] = terms.get(term, 0) + c * d
        return Words(terms, self.work)

    def inverse(self) -> Words:
        """The reciprocal; raises Rejected unless this is one term without letters."""
        if len(self.terms) != 1 or any(word for _, word in self.terms):
            raise Rejected("a statement about words divides by what is no product of parameters")
        [((exponents, word), c)] = self.terms.items()
        return Words({(tuple(-e for e in exponents), word): Fraction(1) / c}, self.work)

    def letters(self) -> set[str]:
        """The letters that occur."""
        return {letter for _, word in self.terms for letter in word}

    def rewritten(self, rules: Mapping[tuple[str, str], Words]) -> Words:
        """The sum, rewritten until no rule applies."""
        settled: dict[Term, Number] = {}
        pending = self.terms
        while pending:
            following: dict[Term, Number] = {}
            for (exponents, word), c in pending.items():
                at = next((i for i, pair in enumerate(pairwise(word)) if pair in rules), None)
                if at is None:
                    settled[exponents, word] = settled.get((exponents, word), 0) + c
                    continue
                image = rules[word[at], word[at + 1]]
                self.work.spend(4 * (1 + len(image.terms)) * (1 + (len(word) + len(exponents)) // 8))
                for (more, middle), d in image.terms.items():
                    term = (tuple(map(add, exponents, more)), word[:at] + middle + word[at + 2 :])
                    following[term] = following.get(term, 0) + c * d
            pending = Words(following, self.work).terms
        return Words(settled, self.work)


class Matrix(Arithmetic):
    """A matrix of numbers, or of quotients; an added number denotes a multiple of the unit matrix."""

    __slots__ = ("rows",)

    def __init__(self, rows: list[list[Any]]):
        self.rows = [[bounded(x) for x in row] for row in rows]

    @property
    def shape(self) -> tuple[int, int]:
        """The numbers of rows and columns."""
        return len(self.rows), len(self.rows[0])

    @property
    def transposed(self) -> Matrix:
        """The transpose."""
        return Matrix([list(column) for column in zip(*self.rows, strict=True)])

    def is_zero(self) -> bool:
        """Whether all entries are 0."""
        return not any(map(any, self.rows))

    def _as_matrix(self, other: Any) -> Matrix:
        """A number as a multiple of the unit matrix of the same size."""
        if isinstance(other, Matrix):
            return other
        n, columns = self.shape
        if n != columns:
            raise Rejected("a number is added to a matrix that is not square")
        return Matrix([[other if i == j else other - other for j in range(n)] for i in range(n)])

    def __neg__(self) -> Matrix:
        return Matrix([[-x for x in row] for row in self.rows])

    def __add__(self, other: Any) -> Matrix:
        if other == 0:
            return self
        other = self._as_matrix(other)
        if self.shape != other.shape:
            raise Rejected("matrices of different sizes are added")
        return Matrix([list(map(add, a, b)) for a, b in zip(self.rows, other.rows, strict=True)])

    def __mul__(self, other: Any) -> Matrix:
        if not isinstance(other, Matrix):
            return Matrix([[x * other for x in row] for row in self.rows])
        if self.shape[1] != other.shape[0]:
            raise Rejected("matrices are multiplied whose sizes do not fit")
        columns = list(zip(*other.rows, strict=True))
        return Matrix([[reduce(add, map(mul, row, column)) for column in columns] for row in self.rows])

    def inverse(self) -> Matrix:
        """Raises Rejected: inverses of matrices are not computed."""
        raise Rejected("a matrix has a negative power")


def same(a: Matrix | Fraction, b: Matrix | Fraction) -> bool:
    """Whether two values are equal; the number 0 equals every matrix of zeros."""
    difference = a + b * Fraction(-1)
    return difference.is_zero() if isinstance(difference, Matrix) else difference == 0


def trace(of: Matrix | Fraction) -> Fraction:
    """The trace of a matrix; the number 0 may denote any matrix of zeros, other numbers raise Rejected."""
    if isinstance(of, Matrix):
        if of.shape[0] != of.shape[1]:
            raise Rejected("the trace of a matrix that is not square is asked for")
        return sum((row[i] for i, row in enumerate(of.rows)), Fraction(0))
    if of:
        raise Rejected("the trace of a number depends on the size of the matrices")
    return of
