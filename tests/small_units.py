"""A run of many small units, for this process and for one that is killed: `small_units.py STORE`."""

import shutil
import sys
import time
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from waiting import GUARD

import chapsym
from chapsym.dynamics import kernels
from chapsym.scene.members.members import Members
from chapsym.scene.plan import plan as plans
from chapsym.scene.plan.plan import planned
from chapsym.scene.read.task import Task
from chapsym.scene.running import sweep

BALLS, STEPS, EVERY = 10, 210, 10
#: Units of work: enough that some balls are done, some begun and some not begun.
UNITS, PART = 6, 3
#: All outputs, and some: a store takes the time of its arrays.
OUTPUTS = ("momentum", "gamma", "omega", "attitude", "contact", "energy", "integrals")
SOME = ("momentum", "gamma")


class SmallUnits(plans.Plan):
    """Three chunks of balls, two segments of frames; the last ones are shorter."""

    @property
    def chunks(self):
        return [slice(i, min(i + 4, len(self.members))) for i in range(0, len(self.members), 4)]

    @property
    def segments(self):
        return [slice(i, min(i + 13, self.frames)) for i in range(0, self.frames, 13)]


def members(n=BALLS):
    """Balls of which some meet a fold: the faster ones in the middle."""
    spread = np.arange(n)[:, np.newaxis] / n
    ball = chapsym.Ball(np.array([4.0, 3.0, 5.0]) * 1e-3 + 1e-3 * spread, np.full(n, 0.02), np.full(n, 0.1))
    omega = np.array([3.0, -2.0, 1.0]) * np.where((np.arange(n) % 5 == 3)[:, np.newaxis], 60.0, 1.0 + spread)
    gamma = np.broadcast_to(np.array([2.0, 3.0, 6.0]) / 7, (n, 3)).copy()
    momentum = 0.01 * kernels.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
    half = np.array([0.5, 0.5, 0.5, 0.5])
    return Members(
        tuple(f"ball {i}" for i in range(n)), ball, momentum, gamma, axes=np.broadcast_to(half, (n, 4)).copy(),
        place=np.full((n, 2), 0.25), parameters={"start.omega.1": omega[:, 0]},
    )  # fmt: skip


def plan(outputs=SOME, scene="", steps=STEPS, seed=7, n=BALLS):
    """Three times two units of 4 balls and 13 frames."""
    whole = planned(members(n), Task(outputs, steps, EVERY, 0.01))
    return replace(
        SmallUnits(whole.members, whole.task, whole.model, whole.needed, whole.refused), scene=scene, seed=seed
    )


def interrupted(path, after, wanted=None):
    """A store of which `after` units more are written."""
    if wanted is None and not path.exists():
        shutil.copytree(Path(_left(after).name) / "run.zarr", path)
    else:
        _run(path, after, wanted or plan())


@cache
def _left(after):
    """A folder with a new one, of which the tests take copies."""
    folder = TemporaryDirectory()
    _run(Path(folder.name) / "run.zarr", after, plan())
    return folder


def _run(path, after, wanted):
    done = iter(range(after))
    real = sweep.advance

    def advance(*args):
        if next(done, None) is None:
            raise KeyboardInterrupt
        return real(*args)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(sweep, "advance", advance)
        patched.setattr(sweep, "cores", lambda: 1)  # so that it is the first units that are written
        with suppress(KeyboardInterrupt):
            sweep.run_to_store(wanted, path)


def equal_to_the_bit(one, other):
    """Coordinates, variables and attributes, NaN where NaN is, and the sign of zero."""
    assert set(one.variables) == set(other.variables)
    for name in one.variables:
        a, b = one[name].values, other[name].values
        assert one[name].dims == other[name].dims, name
        if a.dtype.kind == "f":
            assert a.dtype == b.dtype
            assert (a.view(np.int64) == b.view(np.int64)).all(), name
        else:
            assert (a == b).all(), name
        assert dict(one[name].attrs) == dict(other[name].attrs), name
    assert {**one.attrs, "complete": True} == {**other.attrs, "complete": True}


if __name__ == "__main__":
    calls, real = iter(range(UNITS)), sweep.advance

    def advance(*args, **kwargs):
        """The real one, slower; after one unit none is begun."""
        time.sleep(GUARD if next(calls) else 0.03)
        return real(*args, **kwargs)

    sweep.advance = advance
    wanted = plan()
    import xarray  # noqa: F401
    import zarr  # noqa: F401

    real(wanted, wanted.chunks[0], sweep.begin(wanted, wanted.chunks[0]), wanted.segments[0])
    print("ready", flush=True)
    sweep.run_to_store(wanted, Path(sys.argv[1]))
