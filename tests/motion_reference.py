"""The motion of the balls of a scene from first principles: what the tests compare a run with.

Nothing here comes from chapsym: a scene is read as its documentation says, with a few units, and the ball that rolls
without slipping is integrated in space, where K = Iω + D(ω - ⟨ω,e₃⟩e₃) stays as it is.
"""

import math
import tomllib
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from scipy.integrate import solve_ivp

UNITS = {
    "kg": 1, "g": 1e-3, "lb": 0.45359237, "m": 1, "cm": 0.01, "mm": 0.001, "s": 1, "ms": 0.001, "min": 60,
    "rad/s": 1, "deg/s": math.pi / 180, "rpm": math.pi / 30, "m/s": 1, "cm/s": 0.01, "km/h": 1 / 3.6,
    "kg m^2": 1, "kg cm^2": 1e-4, "g cm^2": 1e-7,
}  # fmt: skip


@dataclass(frozen=True)
class Balls:
    """n balls in the axes in which they are given.

    inertia: about the centre, (n, 3, 3).  D: m ρ², (n,).  radius: (n,), NaN where there is none.
    attitude: unit quaternions from the body to space, (n, 4).  omega: in the body, (n, 3).  contact: (n, 2).
    """

    inertia: np.ndarray
    D: np.ndarray
    radius: np.ndarray
    attitude: np.ndarray
    omega: np.ndarray
    contact: np.ndarray


def si(value):
    """A number, a text with a fraction or a unit, or lists of them, in SI."""
    if isinstance(value, list):
        return np.array([si(part) for part in value])
    if not isinstance(value, str):
        return float(value)
    amount, _, unit = value.partition(" ")
    return float(Fraction(amount)) * UNITS[unit] if unit else float(Fraction(amount))


