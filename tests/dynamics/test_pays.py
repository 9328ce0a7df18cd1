"""When a loop is compiled: for one long run, or for short ones that have come to as many steps in this process."""

from collections import Counter

import numpy as np
import pytest

import chapsym
from chapsym import Ball, substeps
from chapsym.dynamics.levels import compiled, double, single
from chapsym.dynamics.loops import block, composed_block, composed_loop, loop, single_step

BALL, K, GAMMA = Ball((1, 2, 4), 3, radius=0.5), np.array([0.2, -0.1, 0.15]), np.array([2, 3, 6]) / 7
QUARTER = double.SHORT_RUN // 4


@pytest.fixture
def loaded(monkeypatch):
    """The loops that are loaded from now on, in a process that has run nothing; what is on disk is said to be."""
    found = []
    load = double.load
    monkeypatch.setattr(double, "_ready", set())
    monkeypatch.setattr(double, "_plain", Counter())
    monkeypatch.setattr(compiled, "is_kept", lambda function: True)
    monkeypatch.setattr(double, "load", lambda functions: found.append(functions[0]) or load(functions))
    return found


def after(call, loaded):
    """How many calls are taken in plain Python before the first that is not; all have the same bits."""
    first = call()
    for i in range(8):
        if loaded:
            return i
        assert all(np.array_equal(a, b) for a, b in zip(call(), first, strict=True))
    return None


def run(steps, balls=1, **options):
    state = (K, GAMMA) if balls == 1 else (np.tile(K, (balls, 1)), GAMMA)
    found = chapsym.trajectory(BALL, *state, steps, **options)
    return found.momentum, found.gamma


def test_the_steps_of_short_runs_are_summed(loaded):
    assert after(lambda: run(QUARTER), loaded) == 3
    assert loaded == [loop.march]


@pytest.mark.parametrize(("order", "taken_by"), [(2, block.march_block), (4, composed_loop.march_composed)])
def test_those_of_all_balls_and_stages_count_once(order, taken_by, loaded):
    """In a block or one by one."""
    assert after(lambda: run(QUARTER // 4 // len(substeps(order)), 4, order=order), loaded) == 3
    assert loaded == [taken_by]


def test_single_steps_are_summed(loaded):
    state = np.tile(K, (QUARTER, 1)), GAMMA

    def call():
        step = chapsym.step(BALL, *state)
        return step.rotation, step.momentum, step.gamma

    assert after(call, loaded) == 3
    assert loaded == [single_step.advance_all]


def test_a_loop_that_is_not_on_disk_has_to_pay_for_being_compiled(loaded, monkeypatch):
    monkeypatch.setattr(compiled, "is_kept", lambda function: False)
    monkeypatch.setattr(double, "COMPILING", 6 * QUARTER)
    assert after(lambda: run(QUARTER), loaded) == 5


@pytest.mark.parametrize("kept", [True, False])
def test_a_block_of_compositions_is_compiled_for_much_work_alone(kept, loaded, monkeypatch):
    """If it is on disk it serves from the first run that is long enough; the bits are the same."""
    monkeypatch.setattr(compiled, "is_kept", lambda function: kept)
    steps = double.SHORT_RUN // (2 * 17)
    few = run(steps, 2, order=8)
    assert composed_block.march_composed_block not in loaded
    monkeypatch.setattr(double, "BLOCKS", 4 * 17 * steps)
    assert all(np.array_equal(a[:2], b) for a, b in zip(run(steps, 3, order=8), few, strict=True))
    assert (composed_block.march_composed_block in loaded) == kept
    run(steps, 4, order=8)
    assert composed_block.march_composed_block in loaded


def test_a_long_run_is_compiled_at_once(loaded):
    assert after(lambda: run(double.SHORT_RUN), loaded) == 0


def test_without_numba_nothing_is(loaded, monkeypatch):
    monkeypatch.setattr(double, "has_numba", lambda: False)
    assert after(lambda: run(QUARTER // 2), loaded) is None


def test_what_is_on_disk_is_found_by_its_name(tmp_path, monkeypatch):
    monkeypatch.setattr(compiled, "folder_for", lambda name: tmp_path)
    kept = compiled.is_kept.__wrapped__
    (tmp_path / "loop.march.lock").touch()
    (tmp_path / "loop.marching-0.code").touch()
    assert not kept(loop.march)
    (tmp_path / "loop.march-0.code").touch()
    assert kept(loop.march)
    assert not kept(single.loops().loop.march)
