"""Results as `chapsym run` makes them, of balls that roll: for the tests of the page."""

import numpy as np
import results

import chapsym

BALL = chapsym.Ball.from_inertia((0.02, 0.028, 0.035), mass=7.0, radius=0.11)
EVEN = chapsym.Ball.from_inertia((0.02, 0.02, 0.02), mass=7.0, radius=0.11)


def result(run, ball, variables=("momentum", "gamma", "omega", "attitude", "contact"), names=None, **attrs):
    """The Dataset of a trajectory, with the variables that were asked for."""
    count = np.size(run.taken)
    found = results.of(run, variables, "A rolling ball", names=names or [f"ball {i + 1}" for i in range(count)])
    found["radius"] = "ball", np.broadcast_to(ball.radius, count)
    return found.assign_attrs({"model": "full"} | attrs)


def rolled(steps=600, time_step=0.005, omega=(3.0, 4.0, 10.0), ball=BALL, every=1, **options):
    """One ball, or as many as omega has rows, rolled for `steps` steps."""
    gamma = np.broadcast_to([0.0, 0.0, 1.0], np.shape(omega))
    run = chapsym.roll(ball, omega, time_step, steps, gamma=gamma, every=every, attitude=True, contact=True)
    return result(run, ball, **options)
