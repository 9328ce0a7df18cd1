"""The prepared ball, in n dimensions too: the states of a trajectory, to the bit, however its steps are shared out."""

import copy
import pickle

import numpy as np
import pytest
from balls_n import batch
from budget import slow
from crowds import NAMES, same

import chapsym
from chapsym import BadInput, Ball, BallN, Status, StepNotTaken, Stepper, StepperN, trajectory_n
from chapsym.dynamics.levels import double

BALL, K, GAMMA = Ball((1, 2, 4), 3, radius=0.5), np.array([0.2, -0.1, 0.15]), np.array([2, 3, 6]) / 7
#: Starts whose branch folds after a few steps of each order; of a composition at a stage in the midst of a step.
FOLDING = {order: np.array([4.32, -2.16, 3.24]) * size for order, size in ((2, 1.0), (4, 1.35), (8, 1.5))}
TRACED, ORDERS = (
    {"contact": True},
    [{}, {"contact": True}, {"order": 4, "contact": True}, *slow({"attitude": True}, {"order": 8, "contact": True})],
)


def are_shared_out(stepper, whole, calls, steps, every):
    """Steps in these calls, and then frames, are those of a trajectory."""
    at = 0
    assert same(stepper, whole, 0)
    for taken in calls:
        stepper.step(taken)
        at += taken
        assert stepper.taken == at
        assert same(stepper, whole, at)
    run = stepper.trajectory(steps, every)
    assert run.index.tolist() == list(range(0, steps + 1, every))
    assert (run.taken, run.status, run.order) == (steps, Status.TAKEN, whole.order)
    assert same(run, whole, slice(at, at + steps + 1, every))
    assert same(stepper, whole, at + steps)


@pytest.mark.parametrize("options", ORDERS, ids=str)
def test_steps_in_any_calls_are_those_of_a_trajectory(options, way):
    """Past a restoration of the integrals, which counts from the start."""
    whole = chapsym.trajectory(BALL, K, GAMMA, 1300, **options)
    are_shared_out(Stepper(BALL, K, GAMMA, **options), whole, (1, 1, 10, 0, 700, 3, 400), 185, 11)
    assert whole.order == options.get("order", 2)


def test_calls_that_are_long_are_the_same(monkeypatch):
    """They are taken in parts, so that an interrupt is heard."""
    monkeypatch.setattr(double, "CHUNK", 70)
    steps, frames = Stepper(BALL, K, GAMMA, **TRACED), Stepper(BALL, K, GAMMA, **TRACED)
    steps.step(1200)
    run = frames.trajectory(1200, 50)
    whole = chapsym.trajectory(BALL, K, GAMMA, 1200, every=50, **TRACED)
    assert same(run, whole)
    assert same(steps, whole, -1)
    assert same(frames, steps)


def test_an_interrupt_leaves_a_state_that_goes_on(monkeypatch):
    monkeypatch.setattr(double, "CHUNK", 140)
    stepper = Stepper(BALL, K, GAMMA, **TRACED)
    march, calls = stepper._march, []

    def interrupted(*arguments):
        calls.append(arguments)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return march(*arguments)

    monkeypatch.setattr(stepper, "_march", interrupted)
    with pytest.raises(KeyboardInterrupt):
        stepper.step(1200)
    whole = chapsym.trajectory(BALL, K, GAMMA, 1200, **TRACED)
    assert stepper.taken == 280
    assert same(stepper, whole, 280)
    stepper.step(920)
    assert same(stepper, whole, 1200)


@pytest.mark.parametrize("options", ORDERS, ids=str)
def test_a_new_momentum_is_a_new_start(options, way):
    stepper = Stepper(BALL, K, GAMMA, **options)
    stepper.step(20)
    before = [getattr(stepper, name) for name in NAMES]
    stepper.momentum += (0.01, 0.02, -0.03)
    assert stepper.taken == 0
    assert np.array_equal(stepper.momentum, before[0] + (0.01, 0.02, -0.03))
    assert all(np.array_equal(getattr(stepper, name), old) for name, old in zip(NAMES[1:], before[1:], strict=True))
    start = {} if before[2] is None else {"attitude": before[2]}
    whole = chapsym.trajectory(BALL, stepper.momentum, before[1], 30, **options | start)
    stepper.step(30)
    assert np.array_equal(stepper.momentum, whole.momentum[-1])
    assert np.array_equal(stepper.gamma, whole.gamma[-1])
    if before[2] is not None:
        assert np.array_equal(stepper.attitude, whole.attitude[-1])
    if before[3] is not None:
        roundings = 30 * 17 * 2.0**-53  # of steps, or of their stages, that are added to another number
        np.testing.assert_allclose(stepper.contact, before[3] + whole.contact[-1], rtol=0, atol=roundings)


