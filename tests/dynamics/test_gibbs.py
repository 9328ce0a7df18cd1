"""The step in the Gibbs vector: the certificate of the branch, and beyond it what lemma `straight-path` proves."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from small_branch import certified, heavy, prepared

from chapsym import Ball, Status, testing
from chapsym.dynamics.loops import gibbs, loop, path
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


# -- beyond the bound of small-branch


BALL = Ball((0.1, 0.5, 1.6), 0.7)
MOMENTUM, GAMMA = np.array((6, -2, 3)) / 7, np.array((2, 3, 6)) / 7


def of(state):
    """k, γ, I and D of a state as `search_on_path` wants them, or None within the bound of small-branch."""
    array = prepared(state)
    if array[loop.RADIUS] != gibbs.BEYOND:
        return None
    return array[loop.K : loop.K + 3], array[loop.G : loop.G + 3], array[loop.I : loop.I + 3], array[loop.D]


def continued(state):
    """(status, Gibbs vector) of the continuation."""
    ball, momentum, gamma = state
    status, _, q0, *q = small_rotation(*momentum, *gamma, *ball.mass_tensor, float(ball.D))
    return status, np.array(q) / q0 if q0 else np.full(3, np.inf)


@given(testing.states(fraction=(0.2, 0.98)), testing.unit_vectors(), st.floats(0, 3))
def test_what_is_proved_is_the_root_of_the_continuation(state, direction, size):
    """Whatever the guess is: the other roots, to which Newton's iteration may go, are never taken for it."""
    assume(not heavy(state[0]))
    numbers = of(state)
    assume(numbers is not None)
    status, u = continued(state)
    assert status == Status.TAKEN
    for guess in (u, u + size * direction, -size * u, size * direction):
        settled, p, found = path.search_on_path(guess, *numbers)
        if settled:
            assert np.abs(np.array(found) - u).max() <= 1e-9 * np.linalg.norm(u)  # near a fold both lose digits
            assert np.array(p[1:]) / p[0] == pytest.approx(np.array(found), rel=1e-14)


@given(testing.states(fraction=(1.0001, 3.0)), testing.unit_vectors(), st.floats(0, 3))
def test_behind_the_fold_nothing_is_proved(state, direction, size):
    """There are roots there, but none that the small branch goes to."""
    assume(not heavy(state[0]))
    numbers = of(state)
    assume(numbers is not None and continued(state)[0] == Status.FOLDED)
    for guess in (size * direction, -size * direction, 3 * size * direction):
        assert not path.search_on_path(guess, *numbers)[0]


def test_a_root_is_proved_only_up_to_what_its_corrections_leave():
    """What is left over is divided by half the least stretch: for this root it may be 2^-53 of |u|, and no more."""
    state = BALL, 0.8 * MOMENTUM, GAMMA
    numbers, (_, u) = of(state), continued(state)
    k, g, inertia, D = numbers
    square, half = float(u @ u), math.hypot(*k)
    _, least = path.joined(u, square, k, half, g, inertia, D, (max(inertia) - min(inertia)) / 2)
    most = (2.0**-53 * least) ** 2 * square
    assert path.proved(u, 0.99 * most, *numbers)
    assert not path.proved(u, 1.01 * most, *numbers)


def test_how_far_the_straight_path_reaches(thorough):
    """Of seeded states at a fraction of their fold: as measured, so that a check that says no too often is seen."""
    draw, proved = np.random.default_rng(5), {0.6: 0, 0.8: 0, 0.9: 0}
    count, states = 0, 300 if thorough else 100
    while count < states:
        J, D = draw.uniform(0.2, 3, 3), draw.choice([0.0, 3.0])
        K, g = draw.normal(size=(2, 3))
        ball, g = Ball(J, D), g / np.linalg.norm(g)
        K *= 8 * (2 * J.sum() + D) / np.linalg.norm(K)
        status, reach, *_ = small_rotation(*K, *g, *J, D)
        if status != Status.FOLDED or heavy(ball):
            continue
        count += 1
        for fraction in proved:
            state = ball, fraction * reach * K, g
            numbers = of(state)
            proved[fraction] += numbers is None or path.search_on_path(continued(state)[1], *numbers)[0]
    for fraction, least in zip(proved, (299, 290, 265) if thorough else (99, 96, 87), strict=True):
        assert proved[fraction] >= least


