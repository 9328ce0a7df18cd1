"""Identities for every n: words in noncommuting matrix symbols, with rewriting rules.

A matrix identity for all sizes n is proved as follows: the difference of its sides is a sum of words in noncommuting
symbols; products such as R Rᵀ are replaced by their normal forms; all coefficients vanish.  Nothing is assumed about n
or the entries of the matrices.  Columns and rows (γ, γᵀ) are ordinary symbols.

The rules must be confluent: otherwise the normal form would depend on the order of rewriting, and a non-zero normal
form would prove nothing.  The constructor checks all critical pairs.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

import sympy as sp

from .quotient import in_sympy

Word = tuple[sp.Symbol, ...]


#: The expressions of the letters that derivation.py has defined.
DEFINED: dict[sp.Symbol, sp.Expr] = {}


#: The most steps of one rewriting; the longest of chapsym takes some thousands.
MOST_STEPS = 200_000


def matrix_symbols(names: str) -> tuple[sp.Symbol, ...]:
    """Noncommuting symbols, one for each name."""
    return sp.symbols(names, commutative=False, seq=True)


def unfolded(expr: sp.Expr) -> sp.Expr:
    """The expression with each defined letter replaced by its definition."""
    return expr.xreplace(DEFINED) if expr.free_symbols & DEFINED.keys() else expr


class WordAlgebra:
    """Sums of words over Q(commuting parameters), modulo rewriting rules on adjacent pairs.

    `transposes` maps symbols to their transposes: `{J: J, xi: -xi, R: RT}`; the transpose of RT is then R.
    `rules` maps an adjacent pair to the expression that replaces it: `{(R, RT): 1}`.

    `example` maps letters to matrices, and parameters to numbers, that satisfy the rules: their existence is part of a
    proof.  By default an example is searched for, or taken from the examples of a register (prove/witness.py).

    Raises ValueError if the rules are not confluent or do not terminate, if the transpose is not an involution, or if
    the example is not rational or violates a rule or a transpose.
    """

    def __init__(
        self,
        transposes: Mapping[sp.Symbol, sp.Expr],
        rules: Mapping[tuple[sp.Symbol, sp.Symbol], sp.Expr | int] | None = None,
        example: Mapping[sp.Symbol, Any] | None = None,
    ) -> None:
        self.transposes: dict[sp.Symbol, sp.Expr] = {}
        for symbol, image in transposes.items():
            self.transposes[symbol] = image
            if image.is_Symbol:
                self.transposes.setdefault(image, symbol)
        self.example = {x: _rational(x, value) for x, value in (example or {}).items()}
        self.rules = {pair: in_sympy(value) for pair, value in (rules or {}).items()}
        for symbol in self.transposes:
            if self.transpose(self.transpose(symbol)) != symbol:
                raise ValueError(f"transposing {symbol} twice does not give {symbol} back")
        for (a, b), left in self.rules.items():
            for (c, d), right in self.rules.items():
                if b == c and self.normal(left * d) != self.normal(a * right):
                    raise ValueError(f"the rewriting rules are not confluent: {a}{b}{d} has two normal forms")
        for a, b in self.rules:
            self.normal(a * b)
        self._check_example()

    def _check_example(self) -> None:
        """Raises ValueError unless the example satisfies the rules and transposes of which it has all letters."""
        given = self.example
        said = [(a * b, image, f"the rule for {a} {b}") for (a, b), image in self.rules.items()]
        for left, image, what in said:
            if (left.free_symbols | image.free_symbols) <= given.keys():
                product = evaluate(left, given)
                claimed = evaluate(image, given) if image.free_symbols else image * sp.eye(product.rows)
                if not product.is_zero_matrix if image == 0 else product != claimed:
                    raise ValueError(f"the example breaks {what}")
        for x, image in self.transposes.items():
            if {x, *image.free_symbols} <= given.keys() and evaluate(image, given) != given[x].T:
                raise ValueError(f"the example breaks the transpose of {x}")

    def normal(self, expr: sp.Expr | int) -> sp.Expr:
        """The normal form: expanded, with rules applied until none matches."""
        total: dict[Word, sp.Expr] = {}
        pending, steps = list(_terms(expr)), 0
        while pending:
            steps += 1
            if steps > MOST_STEPS:
                raise ValueError(f"the rewriting rules do not end within {MOST_STEPS} steps")
            coefficient, word = pending.pop()
            match = next((i for i in range(len(word) - 1) if word[i : i + 2] in self.rules), None)
            if match is None:
                total[word] = total.get(word, sp.S.Zero) + coefficient
                continue
            left, pair, right = word[:match], word[match : match + 2], word[match + 2 :]
            for c, middle in _terms(self.rules[pair]):
                pending.append((coefficient * c, left + middle + right))
        return sp.Add(*(sp.expand(c) * sp.Mul(*word) for word, c in total.items()))

    def is_zero(self, expr: sp.Expr | int) -> bool:
        """True exactly when the normal form is 0: then the identity holds for every n."""
        return bool(self.normal(expr) == 0)

    def transpose(self, expr: sp.Expr | int) -> sp.Expr:
        """The transpose: each word reversed, with its letters transposed."""
        return sp.Add(
            *(c * sp.Mul(*(self.transposes[letter] for letter in reversed(word))) for c, word in _terms(expr))
        )

    def with_transposes(self, places: Mapping[sp.Symbol, Any]) -> dict[sp.Symbol, Any]:
        """Substitutes for letters (words or matrices), each followed by the substitute for the letter's transpose."""
        whole: dict[sp.Symbol, Any] = {}
        for letter, image in places.items():
            whole[letter] = image
            other = self.transposes.get(letter, letter)
            if other == letter or not other.is_Symbol:
                continue
            if isinstance(image, sp.MatrixBase):
                whole[other] = image.T
            else:
                number, word = image.as_coeff_Mul()  # the number stays in front, as in certificates
                whole[other] = number * self.transpose(word)
        return whole

    def rate(self, expr: sp.Expr, rates: Mapping[sp.Symbol, sp.Expr]) -> sp.Expr:
        """The derivative of a sum of words by Leibniz' rule, from the rates of the letters."""
        total = sp.S.Zero
        for c, word in _terms(self.normal(expr)):
            for i, letter in enumerate(word):
                total += c * sp.Mul(*word[:i]) * rates[letter] * sp.Mul(*word[i + 1 :])
        return self.normal(total)

    def wedge(self, a: sp.Expr, b: sp.Expr) -> sp.Expr:
        """a ∧ b = a bᵀ - b aᵀ for two columns."""
        return a * self.transpose(b) - b * self.transpose(a)

    def trace(self, expr: sp.Expr | int) -> sp.Expr:
        """A normal form for traces: words up to cyclic order and transposition.

        The trace of each word is represented by the least of its rotations and of those of its
        transpose, so that tr X = tr Xᵀ and tr XY = tr YX become equality of expressions.
        """
        total = sp.S.Zero
        for c, word in _terms(self.normal(expr)):
            candidates = [(1, w) for w in _rotations(self._cyclically_reduced(word))]
            [(sign, flipped)] = _terms(self.normal(self.transpose(sp.Mul(*candidates[0][1]))))
            candidates += [(sign, w) for w in _rotations(flipped)]
            least = min(w for _, w in ((s, _key(w)) for s, w in candidates))
            signs = {s for s, w in candidates if _key(w) == least}
            if len(signs) == 1:  # with both signs the trace equals its own negative: it is 0
                word = next(w for _, w in candidates if _key(w) == least)
                total += c * signs.pop() * sp.Mul(*word)
        return sp.expand(total)

    def _cyclically_reduced(self, word: Word) -> Word:
        """A word without pairs across the ends of the trace that a rule replaces by 1."""
        while len(word) >= 2 and self.rules.get((word[-1], word[0])) == 1:
            word = word[1:-1]
        return word

    def gradient(self, expr: sp.Expr, letter: sp.Symbol) -> sp.Expr:
        """G with tr expr = tr(Gᵀ · letter) + (terms without it)."""
        total = sp.S.Zero
        for c, word in _terms(expr):
            if self.transposes[letter] in word:
                [(sign, word)] = _terms(self.transpose(sp.Mul(*word)))
                c *= sign
            if letter in word:
                at = word.index(letter)
                total += c * self.transpose(sp.Mul(*word[at + 1 :], *word[:at]))
        return self.normal(total)

    def dual_of_skew(self, expr: sp.Expr, xi: sp.Symbol) -> sp.Expr:
        """The skew matrix S with expr = ½ tr(ξ S), for a trace expression linear in the skew ξ.

        expr vanishes for *every* skew ξ exactly when S does.
        """
        total = sp.S.Zero
        for c, word in _terms(self.normal(expr)):
            if len(places := [i for i, letter in enumerate(word) if letter == xi]) != 1:
                raise ValueError(f"the expression is not linear in {xi}")
            total += c * sp.Mul(*(word[places[0] + 1 :] + word[: places[0]]))
        return self.normal(total - self.transpose(total))


