"""Results as `chapsym run` makes them, of balls that roll: for the tests of the page."""

import numpy as np
import results

import chapsym

BALL = chapsym.Ball.from_inertia((0.02, 0.028, 0.035), mass=7.0, radius=0.11)
EVEN = chapsym.Ball.from_inertia((0.02, 0.02, 0.02), mass=7.0, radius=0.11)


ALL = ("momentum", "gamma", "omega", "attitude", "contact")


def rolled(steps=600, time_step=0.005, omega=(3.0, 4.0, 10.0), ball=BALL, every=1, variables=ALL, names=None, **attrs):
    """One ball, or as many as omega has rows, rolled for `steps` steps: the Dataset, with what was asked for."""
    gamma = np.broadcast_to([0.0, 0.0, 1.0], np.shape(omega))
    run = chapsym.roll(ball, omega, time_step, steps, gamma=gamma, every=every, attitude=True, contact=True, map=True)
    names = names or [f"ball {i + 1}" for i in range(np.size(run.taken))]
    return results.of(run, variables, "A rolling ball", names=names).assign_attrs({"model": "full"} | attrs)
