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
