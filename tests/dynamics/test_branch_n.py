"""The branch in n dimensions: where it goes, where it folds, and the bound below which a near rotation is on it."""

import warnings

import numpy as np
import pytest
from balls_n import SIZES, UNIT_ROUNDOFF, offset, proven_branch
from budget import slow

import chapsym
from chapsym import Ball, BallN, Status, skew, step_n
from chapsym.dynamics.loops import loop_n
from chapsym.dynamics.n import near_n, so_n
from chapsym.dynamics.n.branch_n import _solved, corrected, small_rotation


@pytest.mark.parametrize("heavy", [1.0, 1e7])
def test_in_three_dimensions_the_fold_is_the_same(heavy):
    """With a large D, up to what its roundings are beside the momentum of the fold."""
    rng = np.random.default_rng(3)
    J, D, gamma = rng.uniform(0.1, 2, (60, 3)), heavy * rng.uniform(0, 2, 60), rng.normal(size=(60, 3))
    gamma /= np.linalg.norm(gamma, axis=-1, keepdims=True)
    K = rng.normal(size=(60, 3)) * 10 ** rng.uniform(-1, 1, (60, 1))
    general, special = step_n(BallN(J, D), skew(K), gamma), chapsym.step(Ball(J, D), K, gamma)
    assert 5 < (special.status == Status.TAKEN).sum() < 55
    assert ((general.status == Status.TAKEN) == (special.status == Status.TAKEN)).all()
    assert np.isnan(general.rotation[general.status == Status.FOLDED]).all()
    assert np.abs(general.reach - special.reach).max() <= 64 * UNIT_ROUNDOFF * (1 + heavy)


