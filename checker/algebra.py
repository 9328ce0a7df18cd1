"""Algebras of words: letters with rules and transposes, scalar parameters, and operations on sums of words.

Each operation is valid for all matrices that satisfy the rules and the transposes of the algebra.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import reduce
from operator import mul

from .document import Data
from .interval import Rejected
from .polynomial import Work
from .trees import Tree, divisors, names_in, plain, value
from .words import Number, Term, Words


class Algebra:
    """An algebra: letters for matrices, parameters for numbers, rules for products of two letters, and transposes."""

    def __init__(self, data: Data, work: Work):
        self.data, self.work, self.letters, self.parameters = data, work, set(data["letters"]), data["parameters"]
        self.none = (0,) * len(self.parameters)
        self.divisors: set[str] = set()  # parameters that were divided by, even if they have cancelled
        self.respected: list[Algebra] = []  # algebras whose rules for shared names hold here
        self.names = {letter: self.word(letter) for letter in data["letters"]}
        for i, name in enumerate(self.parameters):
            self.names[name] = self.scalar(tuple(int(i == j) for j in range(len(self.parameters))))
        self.transposes = {letter: self.read(image, self.names) for letter, image in data["transposes"]}
        self.rules = {(a, b): self.read(image, self.names) for a, b, image in data["rules"]}

    def word(self, *letters: str) -> Words:
        """The word of these letters."""
        return Words({(self.none, letters): 1}, self.work)

    def scalar(self, exponents: tuple[int, ...], c: Number = 1) -> Words:
        """A number times powers of the parameters."""
        return Words({(exponents, ()): c}, self.work)

    def read(self, tree: Tree, names: Mapping[str, Words]) -> Words:
        """The sum of words of a tree."""
        self.divisors |= self.among(names[name] for name in divisors(tree) & names.keys())
        found: Words = value(tree, names, lambda x: self.scalar(self.none, plain(x)))
        return found

    def is_value(self, tree: Tree, words: Words) -> bool:
        """Whether a tree in the names of the algebra equals a sum of words, modulo the rules."""
        return not self.total([words - self.read(tree, self.names)]).terms

    def among(self, words: Iterable[Words]) -> set[str]:
        """The parameters that occur in some words."""
        found = (zip(self.parameters, exponents, strict=True) for one in words for exponents, _ in one.terms)
        return {name for pairs in found for name, e in pairs if e}

    def total(self, parts: Iterable[Words]) -> Words:
        """The sum of the parts, rewritten by the rules."""
        terms: dict[Term, Number] = {}
        for part in parts:
            for term, c in part.terms.items():
                terms[term] = terms.get(term, 0) + c
            self.work.spend(len(terms))
        return Words(terms, self.work).rewritten(self.rules)

    def transposed(self, of: Words) -> Words:
        """The transpose: each word reversed, with the transposes of its letters."""
        return self.total(
            reduce(mul, map(self.transpose, word[::-1]), self.scalar(exponents, c))
            for (exponents, word), c in of.terms.items()
        )

    def transpose(self, letter: str) -> Words:
        """The transpose of a letter."""
        if letter not in self.transposes:
            raise Rejected(f"the transpose of {letter} is needed, and is not given")
        return self.transposes[letter]

    def rate(self, of: Words, rates: Mapping[str, Words]) -> Words:
        """The derivative by Leibniz' rule, from the rates of the letters."""
        parts = []
        for (exponents, word), c in of.terms.items():
            for i, letter in enumerate(word):
                if letter not in rates:
                    raise Rejected(f"the rate of {letter} is needed, and is not given")
                before, after = self.word(*word[:i]), self.word(*word[i + 1 :])
                parts.append(self.scalar(exponents, c) * before * rates[letter] * after)
        return self.total(parts)

    def around(self, of: Words, letter: str) -> Words:
        """Z with tr of = tr(letter · Z); each word must contain the letter exactly once."""
        parts = []
        for (exponents, word), c in of.terms.items():
            if word.count(letter) != 1:
                raise Rejected(f"what is taken out of a trace is not linear in {letter}")
            at = word.index(letter)
            parts.append(self.scalar(exponents, c) * self.word(*word[at + 1 :], *word[:at]))
        return self.total(parts)

    def gradient(self, of: Words, letter: str) -> Words:
        """G with tr of = tr(Gᵀ · letter) + (terms without the letter and its transpose, which must be a letter)."""
        transposes = [word for _, word in self.transpose(letter).terms]
        if len(transposes) != 1 or len(transposes[0]) != 1:
            raise Rejected(f"a gradient is by {letter}, whose transpose is no letter")
        plain, turned = having(of, [letter]), having(of, transposes[0])
        if {*plain.terms} & {*turned.terms}:
            raise Rejected(f"what is taken out of a trace is not linear in {letter}")
        return self.transposed(self.around(self.total([plain, self.transposed(turned)]), letter))

    def dual(self, of: Words, letter: str) -> Words:
        """S = -Sᵀ with tr of = ½ tr(letter · S), for a skew letter."""
        if self.total([self.transpose(letter), self.word(letter)]).terms:
            raise Rejected(f"a dual is by {letter}, whose transpose is not -{letter}")
        found = self.around(of, letter)
        return self.total([found - self.transposed(found)])

    def traced(self, of: Words) -> Words:
        """A sum of words with the same trace, in which cyclic rotations and transposes of one word are merged."""
        settled: list[Words] = []
        pending = of.rewritten(self.rules)
        while pending.terms:
            following = []
            for (exponents, word), c in pending.terms.items():
                if not word:
                    raise Rejected("the trace of a number depends on the size of the matrices")
                if len(word) > 1 and (word[-1], word[0]) in self.rules:
                    following.append(self.scalar(exponents, c) * self.word(word[-1], *word[:-1]))
                else:
                    settled.append(self.scalar(exponents, c) * self._least(word))
            pending = self.total(following)
        return self.total(settled)

    def _least(self, word: tuple[str, ...]) -> Words:
        """A word of equal trace: the least rotation of the word or its transpose; 0 if it is its own negative."""
        self.work.spend(len(word) * len(word))
        signed: list[tuple[tuple[str, ...], Number]] = [(rotation, 1) for rotation in rotations(word)]
        if self.transposes.keys() >= set(word):
            turned = self.transposed(self.word(*word)).terms
            if len(turned) == 1:
                [((exponents, other), sign)] = turned.items()
                if exponents == self.none and abs(sign) == 1:
                    signed += [(rotation, sign) for rotation in rotations(other)]
        least = min(rotation for rotation, _ in signed)
        signs = {sign for rotation, sign in signed if rotation == least}
        return self.scalar(self.none, sum(signs)) * self.word(*least)


def about(data: Data, names: Iterable[str], where: str) -> tuple[list[tuple[str, str, Tree]], list[tuple[str, Tree]]]:
    """The rules and transposes among the named letters; raises Rejected if one of them involves other letters, too."""
    named = {*data["letters"]}.intersection(names)

    def is_about(*trees: Tree) -> bool:
        others = (names_in([0, *trees]) & {*data["letters"]}) - named
        known = names_in([0, *trees]) & named
        if known and others:
            raise Rejected(f"{where} says something of {min(known)} and nothing of {min(others)}")
        return bool(known)

    return [rule for rule in data["rules"] if is_about(*rule)], [pair for pair in data["transposes"] if is_about(*pair)]


def rotations(word: tuple[str, ...]) -> list[tuple[str, ...]]:
    """All cyclic rotations of a word."""
    return [word[i:] + word[:i] for i in range(len(word))]


def having(of: Words, letters: Collection[str], without: bool = False) -> Words:
    """The terms with one of these letters; with `without`, the terms with none of them."""
    chosen = {term: c for term, c in of.terms.items() if (not set(term[1]).isdisjoint(letters)) is not without}
    return Words(chosen, of.work)
