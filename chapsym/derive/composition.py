"""The order conditions of compositions of a self-adjoint step, in a free algebra (lemma `composition-order`).

A self-adjoint step of order 2 is Φ_ε = exp(εX₁ + ε³X₃ + ε⁵X₅ + ...) with operators Xᵢ that depend on the equation,
and the flow is exp(εX₁).  So Φ_{c₁ε} ... Φ_{cₛε} has order p for every equation exactly when the two series agree, word
by word in free letters X₁, X₃, X₅, ..., up to weight p (the weight of a letter is its index).  Trees and brackets are
not needed: there are 54 words up to weight 8.

For palindromic coefficients the order of the stages does not matter.
"""

from collections.abc import Iterator, Sequence
from functools import reduce
from math import factorial
from typing import Any

Word = tuple[int, ...]
Series = dict[Word, Any]


def words(weight: int) -> Iterator[Word]:
    """Every word in the letters 1, 3, 5, ... with this weight."""
    if weight == 0:
        yield ()
    for letter in range(1, weight + 1, 2):
        for rest in words(weight - letter):
            yield (letter, *rest)


def lyndon(order: int) -> list[Word]:
    """The Lyndon words of odd weight below `order`: those smaller than all their proper suffixes."""
    odd = (word for weight in range(1, order, 2) for word in words(weight))
    return [word for word in odd if all(word < word[i:] for i in range(1, len(word)))]


def brackets(weight: int) -> list[dict[Word, int]]:
    """[a,[b,[..., z]]] for each word ab...z of a weight: they span the Lie elements of that weight."""

    def bracket(word: Word) -> dict[Word, int]:
        found = {word[-1:]: 1}
        for letter in reversed(word[:-1]):
            turned: dict[Word, int] = {}
            for inner, factor in found.items():
                for longer, sign in (((letter, *inner), 1), ((*inner, letter), -1)):
                    turned[longer] = turned.get(longer, 0) + sign * factor
            found = turned
        return found

    return [bracket(word) for word in words(weight)]


def step_series(c: Any, order: int) -> Series:
    """exp(cX₁ + c³X₃ + ...): the word w of k letters has the coefficient c^|w|/k!."""
    through = (word for weight in range(order + 1) for word in words(weight))
    return {word: c ** sum(word) / factorial(len(word)) for word in through}


def product(left: Series, right: Series) -> Series:
    """The product of two series in noncommuting letters, for the words of `left`."""
    return {word: sum(left[word[:i]] * right[word[i:]] for i in range(len(word) + 1)) for word in left}


def defects(coefficients: Sequence[Any], order: int) -> Series:
    """The coefficients of the composition minus those of the flow, for each word of weight 1 to `order`.

    coefficients: c₁, ..., cₛ in any type of numbers with division: Fraction (for an exact result), mpf or arb.
    """
    composed = reduce(product, (step_series(c, order) for c in coefficients))
    flow = {word: coefficients[0] ** 0 / factorial(len(word)) * int(sum(word) == len(word)) for word in composed}
    return {word: composed[word] - flow[word] for word in composed if word}
