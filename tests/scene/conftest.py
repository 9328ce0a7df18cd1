"""Members to plan and to roll, and a run of many small units."""

from dataclasses import replace

import pytest
import small_units
from small_units import OUTPUTS, plan

import chapsym
from chapsym.scene.running import sweep


@pytest.fixture
def members():
    """A function that makes n of the balls of the small units, in principal axes unless others are given."""

    def make(n=3, axes=None, radius=True):
        some = replace(small_units.members(n), axes=axes, place=None, parameters={})
        return some if radius else replace(some, ball=chapsym.Ball(some.ball.mass_tensor, some.ball.D))

    return make


@pytest.fixture(scope="session")
def whole():
    """The result of small units, computed in memory at once."""
    return sweep.run_in_memory(plan())


@pytest.fixture(scope="session")
def everything():
    """The same with all outputs."""
    return sweep.run_in_memory(plan(OUTPUTS))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.zarr"
