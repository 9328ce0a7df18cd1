"""Results to draw: Datasets as runs of scenes give them, made of trajectories."""

import numpy as np
import xarray as xr

import chapsym
from chapsym.dynamics import kernels

BOWLING = chapsym.Ball.from_inertia((0.0300, 0.0312, 0.0318), mass=7.0, radius=0.1085)
UNEVEN = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
VERTICAL = chapsym.Ball((0.1, 0.5, 1.6), 0.7)
DIMS = {
    "momentum": ("axis",), "gamma": ("axis",), "omega": ("axis",), "attitude": ("quaternion",), "contact": ("plane",),
    "energy": (), "integrals": ("integral",),
}  # fmt: skip
UNITS = {"momentum": "kg m2", "gamma": "1", "omega": "rad s-1", "attitude": "1", "contact": "m", "energy": "J"}
COORDS = {
    "axis": ["1", "2", "3"], "plane": ["x", "y"], "quaternion": list("wxyz"),
    "integral": ["K.gamma", "K.K", "gamma.gamma"],
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
    found["integrals"] = kernels.invariants(safe_K, safe_g) + nan
    if run.time_step is not None:
        arguments = safe_K / run.time_step, safe_g, J[:, np.newaxis], D[:, np.newaxis]
        found["energy"] = kernels.energy(*arguments) + nan[..., 0]
        found["omega"] = kernels.angular_velocity(*arguments) + nan
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
    return of(
        run, options.pop("outputs", ALL), options.pop("title", "A bowling ball with an off-centre core"), **options
    )


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


def top(steps=300, every=1):
    """D = 0: 𝒦 runs on its polhode, γ is not on a curve."""
    run = chapsym.trajectory(
        chapsym.Ball((1.0, 2.0, 4.0), 0.0), (0.3, 0.6, 0.9), (2 / 7, 3 / 7, 6 / 7), steps, every=every
    )
    return of(run, ("momentum", "gamma", "integrals"), "A free top")


def four(steps=1500):
    """A ball in four dimensions, with momentum, γ and contact."""
    ball = chapsym.BallN(mass_tensor=(1, 2, 0.5, 3), D=3, radius=0.1)
    momentum = np.zeros((4, 4))
    momentum[1, 0], momentum[3, 2], momentum[2, 0] = 0.3, -0.2, 0.1
    run = chapsym.trajectory_n(ball, momentum - momentum.T, (0.1, 0.1, 0.7, 0.7), steps, contact=True)
    labels = ["1", "2", "3", "4"]
    return xr.Dataset(
        {
            "momentum": (("ball", "frame", "row", "column"), run.momentum[np.newaxis], {"units": "kg m2"}),
            "gamma": (("ball", "frame", "axis"), run.gamma[np.newaxis]),
            "attitude": (("ball", "frame", "row", "column"), run.attitude[np.newaxis]),
            "contact": (("ball", "frame", "plane"), run.contact[np.newaxis], {"units": "m"}),
            "integrals": (("ball", "frame", "integral"), run.invariants()[np.newaxis]),
            "mass_tensor": (("ball", "axis"), ball.mass_tensor[np.newaxis]), "D": ("ball", [3.0]),
            "taken": ("ball", [int(run.taken)]), "status": ("ball", [0]),
        },
        {"ball": ["0"], "row": labels, "column": labels, "axis": labels, "plane": labels[:3],
         "integral": ["tr K^2", "tr K^4", "gamma.K^2.gamma", "gamma.gamma"], "step": ("frame", run.index)},
        {"title": "A ball in four dimensions"},
    )  # fmt: skip


def folded():
    """Two balls, the second of which meets a fold after 50 steps."""
    ball, gamma = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1), (2 / 7, 3 / 7, 6 / 7)
    run = chapsym.trajectory(ball, [(0.5, 0.3, 0.2), (1.44, 0.96, 0.3)], gamma, 300, contact=True)
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
