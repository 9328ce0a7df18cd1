"""Each reduction agrees with the full model to roundoff, and serves where it says."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from rolled import rolled

import chapsym
from chapsym.dynamics import Status, kernels
from chapsym.dynamics.closed import top
from chapsym.scene.members.members import Members
from chapsym.scene.plan import models
from chapsym.scene.plan.models import Rolling, Steady, Top, Vertical
from chapsym.scene.plan.plan import planned
from chapsym.scene.read.task import Task

EPS = 2.0**-53
CUT = [slice(0, 10), slice(10, 101)]
COLUMNS = ("momentum", "gamma", "attitude", "contact")


@pytest.fixture
def homogeneous():
    rng = np.random.default_rng(6)
    n = 5
    moment = rng.uniform(0.5, 2.0, n)
    ball = chapsym.Ball(np.repeat(moment[:, np.newaxis], 3, axis=1), rng.uniform(0, 5, n), rng.uniform(0.1, 1, n))
    gamma = rng.normal(size=(n, 3))
    gamma /= np.linalg.norm(gamma, axis=1, keepdims=True)
    place = rng.normal(size=(n, 2))
    return Members(tuple("abcde"), ball, 0.3 * rng.normal(size=(n, 3)), gamma, place=place)


@pytest.fixture
def vertical():
    ball = chapsym.Ball(np.array([[1, 2, 4], [0.5, 2, 3], [1, 1.5, 4]]), np.array([7.0, 0.0, 3.0]))
    gamma = np.array([[2, 3, 6], [6, -2, 3], [-3, 6, 2]]) / 7
    return Members(tuple("abc"), ball, np.array([[0.8], [-0.7], [1.1]]) * gamma, gamma)


def test_steady_rotation_is_the_map(homogeneous):
    steps = 100_000
    plan = planned(homogeneous, Task(COLUMNS, steps, 999))
    assert plan.model.name == Steady.name
    direct, end = rolled(plan, [slice(0, 10), slice(10, plan.frames)])
    stepped, also = rolled(replace(plan, model=Rolling()))
    assert (end["taken"] == also["taken"]).all()
    for name in COLUMNS:  # the steps' roundings add up: an ulp a step at most
        length = 1 if name in ("gamma", "attitude") else np.abs(stepped[name]).max()
        assert np.abs(direct[name] - stepped[name]).max() <= 2 * steps * EPS * length


def test_a_steady_ball_beyond_its_fold_stops_at_once(homogeneous):
    plan = planned(replace(homogeneous, momentum=40 * homogeneous.momentum), Task(COLUMNS, 10))
    columns, state = rolled(replace(plan, model=Steady()))
    assert (state["status"] != Status.TAKEN).any()
    stopped = state["status"] != Status.TAKEN
    assert (state["taken"] == np.where(stopped, 0, 10)).all()
    assert np.isnan(columns["gamma"][stopped, 1:]).all()
    assert not np.isnan(columns["gamma"][:, 0]).any()


@pytest.mark.parametrize("changed", [{"order": 4}, {"precision": "single"}])
def test_a_reduction_is_of_the_map_of_order_2_in_float64_and_says_what_it_is_not_of(homogeneous, vertical, changed):
    task = Task(("gamma",), 10**6, 10**5)
    assert planned(homogeneous, task).model.name == Steady.name
    tensor = homogeneous.ball.mass_tensor.copy()
    tensor[3, 0] = np.nextafter(tensor[3, 0], 9)
    some = replace(homogeneous, ball=chapsym.Ball(tensor, homogeneous.ball.D, homogeneous.ball.radius))
    for plan, model, said in (
        (planned(homogeneous, replace(task, **changed)), Steady, "it has order 2 and float64 only"),
        (planned(vertical, Task(("gamma", "attitude"), 10)), Vertical, "it does not follow attitude"),
        (planned(some, Task(COLUMNS, 10)), Steady, "d has unequal moments"),
    ):
        assert plan.model.name == Rolling.name
        assert said in plan.refused[model.name]


@pytest.mark.parametrize(("every", "last"), [(10, 40), (9, 41)])
def test_frames_at_once_count_their_steps(homogeneous, every, last):
    task, counted = Task(("gamma",), last, every), []
    Steady().advance(homogeneous, task, frozenset({"gamma"}), {}, slice(0, task.frames), counted.append)
    assert counted == [len(homogeneous) * last]


def test_vertical_momentum_is_the_map(vertical):
    steps = 2000
    plan = planned(vertical, Task(("momentum", "gamma"), steps, 3))
    assert plan.model.name == Vertical.name
    reduced, end = rolled(plan, [slice(0, 100), slice(100, plan.frames)])
    stepped, also = rolled(replace(plan, model=Rolling()))
    assert (end["taken"] == also["taken"]).all()
    for name in ("momentum", "gamma"):  # both drift along the curve, by some roundings a step
        assert np.abs(reduced[name] - stepped[name]).max() <= 10 * steps * EPS


def test_the_phase_is_that_of_the_curve_and_turns_by_the_rotation_number(vertical):
    steps = 3000
    plan = planned(vertical, Task(("gamma", "phase", "rotation_number"), steps))
    columns, _ = rolled(plan)
    for i in range(3):
        ball = chapsym.Ball(vertical.ball.mass_tensor[i], vertical.ball.D[i])
        curve = chapsym.Curve.through(ball, vertical.gamma[i])
        assert np.abs(curve.point(columns["phase"][i]) - columns["gamma"][i]).max() < 1e-12
        turned = np.unwrap(columns["phase"][i], period=curve.period)
        # The mean over N steps is off by a bounded part of a turn over N.
        assert abs((turned[-1] - turned[0]) / curve.period / steps - columns["rotation_number"][i]) < 1 / steps


@pytest.fixture
def tops():
    ball = chapsym.Ball(np.array([[1, 2, 4], [0.5, 2, 3], [1, 1, 2.5]]), np.zeros(3))
    gamma = np.array([[2, 3, 6], [6, -2, 3], [-3, 6, 2]]) / 7
    return Members(tuple("abc"), ball, np.array([[0.3, -0.2, 0.5], [0.1, 0.9, 0.2], [0.4, 0.1, -0.6]]), gamma)


def test_the_discrete_top_is_the_map(tops):
    """Against 31 digits: in float64 the roundings walk across the levels, and what they make of the phase adds up."""
    steps = 100_000
    plan = planned(tops, Task(("momentum", "gamma", "attitude"), steps, 9_999))
    assert plan.model.name == Top.name
    direct, end = rolled(plan, [slice(0, 3), slice(3, plan.frames)])
    start = tops.ball, tops.momentum, tops.gamma
    exact = chapsym.trajectory(*start, steps, every=9_999, attitude=True, precision="double-double")
    assert (end["taken"] == exact.taken).all()
    sign = np.sign((direct["attitude"] * exact.attitude).sum(axis=-1, keepdims=True))  # both are the same attitude
    direct["attitude"] *= sign
    for name in ("momentum", "gamma", "attitude"):
        assert np.abs(direct[name] - getattr(exact, name)).max() <= 64 * EPS


def test_a_top_needs_no_gamma_for_its_energy(tops):
    plan = planned(tops, Task(("energy", "omega"), 10**6, 10**5, 0.01))
    assert (plan.model.name, plan.needed) == (Top.name, {"momentum"})
    columns, _ = rolled(plan)
    assert np.abs(columns["energy"] / columns["energy"][:, :1] - 1).max() < 1e-14
    full, _ = rolled(planned(tops, Task(("omega", "gamma"), 10**6, 10**5, 0.01)))
    assert np.abs(full["omega"] - columns["omega"]).max() <= 8 * EPS * np.abs(full["omega"]).max()


def test_the_cheaper_of_two_models_is_taken_and_the_balls_of_a_dearer_one_are_not_looked_at(tops, monkeypatch):
    few = planned(tops, Task(("momentum",), 1000))
    assert few.model.name == Rolling.name
    assert few.refused[Top.name].startswith("it would cost ")
    assert planned(tops, Task(("momentum",), 10**7, 10**5)).model.name == Top.name
    for outputs in (("rotation_number",), ("rotation_number", "gamma")):  # which is not found step by step
        assert planned(tops, Task(outputs, 3000, 100)).model.name == Top.name
    monkeypatch.setattr("chapsym.scene.plan.models.motion_of", None)
    plan = planned(tops, Task(("momentum",), 10))
    assert plan.model.name == Rolling.name
    assert "times as much" in plan.refused[Top.name]


def test_the_phase_of_a_top_is_that_of_its_curve(tops):
    columns, _ = rolled(planned(tops, Task(("momentum", "phase", "rotation_number"), 500, 5)))
    for i in range(3):
        K, ball = tops.momentum[i], chapsym.Ball(tops.ball.mass_tensor[i], 0)
        size = np.linalg.norm(K)
        curve = chapsym.Curve.through(ball, K / size)
        assert np.abs(size * curve.point(columns["phase"][i]) - columns["momentum"][i]).max() < 1e-13
        turns = chapsym.rotation_number(ball, size, K / size)
        assert columns["rotation_number"][i] == pytest.approx(turns, rel=1e-12)


def test_a_phase_is_refused_where_there_is_no_curve_and_beside_the_vertical(vertical):
    beside = vertical.momentum.copy()
    beside[1, 0] += 1e-14
    with pytest.raises(chapsym.BadInput, match="momentum of b is not along γ"):
        planned(replace(vertical, momentum=beside), Task(("phase",), 10))
    assert planned(replace(vertical, momentum=beside), Task(("gamma",), 10)).model.name == Rolling.name
    along = np.tile([0.0, 0.0, 1.0], (3, 1))
    with pytest.raises(chapsym.BadInput, match="the map fixes this gamma"):
        planned(replace(vertical, gamma=along, momentum=0.5 * along), Task(("phase",), 10))


def test_the_rotation_number_without_D_is_the_increment_and_with_D_that_of_any_point():
    ball, gamma = chapsym.Ball((1, 2, 4), 0), np.array([2, 3, 6]) / 7
    curve = chapsym.Curve.through(ball, gamma)
    for h in (0.5, -0.02, 2.0):
        turn = float(chapsym.increment(curve, h, 0.0)) / curve.period
        assert chapsym.rotation_number(ball, h, gamma) == pytest.approx(turn, rel=1e-13)
    ball, gamma = chapsym.Ball((1, 2, 4), 7), np.array([2, 3, 6]) / 7
    curve = chapsym.Curve.through(ball, gamma)
    found = [chapsym.rotation_number(ball, 2.0, curve.point(u)) for u in (0.0, 0.3, 1.7)]
    assert max(found) - min(found) < 1e-11
    assert found[0] != pytest.approx(float(chapsym.increment(curve, 2.0, 0.0)) / curve.period, rel=1e-6)


def test_a_top_without_an_attitude_at_once_takes_its_steps(tops, monkeypatch):
    task = Task(("gamma",), 1_000_000, 100_000)
    assert planned(tops, task).model.name == Top.name
    monkeypatch.setattr(top, "MOST", 0)
    plan = planned(tops, task)
    assert plan.model.name == Rolling.name
    assert "too near to the separatrix" in plan.refused[Top.name]
    assert planned(tops, replace(task, outputs=("momentum",))).model.name == Top.name


def test_a_ball_beyond_its_fold_has_no_rotation_number_and_the_others_theirs(vertical):
    wild = replace(vertical, momentum=vertical.momentum * np.array([[50.0], [1.0], [1.0]]))
    task = Task(("gamma", "rotation_number"), 100)
    plan = planned(wild, task)
    columns, state = rolled(plan, CUT)
    assert plan.model.name == Vertical.name
    assert state["status"].tolist()[1:] == [0, 0]
    assert np.isnan(columns["rotation_number"]).tolist() == [True, False, False]
    alone, _ = rolled(planned(vertical, task), CUT)
    for name in task.outputs:
        assert (columns[name][1:] == alone[name][1:]).all()


@pytest.mark.parametrize("apart", [1e-11, -3e-12])
def test_next_to_the_separatrix_a_phase_is_as_good_as_the_roundings_leave_it(apart):
    ball = chapsym.Ball(np.array([[1.0, 2.0, 4.0]]), np.array([3.0]))
    # ⟨γ,Λ⁻¹γ⟩ = 1/Λ₂ for Λ = (9, 8, 6) where γ₁²/9 = γ₃²/3
    gamma = np.array([[1.0, 0.5, np.sqrt(1 / 3) * (1 + apart)]])
    gamma /= np.sqrt((gamma**2).sum())
    near = Members(("near",), ball, gamma, gamma)
    columns, state = rolled(planned(near, Task(("gamma", "phase", "rotation_number"), 100_000, 10)))
    assert state["status"] == 0
    curve = chapsym.Curve.through(chapsym.Ball((1, 2, 4), 3), gamma[0])
    assert np.abs(curve.point(columns["phase"][0]) - columns["gamma"][0]).max() < 1e-13 / curve.complement
    assert np.isfinite(columns["rotation_number"])


def test_a_given_attitude_is_that_of_the_first_frame(homogeneous, tops):
    for members in (homogeneous, tops):
        spun = np.broadcast_to([0.6, 0.0, 0.0, 0.8], (len(members), 4))
        attitude = kernels.compose(spun, Rolling().attitude(members))
        plan = planned(replace(members, attitude=attitude), Task(("attitude",), 100_000_000, 50_000_000))
        assert plan.model.name in (Steady.name, Top.name)
        for model in (plan.model, Rolling()):
            start, _ = rolled(replace(plan, task=Task(("attitude",), 5, 5), model=model))
            assert np.abs(start["attitude"][:, 0] - attitude).max() < EPS * 2


def test_a_top_near_the_separatrix_is_followed_step_by_step_where_its_attitude_would_lose_digits():
    K, gamma = np.array([[1e-4, 0.5, 0]]), np.array([[0, 0, 1.0]])
    some = Members(("a",), chapsym.Ball(np.array([[1.0, 2.0, 4.0]]), [0.0]), K, gamma)
    assert chapsym.Curve.through(chapsym.Ball((1, 2, 4), 0), K[0] / np.linalg.norm(K)).complement < 1e-3
    plan = planned(some, Task(("momentum", "gamma", "attitude"), 10**7, 10**6))
    assert plan.model.name == Rolling.name
    assert plan.refused[Top.name] == "a is near the separatrix, where an attitude at once loses digits"
    assert planned(some, Task(("momentum",), 10**7, 10**6)).model.name == Top.name


def test_31_digits_of_attitude_and_contact():
    run = {"time_step": 0.01, "steps": 20, "precision": "double-double", "outputs": ["gamma", "attitude", "contact"]}
    body = {"inertia": [0.006, 0.007, 0.009], "mass": 2, "radius": 0.1}
    start = {"omega": [3, -2, 1], "gamma": ["2/7", "3/7", "6/7"]}
    origin = chapsym.run_scene({"ball": body, "start": start, "run": run}).dataset.isel(ball=0)
    moved = {**start, "position": ["1/3", -2.7]}
    placed = chapsym.run_scene({"ball": body, "start": moved, "run": run}).dataset.isel(ball=0)

    def exact(data, name):
        return np.vectorize(Fraction)(data[name].values) + np.vectorize(Fraction)(data[f"{name}_low"].values)

    w, x, y, z = exact(origin, "attitude").T
    up = np.stack([2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z], -1)
    assert abs(up - exact(origin, "gamma")).max() < 1e-30
    place = np.array([Fraction(1 / 3), Fraction(-2.7)])
    assert abs(exact(placed, "contact") - exact(origin, "contact") - place).max() < 1e-30


def test_a_rotation_number_is_computed_once_for_all_segments(vertical, monkeypatch):
    asked = []
    real = chapsym.rotation_number
    monkeypatch.setattr(models.dynamics, "rotation_number", lambda *of: asked.append(of) or real(*of))
    columns, _ = rolled(planned(vertical, Task(("rotation_number", "gamma"), 30)), [slice(0, 9), slice(9, 31)])
    assert len(asked) == 3
    assert np.isfinite(columns["rotation_number"]).all()
