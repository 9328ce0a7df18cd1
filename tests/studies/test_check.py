"""The check can fail: a wrong step, a wrong kernel and a drifting trajectory are seen."""

import dataclasses

import numpy as np
import pytest

from chapsym.dynamics.loops import gibbs
from chapsym.studies import check


def stratum(name, states):
    (some,) = check.drawn(name, states, 3)
    return check.worst(name, check.compare_all(some))


def test_a_step_that_is_a_little_wrong_is_seen(monkeypatch):
    honest = check.step

    def wrong(*given, **options):
        found = honest(*given, **options)
        return dataclasses.replace(found, momentum=found.momentum * (1 + 1e-13))

    monkeypatch.setattr(check, "step", wrong)
    row = stratum("generic", 2)
    assert not row.kept
    assert row.of_proved > 1  # the bounds are those of the step that was right


@pytest.mark.usefixtures("plain")
def test_the_lost_digits_of_a_heavy_ball_are_seen(monkeypatch):
    """The promise is sharp enough for the round of other balls, whose rows of A sum to D: as if none were heavy."""
    monkeypatch.setattr(gibbs, "is_heavy", lambda *body: False)
    assert stratum("generic", 3).kept
    assert not stratum("D = 1e3 to 1e6", 3).kept


def test_a_drift_is_seen():
    moved = check.drift(2000)
    assert moved.kept
    assert not dataclasses.replace(moved, squared=2 * moved.budget).kept


def test_states_are_seeded():
    a, b = (check.STRATA["generic"](np.random.default_rng(5)) for _ in range(2))
    assert (a.K == b.K).all()
