"""Results to draw: Datasets as runs of scenes give them, made of trajectories."""

import numpy as np
import xarray as xr

import chapsym
from chapsym.scene.members.members import Members
from chapsym.scene.plan.models import FOLLOWED
from chapsym.scene.plan.plan import asked_for, planned
from chapsym.scene.read.task import Task
from chapsym.scene.result.dataset import arrays

BOWLING = chapsym.Ball.from_inertia((0.0300, 0.0312, 0.0318), mass=7.0, radius=0.1085)
UNEVEN = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
VERTICAL = chapsym.Ball((0.1, 0.5, 1.6), 0.7)
GAMMA = (2 / 7, 3 / 7, 6 / 7)


def of(run, outputs, title="A ball", parameters=None, names=None):
    """The Dataset that `chapsym run` makes of a trajectory, of one ball or a batch, with the outputs that are named."""
    columns = {name: getattr(run, name) for name in FOLLOWED if getattr(run, name) is not None}
    state = {"taken": np.atleast_1d(run.taken), "status": np.atleast_1d(run.status)}
    count = len(state["status"])
    if not np.ndim(run.status):
        columns = {name: values[np.newaxis] for name, values in columns.items()}
    ball, index = run.ball, run.index
    radius = None if ball.radius is None else np.broadcast_to(ball.radius, count)
    tensor = np.broadcast_to(ball.mass_tensor, (count, ball.mass_tensor.shape[-1]))
    members = Members(
        tuple(names or map(str, range(count))), type(ball)(tensor, np.broadcast_to(ball.D, count), radius),
        columns["momentum"][:, 0], columns["gamma"][:, 0], parameters=parameters or {},
    )  # fmt: skip
    every = int(index[1]) if len(index) > 1 else 1
    task = Task(tuple(outputs), int(index[-1]), every, getattr(run, "time_step", None))
    data = arrays(planned(members, task), asked_for(members, task, columns), state).dataset()
    return data.assign_attrs(title=title)


ALL = ("momentum", "gamma", "omega", "attitude", "contact", "energy", "integrals")


def bowling(steps=2000, every=1, outputs=ALL):
    """A bowling ball, two seconds of it."""
    run = chapsym.roll(BOWLING, (2.0, 30.0, 5.0), 1e-3, steps, every=every, contact=True, map=True)
    return of(run, outputs, "A dynamically asymmetric bowling ball")


def uneven(steps=1000):
    """The ball of docs/first.toml."""
    run = chapsym.roll(UNEVEN, (3.0, -2.0, 1.0), 0.01, steps, gamma=GAMMA, contact=True, map=True)
    return of(run, ALL, "An uneven ball of 2 kg, rolled for ten seconds")


def vertical(steps=400, height=0.3):
    """Vertical momentum: γ runs on its elliptic curve; with the phase u."""
    gamma = np.array([0.48, 0.6, 0.64])
    run = chapsym.trajectory(VERTICAL, height * gamma, gamma, steps)
    found = of(run, ("momentum", "gamma", "integrals"), "Vertical momentum on its elliptic curve")
    curve = chapsym.Curve.through(VERTICAL, gamma)
    u = np.unwrap(curve.argument(run.gamma), period=curve.period)
    found["phase"] = ("ball", "frame"), u[np.newaxis], {"units": "1"}
    return found


def batch(balls=400, steps=1500, every=5, seed=1, width=0.05):
    """Nearby starts of the uneven ball."""
    rng = np.random.default_rng(seed)
    omega = np.array([3.0, -2.0, 1.0]) + width * rng.standard_normal((balls, 3))
    run = chapsym.roll(UNEVEN, omega, 0.01, steps, gamma=GAMMA, every=every, contact=True, map=True)
    return of(run, ALL, f"{balls} nearby starts", {"start.omega.1": omega[:, 0]})


def top(steps=300, every=1):
    """D = 0: 𝒦 runs on its polhode, γ is not on a curve."""
    run = chapsym.trajectory(chapsym.Ball((1.0, 2.0, 4.0), 0.0), (0.3, 0.6, 0.9), GAMMA, steps, every=every)
    return of(run, ("momentum", "gamma", "integrals"), "A free top")


def four(steps=1500):
    """A ball in four dimensions, with momentum, γ and contact."""
    ball = chapsym.BallN(mass_tensor=(1, 2, 0.5, 3), D=3, radius=0.1)
    momentum = np.zeros((4, 4))
    momentum[1, 0], momentum[3, 2], momentum[2, 0] = 0.3, -0.2, 0.1
    run = chapsym.trajectory_n(ball, momentum - momentum.T, (0.1, 0.1, 0.7, 0.7), steps, contact=True)
    return of(run, ("momentum", "gamma", "attitude", "contact", "integrals"), "A ball in four dimensions")


def folded():
    """Two balls, the second of which meets a fold after 50 steps."""
    ball = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1)
    run = chapsym.trajectory(ball, [(0.5, 0.3, 0.2), (1.44, 0.96, 0.3)], GAMMA, 300, contact=True)
    return of(run, ("momentum", "gamma", "contact", "integrals"), "One ball stops", names=["slow", "fast"])


def sweep(balls=60):
    """Rotation numbers over a parameter, of a made-up smooth law."""
    height = np.linspace(0.05, 0.5, balls)
    data = {"rotation_number": height / (1 + height), "taken": np.full(balls, 10), "status": np.zeros(balls, dtype=int)}
    coords = {
        "ball": [str(i) for i in range(balls)], "step": ("frame", [0]),
        "start.momentum": ("ball", height, {"units": "kg m2"}),
    }  # fmt: skip
    title = {"title": "Rotation number of a vertical momentum"}
    return xr.Dataset({name: ("ball", values) for name, values in data.items()}, coords, title)


#: The ball of `rolled`, and one whose moments are equal.
BALL = chapsym.Ball.from_inertia((0.02, 0.028, 0.035), mass=7.0, radius=0.11)
EVEN = chapsym.Ball.from_inertia((0.02, 0.02, 0.02), mass=7.0, radius=0.11)


def rolled(steps=600, time_step=0.005, omega=(3.0, 4.0, 10.0), ball=BALL, every=1, names=None, **attrs):
    """One ball, or as many as omega has rows, rolled for `steps` steps: the Dataset, for the page."""
    gamma = np.broadcast_to([0.0, 0.0, 1.0], np.shape(omega))
    run = chapsym.roll(ball, omega, time_step, steps, gamma=gamma, every=every, attitude=True, contact=True, map=True)
    names = names or [f"ball {i + 1}" for i in range(np.size(run.taken))]
    return of(run, ALL[:5], "A rolling ball", names=names).assign_attrs({"model": "full"} | attrs)
