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
from chapsym.generated import gibbs_newton

J = (0.1, 0.5, 1.6)
I = (2.1, 1.7, 0.6)
D = 0.7
G = (2 / 7, 3 / 7, 6 / 7)


def round_from(guess, array):
    k, g, inertia = array[0:3], array[3:6], array[loop.I : loop.D]
    return gibbs.settle(guess, k, g, inertia, *array[loop.D :])


@given(certified((0.0, 1.0)))
def test_a_certified_root_is_that_of_the_continuation(state):
    """Lemma small-branch, on numbers: the continuation succeeds, ends inside the ball, and is what the search finds."""
    ball, momentum, gamma = state
    array = prepared(state)
    status, _, q0, *q = small_rotation(*momentum, *gamma, *ball.mass_tensor, float(ball.D))
    assert status == 0
    u = np.array(q) / q0
    assert u @ u <= array[loop.RADIUS] * (1 + 1e-12)
    found = gibbs.search((0.0, 0.0, 0.0), array[0:3], array[3:6], array[loop.I : loop.D], *array[loop.D :])
    assert found[0]
    # ⟨d, ∂G d⟩ ≥ least|d|² by the lemma, and the residuals of both are rounded a few times: Bu, u × Iu, (1 + |u|²)k.
    inertia, size = array[loop.I : loop.D], 2 * np.linalg.norm(array[0:3])
    least = inertia.min() - np.linalg.norm(u) * ((inertia.max() - inertia.min()) / 2 + size)
    rounded = (inertia.max() + array[loop.D]) * np.linalg.norm(u) + size
    assert np.abs(np.array(found[2]) - u).max() <= 8 * 2.0**-53 * rounded / least + 1e-300


@given(certified((1e-9, 0.3)), st.floats(0.0, 1e-6), testing.unit_vectors())
def test_what_is_settled_is_settled(state, off, direction):
    """One more Newton iterate, in Fractions, from the settled vector moves it by roundings only."""
    array = prepared(state)
    assume(array[loop.RADIUS] > 0)
    size = math.sqrt(array[loop.RADIUS])
    root = gibbs.search((0.0, 0.0, 0.0), array[0:3], array[3:6], array[loop.I : loop.D], *array[loop.D :])
    settled, p, u = round_from(np.array(root[2]) + off * size * direction, array)
    assert settled
    exact = [Fraction(float(x)) for x in (*u, *array[0:6], *array[loop.I : loop.RADIUS])]
    det, *n = gibbs_newton(*exact)[:4]
    top, least = array[loop.I : loop.D].max() + array[loop.D], array[loop.I : loop.D].min()
    for x, y, z in zip(u, n, p[1:], strict=True):
        budget = 24 * 2.0**-53 * (top / least) * max(map(abs, u))
        assert abs(float(y / det - Fraction(float(x)))) <= budget
        assert abs(z / p[0] - x) <= 2.0**-52 * max(map(abs, u))


def entered(momentum):
    """The state that a march starts from, and by what its momentum is scaled."""
    state = np.zeros(loop.ROWS)
    return state, loop.entered(np.array(momentum), G, np.array(J), D, state)


@pytest.mark.parametrize("guess", [(2.0, 0.0, 0.0), (math.nan, 0.0, 0.0), (math.inf, 1.0, 1.0)])
def test_a_guess_outside_the_ball_settles_nothing(guess):
    state, _ = entered((0.03, -0.02, 0.04))
    assert not round_from(guess, state)[0]
    assert loop.safe_rotation(guess, state)[0] == 0  # and the safe way goes on without it


def test_a_poor_guess_is_not_settled_in_one_round_and_what_would_underflow_takes_the_safe_way():
    assert not round_from((0.0, 0.0, 0.0), entered((0.3, -0.2, 0.2))[0])[0]
    state, scale = entered((1e-200, 0, 0))
    assert state[loop.RADIUS] == -1
    assert scale * state[0] == 1e-200


@pytest.mark.parametrize(
    ("momentum", "certified"),
    [((0.0, 0.0, 0.0), True), ((0.0, 0.0, 0.3), True), ((0.0, 0.0, 0.58), False), ((0.0, 0.0, 0.7), False)],
)
def test_the_certificate_ends_where_the_lemma_does(momentum, certified):
    """I_min = 0.6: |𝒦| = 0.58 is below it, but its ball is not inside the one on which G is monotone."""
    radius, _ = gibbs.certificate([x / 2 for x in momentum], I, D)
    assert (radius >= 0) == certified


@given(certified((0.001, 1.0)))
def test_the_bound_on_what_a_correction_leaves_is_one(state):
    """c|d|² bounds the distance of a Newton iterate to the root, for guesses in the ball; enough ≤ LEFT·|u|/c."""
    array = prepared(state)
    radius, enough = array[loop.RADIUS], array[loop.ENOUGH]
    assume(radius > 1e-20)
    root = np.array(gibbs.search((0.0, 0.0, 0.0), array[0:3], array[3:6], array[loop.I : loop.D], *array[loop.D :])[2])
    size = np.linalg.norm(root)
    for share in (0.0, 0.5, -0.5):
        guess = share * math.sqrt(radius) * np.array(G)
        det, *n = gibbs_newton(*guess, *array[0:6], *array[loop.I : loop.RADIUS])[:4]
        after = np.array(n) / det
        d = after - guess
        assert np.linalg.norm(after - root) <= (d @ d) * gibbs.LEFT * size / enough * (1 + 1e-9) + 1e-12 * size
