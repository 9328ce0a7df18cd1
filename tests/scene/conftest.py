"""Members to plan and to roll, and a run of many small units."""

import numpy as np
import pytest
from small_units import OUTPUTS, plan

import chapsym
from chapsym.dynamics import kernels
from chapsym.scene.members.members import Members
from chapsym.scene.running import sweep

TIME_STEP = 0.01


@pytest.fixture
def members():
    """A function that makes n balls in SI units, all different, with K = Λω - D⟨ω,γ⟩γ."""

    def make(n=3, **changed):
        spread = np.arange(n)[:, np.newaxis] / max(n, 1)
        ball = chapsym.Ball(
            np.array([0.004, 0.003, 0.005]) + 1e-3 * spread, 0.02 + np.zeros(n), changed.pop("radius", np.full(n, 0.1))
        )
        ball = changed.pop("ball", ball)
        omega = np.array([3.0, -2.0, 1.0]) + spread
        gamma = np.broadcast_to(np.array([2, 3, 6]) / 7, (n, 3)).copy()
        momentum = TIME_STEP * kernels.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
        return Members(
            **({"names": tuple(map(str, range(n))), "ball": ball, "momentum": momentum, "gamma": gamma} | changed)
        )

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
