"""The paper's formulas once more, with `fractions` alone: what the tests compare against.

Nothing here comes from chapsym: matrices are lists of rows, and every formula is typed from the paper.
"""

from fractions import Fraction

Matrix = list[list[Fraction]]


def matmul(a: Matrix, b: Matrix) -> Matrix:
    return [
        [sum((x * y for x, y in zip(row, column, strict=True)), Fraction(0)) for column in zip(*b, strict=True)]
        for row in a
    ]


def transposed(a: Matrix) -> Matrix:
    return [list(column) for column in zip(*a, strict=True)]


def added(*terms: tuple[Fraction | int, Matrix]) -> Matrix:
    """The sum of coefficient·matrix."""
    size = range(len(terms[0][1]))
    return [[sum((c * m[i][j] for c, m in terms), Fraction(0)) for j in size] for i in size]


def diagonal(entries) -> Matrix:
    return [[Fraction(entries[i]) if i == j else Fraction(0) for j in range(3)] for i in range(3)]


def outer(v) -> Matrix:
    return [[x * y for y in v] for x in v]


def times(a: Matrix, v) -> list:
    return [sum(x * y for x, y in zip(row, v, strict=True)) for row in a]


def dot(v, w):
    return sum(x * y for x, y in zip(v, w, strict=True))


def cross(v, w):
    return [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]


def axial(a: Matrix) -> list:
    """(A32, A13, A21), Section 5."""
    return [a[2][1], a[0][2], a[1][0]]


def rotation(q0, q1, q2, q3) -> Matrix:
    """Rodrigues: x + 2 q0 q×x + 2 q×(q×x), column by column."""
    q = [q1, q2, q3]
    columns = []
    for i in range(3):
        e = [Fraction(int(i == j)) for j in range(3)]
        once = cross(q, e)
        twice = cross(q, once)
        columns.append([e[k] + 2 * q0 * once[k] + 2 * twice[k] for k in range(3)])
    return transposed(columns)


def momentum(omega: Matrix, gamma, J, D) -> Matrix:
    """(4.13), second form."""
    half = Fraction(D) / 2
    Jd, G, T = diagonal(J), outer(gamma), transposed(omega)
    return added(
        (1, matmul(omega, Jd)), (-1, matmul(Jd, T)),
        (half, matmul(omega, G)), (-half, matmul(G, T)),
        (half, matmul(G, omega)), (-half, matmul(T, G)),
    )  # fmt: skip
