"""The motion of the balls of a scene from first principles: what the tests compare a run with.

Nothing here comes from chapsym: a scene is read as its documentation says, with a few units, and the ball that rolls
without slipping is integrated in space, where K = Iω + D(ω - ⟨ω,e₃⟩e₃) stays as it is, or by Newton's laws.
"""

import math
import tomllib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import mpmath
import numpy as np
from scipy.integrate import solve_ivp

UNITS = {
    "kg": 1, "g": 1e-3, "lb": 0.45359237, "m": 1, "cm": 0.01, "mm": 0.001, "s": 1, "ms": 0.001, "min": 60,
    "rad/s": 1, "deg/s": math.pi / 180, "rpm": math.pi / 30, "m/s": 1, "cm/s": 0.01, "km/h": 1 / 3.6,
    "kg m^2": 1, "kg cm^2": 1e-4, "g cm^2": 1e-7,
}  # fmt: skip
RANGES = ("linspace", "grid", "random", "normal")


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


def balls_of(scene, values: Mapping[str, np.ndarray], count: int, chosen) -> Balls:
    """The chosen ones of the `count` balls of a scene; `values` has, by dotted key, what a sweep varies, (count,).

    Raises AssertionError where the values are not the product of the ranges that span, or not within those drawn.
    """
    tables = scene["ball"] if isinstance(scene["ball"], list) else [scene["ball"]]
    found, first = [], 0
    for table in tables:
        whole = {
            "ball": {key: part for key, part in table.items() if key != "start"},
            "start": table.get("start") or scene["start"],
        }
        ranges = dict(ranges_in(whole))
        size = checked(ranges, values, first, scene.get("sweep", {}).get("samples", 1))
        for i in chosen:
            if first <= i < first + size:
                one = filled(whole, {key: values[key][i] for key in ranges})
                found.append(ball_of(one["ball"], one["start"]))
        first += size
    assert first == count, f"the scene has {first} balls, and its result {count}"
    return Balls(*(np.array(part) for part in zip(*found, strict=True)))


def ranges_in(value, key=""):
    """(dotted key, range) of each range in nested tables and lists; numbers of lists count from 1 on."""
    if isinstance(value, dict) and len(value) == 1 and next(iter(value)) in RANGES:
        yield key, value
    elif isinstance(value, dict | list):
        named = value.items() if isinstance(value, dict) else enumerate(value, start=1)
        for name, part in named:
            yield from ranges_in(part, f"{key}.{name}" if key else str(name))


def checked(ranges, values, first, samples):
    """How many balls the ranges make; their values, from the ball `first` on, must be those that the ranges say."""
    spans = {key: spanned(one) for key, one in ranges.items() if "linspace" in one or "grid" in one}
    drawn = {key: one for key, one in ranges.items() if key not in spans}
    repeated = samples if drawn else 1
    size = math.prod(map(len, spans.values())) * repeated
    there = {key: np.round(values[key][first : first + size], 9) for key in ranges}
    wanted = Counter(dict.fromkeys(product(*(np.round(one, 9) for one in spans.values())), repeated))
    assert Counter(zip(*(there[key] for key in spans), strict=True)) == wanted or not spans
    for key, one in drawn.items():
        a, b = si(next(iter(one.values())))
        low, high = (a, b) if "random" in one else (a - 6 * b, a + 6 * b)
        assert np.all((low - 1e-9 <= there[key]) & (there[key] <= high + 1e-9)), f"{key} is not within {one}"
    return size


def spanned(one):
    """The values of a range that spans a dimension."""
    if "grid" in one:
        return si(one["grid"])
    first, last, count = one["linspace"]
    return np.linspace(si(first), si(last), count)


def filled(value, values, key=""):
    """Nested tables in which the ranges are numbers."""
    if key in values:
        return values[key]
    if isinstance(value, list):
        return [filled(part, values, f"{key}.{i}") for i, part in enumerate(value, start=1)]
    if isinstance(value, dict):
        return {name: filled(part, values, f"{key}.{name}" if key else name) for name, part in value.items()}
    return value


def ball_of(ball, start):
    """(inertia, D, radius, attitude, ω in the body, contact point) of one ball, of its tables without ranges."""
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


def newton(balls: Balls, time, digits=20):
    """(γ, ω, R, contact) of the first ball after `time`, by Newton's laws and Taylor's series in mpmath.

    The force at the contact point is F = m v̇ = mρ ω̇ × e₃, so with its torque -ρ e₃ × F, in the body,
    Iω̇ + ω × Iω = -D(ω̇ - ⟨ω̇,γ⟩γ); and Ṙ = R[ω]×.
    """
    mp = mpmath.MPContext()
    mp.dps = digits
    inertia, D, radius = mp.matrix(balls.inertia[0].tolist()), mp.mpf(balls.D[0]), mp.mpf(balls.radius[0])

    def skew(a):
        return mp.matrix([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])

    def rate(t, y):
        omega, R = mp.matrix(y[:3]), mp.matrix([y[3:6], y[6:9], y[9:12]])
        gamma = R[2, :].T
        heavy = inertia + D * (mp.eye(3) - gamma * gamma.T)
        faster = mp.lu_solve(heavy, -(skew(omega) * (inertia * omega)))
        in_space = R * omega
        return [*faster, *(R * skew(omega)), radius * in_space[1], -radius * in_space[0]]

    start = [*balls.omega[0], *matrix(balls.attitude[0]).reshape(-1), *balls.contact[0]]
    y = np.array(mp.odefun(rate, 0, [mp.mpf(float(x)) for x in start])(mp.mpf(time)), dtype=float)
    return y[9:12], y[:3], y[3:12].reshape(3, 3), y[12:]
