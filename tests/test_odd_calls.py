"""Public functions with odd arguments: no exception but those documented, no warning, no NaN in silence."""

from fractions import Fraction

import numpy as np
import odd_calls
import pytest

import chapsym
from chapsym import BadInput


def test_odd_calls_end_in_a_result_or_a_sentence(request):
    calls = 100_000 if request.config.getoption("--thorough") else 2_000
    found = {seed: said for seed in range(calls) if (said := odd_calls.wrong(seed))}
    assert not found


def test_what_is_wrong_with_a_call_is_seen(monkeypatch):
    """An exception of another kind, a warning, NaN, and an array that is changed."""

    def broken(ball, momentum, gamma):
        raise KeyError(gamma)

    def loud(ball, momentum, gamma):
        return np.float64(1e300) * 1e300

    def silent(ball, momentum, gamma):
        return np.array([np.nan])

    def careless(ball, momentum, gamma):
        if isinstance(momentum, np.ndarray) and momentum.dtype == float:
            momentum[...] = 7.0

    for wrong, said in (
        (broken, "KeyError"),
        (loud, "RuntimeWarning"),
        (silent, "NaN"),
        (careless, "changes momentum"),
    ):
        monkeypatch.setattr(chapsym, "exact_top", wrong)
        monkeypatch.setattr(odd_calls, "NAMES", ["exact_top"])
        assert any(said in (odd_calls.wrong(seed) or "") for seed in range(30)), said


@pytest.mark.parametrize("tensor", [np.array(0.5), [[1, 2], [3]], 0.5, "1,2,4", None])
def test_an_exact_ball_of_what_is_no_tensor_is_refused(tensor):
    with pytest.raises(BadInput, match="mass_tensor"):
        chapsym.ExactBall(tensor, 1)


def test_what_does_not_broadcast_is_refused():
    with pytest.raises(BadInput, match="momentum and gamma do not broadcast"):
        chapsym.invariants_n(np.zeros((2, 4, 4)), np.zeros((0, 4)))


def test_a_ball_with_two_radii_is_a_batch():
    ball = chapsym.Ball((1, 2, 4), 3, [0.1, 0.2])
    with pytest.raises(BadInput, match="one ball and one gamma"):
        chapsym.rotation_number(ball, 0.05, (2 / 7, 3 / 7, 6 / 7))


class Unwilling:
    """What raises an error of its own where an array is made of it."""

    def __array__(self, dtype=None, copy=None):
        raise KeyError("unwilling")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("odd", [Unwilling(), np.array([1, np.complex64(2j), 3], dtype=object)])
def test_what_makes_no_array_and_complex_numbers_among_objects_are_refused(odd):
    with pytest.raises(BadInput, match="omega must be real numbers"):
        chapsym.roll(chapsym.Ball((1, 2, 4), 3), odd, 0.1, 1)


@pytest.mark.parametrize("odd", [0.5, b"ball.npz", None, np.zeros(3)])
def test_what_is_no_scene_and_no_result_is_refused_by_its_name(odd):
    for read, said in (
        (chapsym.run_scene, "scene must be a .toml file or a dictionary, not"),
        (chapsym.open_result, "path must be that of a result, not"),
        (lambda given: chapsym.interpolated(given, 0.5), "run must be a result, its Dataset, or a Trajectory, not"),
    ):
        with pytest.raises(BadInput, match=said):
            read(odd)
    run = chapsym.roll(chapsym.Ball((1, 2, 4), 3), (1, 0, 0), 0.1, 3).to_xarray()
    for times in ([[0.1], [0.1, 0.2]], "soon", 0.1j):
        with pytest.raises(BadInput, match="times must be real numbers"):
            chapsym.interpolated(run, times)


def test_a_count_that_is_a_time_and_a_place_of_other_balls_are_refused():
    ball, masked = chapsym.Ball((1, 2, 4), 3, 0.5), np.ma.array(2.0, mask=False)
    with pytest.raises(BadInput, match=r"steps must be a whole number from 0 on, not np\.timedelta64"):
        chapsym.roll(ball, (1, 0, 0), 0.1, np.timedelta64(5, "s"))
    with pytest.raises(BadInput, match="position"):
        chapsym.roll(ball, (1, 0, 0), 0.1, 5, contact=True, position=[[1, 2]])
    with pytest.raises(BadInput) as refused:
        chapsym.roll(ball, (1, 0, 0), 0.1, masked)
    assert "\n" not in str(refused.value)


UNSHOWN = {"integer": 10**6000, "fraction": Fraction(10**6000, 7), "list": [-(10**6000)], "own": odd_calls.Unshown()}


@pytest.mark.parametrize("odd", UNSHOWN.values(), ids=UNSHOWN)
def test_what_cannot_be_shown_is_refused_by_its_name(odd):
    ball, K, gamma = chapsym.Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (2 / 7, 3 / 7, 6 / 7)
    for name, call in (
        ("steps", lambda: chapsym.trajectory(ball, K, gamma, odd)),
        ("order", lambda: chapsym.substeps(odd)),
        ("precision", lambda: chapsym.step(ball, K, gamma, precision=odd)),
        ("index", lambda: chapsym.steady_frames(ball, (0, 0, 1), (0, 0, 1), odd)),
        ("digits", lambda: chapsym.certified_motion(ball, K, gamma, 1, odd)),
        ("of", lambda: chapsym.accurate(ball, K, gamma, 1, 1e-3, of=odd)),
        ("path", lambda: chapsym.open_result(odd)),
    ):
        with pytest.raises(BadInput, match=name):
            call()
    for level in (chapsym.Digits, chapsym.Enclosure):
        with pytest.raises(ValueError, match="takes a whole number"):
            level(odd)


