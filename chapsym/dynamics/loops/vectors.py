"""Vectors as tuples: what the loops do with them, and how they lie in arrays, in a row or in the column of a lane."""

from math import ldexp, sqrt

from chapsym.numbers.loose import Loose
from chapsym.numbers.pairs import two_sum


def three(array, at):
    """Three numbers of an array, from `at` on."""
    return array[at], array[at + 1], array[at + 2]


def put(array, at, v):
    """Writes three numbers into an array, from `at` on."""
    array[at], array[at + 1], array[at + 2] = v[0], v[1], v[2]


def four(array, at):
    """Four numbers of an array."""
    return array[at], array[at + 1], array[at + 2], array[at + 3]


def put_four(array, at, q):
    """Writes four numbers into an array."""
    array[at], array[at + 1], array[at + 2], array[at + 3] = q[0], q[1], q[2], q[3]


def three_in(S, at, i):
    """Three numbers of a lane, from the row `at` on."""
    return S[at, i], S[at + 1, i], S[at + 2, i]


def put_in(S, at, i, v):
    """Writes three numbers into a lane, from the row `at` on."""
    S[at, i], S[at + 1, i], S[at + 2, i] = v[0], v[1], v[2]


def four_in(S, at, i):
    """Four numbers of a lane."""
    return S[at, i], S[at + 1, i], S[at + 2, i], S[at + 3, i]


def put_four_in(S, at, i, q):
    """Writes four numbers into a lane."""
    S[at, i], S[at + 1, i], S[at + 2, i], S[at + 3, i] = q[0], q[1], q[2], q[3]


def plus(a, b):
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def plus_four(a, b):
    """The sum of four numbers and four others."""
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
    """|v|², with another order of the sum than `dot`."""
    return v[0] * v[0] + (v[1] * v[1] + v[2] * v[2])


def square_of_four(q):
    """The sum of four squares."""
    return (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3])


def cross(a, b):
    """a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def conjugate(q):
    """The quaternion of the inverse rotation."""
    return q[0], -q[1], -q[2], -q[3]


def largest(v):
    """The largest absolute value of three numbers."""
    return max(abs(v[0]), abs(v[1]), abs(v[2]))


def pair(array, at):
    """A pair of an array, its high half first."""
    return Loose(array[at], array[at + 1])


def put_pair(array, at, x):
    """Writes a pair into an array."""
    array[at], array[at + 1] = x.high, x.low


def three_pairs(array, at):
    """Three pairs of an array."""
    return pair(array, at), pair(array, at + 2), pair(array, at + 4)


def put_pairs(array, at, v):
    """Writes three pairs into an array."""
    put_pair(array, at, v[0])
    put_pair(array, at + 2, v[1])
    put_pair(array, at + 4, v[2])


def pairs_in(S, at, i):
    """Three pairs of a lane."""
    return Loose(S[at, i], S[at + 1, i]), Loose(S[at + 2, i], S[at + 3, i]), Loose(S[at + 4, i], S[at + 5, i])


def put_pairs_in(S, at, i, v):
    """Writes three pairs into a lane."""
    put_in(S, at, i, (v[0].high, v[0].low, v[1].high))
    put_in(S, at + 3, i, (v[1].low, v[2].high, v[2].low))


def exact(v):
    """A vector of floats that count as exact."""
    return Loose(v[0]), Loose(v[1]), Loose(v[2])


def summed(v, w):
    """v + w of floats, as pairs."""
    return Loose(*two_sum(v[0], w[0])), Loose(*two_sum(v[1], w[1])), Loose(*two_sum(v[2], w[2]))


def highs(v):
    """The high halves of a vector of pairs."""
    return v[0].high, v[1].high, v[2].high


def lows(v):
    """The low halves of a vector of pairs."""
    return v[0].low, v[1].low, v[2].low


def normalised(v):
    """A vector of pairs of which the low halves are small."""
    return v[0].normalised(), v[1].normalised(), v[2].normalised()


def normalised_four(q):
    """Four pairs of which the low halves are small."""
    return q[0].normalised(), q[1].normalised(), q[2].normalised(), q[3].normalised()


def of_length_one(q):
    """A quaternion of nearly the length 1, divided by it: a Newton step."""
    t = (3 - square_of_four(q)) / 2
    return t * q[0], t * q[1], t * q[2], t * q[3]
