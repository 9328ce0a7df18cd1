"""Results as `chapsym run` makes them, of balls that roll: for the tests of the page."""

import numpy as np
import xarray as xr

import chapsym
from chapsym.dynamics import kernels

BALL = chapsym.Ball.from_inertia((0.02, 0.028, 0.035), mass=7.0, radius=0.11)
EVEN = chapsym.Ball.from_inertia((0.02, 0.02, 0.02), mass=7.0, radius=0.11)
COMPONENTS = {"attitude": "quaternion", "contact": "plane"}


def result(run, ball, variables=("momentum", "gamma", "omega", "attitude", "contact"), names=None, **attrs):
    """The Dataset of a trajectory, with the variables that were asked for."""
    arrays = {name: getattr(run, name) for name in ("momentum", "gamma", "attitude", "contact")}
    arrays["omega"] = kernels.angular_velocity(run.momentum / run.time_step, run.gamma, ball.mass_tensor, ball.D)
    arrays = {name: array if array.ndim == 3 else array[np.newaxis] for name, array in arrays.items()}
    count = len(arrays["momentum"])
    data = {name: (("ball", "frame", COMPONENTS.get(name, "axis")), arrays[name]) for name in variables}
    data |= {name: (("ball",), np.atleast_1d(getattr(run, name)).astype(int)) for name in ("taken", "status")}
    data["mass_tensor"] = (("ball", "axis"), np.broadcast_to(ball.mass_tensor, (count, 3)))
    data["radius"] = (("ball",), np.broadcast_to(ball.radius, (count,)))
    coords = {
        "ball": names or [f"ball {i + 1}" for i in range(count)],
        "step": ("frame", run.index),
        "time": ("frame", run.time),
    }
    return xr.Dataset(data, coords, {"title": "A rolling ball", "model": "full"} | attrs)


def rolled(steps=600, time_step=0.005, omega=(3.0, 4.0, 10.0), ball=BALL, every=1, **options):
    """One ball, or as many as omega has rows, rolled for `steps` steps."""
    gamma = np.broadcast_to([0.0, 0.0, 1.0], np.shape(omega))
    run = chapsym.roll(ball, omega, time_step, steps, gamma=gamma, every=every, attitude=True, contact=True)
    return result(run, ball, **options)