def test_the_intervals_cover_the_path(monkeypatch):
    """What the check of the intervals is given, by formulas in vectors: with room for roundings only."""
    calls = []
    monkeypatch.setattr(path, "small_between", lambda *given: calls.append(given) or True)
    draw = np.random.default_rng(3)
    for size in np.linspace(0.01, 1.5, 100):
        inertia, D = draw.uniform(1, 2, 3), draw.choice([0.0, 3.0])
        u, g, k = draw.normal(size=(3, 3))
        u, g = u * size / np.linalg.norm(u), g / np.linalg.norm(g)
        square, x, spread = u @ u, np.cross(u, inertia * u), np.ptp(inertia) / 2
        k = draw.choice([0.1 * x, k])  # c is 0 where u × Iu has much of a small k
        half = np.linalg.norm(k)
        proved, least = path.joined(u, square, k, half, g, inertia, D, spread)
        B = np.diag(inertia) + D * (np.eye(3) - np.outer(g, g))
        bent = np.array([np.cross(u, inertia * e) + np.cross(e, inertia * u) for e in np.eye(3)]).T
        S = B + (bent + bent.T) / 2 - np.outer(k, u) - np.outer(u, k)
        eigenvalues = np.linalg.eigvalsh(B)[0], np.linalg.eigvalsh(S)[0]
        assert proved == (eigenvalues[1] > 0)
        a, b, most = np.array([call[:3] for call in calls]).T
        assert [a[0], *a[1:], 1.0] == [0.0, *b[:-1], b[-1]]
        assert (most >= np.where((a <= 0.5) & (b >= 0.5), 0.25, np.maximum(a * (1 - a), b * (1 - b)))).all()
        component = x @ k / half**2
        exact = [
            component,
            (x - component * k) @ (x - component * k),
            spread + 2 * half,
            half * np.sqrt(square) - k @ u,
        ]
        for *_, (found, c, along, across, length, slope, bent, first, last) in calls:
            assert 0 <= c <= 1
            assert (found, length, last) == (square, half, least)
            assert [along, across, slope, bent] == pytest.approx(exact, abs=1e-12)
            for bound, eigenvalue in zip((first, last), eigenvalues, strict=True):
                assert 0.4 * eigenvalue <= bound <= eigenvalue * (1 + 1e-12) or (bound == -1 and eigenvalue < 0)
        calls.clear()


def stretched(rng):
    """A random positive definite matrix, with eigenvalues far apart or together."""
    axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return axes @ np.diag(10.0 ** rng.uniform(-3, 0, 3)) @ axes.T


def test_the_least_eigenvalue_is_bounded_from_below():
    rng = np.random.default_rng(1)
    for _ in range(300):
        matrix = stretched(rng)
        trace, det = np.trace(matrix), np.linalg.det(matrix)
        minors = (trace**2 - np.trace(matrix @ matrix)) / 2
        least = np.linalg.eigvalsh(matrix)[0]
        assert 0.5 * least <= path.lowest(trace, minors, det) <= least * (1 + 1e-9)
    assert path.lowest(1.0, -1.0, -1.0) == path.lowest(-3.0, 3.0, -1.0) == path.lowest(3.0, 1.0, -0.1) == -1.0


@pytest.mark.parametrize("guess", [(math.nan, 0.0, 0.0), (math.inf, 1.0, 1.0), (1e200, 0.0, 0.0)])
def test_a_guess_that_is_no_number_proves_nothing(guess):
    numbers = of((BALL, 0.6 * MOMENTUM, GAMMA))
    with np.errstate(all="ignore"):
        assert not path.search_on_path(tuple(map(np.float64, guess)), *numbers)[0]


def test_an_interval_is_small_where_it_says_so():
    """4σs(1 - s)|R(s)| < m(s)², with R and m by their formulas in vectors, for the largest σ that is accepted."""
    rng, closest = np.random.default_rng(2), 0.0
    for _ in range(1000):
        a, b = np.sort(rng.uniform(size=2))
        b = a + (b - a) * rng.choice([0.1, 1.0])
        k, u = rng.normal(size=(2, 3)) * [[1], [rng.uniform(0, 1.5)]]
        inertia, c, first, last = rng.uniform(0.5, 2, 3), rng.uniform(), *rng.uniform(0.1, 2, 2)
        x, square, half = np.cross(u, inertia * u), u @ u, np.linalg.norm(k)
        along, sag = x @ k / half**2, rng.uniform(0, 1)
        across = max(x @ x - along**2 * half**2, 0)
        most = 0.25 if a <= 0.5 <= b else max(a * (1 - a), b * (1 - b))
        low, high = 0.0, 1e3
        for _ in range(50):
            middle = (low + high) / 2
            small = path.small_between(a, b, most, (square, c, along, across, half, middle, sag, first, last))
            low, high = (middle, high) if small else (low, middle)
        if low == 0.0:
            continue  # m is not positive
        s = np.linspace(a, b, 30)
        R = np.linalg.norm(np.outer(square * (1 + s) - c * (1 + s * s * square), k) - x, axis=1)
        m = (1 - s) * first + s * last - s * (1 - s) * sag
        assert m.min() > 0
        used = (4 * low * s * (1 - s) * R / m**2).max()
        assert used < 1
        closest = max(closest, used)
    assert closest > 0.95
    # r = s(1 - s) is 0 at both ends, and not between.
    assert not path.small_between(0.0, 1.0, 0.25, (1.0, 1.0, 0.0, 0.0, 1.0, 8.0, 0.0, 1.0, 1.0))