def test_a_restart_is_a_new_object():
    attitude = chapsym.trajectory(BALL, K, GAMMA, 5, attitude=True).attitude[-1]
    gamma = chapsym.trajectory(BALL, K, GAMMA, 5).gamma[-1]
    for start in ((K, GAMMA), (list(K), tuple(GAMMA)), (-K, gamma, attitude), (K.astype("f4"), GAMMA.astype("f4"))):
        stepper = Stepper(BALL, 2 * K, -GAMMA, **TRACED)
        stepper.step(7)
        stepper.restart(*start)
        other = Stepper(BALL, *start[:2], attitude=start[2] if len(start) == 3 else False, **TRACED)
        assert same(stepper, other)
        stepper.step(9)
        other.step(9)
        assert same(stepper, other)


@pytest.mark.parametrize("options", ORDERS, ids=str)
def test_a_step_that_cannot_be_taken_leaves_the_state_before_it(options, way):
    start = FOLDING[options.get("order", 2)]
    with pytest.raises(StepNotTaken) as whole:
        chapsym.trajectory(BALL, start, GAMMA, 200, **options)
    last = whole.value.trajectory
    assert whole.value.index > 2
    stepper = Stepper(BALL, start, GAMMA, **options)
    with pytest.raises(StepNotTaken) as framed:
        copy.copy(stepper).trajectory(200)
    assert same(framed.value.trajectory, last)
    stepper.step(2)
    for index in (whole.value.index - 2, 0):  # again: it is where it was
        with pytest.raises(StepNotTaken) as caught:
            stepper.step(300)
        assert (caught.value.status, caught.value.index) == (whole.value.status, index)
        assert (caught.value.reach, stepper.taken) == (whole.value.reach, whole.value.index)
        assert same(stepper, last, -1)
    stepper.momentum = K
    stepper.step()


def test_omega_is_that_of_a_trajectory():
    stepper = Stepper(BALL, K, GAMMA, time_step=0.02)
    run = stepper.trajectory(10, 10)
    assert np.array_equal(run.omega, chapsym.trajectory(BALL, K, GAMMA, 10, every=10, time_step=0.02).omega)
    assert np.array_equal(stepper.omega, run.omega[-1])
    assert run.time.tolist() == [0, 0.2]
    with pytest.raises(BadInput, match="time_step="):
        _ = Stepper(BALL, K, GAMMA).omega
    for tensor, momentum in (((1e-150, 2e-150, 5e-151), (1e300, 0, 0)), ((5e-324, 5e-324, 0), (0, 0, 0))):
        with pytest.raises(BadInput, match="omega is beyond the range of float64"):
            _ = Stepper(chapsym.Ball(tensor, 0), momentum, (0, 0, 1), time_step=1e-3).omega


def test_a_restart_refuses_an_attitude_that_is_none_where_none_is_followed():
    with pytest.raises(BadInput, match="attitude"):
        Stepper(BALL, K, GAMMA).restart(K, GAMMA, "rubbish")


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
@pytest.mark.parametrize("options", [TRACED, {"order": 4}], ids=str)
def test_a_copy_goes_its_own_way(copied, options):
    stepper = Stepper(BALL, K, GAMMA, time_step=0.1, **options)
    stepper.step(40)
    other = copied(stepper)
    assert same(other, stepper)
    assert (other.taken, other.time_step) == (40, 0.1)
    stepper.step(1000)
    assert not np.array_equal(other.gamma, stepper.gamma)
    other.step(1000)
    assert same(other, stepper)


def test_what_is_returned_is_not_the_state():
    stepper = Stepper(BALL, K, GAMMA, **TRACED)
    other = copy.copy(stepper)
    run = stepper.trajectory(3)
    other.step(3)
    for name in NAMES:
        getattr(stepper, name)[:] = 5.0
        getattr(run, name)[:] = 5.0
    assert same(stepper, other)


