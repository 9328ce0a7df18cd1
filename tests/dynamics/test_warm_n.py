"""Steps in n dimensions from a guess: as accurate as one by one, with the same bits however they are taken."""

import numpy as np
import pytest
from balls_n import UNIT_ROUNDOFF, batch
from budget import slow
from crowds import NAMES, same
from extremes_n import FOUR, truth_n
from plain import in_plain_python

from chapsym import BallN, Digits, Status, StepNotTaken, step_n, substeps, trajectory_n
from chapsym.dynamics.n import run_n, so_n
from chapsym.dynamics.n.branch_n import small_rotation
from chapsym.dynamics.n.near_n import limits
from research.extremes.judging import BUDGET
from research.extremes.states import State

ONE = np.ones(1)
#: With so small a factor some corrections of the first ball are small enough, and some not.
STUBBORN = {3: 1.6e-17, 4: 3e-17, 5: 3e-17, 8: 6e-17}


def alone(ball, i):
    return BallN(ball.mass_tensor[i], ball.D[i], radius=ball.radius[i])


def asking(patch, *factors):
    """Of the ball i it is asked that the last correction be smaller by the factor i of its square."""

    def asked(*balls):
        near, enough = limits(*balls)
        return near, enough * np.array(factors)[: len(enough), np.newaxis]

    patch.setattr(run_n, "limits", asked)


@pytest.mark.parametrize(
    ("n", "order", "stubborn"),
    [
        (3, 2, True), (4, 4, True), *slow((4, 2, False), (5, 2, True), (8, 2, False)),
        *slow((3, 2, False), (3, 4, True), (4, 2, True), (5, 2, False), (5, 4, True), (8, 2, True), (8, 4, True)),
    ],
)  # fmt: skip
def test_compiled_and_in_python_one_ball_and_a_batch_have_the_same_bits(n, order, stubborn, monkeypatch):
    """Two balls are stubborn: of some of their stages, or of all, the corrections are not as small as is asked."""
    ball, K, gamma = batch(n, 5, 0.1)
    if stubborn:
        asking(monkeypatch, STUBBORN[n], 0, 1, 1, 1)
    stages = substeps(order)
    assert (limits(K, ball.mass_tensor, ball.D, stages)[0] > 0).all()
    safe, taken = [], run_n._safely
    monkeypatch.setattr(run_n, "_safely", lambda *at: safe.append(1) or taken(*at))
    steps = (20 if n == 8 else 60) if not stubborn else 30 if order == 2 else 15
    work = steps * len(stages)
    with in_plain_python():
        slow = trajectory_n(ball, K, gamma, steps, order=order, every=5, contact=True)
    in_python = len(safe)
    fast = trajectory_n(ball, K, gamma, steps, order=order, every=5, contact=True)
    assert same(slow, fast)
    assert len(safe) == 2 * in_python
    assert work < in_python < 2 * work if stubborn else not safe
    one = trajectory_n(alone(ball, 0), K[0], gamma[0], steps, order=order, every=5, contact=True)
    assert all((getattr(one, name) == getattr(fast, name)[0]).all() for name in NAMES)


@pytest.mark.parametrize("order", [2, 6])
def test_the_safe_way_takes_the_same_stages(order, monkeypatch):
    """Each by the continuation: beside the guesses some ulps a stage."""
    ball, K, gamma = batch(4, 1, 0.1)
    whole = trajectory_n(ball, K, gamma, 5, order=order, contact=True)
    asking(monkeypatch, 0)
    calls, taken = [], run_n._safely
    monkeypatch.setattr(run_n, "_safely", lambda *at: calls.append(1) or taken(*at))
    safe = trajectory_n(ball, K, gamma, 5, order=order, contact=True)
    assert len(calls) == 5 * len(substeps(order))
    allowed = 16 * UNIT_ROUNDOFF * len(calls)
    assert all(np.abs(getattr(whole, name) - getattr(safe, name)).max() <= allowed for name in NAMES)


def test_how_a_run_is_cut_and_what_is_kept_does_not_matter(monkeypatch):
    ball, K, gamma = batch(4, 3, 0.1)
    whole = trajectory_n(ball, K, gamma, 300, contact=True)
    monkeypatch.setattr(run_n, "CHUNK", 7)
    assert same(whole, trajectory_n(ball, K, gamma, 300, contact=True))
    few = trajectory_n(ball, K, gamma, 300, every=150)
    assert (few.momentum == whole.momentum[:, ::150]).all()
    assert (few.gamma == whole.gamma[:, ::150]).all()


