"""The parts of the loops that differ in float32.  Plain scalar Python, converted with the loops (`single`)."""

from math import sqrt

from numpy import float32, float64

from chapsym.generated import centre_step, compose, rotate

from .branch import small_rotation
from .integrals import added
from .vectors import square, square_of_four


def widened(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """`branch.small_rotation` in float64 with unit γ, rounded to float32.

    Near a fold float32 could not separate the branches, and the rounding error of |γ| would move the fold.
    """
    x, y, z = float64(g1), float64(g2), float64(g3)
    length = sqrt(x * x + (y * y + z * z))
    status, reach, q0, q1, q2, q3 = small_rotation(
        float64(K1), float64(K2), float64(K3), x / length, y / length, z / length,
        float64(J1), float64(J2), float64(J3), float64(D),
    )  # fmt: skip
    return status, float32(reach), float32(q0), float32(q1), float32(q2), float32(q3)


def add(array, at, rest, z):
    """Adds z to array[at], with the compensation of the sum in array[rest]."""
    array[at], array[rest] = added(array[at], array[rest], z)


def follow_body(p, g, attitude, contact, radius):
    """`loop.follow_body` with compensation: attitude (4 and 4 compensations) and contact (2 and 2 compensations).

    A slow ball turns and rolls less in a step than float32 can resolve.
    """
    squared = square(p[1:4])
    length = sqrt(p[0] * p[0] + squared)
    q = p[0] / length, p[1] / length, p[2] / length, p[3] / length
    a = attitude[0], attitude[1], attitude[2], attitude[3]
    x, y, _ = rotate(*a, *centre_step(*q, *g))
    add(contact, 0, 2, radius * x)
    add(contact, 1, 3, radius * y)
    # a ∘ (q - 1), with q0 - 1 from the versed sine, and one Newton step to length 1.
    z = compose(*a, -squared / (length * (length + p[0])), *q[1:4])
    stretch = 0.5 - 0.5 * square_of_four(a)
    add(attitude, 0, 4, z[0] + stretch * a[0])
    add(attitude, 1, 5, z[1] + stretch * a[1])
    add(attitude, 2, 6, z[2] + stretch * a[2])
    add(attitude, 3, 7, z[3] + stretch * a[3])