@pytest.mark.parametrize("n", [4, 5, *slow(3, 8)])
def test_the_branch_is_the_proven_one(n):
    rng = np.random.default_rng(n)
    for i in range(3):
        J, D, gamma = rng.uniform(0.1, 2, n), np.float64((0.0, 1.0)[i % 2]), rng.normal(size=n)
        J[0] *= i % 3 > 0
        gamma /= np.linalg.norm(gamma)
        K = so_n.from_coordinates(rng.normal(size=n * (n - 1) // 2), n) * 100
        _, _, reach = small_rotation(K[None], gamma[None], J[None], D[None])
        K *= reach[0] * (0.2, 0.6, 0.95)[i % 3]
        assert np.abs(offset((K, gamma, J, D)) - proven_branch(K, gamma, J, D)).max() < 1e-11


@pytest.mark.parametrize("n", [4, *slow(5)])
def test_past_the_fold_no_other_branch_is_taken(n, thorough):
    """Newton alone, whatever its corrections, would find another rotation for some of these."""
    rng, balls = np.random.default_rng(5), 400 if thorough else 80
    J, D, gamma = rng.uniform(0.1, 2, (balls, n)), rng.uniform(0, 2, balls), rng.normal(size=(balls, n))
    gamma /= np.linalg.norm(gamma, axis=-1, keepdims=True)
    J[::3, 0] = 0
    K = so_n.from_coordinates(rng.normal(size=(balls, n * (n - 1) // 2)), n) * 100
    folded = step_n(BallN(J, D), K, gamma)
    assert (folded.status == Status.FOLDED).all()
    past = folded.reach * (1 + 10 ** rng.uniform(-4, -2, balls))
    again = step_n(BallN(J, D), K * past[:, None, None], gamma)
    assert (again.status == Status.FOLDED).all()
    assert np.abs(again.reach * past / folded.reach - 1).max() < 1e-12


def test_one_singular_system_does_not_spoil_the_others():
    matrices = np.stack([np.eye(3), np.zeros((3, 3)), 2 * np.eye(3)])
    assert _solved(matrices, np.ones((3, 3))).tolist() == [[1] * 3, [np.inf] * 3, [0.5] * 3]


def test_from_a_fold_newton_does_not_settle_and_does_not_complain():
    """At a rotation by 90° of a ball with J = 1, D = 0 the Jacobian is exactly singular."""
    quarter = np.eye(4)[[1, 0, 2, 3]] * [[-1], [1], [1], [1]]
    E = np.stack([quarter - np.eye(4), np.zeros((4, 4))])
    state = np.tile(np.eye(4)[0], (2, 1)), np.ones((2, 4)), np.zeros(2)
    assert np.linalg.matrix_rank(so_n.jacobian(E[0], *(x[0] for x in state))) < 6
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        moved, settled = corrected(E, np.full((2, 6), 0.1), *state)
    assert settled.tolist() == [False, True]
    assert np.abs(so_n.momentum(moved[1], *(x[1] for x in state))).max() == pytest.approx(0.1)


def test_a_bifurcation_ends_the_branch_as_a_fold_does():
    """The rotations about e₂ go on, but the Jacobian vanishes on the way: so it is in three dimensions."""
    J, D, gamma = (0.0, 0.0, 1.0), 1.0, np.array([1.0, 0.0, 4.0]) / np.sqrt(17)
    found = []
    for step, momentum in ((chapsym.step, [0, 1.0, 0]), (chapsym.step_n, chapsym.skew([0, 1.0, 0]))):
        ball = chapsym.Ball(J, D) if step is chapsym.step else chapsym.BallN(J, D)
        with pytest.raises(chapsym.StepNotTaken) as caught:
            step(ball, momentum, gamma)
        assert caught.value.status == chapsym.Status.FOLDED
        found.append(caught.value.reach)
    assert found[0] == pytest.approx(16 / 17, rel=1e-7)
    assert found[1] == pytest.approx(16 / 17, rel=1e-7)


# -- the bound: each inequality of it


ONE = np.ones(1)


def turned_planes(angles, n):
    """The rotation by these angles in the planes (0, 1), (2, 3), …"""
    M = np.eye(n)
    for i, angle in enumerate(angles):
        M[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return M


def rotations(rng, n, largest, balls):
    """Random rotations whose largest angle is `largest`."""
    bases = np.linalg.qr(rng.normal(size=(balls, n, n)))[0]
    angles = largest * np.sign(rng.normal(size=(balls, n // 2))) * rng.uniform(0, 1, (balls, n // 2)) ** 0.3
    angles[:, 0] = largest
    return np.stack([basis @ turned_planes(a, n) @ basis.T for basis, a in zip(bases, angles, strict=True)])


def bodies(rng, n, balls):
    """(J, D, γ, s): one moment of some vanishes, some are without contact, some heavy."""
    J, D, gamma = rng.uniform(0.05, 1, (balls, n)), rng.uniform(0, 2, balls), rng.normal(size=(balls, n))
    J[::3, 0], D[::4], D[1::4] = 0, 0, 30
    gamma /= np.linalg.norm(gamma, axis=-1, keepdims=True)
    return J, D, gamma, np.sort(J, axis=-1)[:, :2].sum(axis=-1)


@pytest.mark.parametrize("n", SIZES)
def test_the_form_of_the_slope_is_at_least_lambda(n):
    rng = np.random.default_rng([1, n])
    J, D, gamma, s = bodies(rng, n, 300)
    for angle in (0.1, 0.7, 1.3, 1.55):
        T = so_n.jacobian(rotations(rng, n, angle, len(D)) - np.eye(n), gamma, J, D)
        lowest = np.linalg.eigvalsh((T + T.mT) / 2)[:, 0]
        assert (lowest >= near_n.least(np.full(len(D), angle), s, D) - 64 * UNIT_ROUNDOFF * (2 + D)).all()


@pytest.mark.parametrize("D", [0.0, 1.0, 50.0])
def test_in_four_dimensions_lambda_is_attained(D):
    """By equal moments and equal angles in the plane of γ and in that normal to it: so no larger λ would be right."""
    for angle in (0.3, 1.0, 1.5):
        T = so_n.jacobian(turned_planes((angle, angle), 4) - np.eye(4), np.eye(4)[0], np.ones(4), np.float64(D))
        lowest = np.linalg.eigvalsh((T + T.T) / 2)[0]
        expected = near_n.least(np.array(angle), np.array(2.0), np.array(D))
        assert abs(lowest - expected) <= 64 * UNIT_ROUNDOFF * (2 + D)
        assert D < 10 or angle < 1 or expected < 0  # far from the identity the form has no sign for a heavy ball


@pytest.mark.parametrize("n", SIZES)
def test_the_momentum_of_a_rotation_has_the_least_size_that_is_said(n):
    rng = np.random.default_rng([2, n])
    J, D, gamma, s = bodies(rng, n, 300)
    for angle in (0.05, 0.8, 1.5, 2.5):
        E = rotations(rng, n, angle, len(D)) - np.eye(n)
        size = np.linalg.norm(so_n.coordinates(so_n.momentum(E, gamma, J, D)), axis=-1)
        half = np.full(len(D), angle / 2)
        assert (size >= 2 * np.sin(half) * near_n.least(half, s, D) - 64 * UNIT_ROUNDOFF * (2 + D)).all()


@pytest.mark.parametrize("n", SIZES)
def test_just_below_the_bound_the_rotation_is_the_proven_one_and_is_near(n):
    rng = np.random.default_rng([3, n])
    J, D, gamma, _ = bodies(rng, n, 6 if n < 8 else 2)
    D = np.minimum(D, 0.5)
    for j, d, g in zip(J, D, gamma, strict=True):
        way = so_n.from_coordinates(rng.normal(size=n * (n - 1) // 2), n)
        scale = 2.0 ** -np.frexp(2 * j.max() + d)[1]
        below, above = 1e-6, 1e3  # the size of the momentum at the bound
        for _ in range(60):
            size = np.sqrt(below * above)
            K = way * size / np.linalg.norm(so_n.coordinates(way))
            known = near_n.bounds(scale * size * np.ones((1, 1)), scale * j[None], scale * d[None])[0][0, 0] > 0
            below, above = (size, above) if known else (below, size)
        K = way * 0.999 * below / np.linalg.norm(so_n.coordinates(way))
        ((near,),), _ = near_n.limits(K[None], j[None], d[None], ONE)
        E = offset((K, g, j, d))
        assert 0 < (E * E).sum() <= near
        assert np.abs(E - proven_branch(K, g, j, d)).max() < 1e-11


def test_beyond_the_bound_and_out_of_range_nothing_is_known():
    K, J = so_n.from_coordinates(np.full((1, 6), 0.1), 4), np.array([[1.0, 2.0, 0.5, 3.0]])
    known = [
        (K, J, 3.0), (1e-30 * K, J, 3.0), (1e-200 * K, 1e-200 * J, 3e-200), (1e200 * K, 1e200 * J, 3e200),
    ]  # fmt: skip
    unknown = [
        (30 * K, J, 3.0), (0 * K, J, 3.0), (1e-300 * K, J, 3.0), (K, J, 1e6), (1e-290 * K, 1e-290 * J, 3e-290),
        (1e290 * K, 1e290 * J, 3e290), (K, J * [[1e-12, 1e-12, 1, 1]], 3.0), (1e300 * K, 1e-8 * J, 0.0),
    ]  # fmt: skip
    for states, sign in ((known, 1), (unknown, -1)):
        for k, j, d in states:
            assert np.sign(near_n.limits(k, j, np.array([d]), ONE)[0]).tolist() == [[sign]], (k, j, d)


@pytest.mark.parametrize(("D", "inside", "outside"), [(0.0, 0.98, 0.99), (2.0, 0.86, 0.88), (10.0, 0.64, 0.66)])
def test_the_bound_is_where_the_page_says(D, inside, outside):
    J, K = np.array([[0.75, 2.0, 0.25, 3.0]]), so_n.from_coordinates(np.eye(6)[:1], 4)
    for size, sign in ((inside, 1), (outside, -1)):
        assert np.sign(near_n.limits(size * K, J, np.array([D]), ONE)[0]) == sign


def test_another_rotation_with_the_momentum_is_not_taken():
    """For equal moments and D = 0 those by θ and by 180° - θ in a plane have one momentum; Newton stays where it is."""
    J, D, gamma, n = np.full(4, 0.25), np.zeros(1), np.eye(4)[3], 4
    small, large = (turned_planes((angle,), n) - np.eye(n) for angle in (0.3, np.pi - 0.3))
    K = so_n.momentum(small, gamma, J, D[0])
    near, enough = (x[0] for x in near_n.limits(K[None], J[None], D, ONE))
    for E, right in ((small, True), (large, False)):
        found, none = E.copy(), np.empty(0)
        ball = loop_n.Under(K, gamma, J, 0.0, ONE, near, enough, none, none, 1.0, none, none, 1.0)
        assert loop_n.settle(ball, K, 0, found, np.empty((6, 6))) == right
        assert np.abs(found - E).max() < 1e-15
