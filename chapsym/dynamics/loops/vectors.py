"""Vectors as tuples: their operations in the loops, and their storage in arrays: in a row, or in a lane's column."""

from math import ldexp, sqrt


def three(array, at):
    """Three numbers of an array, from `at` on."""
    return array[at], array[at + 1], array[at + 2]


def put(array, at, v):
    """Writes three numbers into an array, from `at` on."""
    array[at], array[at + 1], array[at + 2] = v[0], v[1], v[2]


def four(array, at):
    """Four numbers of an array, from `at` on."""
    return array[at], array[at + 1], array[at + 2], array[at + 3]


def put_four(array, at, q):
    """Writes four numbers into an array, from `at` on."""
    array[at], array[at + 1], array[at + 2], array[at + 3] = q[0], q[1], q[2], q[3]


def three_in(S, at, i):
    """Three numbers of a lane, from the row `at` on."""
    return S[at, i], S[at + 1, i], S[at + 2, i]


def put_in(S, at, i, v):
    """Writes three numbers into a lane, from the row `at` on."""
    S[at, i], S[at + 1, i], S[at + 2, i] = v[0], v[1], v[2]


def four_in(S, at, i):
    """Four numbers of a lane, from the row `at` on."""
    return S[at, i], S[at + 1, i], S[at + 2, i], S[at + 3, i]


def put_four_in(S, at, i, q):
    """Writes four numbers into a lane, from the row `at` on."""
    S[at, i], S[at + 1, i], S[at + 2, i], S[at + 3, i] = q[0], q[1], q[2], q[3]


def plus(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def plus_four(a, b):
    """a + b, of four numbers each."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]


def minus(a, b):
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scaled(s, v):
    """The vector v times a number."""
    return s * v[0], s * v[1], s * v[2]


def scaled_four(s, q):
    """Four numbers times a number."""
    return s * q[0], s * q[1], s * q[2], s * q[3]


def mixed(w, a, v, b):
    """w a + v b, of four numbers each."""
    return plus_four(scaled_four(w, a), scaled_four(v, b))


def shifted(v, exponent):
    """The vector v times a power of two."""
    return ldexp(v[0], exponent), ldexp(v[1], exponent), ldexp(v[2], exponent)


def dot(a, b):
    """⟨a, b⟩."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def length(v):
    """|v|."""
    return sqrt(dot(v, v))


def dot_four(a, b):
    """The sum of four products."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]


def square(v):
    """|v|², summed in another order than in `dot`."""
    return v[0] * v[0] + (v[1] * v[1] + v[2] * v[2])


def square_of_four(q):
    """The sum of four squares."""
    return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3])


def unit(q):
    """Four numbers divided by their length."""
    size = sqrt(square_of_four(q))
    return q[0] / size, q[1] / size, q[2] / size, q[3] / size


def cross(a, b):
    """a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def adjoint(c, r):
    """adj(A) r for a matrix A with the cofactors c, row by row: det A times the solution of A x = r."""
    return (
        c[0] * r[0] + c[3] * r[1] + c[6] * r[2], c[1] * r[0] + c[4] * r[1] + c[7] * r[2],
        c[2] * r[0] + c[5] * r[1] + c[8] * r[2],
    )  # fmt: skip


def conjugate(q):
    """The quaternion of the inverse rotation."""
    return q[0], -q[1], -q[2], -q[3]


def largest(v):
    """The largest absolute value of three numbers."""
    return max(abs(v[0]), abs(v[1]), abs(v[2]))
