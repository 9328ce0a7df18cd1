"""A ball with an inertia tensor: what is given and returned is in its axes, as by hand with the whole tensor."""

import pickle
from contextlib import nullcontext
from fractions import Fraction
from inspect import Parameter, isfunction, signature

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import chapsym
from chapsym import BadInput, Ball
from chapsym.accuracy import accurate
from chapsym.accuracy.discretisation import discretisation
from chapsym.dynamics import kernels
from chapsym.dynamics.attitudes import attitude_with

EPS = np.finfo(np.float64).eps
TENSOR = np.array([[0.0301, 0.001, -0.0004], [0.001, 0.0312, 0.0007], [-0.0004, 0.0007, 0.0318]])
KEYS = {"mass": 7.0, "radius": 0.1085}
BALL = Ball.from_inertia(TENSOR, **KEYS)
OMEGA, GAMMA = np.array([2.0, 30.0, 5.0]), np.array([2.0, 3.0, 6.0]) / 7
TURN = np.array([0.5, -0.1, 0.7, 0.5])
FAR = Ball.from_inertia([[6.0, 0.5, -0.3], [0.5, 5.0, 0.2], [-0.3, 0.2, 3.5]], D=3.0)
STATE = {"momentum": (1.0, -0.5, 0.75), "gamma": GAMMA}


def by_hand(tensor, D, omega, gamma):
    """K = Iω + D(ω - ⟨ω,γ⟩γ) with the whole tensor."""
    return omega @ tensor + D * (omega - (omega * gamma).sum(axis=-1, keepdims=True) * gamma)


def matrix(quaternion):
    return np.stack([kernels.rotate(quaternion, e) for e in np.eye(3)], axis=-1)


MOMENTUM = 1e-3 * by_hand(TENSOR, float(BALL.D), OMEGA, GAMMA)


def test_the_tensor_is_that_of_its_principal_moments_in_its_axes():
    Q = matrix(BALL.axes)
    np.testing.assert_allclose(Q @ np.diag(BALL.inertia) @ Q.T, TENSOR, atol=8 * EPS * 0.03)
    assert BALL.D == 7.0 * 0.1085**2
    assert BALL.mass_tensor.shape == (3,)
    assert BALL.principal.axes is None
    assert BALL.principal.inertia.tolist() == BALL.inertia.tolist()
    assert pickle.loads(pickle.dumps(BALL)) == BALL != BALL.principal
    assert (Ball(BALL.mass_tensor, BALL.D, BALL.radius, BALL.axes).axes == BALL.axes).all()


def test_vectors_go_to_principal_axes_and_back():
    there = BALL.to_principal(OMEGA)
    np.testing.assert_allclose(there, matrix(BALL.axes).T @ OMEGA, atol=16 * EPS * 30)
    np.testing.assert_allclose(BALL.from_principal(there), OMEGA, atol=16 * EPS * 30)
    several = Ball.from_inertia([TENSOR, np.diag([2.0, 3.0, 4.0])], D=1)
    frames = np.random.default_rng(5).normal(size=(2, 7, 3))
    turned = several.to_principal(frames, frames=True)
    assert (turned[0] == BALL.to_principal(frames[0])).all()
    assert (turned[1] == frames[1]).all()
    assert several.to_principal(OMEGA).shape == (2, 3)
    assert (BALL.to_principal([Fraction(x) for x in OMEGA]) == there).all()
    same = BALL.principal.to_principal(OMEGA)
    assert same.tolist() == OMEGA.tolist()
    assert not np.shares_memory(same, OMEGA)
    with pytest.raises(BadInput, match=r"vectors must be real numbers of the shape \(\.\.\., 3\), not \(1, 2\)"):
        BALL.to_principal((1, 2))
    with pytest.raises(BadInput, match="the leading axes of the axes of the ball and the vectors do not broadcast"):
        several.to_principal(np.ones((3, 3)))


