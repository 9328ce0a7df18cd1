"""The prepared ball in n dimensions: the states of `trajectory_n`, to the bit, however its steps are shared out."""

import copy

import numpy as np
import pytest
from balls_n import batch
from crowds import same

from chapsym import BadInput, BallN, Status, StepNotTaken, StepperN, trajectory_n

OPTIONS = [{}, {"contact": True}, {"order": 4, "contact": True}]


def alone(n=4, size=0.2, seed=7):
    ball, K, gamma = batch(n, 1, size, seed)
    return BallN(ball.mass_tensor[0], ball.D[0], radius=ball.radius[0]), K[0], gamma[0]


@pytest.mark.parametrize("size", [0.2, 1.3], ids=["below the bound", "above it"])
@pytest.mark.parametrize("options", OPTIONS, ids=str)
def test_steps_in_any_calls_are_those_of_a_trajectory(options, size):
    start = alone(size=size)
    whole = trajectory_n(*start, 45, **options)
    stepper, at = StepperN(*start, **options), 0
    assert same(stepper, whole, 0)
    for steps in (1, 1, 10, 0, 3):
        stepper.step(steps)
        at += steps
        assert stepper.taken == at
        assert same(stepper, whole, at)
    run = stepper.trajectory(30, 7)
    assert run.index.tolist() == [0, 7, 14, 21, 28]
    assert (run.taken, run.status, run.order) == (30, Status.TAKEN, options.get("order", 2))
    assert same(run, whole, slice(at, at + 30, 7))
    assert same(stepper, whole, 45)


@pytest.mark.parametrize("size", [0.2, 1.3])
def test_a_restart_a_new_momentum_and_a_copy_go_on_alone(size):
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


def test_a_step_that_is_not_taken_leaves_the_state_before_it():
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
def test_input_without_an_answer_is_refused_and_the_state_stays(change, sentence):
    stepper = StepperN(*alone())
    stepper.step(2)
    before = copy.copy(stepper)
    with pytest.raises(BadInput, match=sentence):
        change(stepper)
    assert same(stepper, before)
    assert stepper.taken == 2
