"""Results to draw: Datasets as runs of scenes give them, made of trajectories."""

import numpy as np
import xarray as xr

import chapsym
from chapsym.dynamics import front

BOWLING = chapsym.Ball.from_inertia((0.0300, 0.0312, 0.0318), mass=7.0, radius=0.1085)
UNEVEN = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
VERTICAL = chapsym.Ball((0.1, 0.5, 1.6), 0.7)
DIMS = {
    "momentum": ("axis",), "gamma": ("axis",), "omega": ("axis",), "attitude": ("quaternion",), "contact": ("plane",),
    "energy": (), "integrals": ("integral",),
}  # fmt: skip
UNITS = {"momentum": "kg m2", "gamma": "1", "omega": "rad s-1", "attitude": "1", "contact": "m", "energy": "J"}
COORDS = {
    "axis": ["1", "2", "3"], "plane": ["x", "y"], "quaternion": list("wxyz"), "integral": ["K.gamma", "K.K", "gamma.gamma"],
}  # fmt: skip


def of(run, outputs, title="A ball", parameters=None, names=None):
    """The Dataset of a trajectory, of one ball or a batch, with the outputs that are named."""
    batch = run.momentum.ndim == 3
    lift = (lambda a: a) if batch else (lambda a: np.asarray(a)[np.newaxis])
    J = np.broadcast_to(run.ball.mass_tensor, (*lift(run.taken).shape, 3))
    D = np.broadcast_to(run.ball.D, lift(run.taken).shape)
    K, g = lift(run.momentum), lift(run.gamma)
    found = {"momentum": K, "gamma": g, "attitude": run.attitude, "contact": run.contact}
    found = {name: lift(a) if name in ("attitude", "contact") and a is not None else a for name, a in found.items()}
    there = np.isfinite(K).all(axis=-1)[..., np.newaxis]
    safe_K, safe_g = np.where(there, K, 0.0), np.where(there, g, [0.0, 0.0, 1.0])
    nan = np.where(there, 0.0, np.nan)
    found["integrals"] = front.invariants(safe_K, safe_g) + nan
    if run.time_step is not None:
        arguments = safe_K / run.time_step, safe_g, J[:, np.newaxis], D[:, np.newaxis]
        found["energy"] = front.energy(*arguments) + nan[..., 0]
        found["omega"] = front.angular_velocity(*arguments) + nan
    data = {
        name: (("ball", "frame", *DIMS[name]), found[name], {"units": UNITS.get(name, "")}) for name in outputs
    }  # fmt: skip
    data |= {
        "taken": ("ball", lift(run.taken)), "status": ("ball", lift(run.status)),
        "mass_tensor": (("ball", "axis"), J, {"units": "kg m2"}), "D": ("ball", D, {"units": "kg m2"}),
    }  # fmt: skip
    used = {dim for dims, *_ in data.values() for dim in ((dims,) if isinstance(dims, str) else dims)}
    coords = {dim: labels for dim, labels in COORDS.items() if dim in used}
    coords |= {"ball": list(names or map(str, range(len(D)))), "step": ("frame", run.index)}
    if run.time_step is not None:
        coords["time"] = ("frame", run.time, {"units": "s"})
    coords |= {name: ("ball", values, {"units": units}) for name, (values, units) in (parameters or {}).items()}
    return xr.Dataset(data, coords, {"title": title})


ALL = ("momentum", "gamma", "omega", "attitude", "contact", "energy", "integrals")


def bowling(steps=2000, every=1, **options):
    """A bowling ball, two seconds of it."""
    run = chapsym.roll(BOWLING, (2.0, 30.0, 5.0), 1e-3, steps, every=every, contact=True)
    return of(run, options.pop("outputs", ALL), options.pop("title", "A bowling ball with an off-centre core"), **options)


def uneven(steps=1000):
    """The ball of docs/first.toml."""
    run = chapsym.roll(UNEVEN, (3.0, -2.0, 1.0), 0.01, steps, gamma=(2 / 7, 3 / 7, 6 / 7), contact=True)
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
    run = chapsym.roll(
        UNEVEN, omega, 0.01, steps, gamma=(2 / 7, 3 / 7, 6 / 7), every=every, contact=True
    )  # fmt: skip
    return of(run, ALL, f"{balls} nearby starts", {"start.omega.1": (omega[:, 0], "rad s-1")})