def test_the_motion_is_that_of_the_equations_with_the_whole_tensor():
    D = float(BALL.D)

    def rates(t, state):
        K, gamma = state[:3], state[3:]
        omega = np.linalg.solve(TENSOR + D * (np.eye(3) - np.outer(gamma, gamma)), K)
        return np.concatenate([np.cross(K, omega), np.cross(gamma, omega)])

    start = np.concatenate([by_hand(TENSOR, D, OMEGA, GAMMA), GAMMA])
    exact = solve_ivp(rates, (0, 0.5), start, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
    run = chapsym.trajectory(BALL, 2e-3 * start[:3], GAMMA, 250, order=8, time_step=2e-3)
    np.testing.assert_allclose(run.angular_momentum()[-1], exact[:3], atol=1e-9)
    np.testing.assert_allclose(run.gamma[-1], exact[3:], atol=1e-9)
    omega = np.linalg.solve(TENSOR + D * (np.eye(3) - run.gamma[..., None] * run.gamma[:, None]),
                            run.angular_momentum()[..., None])[..., 0]  # fmt: skip
    energy = (run.angular_momentum() * omega).sum(axis=-1) / 2
    np.testing.assert_allclose(run.kinetic_energy(), energy, rtol=64 * EPS)
    assert run.ball is BALL
    rolled = chapsym.roll(BALL, OMEGA, 1e-3, 2, gamma=GAMMA)
    np.testing.assert_allclose(rolled.momentum[0], MOMENTUM, rtol=16 * EPS)
    longer = chapsym.extrapolate(BALL, start[:3], GAMMA, 0.01, 50, attitude=True)
    np.testing.assert_allclose(longer.angular_momentum, exact[:3], atol=1e-9)
    np.testing.assert_allclose(kernels.rotate(longer.attitude, longer.gamma), [0, 0, 1], atol=1e-13)


@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize("attitude", [False, True, "given"])
def test_a_body_that_is_turned_in_its_axes_rolls_the_same_way(precision, attitude):
    """Attitudes are of the given axes, so the contact point does not know in which axes the tensor is given."""
    Q = matrix(TURN)
    turned = Ball.from_inertia(Q @ TENSOR @ Q.T, **KEYS)
    first = attitude_with(GAMMA)
    options = {"contact": True, "time_step": 1e-3, "precision": precision}
    tolerance = 1e-3 if precision == "single" else 1e-12
    run = chapsym.trajectory(BALL, MOMENTUM, GAMMA, 100, attitude=first if attitude == "given" else attitude, **options)
    np.testing.assert_allclose(run.attitude[0], first, atol=4 * EPS if precision == "double" else 1e-6)
    same = chapsym.trajectory(
        turned, Q @ MOMENTUM, Q @ GAMMA, 100, attitude=kernels.compose(first, TURN * [1, -1, -1, -1]), **options
    )
    np.testing.assert_allclose(same.momentum, run.momentum @ Q.T, atol=tolerance * 1e-2)
    np.testing.assert_allclose(same.gamma, run.gamma @ Q.T, atol=tolerance)
    np.testing.assert_allclose(same.contact, run.contact, atol=tolerance)
    np.testing.assert_allclose(kernels.rotate(same.attitude, same.gamma), [[0, 0, 1]] * 101, atol=tolerance)
    np.testing.assert_allclose(same.kinetic_energy(), run.kinetic_energy(), rtol=tolerance)
    assert {x.dtype for x in (run.momentum, run.gamma, run.attitude)} == {np.dtype(f"f{8 if tolerance < 1e-6 else 4}")}


def test_a_step_is_the_first_of_a_trajectory_its_rotation_turns_gamma_and_there_is_a_way_back():
    step, run = chapsym.step(FAR, **STATE), chapsym.trajectory(FAR, **STATE, steps=1)
    assert step.momentum.tolist() == run.momentum[1].tolist()
    assert step.gamma.tolist() == run.gamma[1].tolist()
    np.testing.assert_allclose(kernels.transport(step.rotation, GAMMA), step.gamma, atol=8 * EPS)
    np.testing.assert_allclose(kernels.transport(step.rotation, np.array(STATE["momentum"])), step.momentum, atol=1e-15)
    there = chapsym.trajectory(FAR, **STATE, steps=50, attitude=True)
    back = chapsym.reverse(there)
    assert back.ball is FAR
    assert chapsym.retrace_error(there, back).max() < 1e-12
    finer = chapsym.compose_step(FAR, **STATE, order=4)
    np.testing.assert_allclose(finer.gamma, chapsym.trajectory(FAR, **STATE, steps=1, order=4).gamma[1], atol=8 * EPS)


def test_frames_before_a_fold_are_in_the_given_axes_and_later_ones_are_not_numbers():
    ball, K = FAR, 4.0 * np.array(STATE["momentum"])
    with pytest.raises(chapsym.StepNotTaken) as raised:
        chapsym.trajectory(ball, K, GAMMA, 200)
    stopped, frames = raised.value, raised.value.trajectory
    assert stopped.index > 0
    assert frames.ball is ball
    np.testing.assert_allclose(frames.momentum[0], K, rtol=8 * EPS)
    again = chapsym.step(ball, frames.momentum[0], frames.gamma[0])
    np.testing.assert_allclose(frames.momentum[1], again.momentum, rtol=1e-13)
    batch = chapsym.trajectory(ball, [K, K / 100], GAMMA, 200)
    assert np.isnan(batch.momentum[0, stopped.index + 1 :]).all()
    assert np.isfinite(batch.momentum[1]).all()
    with pytest.raises(chapsym.StepNotTaken):
        chapsym.step(ball, 1e6 * K, GAMMA)


def test_a_batch_of_tensors_is_each_of_them():
    tensors = np.stack([TENSOR, np.diag([0.03, 0.031, 0.032]), TENSOR[::-1, ::-1]])
    balls = Ball.from_inertia(tensors, mass=(7.0, 6.0, 5.0), radius=0.1085)
    assert balls.mass_tensor.shape == (3, 3)
    assert balls.axes[1].tolist() == [1, 0, 0, 0]
    runs = chapsym.roll(balls, OMEGA, 1e-3, 20, gamma=GAMMA, contact=True)
    for i, (tensor, mass) in enumerate(zip(tensors, (7.0, 6.0, 5.0), strict=True)):
        one = Ball.from_inertia(tensor, mass=mass, radius=0.1085)
        run = chapsym.roll(one, OMEGA, 1e-3, 20, gamma=GAMMA, contact=True)
        np.testing.assert_allclose(runs.momentum[i], run.momentum, rtol=0, atol=1e-15)
        np.testing.assert_allclose(runs.contact[i], run.contact, rtol=0, atol=1e-14)
        np.testing.assert_allclose(runs.kinetic_energy()[i], run.kinetic_energy(), rtol=1e-13)
    assert chapsym.roll(BALL, [OMEGA, 2 * OMEGA], 1e-3, 5, contact=True).attitude.shape == (2, 6, 4)
    turns = Ball((1, 2, 4), 3, axes=[[1, 0, 0, 0], TURN])
    assert turns.mass_tensor.shape == (2, 3)
    assert chapsym.step(turns, **STATE).gamma.shape == (2, 3)


def test_a_diagonal_tensor_is_its_moments_and_rows_are_a_batch_where_they_are_no_tensor_or_are_said_to_be_one():
    ball = Ball.from_inertia(np.diag([6.0, 5.0, 3.0]), D=3)
    assert (ball.axes, ball.mass_tensor.tolist()) == (None, [1, 2, 4])
    assert Ball.from_inertia(np.diag([0.1, 0.2, 0.1 + 0.2]), D=1).mass_tensor.min() == 0
    rows = [[6.0, 5.0, 3.0], [4.0, 4.0, 2.0], [3.0, 3.0, 3.0]]
    assert Ball.from_inertia(rows, D=1).inertia.tolist() == rows
    assert Ball.from_inertia([[2, 2, 2]] * 3, D=1, batch=True).inertia.tolist() == [[2, 2, 2]] * 3
    assert Ball.from_inertia([[2, 2, 2]] * 4, D=1).mass_tensor.shape == (4, 3)
    assert Ball.from_inertia([[[2, 2, 2]] * 3] * 2, D=1, batch=True).mass_tensor.shape == (2, 3, 3)


@pytest.mark.parametrize(
    ("build", "sentence"),
    [
        (
            lambda: Ball.from_inertia([[2, 2, 2]] * 3, D=1),
            # Two principal moments are equal: no axis is nearer than another, and LAPACK's order is the processor's.
            r"the inertia \((0, 0, 6|0, 6, 0|6, 0, 0)\).*; if each row is the",
        ),
        (lambda: Ball.from_inertia(np.diag([1.0, 1, 3]), D=1), r"no body has the inertia \(1, 1, 3\)[^;]*$"),
        (lambda: Ball.from_inertia([[2, 0.1, 0], [0.2, 3, 0], [0, 0, 4]], D=1), r"\(2, 0\.1, 0\).*symmetric.* by 0\.1"),
        (lambda: Ball.from_inertia([[2, -0.1, 0], [0.1, 3, 0], [0, 0, 4]], D=1), r"moment -0\.1; if it is a tens"),
        (lambda: Ball.from_inertia([TENSOR, np.triu(TENSOR)], D=1), "if it is a tensor, it must be symmetric"),
        (lambda: Ball.from_inertia(1.7e308 * (np.eye(3) + 1e-3), D=1), "inertia is beyond the range of float64"),
        (lambda: Ball((1, 2, 4), 3, axes=(1, 1, 0, 0)), "axes must be unit quaternions"),
        (lambda: Ball([(1, 2, 4)] * 3, 3, axes=[TURN, TURN]), "leading axes of mass_tensor and axes do not broadcast"),
        (lambda: Ball((1, 2, 4), [3] * 3, axes=[TURN, TURN]), "mass_tensor, D, radius and axes do not broadcast"),
        (lambda: chapsym.step(FAR, **STATE, precision="double-double"), "are kept in principal axes"),
        (lambda: chapsym.step(FAR, (1, 2, 3), (0, 0, 2)), "gamma must be a unit vector"),
        (lambda: chapsym.roll(BALL, OMEGA, 1e-3, 2, attitude=(1, 0, 0, 0), gamma=GAMMA), "attitude and gamma disagree"),
    ],
)
def test_what_cannot_be_is_one_sentence(build, sentence):
    with pytest.raises(BadInput, match=sentence):
        build()


def test_too_many_arguments_are_told_as_of_any_function():
    with pytest.raises(TypeError, match="unexpected keyword argument 'nothing'"):
        chapsym.step(FAR, **STATE, nothing=1)
    assert list(signature(chapsym.step).parameters) == ["ball", "momentum", "gamma", "precision", "proved"]


#: Those that answer in the axes of the ball; all others of one ball refuse.
ANSWER = {"step", "compose_step", "trajectory", "roll", "extrapolate"}
ARGUMENTS = {
    "momentum": STATE["momentum"], "angular_momentum": STATE["momentum"], "omega": OMEGA, "gamma": GAMMA, "order": 4,
    "steps": 2, "time_step": 1e-3, "height": 0.1, "index": [0, 1], "path": [[0, 0, 0], STATE["momentum"]],
    "time": 1.0, "times": 1.0, "accuracy": 1e-6,
}  # fmt: skip
OF_A_BALL = [
    name
    for name in chapsym.__all__
    if isfunction(getattr(chapsym, name)) and "ball" in signature(getattr(chapsym, name)).parameters
]


@pytest.mark.parametrize("name", sorted(name for name in OF_A_BALL if not name.endswith("_n")))
def test_every_function_of_a_ball_answers_in_its_axes_or_refuses(name):
    function = getattr(chapsym, name)
    needed = [p.name for p in signature(function).parameters.values() if p.default is Parameter.empty]
    given_ = {part: ARGUMENTS[part] for part in needed if part != "ball"}
    with nullcontext() if name in ANSWER else pytest.raises(BadInput, match=r"principal axes only.*ball\.principal"):
        function(FAR, **given_)


@pytest.mark.parametrize(
    "call",
    [
        lambda: chapsym.Curve.through(FAR, GAMMA),
        lambda: chapsym.TopMotion.free(FAR, STATE["momentum"]),
        lambda: chapsym.TopMotion.vertical(FAR, 0.1, GAMMA),
        lambda: chapsym.certify(chapsym.trajectory(FAR, **STATE, steps=2)),
        lambda: accurate(FAR, STATE["momentum"], GAMMA, 1.0, 1e-6),
        lambda: discretisation(Ball([(1, 2, 4)], [3], axes=TURN), np.ones((1, 3)), GAMMA[None], 1e-3, 5),
    ],
)
def test_whatever_else_takes_a_ball_refuses(call):
    with pytest.raises(BadInput, match="takes principal axes only"):
        call()


def test_between_its_frames_a_run_is_in_the_axes_of_its_ball_too():
    fine = chapsym.roll(BALL, OMEGA, 0.002, 100, gamma=GAMMA, attitude=True)
    run = chapsym.roll(BALL, OMEGA, 0.002, 100, gamma=GAMMA, attitude=True, every=2)
    found = run.at(fine.time)
    for name in ("momentum", "gamma", "omega", "attitude"):
        assert np.abs(getattr(found, name) - getattr(fine, name)).max() < 1e-6, name
    assert np.allclose(run.at(0.074).omega, fine.omega[37], atol=1e-6)