@pytest.mark.parametrize(
    ("arguments", "options", "sentence"),
    [
        ((BALL, np.tile(K, (2, 1)), GAMMA), {}, r"takes one ball, not a batch .* \(2,\)"),
        ((BALL, (1, 2), GAMMA), {}, "momentum must have 3 components"),
        ((BALL, K, 1.1 * GAMMA), {}, "gamma must be a unit vector"),
        ((BALL, K, GAMMA), {"order": 3}, "order must be one of"),
        ((BALL, K, GAMMA), {"time_step": -1}, "time_step must be one positive number"),
        ((BALL, K, GAMMA), {"attitude": (1, 0, 0, 0)}, "attitude and gamma disagree"),
        ((Ball((1, 2, 4), 3), K, GAMMA), TRACED, "the contact point needs the radius"),
        ((Ball.from_inertia(np.diag([6, 5, 3.0]) + 0.1, D=3), K, GAMMA), {}, "ball.principal"),
        ((None, K, GAMMA), {}, "ball must be a chapsym.Ball"),
    ],
)
def test_bad_input_is_refused_when_it_is_made(arguments, options, sentence):
    with pytest.raises(BadInput, match=sentence):
        Stepper(*arguments, **options)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda s: s.restart((1, 2), GAMMA), "momentum must have 3 components"),
        (lambda s: s.restart(np.tile(K, (2, 1)), GAMMA), r"momentum must be one vector, .* \(2, 3\)"),
        (lambda s: s.restart(K, 1.01 * GAMMA), "gamma must be a unit vector"),
        (lambda s: s.restart(K, np.array([np.inf, 0, 0])), "gamma must be finite"),
        (lambda s: s.restart(K, GAMMA, (1, 0, 0, 0)), "attitude and gamma disagree"),
        (lambda s: setattr(s, "momentum", np.array([np.nan, 0, 0])), "momentum must be finite"),
        (lambda s: s.step(-1), "steps must be a whole number from 0 on"),
        (lambda s: s.trajectory(5, 0), "every must be a whole number from 1 on"),
        (lambda s: s.trajectory(10**18), "frames of 1 balls do not fit into memory"),
    ],
)
def test_what_is_refused_on_the_way_changes_nothing(change, sentence):
    stepper = Stepper(BALL, K, GAMMA, **TRACED)
    stepper.step(5)
    other = copy.copy(stepper)
    with pytest.raises(BadInput, match=sentence):
        change(stepper)
    for one in (stepper, other):
        assert one.taken == 5
        one.step(5)
    assert same(stepper, other)


@pytest.mark.parametrize("name", ["ball", "order", "time_step"])
def test_what_a_stepper_was_made_with_stays(name):
    """Its steps, which are prepared, would not follow another."""
    with pytest.raises(AttributeError, match=name):
        setattr(Stepper(BALL, K, GAMMA), name, None)


def test_huge_momenta_are_numbers():
    """Their sum overflows, they do not."""
    stepper = Stepper(Ball((1e308, 4e307, 3e307), 0), (1.5e307,) * 3, (0, 0, 1))
    stepper.momentum = np.array([1e308, 1e308, 1e308])
    assert stepper.momentum.tolist() == [1e308] * 3


# -- in n dimensions


def alone(n=4, size=0.2, seed=7):
    ball, K, gamma = batch(n, 1, size, seed)
    return BallN(ball.mass_tensor[0], ball.D[0], radius=ball.radius[0]), K[0], gamma[0]


@pytest.mark.parametrize("size", [0.2, 1.3], ids=["below the bound", "above it"])
@pytest.mark.parametrize("options", [{}, {"contact": True}, {"order": 4, "contact": True}], ids=str)
def test_in_n_dimensions_steps_in_any_calls_are_those_of_a_trajectory(options, size):
    start = alone(size=size)
    are_shared_out(StepperN(*start, **options), trajectory_n(*start, 45, **options), (1, 1, 10, 0, 3), 30, 7)


