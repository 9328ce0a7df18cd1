"""The modified equations against the map itself at high precision."""

from itertools import pairwise

import mpmath as mp
import pytest
from certificate_maker import cross, gibbs, turned

INERTIA, CONTACT = mp.matrix([6, 5, 3]), mp.mpf(3)  # J = (1, 2, 4)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def matrix(g):
    return mp.diag([x + CONTACT for x in INERTIA]) - CONTACT * g * g.T


def weighted(x):
    return mp.matrix([a * b for a, b in zip(INERTIA, x, strict=True)])


def step(K, g, size):
    """The map on (K, γ), 𝒦 = εK."""
    u = gibbs((1, 2, 4), CONTACT, size * K, g)
    return turned(u, K), turned(u, g)


def angular(K, g, size):
    """ω + ε²ω₃, from its terms."""
    solve = lambda x: mp.lu_solve(matrix(g), x)  # noqa: E731
    w = solve(K)
    a, moving = solve(cross(weighted(w), w)), cross(g, w)
    load = cross(w, weighted(a)) + cross(a, weighted(w)) + 2 * CONTACT * (dot(g, a) * moving + dot(moving, a) * g)
    return w + size**2 * (2 * dot(w, w) * w - cross(w, a) - solve(load)) / 12


def flow(K, g, size):
    """The modified field over the time ε: Runge and Kutta's steps of the order 4, 32 of them, extrapolated twice."""

    def run(count):
        k, v, h = K.copy(), g.copy(), size / count
        for _ in range(count):
            rates = []
            for part in (0, h / 2, h / 2, h):
                x, y = (k + part * rates[-1][0], v + part * rates[-1][1]) if rates else (k, v)
                w = angular(x, y, size)
                rates.append((cross(x, w), cross(y, w)))
            weights = (1, 2, 2, 1)
            k += h / 6 * sum((c * r[0] for c, r in zip(weights, rates, strict=True)), mp.zeros(3, 1))
            v += h / 6 * sum((c * r[1] for c, r in zip(weights, rates, strict=True)), mp.zeros(3, 1))
        return mp.matrix([*k, *v])

    coarse, middle, fine = run(4), run(8), run(16)
    return ((32 * (16 * fine - middle) / 15) - (16 * middle - coarse) / 15) / 31


@mp.workdps(50)
def test_the_defect_of_the_step_is_of_order_5():
    """One step against the flow of the modified field: ε⁵, as there is no term in ε³ of Ω̃ (self-adjoint)."""
    K, g = mp.matrix([1, 2, mp.mpf(17) / 5]), mp.matrix([3, 6, 2]) / 7
    defects = []
    for power in (7, 8, 9):
        size = mp.mpf(2) ** -power
        defects.append(mp.norm(mp.matrix([x for v in step(K, g, size) for x in v]) - flow(K, g, size)))
    slopes = [float(mp.log(a / b, 2)) for a, b in pairwise(defects)]
    assert slopes == pytest.approx([5, 5], abs=0.02)
