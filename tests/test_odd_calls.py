"""Public functions with odd arguments: no exception but those documented, no warning, no NaN in silence."""

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