def times(run):
    """The times of the frames of a [run]."""
    if "time_step" not in run:
        return np.linspace(0.0, si(run["time"]), run.get("frames", 1) + 1)
    step = si(run["time_step"])
    steps = run["steps"] if "steps" in run else round(si(run["time"]) / step)
    every = steps // run["frames"] if "frames" in run else run.get("every", 1)
    return np.arange(steps // every + 1) * every * step


def load(path):
    """The tables of a scene file."""
    with open(path, "rb") as stream:
        return tomllib.load(stream)


def balls_of(scene) -> Balls:
    """The balls of a scene whose tables have no ranges."""
    tables = scene["ball"] if isinstance(scene["ball"], list) else [scene["ball"]]
    found = [ball_of(table, table.get("start") or scene["start"]) for table in tables]
    return Balls(*(np.array(part) for part in zip(*found, strict=True)))


def ball_of(ball, start):
    """(inertia, D, radius, attitude, ω in the body, contact point) of one ball."""
    radius = si(ball["radius"]) if "radius" in ball else math.nan
    D = si(ball["D"]) if "D" in ball else si(ball["mass"]) * radius**2
    if "attitude" in start:
        attitude = unit(si(start["attitude"]))
    else:  # the least rotation that turns γ to e₃: about γ × e₃
        g = unit(si(start.get("gamma", [0, 0, 1])))
        attitude = unit(np.array([1 + g[2], g[1], -g[0], 0.0]))
    into_body = matrix(attitude).T
    if "velocity" in start:  # of the centre, ρ ω × e₃ = ρ(ω₂, -ω₁)
        v = si(start["velocity"])
        omega = into_body @ [-v[1] / radius, v[0] / radius, si(start.get("spin", 0.0))]
    else:
        omega = si(start["omega"])
        omega = into_body @ omega if start.get("axes") == "space" else omega
    return inertia_of(ball), D, radius, attitude, omega, si(start.get("position", [0.0, 0.0]))


def inertia_of(ball):
    """The tensor of inertia about the centre, (3, 3), from tables of moments or what a preset is made of."""
    one = np.eye(3)
    if "inertia" in ball:
        inertia = si(ball["inertia"])
        return inertia if inertia.ndim == 2 else np.diag(inertia)
    if "mass_tensor" in ball:
        J = si(ball["mass_tensor"])
        return J.sum() * one - np.diag(J)
    mass, radius = si(ball["mass"]), si(ball["radius"])
    if ball["preset"] == "homogeneous":
        return 2 / 5 * mass * radius**2 * one
    if ball["preset"] == "shell":
        return shell(mass, radius, ball) * one
    if ball["preset"] == "dumbbell":
        point, away = si(ball["point_mass"]), si(ball["separation"]) / 2
        return shell(mass - 2 * point, radius, ball) * one + 2 * point * away**2 * np.diag([1.0, 1.0, 0.0])
    assert ball["preset"] == "bowling"
    block, (a, b, c), o = si(ball["block_mass"]), si(ball["block_size"]), si(ball["block_offset"])
    weight = block * np.linalg.norm(o) / radius
    opposite = -radius * unit(o)
    return (
        2 / 5 * (mass - block - weight) * radius**2 * one
        + block / 12 * np.diag([b * b + c * c, a * a + c * c, a * a + b * b])
        + block * (o @ o * one - np.outer(o, o))
        + weight * (opposite @ opposite * one - np.outer(opposite, opposite))
    )


def shell(mass, radius, ball):
    """The moment of inertia of a shell."""
    if "thickness" not in ball:
        return 2 / 3 * mass * radius**2
    inner = radius - si(ball["thickness"])
    return 2 / 5 * mass * (radius**5 - inner**5) / (radius**3 - inner**3)


def unit(v):
    return v / np.linalg.norm(v)


def matrix(q):
    """The rotation matrices (..., 3, 3) of quaternions of any length (..., 4)."""
    w, x, y, z = np.moveaxis(q / np.linalg.norm(q, axis=-1, keepdims=True), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def about_contact(inertia, D, gamma):
    """The tensors that take ω to K, I + D(1 - γγᵀ), in the body."""
    return inertia + D[..., np.newaxis, np.newaxis] * (
        np.eye(3) - gamma[..., :, np.newaxis] * gamma[..., np.newaxis, :]
    )


def spin_of(balls, q, K):
    """(ω, γ, R) in the body at attitudes (..., n, 4), of K in space."""
    R = matrix(q)
    gamma = R[..., 2, :]
    there = np.swapaxes(R, -1, -2) @ K[..., np.newaxis]
    return np.linalg.solve(about_contact(balls.inertia, balls.D, gamma), there)[..., 0], gamma, R


def motion(balls: Balls, times, method="DOP853", rtol=1e-13, atol=1e-15):
    """gamma, omega (in the body), attitude and contact of the balls at the times, (n, frames, ...)."""
    n = len(balls.D)
    R = matrix(balls.attitude)
    K = (R @ about_contact(balls.inertia, balls.D, R[:, 2]) @ balls.omega[..., np.newaxis])[..., 0]
    radius = np.nan_to_num(balls.radius)

    def rate(t, y):
        q = y.reshape(n, 6)[:, :4]
        omega, _, R = spin_of(balls, q, K)
        w, x, y, z = q.T
        a, b, c = omega.T
        turned = np.stack([-x * a - y * b - z * c, w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a])
        in_space = (R @ omega[..., np.newaxis])[..., 0]
        rolled = radius * np.stack([in_space[:, 1], -in_space[:, 0]])
        return np.concatenate([turned / 2, rolled]).T.reshape(-1)

    start = np.concatenate([balls.attitude, balls.contact], axis=1).reshape(-1)
    found = solve_ivp(rate, (0.0, times[-1]), start, method=method, t_eval=times, rtol=rtol, atol=atol)
    assert found.success, found.message
    states = found.y.T.reshape(-1, n, 6)
    attitude = states[..., :4] / np.linalg.norm(states[..., :4], axis=-1, keepdims=True)
    omega, gamma, _ = spin_of(balls, attitude, K)
    whole = {"gamma": gamma, "omega": omega, "attitude": attitude, "contact": states[..., 4:]}
    return {name: np.swapaxes(part, 0, 1) for name, part in whole.items()}
