"""Euler parameters as words: a quaternion acts from the left, its conjugate from the right, by 4 × 4 matrices.

The rotation of q is x ↦ q x q̄.  If q' = ½ q ω, it has the angular velocity ω in the body.  So q(ε) with q(0) = 1 has
the rotation exp(ε ω), and the same expansion as the words.
"""

from functools import cache

import sympy as sp

from . import three
from .derivation import coordinates, entry, rate, replaced, written
from .limits import Remainder, Turning, coefficients, omega, remainder
from .quotient import Quotient
from .words import WordAlgebra, matrix_symbols, unfolded

#: The maps x ↦ qx, x ↦ xq̄, x ↦ ωx and x ↦ xω.
Q, Q_bar, W, W_bar = matrix_symbols("Q Q_bar W W_bar")
#: Multiplications from the left commute with multiplications from the right.
ALGEBRA = WordAlgebra({}, {(W, Q_bar): Q_bar * W, (W, W_bar): W_bar * W})
TURN = Turning(
    {Q: sp.S.One, Q_bar: sp.S.One}, {Q: Q * W / 2, Q_bar: -Q_bar * W_bar / 2, W: sp.S.Zero, W_bar: sp.S.Zero}
)

#: A second quaternion q_a = exp(½ε²a), with q_a' = ε q_a a.
Q_a, A, eps = matrix_symbols("Q_a A eps")
FREE = WordAlgebra({})
BOTH_TURN = Turning(
    {Q: sp.S.One, Q_a: sp.S.One, eps: sp.S.Zero},
    {Q: Q * W / 2, Q_a: Q_a * eps * A, W: sp.S.Zero, A: sp.S.Zero, eps: sp.S.One},
)

other = sp.Matrix(sp.symbols("a1:4"))
RING = Quotient((three.q0, *three.q, *omega, *other, sp.Symbol("epsilon")))


def left(scalar: sp.Expr, vector: sp.Matrix) -> sp.Matrix:
    """The matrix of x ↦ (scalar, vector) x."""
    return sp.Matrix.hstack(*(three.quaternion_product(sp.Matrix([scalar, *vector]), e) for e in _basis()))


def right(scalar: sp.Expr, vector: sp.Matrix) -> sp.Matrix:
    """The matrix of x ↦ x (scalar, vector)."""
    return sp.Matrix.hstack(*(three.quaternion_product(e, sp.Matrix([scalar, *vector])) for e in _basis()))


def _basis() -> list[sp.Matrix]:
    return sp.eye(4).columnspace()


@cache
def turned() -> tuple[sp.Symbol, sp.Symbol, sp.Symbol, sp.Symbol]:
    """Letters for x ↦ q x q̄, its value at ε = 0, its derivative by ε, and ½(ωx - xω)."""
    whole = written("conjugation", "x ↦ q x q̄", Q * Q_bar, ALGEBRA)
    spin = written("spin", "x ↦ ½(ωx - xω)", (W - W_bar) / 2, ALGEBRA)
    at = replaced("conjugation_at", "at ε = 0", whole, TURN.start, ALGEBRA)
    return whole, at, rate("conjugation_rate", "its derivative by ε: q' = ½ q ω, q̄' = -½ ω q̄", whole, TURN.rates), spin


def on_vectors(of: sp.Symbol) -> list[list[sp.Symbol]]:
    """Letters for the columns of a map from vectors to quaternions; a column is a scalar and a vector."""
    q0, q = three.q0, three.q
    values = {Q: left(q0, q), Q_bar: right(q0, -q), W: left(sp.S.Zero, omega), W_bar: right(sp.S.Zero, omega)}
    matrix = coordinates(f"{of}_matrix", "by the matrices of the products", of, values, RING)
    return [[entry(f"{of}_{i}{j}", "an entry", matrix, i, j) for i in range(4)] for j in (1, 2, 3)]


@cache
def expansion() -> tuple[sp.Symbol, list[sp.Matrix]]:
    """A letter for q at ε = 0, and the (scalar, vector) coefficients of ε, ε², ... in q for exp(ε ω)."""
    start, *rest = coefficients(written("quaternion", "x ↦ q x, q' = ½ q ω", Q, ALGEBRA), TURN)
    values = {Q: sp.eye(4), Q_bar: sp.eye(4), W: left(sp.S.Zero, omega), W_bar: right(sp.S.Zero, omega)}
    return start, [_column(letter, values) for letter in rest]


def remainders() -> tuple[Remainder, Remainder]:
    """The remainders of q/ε and of q₀."""
    _, columns = expansion()
    zero = sp.zeros(3, 1)
    vectors, scalars = [zero, *(c[1:, :] for c in columns)], [zero, sp.ones(1, 1), *(c[:1, :] for c in columns)]

    def vanishes(of: sp.Matrix) -> bool:
        return bool(of.applyfunc(unfolded).is_zero_matrix)

    return remainder(vectors, vanishes), remainder(scalars, vanishes)


@cache
def other_expansion() -> list[sp.Matrix]:
    """The (scalar, vector) coefficients of ε, ε², ... in the quaternion of exp(ε ω) exp(ε² a)."""
    both = written("both", "x ↦ q q_a x, q_a = exp(½ε²a)", Q * Q_a, FREE)
    values = {W: left(sp.S.Zero, omega), A: left(sp.S.Zero, other)}
    return [_column(letter, values) for letter in coefficients(both, BOTH_TURN)[1:3]]


def _column(of: sp.Symbol, values: dict[sp.Symbol, sp.Matrix]) -> sp.Matrix:
    """Letters for the image of the quaternion 1."""
    matrix = coordinates(f"{of}_matrix", "by the matrices of the products", of, values, RING)
    return sp.Matrix([entry(f"{of}_{i}", "by its first column", matrix, i, 0) for i in range(4)])