def test_a_number_that_raises_an_error_of_its_own_is_refused():
    with pytest.raises(BadInput, match="momentum must be real numbers"):
        chapsym.invariants_n([odd_calls.Unwilling(0.1)], (1, 0, 0))


def test_arguments_of_frames_that_are_known_at_once_are_those_of_a_run():
    ball, top = chapsym.Ball((1, 2, 4), 3, 0.1), chapsym.Ball((1, 2, 4), 0)
    for odd in ("0.1", -0.1, float("nan"), [0.1], 10**400, 1e308):
        with pytest.raises(BadInput, match="time_step"):
            chapsym.steady_frames(ball, (0, 0, 1), (0, 0, 1), [0, 10], time_step=odd)
        with pytest.raises(BadInput, match="time_step"):
            chapsym.top_frames(top, (0.1, 0.2, 0.3), (0, 0, 1), [0, 10], time_step=odd)
    with pytest.raises(BadInput, match="contact must be True or False"):
        chapsym.steady_frames(ball, (0, 0, 1), (0, 0, 1), [0], contact=[True, True])


def test_a_switch_and_an_order_that_are_arrays_are_refused():
    with pytest.raises(BadInput, match="batch must be True or False"):
        chapsym.Ball.from_inertia((3, 4, 5), mass=20, radius=1, batch=np.ones(3))
    with pytest.raises(BadInput, match="order must be one of 2, 4, 6, 8"):
        chapsym.compose_step(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1), np.ones(3))


@pytest.mark.filterwarnings("error")
def test_small_integers_number_steps_of_a_top_and_moments_that_underflow_are_no_warning():
    motion = chapsym.TopMotion.free(chapsym.Ball((1, 2, 4), 0), (0.1, 0.2, 0.3))
    assert (motion.rotations(np.array([1, 200], np.uint8)) == motion.rotations([1, 200])).all()
    assert chapsym.is_top(chapsym.Ball((2.6e164, 7.5e-224, 5.7e-172), 0), (0.06, 0.05, 0.02), (1, 0, 0))


def test_a_limit_beyond_float64_is_no_limit():
    ball = chapsym.Ball((1, 2, 4), 3)
    run = chapsym.certified_motion(ball, (0.1, 0.2, 0.3), (0, 0, 1), 0.1, 10, limit=10**400)
    assert run.stopped is None


@pytest.mark.filterwarnings("error")
def test_exact_numbers_beyond_float64_are_refused_without_a_warning():
    with pytest.raises(BadInput, match="radius must be positive"):
        chapsym.ExactBall((1, 2, 4), 3, -(10**400))
    with pytest.raises(BadInput, match="too far apart in size"):
        chapsym.certified_motion(chapsym.ExactBall((1, 1, 1), 10**11179), (-0.2, 1, 0), (0, 0, 1), 0.5, 10)


@pytest.mark.filterwarnings("error")
def test_vectors_numbers_of_steps_and_attitudes_that_are_none_are_refused():
    ball = chapsym.Ball.from_inertia([[3, 0.5, 0], [0.5, 4, 0], [0, 0, 5]], D=0.5)
    for one in (ball, ball.principal):
        with pytest.raises(BadInput, match="vectors must be real numbers"):
            one.to_principal([[1, 2], [3]])
    with pytest.raises(BadInput, match="frames must be True or False"):
        ball.from_principal((1, 0, 0), frames=np.ones(3))
    with pytest.raises(BadInput, match="index must be a list of whole numbers"):
        chapsym.steady_frames(ball.principal, (0, 0, 1), (0, 0, 1), Unwilling())
    with pytest.raises(BadInput, match="attitude must be unit quaternions"):
        chapsym.trajectory(ball.principal, (0, 0, 1), (0, 0, 1), 1, attitude=(1e200, 0, 0, 0))
    with pytest.raises(BadInput, match="time_step must be real numbers"):
        chapsym.Stepper(ball.principal, (0, 0, 1), (0, 0, 1), time_step=odd_calls.Unwilling(0.1))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("size", [1e-310, 1e-200, 1e200])
def test_an_exact_top_is_restored_in_any_units(size):
    """Squares of its momentum are beyond float64."""
    gamma, J = (0.6, 0, 0.8), np.array((1, 2, 4))
    found = []
    for unit in (1.0, size):
        top = chapsym.exact_top(chapsym.Ball(J * unit, 0), np.array((0.06, 0.01, 0.08)) * unit, gamma)
        run = top.restore(chapsym.trajectory(top.ball, top.momentum, gamma, 5))
        found.append((run.momentum / unit, run.gamma))
    for ordinary, other in zip(*found, strict=True):
        assert np.abs(ordinary - other).max() < 1e-13
    with pytest.raises(BadInput, match="this is no trajectory of the exact top"):
        top.restore(None)