@pytest.mark.parametrize("condition", FOUR)
def test_each_step_is_as_accurate_as_one_of_its_own(condition):
    """𝒦 and γ within the budget of a step in the study of the extremes, beside mpmath; γ of the frame is not unit."""
    served = 0
    for start in FOUR[condition]:
        J, D, gamma = start.J, start.D, start.g
        K = 0.3 * so_n.from_coordinates(np.array(start.K), 4)
        served += (limits(K[None], np.array([J]), np.array([D]), ONE)[0] > 0).sum()
        run = trajectory_n(BallN(J, D), K, gamma, 13)
        for k in (0, 12):
            state = State(J, D, tuple(so_n.coordinates(run.momentum[k])), tuple(run.gamma[k]))
            E, after, vertical, kappa = truth_n(state)
            budget = BUDGET * UNIT_ROUNDOFF * (1 + float(max(map(abs, E))) * kappa)
            if k == 0:
                turn = step_n(BallN(J, D), K, gamma).rotation - np.eye(4)
                assert max(abs(float(a - b)) for a, b in zip(E, turn.flat, strict=True)) <= budget
            off = max(abs(float(a - b)) for a, b in zip(after, run.momentum[k + 1].flat, strict=True))
            assert off <= budget * np.abs(K).max()
            assert max(abs(float(a - b)) for a, b in zip(vertical, run.gamma[k + 1], strict=True)) <= budget
    others = {"D = 1e6", "D = 1e12", "at rest", "momentum 1e-300", "momentum 5e-320", "ratios of 1e12"}
    assert bool(served) == (condition not in others)


@pytest.mark.usefixtures("way")
def test_a_step_is_the_first_of_a_trajectory():
    """Of balls below the bound and above it, and with the rotation that the attitude takes."""
    ball, K, gamma = batch(4, 4, 0.1)
    K *= np.array([1.0, 12.0, 0.0, 1e-40])[:, None, None]
    run = trajectory_n(ball, K, gamma, 3, attitude=True)
    step = step_n(ball, K, gamma)
    assert (step.status == Status.TAKEN).all()
    assert (step.momentum == run.momentum[:, 1]).all()
    assert (step.gamma == run.gamma[:, 1]).all()
    assert np.abs(run.attitude[:, 0] @ step.rotation - run.attitude[:, 1]).max() <= 8 * UNIT_ROUNDOFF
    E, _, _ = small_rotation(K, gamma, ball.mass_tensor, ball.D)
    assert np.abs(step.rotation - (np.eye(4) + E)).max() <= 8 * UNIT_ROUNDOFF


def test_a_ball_that_stops_stops_alone(monkeypatch):
    """The safe way refuses its step 20: what it returns is not known to be met by any ball below the bound."""
    ball, K, gamma = batch(4, 3, 0.1)
    whole = trajectory_n(ball, K, gamma, 40, contact=True)
    asking(monkeypatch, 0, 1, 1)
    calls, taken = [], run_n.small_rotation

    def refusing(*ball):
        calls.append(1)
        E, status, reach = taken(*ball)
        return (E, np.array([Status.FOLDED]), np.array([0.5])) if len(calls) == 20 else (E, status, reach)

    monkeypatch.setattr(run_n, "small_rotation", refusing)
    run = trajectory_n(ball, K, gamma, 40, contact=True)
    assert run.status.tolist() == [Status.FOLDED, Status.TAKEN, Status.TAKEN]
    assert run.taken.tolist() == [19, 40, 40]
    assert np.isfinite(run.contact[0, :20]).all()
    assert np.isnan(run.contact[0, 20:]).all()
    assert (run.momentum[1:] == whole.momentum[1:]).all()
    calls.clear()
    with pytest.raises(StepNotTaken) as caught:
        trajectory_n(alone(ball, 0), K[0], gamma[0], 40)
    assert (caught.value.index, caught.value.reach) == (19, 0.5)


def test_balls_above_the_bound_go_beside_those_below():
    ball, K, gamma = batch(4, 4, 0.1)
    K *= np.array([12.0, 12.0, 12.0, 0.0])[:, None, None]
    near = limits(K, ball.mass_tensor, ball.D, ONE)[0]
    assert (near > 0).tolist() == [[True], [False], [False], [False]]
    seen = []
    run = trajectory_n(ball, K, gamma, 30, contact=True, progress=seen.append)
    assert run.status.tolist() == [Status.TAKEN, Status.TAKEN, Status.FOLDED, Status.TAKEN]
    assert seen[-1] == run.taken.sum()
    assert seen == sorted(seen)
    one = trajectory_n(alone(ball, 0), K[0], gamma[0], 30, contact=True)
    assert all((getattr(one, name) == getattr(run, name)[0]).all() for name in NAMES)
    step = step_n(alone(ball, 1), run.momentum[1, 9], run.gamma[1, 9])
    assert np.abs(step.momentum - run.momentum[1, 10]).max() <= 16 * UNIT_ROUNDOFF * np.abs(K).max()
    assert (run.gamma[3] == gamma[3]).all()


def test_steps_in_many_digits_are_counted_one_by_one():
    ball, K, gamma = batch(4, 2, 0.1)
    seen = []
    trajectory_n(ball, K, gamma, 3, precision=Digits(20), progress=seen.append)
    assert seen == [2, 4, 6]