def _rational(letter: sp.Symbol, value: Any) -> Any:
    """A matrix of rational numbers, or a rational number, of an example."""
    if isinstance(value, sp.MatrixBase) and all(x.is_Rational for x in value):
        return value
    if isinstance(value, int | Fraction | sp.Rational):
        return sp.Rational(value)
    raise ValueError(f"the example of {letter} must be a sp.Matrix of rational numbers, or one such number")


@dataclass(frozen=True)
class Traces:
    """Traces of sums of words of an algebra."""

    algebra: WordAlgebra

    def is_zero(self, expr: sp.Expr | int) -> bool:
        """True exactly when tr expr has the normal form 0; raises ValueError for the trace of a number."""
        traced = self.algebra.trace(expr)
        if any(not word for _, word in _terms(traced)):
            raise ValueError("the trace of a number depends on the size of the matrices")
        return bool(traced == 0)


def _terms(expr: sp.Expr | int) -> Sequence[tuple[sp.Expr, Word]]:
    """The (coefficient, word) pairs of an expression."""
    return _pairs(unfolded(in_sympy(expr)))


@lru_cache(10_000)
def _pairs(expr: sp.Expr) -> list[tuple[sp.Expr, Word]]:
    found = []
    for term in sp.Add.make_args(sp.expand(expr)):
        commuting, letters = term.args_cnc()
        word: list[sp.Symbol] = []
        for letter in letters:
            base, power = letter.as_base_exp()
            if not (base.is_Symbol and power.is_Integer and power > 0):
                raise ValueError(f"not a word: {term}")
            word += [base] * int(power)
        if (coefficient := sp.Mul(*commuting)) != 0:
            found.append((coefficient, tuple(word)))
    return found


def _rotations(word: Word) -> list[Word]:
    return [word[i:] + word[:i] for i in range(max(len(word), 1))]


def _key(word: Word) -> tuple[str, ...]:
    return tuple(letter.name for letter in word)


def evaluate(expr: sp.Expr | int, values: Mapping[sp.Symbol, sp.Matrix | sp.Expr]) -> Any:
    """A sum of words at explicit matrices (columns and rows included) and values of the parameters.

    The empty word is the n × n identity (columns and rows have n entries); a sum without words is the number 0.
    """
    matrices = {symbol: value for symbol, value in values.items() if isinstance(value, sp.MatrixBase)}
    scalars = {symbol: value for symbol, value in values.items() if symbol not in matrices}
    parts = []
    for commuting, word in _terms(expr):
        coefficient = commuting.xreplace(scalars)
        product = matrices[word[0]] if word else sp.eye(max(matrix.rows for matrix in matrices.values()))
        for letter in word[1:]:
            product = product * matrices[letter]
        parts.append(product if coefficient == 1 else coefficient * product)
    return sum(parts[1:], parts[0]) if parts else sp.S.Zero
