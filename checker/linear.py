"""Vectors and matrices of intervals, linear equations, and Newton's test."""

from collections.abc import Callable, Sequence
from functools import reduce
from operator import add
from typing import Any

from .interval import Interval, Rejected

Vector = Sequence[Interval]
Matrix = Sequence[Vector]
#: The most Newton iterations; and log₂ of the assumed size of the second derivative.
MOST_ITERATIONS, CURVED = 20, 4
NO_ROOT = "Newton's test proves no root near the numbers of the file"


def dot(v: Sequence[Any], w: Sequence[Any]) -> Any:
    """⟨v, w⟩."""
    return reduce(add, (x * y for x, y in zip(v, w, strict=True)))


def cross(v: Vector, w: Vector) -> Vector:
    """v × w in three dimensions."""
    return [v[i - 2] * w[i - 1] - v[i - 1] * w[i - 2] for i in range(3)]


def plus(v: Vector, w: Vector) -> Vector:
    """v + w."""
    return [x + y for x, y in zip(v, w, strict=True)]


def minus(v: Vector, w: Vector) -> Vector:
    """v - w."""
    return [x - y for x, y in zip(v, w, strict=True)]


def times(s: Interval | int, v: Vector) -> Vector:
    """s·v."""
    return [s * x for x in v]


def units(n: int, like: Interval) -> Matrix:
    """The unit vectors of Rⁿ, with the scale of `like`."""
    return [[like._of(int(i == j)) for j in range(n)] for i in range(n)]


def transposed(matrix: Matrix) -> Matrix:
    """The columns of a matrix, as rows."""
    return [list(column) for column in zip(*matrix, strict=True)]


def image(matrix: Matrix, v: Vector) -> Vector:
    """The product of a matrix and a vector."""
    return [dot(row, v) for row in matrix]


def determinant(matrix: Matrix) -> Interval:
    """The determinant of a 3 × 3 matrix: ⟨first row, second × third⟩."""
    return dot(matrix[0], cross(matrix[1], matrix[2]))


def solve(matrix: Matrix, right: Matrix) -> Matrix:
    """X (n × m) with A X = B by elimination, for every A in `matrix` (n × n) and B in `right` (n × m).

    For each A and B the steps are those of the real elimination, and no pivot is 0 (else this raises Rejected): so
    every A in `matrix` is regular, and the result contains all solutions.
    """
    rows = [[*a, *b] for a, b in zip(matrix, right, strict=True)]
    for i in range(len(rows)):
        best = max(range(i, len(rows)), key=lambda j: rows[j][i].least)
        rows[i], rows[best] = rows[best], rows[i]
        if not rows[i][i].sign:
            raise Rejected(
                "there is no root near the numbers of the file, or it may be multiple: a matrix may be singular"
            )
        pivot = [x / rows[i][i] for x in rows[i][i + 1 :]]
        rows = [[*row[: i + 1], *minus(row[i + 1 :], times(row[i], pivot))] for row in rows]
        rows[i][i + 1 :] = pivot
    return [row[len(rows) :] for row in rows]


def isolated(residual: Callable[[Vector], Vector], jacobian: Callable[[Vector], Matrix], box: Vector) -> Vector:
    """A box inside the box X that contains the unique root of a map f of Rⁿ in X; raises Rejected if not proved.

    `residual` and `jacobian` enclose f and f′ for all values of the parameters.  Let c be the middle of X and S =
    jacobian(X).  For x, y in X, f(x) - f(y) = A(x, y)(x - y), where A, the mean of f′ on the segment, lies in S.
    Assume that all matrices in S are regular and N = c - S⁻¹f(c) lies inside X.  Then the continuous map
    x ↦ c - A(x, c)⁻¹f(c) takes X into N, so it has a fixed point (Brouwer) in N, which is a root of f.  Two roots x, y
    in X have A(x, y)(x - y) = 0, so x = y.  This holds for each value of the parameters: the root is a function of
    them, and N contains its values.
    """
    root = _newton_step(residual, jacobian, [x.point() for x in box], box)
    if not all(x.inside(y) for x, y in zip(root, box, strict=True)):
        raise Rejected(NO_ROOT)
    return root


def newton(residual: Callable[[Vector], Vector], jacobian: Callable[[Vector], Matrix], centre: Vector) -> Vector:
    """A box that contains one root of f near `centre`: `isolated` in a box about the limit of Newton's iteration.

    The iteration ends when d², the error left by a correction d, is below the width from parameters and rounding.
    """
    for _ in range(MOST_ITERATIONS):
        near = _newton_step(residual, jacobian, centre, centre)  # the test may start from any point
        square = max(x.most for x in minus(near, centre)) ** 2 << CURVED >> near[0].bits
        centre, width = [x.point() for x in near], max(x.width for x in near)
        if square <= width:
            return isolated(residual, jacobian, [x.wider(2 * (width + square) + 8) for x in centre])
    raise Rejected(NO_ROOT)


def _newton_step(
    residual: Callable[[Vector], Vector], jacobian: Callable[[Vector], Matrix], at: Vector, over: Vector
) -> Vector:
    """at - S⁻¹f(at), S = f′(over)."""
    return minus(at, [s for (s,) in solve(jacobian(over), [[x] for x in residual(at)])])