@pytest.mark.parametrize("size", [0.2, 1.3])
def test_in_n_dimensions_a_restart_a_new_momentum_and_a_copy_go_on_alone(size):
    ball, K, gamma = alone(size=size)
    stepper = StepperN(ball, K, gamma, order=4, contact=True)
    stepper.step(5)
    other = copy.copy(stepper)
    stepper.step(5)
    other.step(5)
    assert same(stepper, other)
    other.momentum = 0.5 * K
    assert (other.taken, other.momentum.tolist()) == (0, (0.5 * K).tolist())
    run = trajectory_n(ball, 0.5 * K, stepper.gamma, 3, order=4, attitude=stepper.attitude, contact=True)
    other.step(3)
    assert (other.momentum == run.momentum[3]).all()
    assert (other.attitude == run.attitude[3]).all()
    assert np.abs(other.contact - stepper.contact - run.contact[3]).max() < 1e-15
    stepper.restart(K, gamma)
    assert same(stepper, StepperN(ball, K, gamma, contact=True))
    for array in (stepper.momentum, stepper.gamma, stepper.attitude, stepper.contact):
        array[...] = 7.0  # a copy
    assert same(stepper, StepperN(ball, K, gamma, contact=True))


def test_in_n_dimensions_a_step_that_is_not_taken_leaves_the_state_before_it():
    """A stage of the third step folds, when others of it are done."""
    ball, K, gamma = batch(4, 1, 4.07, seed=4)
    start = BallN(ball.mass_tensor[0], ball.D[0]), K[0], gamma[0]
    whole = trajectory_n(*start, 2, order=4)
    stepper = StepperN(*start, order=4)
    for call, index in ((lambda: stepper.step(30), 2), (lambda: stepper.trajectory(7), 0)):
        with pytest.raises(StepNotTaken) as caught:
            call()
        assert (caught.value.status, caught.value.index) == (Status.FOLDED, index)
        assert (stepper.taken, same(stepper, whole, 2)) == (2, True)
    assert caught.value.trajectory.momentum.tolist() == [whole.momentum[2].tolist()]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda s: s.step(-1), "steps must be a whole number from 0 on, not -1"),
        (lambda s: s.trajectory(3, 0), "every must be a whole number from 1 on, not 0"),
        (lambda s: setattr(s, "momentum", np.eye(4)), "momentum must be skew"),
        (lambda s: setattr(s, "momentum", np.zeros((2, 4, 4))), "momentum must be one skew matrix"),
        (lambda s: s.restart(np.zeros((2, 4, 4)), (0, 0, 0, 1)), "a StepperN takes one ball, not a batch"),
        (lambda s: s.restart(np.zeros((4, 4)), (0, 0, 1, 1)), "gamma must be a unit vector"),
        (lambda s: StepperN(s.ball, s.momentum, s.gamma, order=5), "order must be one of 2, 4, 6, 8"),
        (lambda s: StepperN(s.ball, s.momentum, s.gamma, contact=np.ones(2)), "contact must be True or False"),
        (lambda s: StepperN(BallN(np.ones(4), 1), s.momentum, s.gamma, contact=True), "needs the radius"),
    ],
)
def test_in_n_dimensions_input_without_an_answer_is_refused_and_the_state_stays(change, sentence):
    stepper = StepperN(*alone())
    stepper.step(2)
    before = copy.copy(stepper)
    with pytest.raises(BadInput, match=sentence):
        change(stepper)
    assert same(stepper, before)
    assert stepper.taken == 2


N = BallN((1, 2, 4), 3), chapsym.skew(K), GAMMA
FLOWS = {
    "three": (Stepper, chapsym.trajectory, (BALL, K, GAMMA)), "n": (StepperN, trajectory_n, N),
    "beyond the bound": (StepperN, trajectory_n, (N[0], 8 * N[1], GAMMA)),
}  # fmt: skip


@pytest.mark.parametrize(("order", "steps"), [(2, 1), (2, 300), (4, 1)])
@pytest.mark.parametrize("flow", FLOWS)
def test_an_interrupt_leaves_the_state_of_the_steps_that_are_counted(flow, order, steps, monkeypatch):
    """Python raises it right after the compiled call in which it arrives."""
    made, run, start = FLOWS[flow]
    moving, real = made(*start, order=order), made._march_on if flow == "three" else made._march

    def march(self, *arguments):
        real(self, *arguments)
        raise KeyboardInterrupt

    moving.step(7)
    monkeypatch.setattr(made, real.__name__, march)
    with pytest.raises(KeyboardInterrupt):
        moving.step(steps)
    monkeypatch.undo()
    assert moving.taken in (7, 7 + steps)
    truth = run(*start, moving.taken + 2, order=order)
    for frame in (-3, -1):
        assert (moving.gamma == truth.gamma[frame]).all()
        assert (moving.momentum == truth.momentum[frame]).all()
        moving.step(2)
