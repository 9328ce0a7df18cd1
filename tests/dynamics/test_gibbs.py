"""The step in the Gibbs vector: the certificate of the branch, what a round settles, and what it must not."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from small_branch import certified, prepared

from chapsym import testing
from chapsym.dynamics.loops import gibbs, loop
from chapsym.dynamics.loops.branch import small_rotation
from chapsym.generated import gibbs_newton, gibbs_second, turn

J = (0.1, 0.5, 1.6)
I = (2.1, 1.7, 0.6)
D = 0.7
G = (2 / 7, 3 / 7, 6 / 7)


def round_from(guess, array):
    k, g, inertia = array[0:3], array[3:6], array[45:48]
    return gibbs.settle(*guess, *k, *g, *inertia, *array[48:51])


@given(certified((0.0, 1.0)))
def test_a_certified_root_is_that_of_the_continuation(state):
    """Lemma small-branch, on numbers: the continuation succeeds, ends inside the ball, and is what the search finds."""
    ball, momentum, gamma = state
    array = prepared(state)
    status, _, q0, *q = small_rotation(*momentum, *gamma, *ball.mass_tensor, float(ball.D))
    assert status == 0
    u = np.array(q) / q0
    assert u @ u <= array[loop.RADIUS] * (1 + 1e-12)
    found = gibbs.search(0.0, 0.0, 0.0, *array[0:3], *array[3:6], *array[45:48], *array[48:51])
    assert found[0]
    # ⟨d, ∂G d⟩ ≥ least|d|² by the lemma, and the residuals of both are rounded a few times: Bu, u × Iu, (1 + |u|²)k.
    inertia, size = array[45:48], 2 * np.linalg.norm(array[0:3])
    least = inertia.min() - np.linalg.norm(u) * ((inertia.max() - inertia.min()) / 2 + size)
    rounded = (inertia.max() + array[48]) * np.linalg.norm(u) + size
    assert np.abs(np.array(found[5:]) - u).max() <= 8 * 2.0**-53 * rounded / least + 1e-300


@given(certified((1e-9, 0.3)), st.floats(0.0, 1e-6), testing.unit_vectors())
def test_what_is_settled_is_settled(state, off, direction):
    """One more Newton iterate, in Fractions, from the settled vector moves it by roundings only."""
    array = prepared(state)
    assume(array[loop.RADIUS] > 0)
    size = math.sqrt(array[loop.RADIUS])
    root = gibbs.search(0.0, 0.0, 0.0, *array[0:3], *array[3:6], *array[45:48], *array[48:51])
    settled, p0, p1, p2, p3, *u = round_from(np.array(root[5:]) + off * size * direction, array)
    assert settled
    exact = [Fraction(float(x)) for x in (*u, *array[0:6], *array[45:49])]
    det, *n = gibbs_newton(*exact)[:4]
    top, least = array[45:48].max() + array[48], array[45:48].min()
    for x, y, p in zip(u, n, (p1, p2, p3), strict=True):
        budget = 24 * 2.0**-53 * (top / least) * max(map(abs, u))
        assert abs(float(y / det - Fraction(float(x)))) <= budget
        assert abs(p / p0 - x) <= 2.0**-52 * max(map(abs, u))


@pytest.mark.parametrize("guess", [(2.0, 0.0, 0.0), (math.nan, 0.0, 0.0), (math.inf, 1.0, 1.0)])
def test_a_guess_outside_the_ball_settles_nothing(guess):
    state = np.zeros(loop.ROWS)
    loop.prepare((0.03, -0.02, 0.04), G, J, D, state)
    assert not round_from(guess, state)[0]
    assert loop.safe_rotation(*guess, state)[0] == 0  # and the safe way goes on without it


def test_a_poor_guess_is_not_settled_in_one_round():
    state = np.zeros(loop.ROWS)
    loop.prepare((0.3, -0.2, 0.2), G, J, D, state)
    assert not round_from((0.0, 0.0, 0.0), state)[0]


@pytest.mark.parametrize(
    ("momentum", "certified"),
    [((0.0, 0.0, 0.0), True), ((0.0, 0.0, 0.3), True), ((0.0, 0.0, 0.58), False), ((0.0, 0.0, 0.7), False)],
)
def test_the_certificate_ends_where_the_lemma_does(momentum, certified):
    """I_min = 0.6: |𝒦| = 0.58 is below it, but its ball is not inside the one on which G is monotone."""
    radius, _ = gibbs.certificate(*(x / 2 for x in momentum), *I, D)
    assert (radius >= 0) == certified


@given(certified((0.001, 1.0)))
def test_the_bound_on_what_a_correction_leaves_is_one(state):
    """c|d|² bounds the distance of a Newton iterate to the root, for guesses in the ball; enough ≤ LEFT·|u|/c."""
    array = prepared(state)
    radius, enough = array[loop.RADIUS], array[loop.ENOUGH]
    assume(radius > 1e-20)
    root = np.array(gibbs.search(0.0, 0.0, 0.0, *array[0:3], *array[3:6], *array[45:48], *array[48:51])[5:])
    size = np.linalg.norm(root)
    for share in (0.0, 0.5, -0.5):
        guess = share * math.sqrt(radius) * np.array(G)
        det, *n = gibbs_newton(*guess, *array[0:6], *array[45:49])[:4]
        after = np.array(n) / det
        d = after - guess
        assert np.linalg.norm(after - root) <= (d @ d) * gibbs.LEFT * size / enough * (1 + 1e-9) + 1e-12 * size


def test_the_second_correction_is_that_of_the_lemma():
    """G(u + d + e) is smaller than G(u + d) by a factor of |d|, in Fractions."""
    exact = [Fraction(x).limit_denominator(100) for x in (0.1, -0.05, 0.02, 0.15, -0.1, 0.1)]
    u, k = exact[:3], exact[3:]
    g, inertia = [Fraction(x, 7) for x in (2, 3, 6)], [Fraction(x, 10) for x in (21, 17, 6)]
    det, *rest = gibbs_newton(*u, *k, *g, *inertia, Fraction(7, 10))
    n, cofactors = rest[:3], rest[3:]
    d = [x / det - y for x, y in zip(n, u, strict=True)]
    e = gibbs_second(*d, *k, *cofactors, *inertia)
    before = distance([x / det for x in n], k, g, inertia)
    after = distance([(x - y) / det for x, y in zip(n, e, strict=True)], k, g, inertia)
    assert 0 < after < before * 3 * max(map(abs, d))


def distance(u, k, g, inertia):
    """|G(u)| by the vector formula."""
    contact = Fraction(7, 10)
    along = sum(x * y for x, y in zip(u, g, strict=True))
    swirl = cross(u, [i * x for i, x in zip(inertia, u, strict=True)])
    norm = 1 + sum(x * x for x in u)
    rows = [
        (i + contact) * x - contact * along * y + s - norm * z
        for i, x, y, s, z in zip(inertia, u, g, swirl, k, strict=True)
    ]
    return max(map(abs, rows))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def test_turn_is_the_same_for_a_quaternion_of_any_length():
    p, v = [Fraction(x, 3) for x in (5, 1, -2, 1)], [Fraction(x) for x in (1, -2, 4)]
    once = turn(*p, *v)
    assert once == turn(*(7 * x for x in p), *v)
    moved = [x + y for x, y in zip(v, once, strict=True)]
    assert sum(x * x for x in moved) == sum(x * x for x in v)
    assert moved != v


def test_what_would_underflow_takes_the_safe_way():
    state = np.zeros(loop.ROWS)
    scale = loop.prepare(np.array([1e-200, 0, 0]), G, np.array(J), D, state)
    assert state[loop.RADIUS] == -1
    assert scale * state[0] == 1e-200
