"""Arguments of the kernels in every stratum, from numbers in [0, 1]: so that a sample and a search draw alike."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from chapsym.dynamics.ball import Floats
from chapsym.generated import TABLE, gibbs_newton, momentum, tangent_jacobian, vertical_square

#: How many numbers in [0, 1] make a state.
DRAWN = 18


@dataclass(frozen=True)
class World:
    """One ball and its rotation, in float64: what the arguments of all kernels are made of.

    J, D, gamma (unit); axis (unit) and half angle of the rotation; tilt: a second direction; size: of a free vector.
    """

    J: Floats
    D: float
    gamma: Floats
    axis: Floats
    half: float
    tilt: Floats
    size: float

    @property
    def rotation(self) -> Floats:
        """The Euler parameters, scalar first."""
        return np.array([np.cos(self.half), *(np.sin(self.half) * self.axis)])


def _direction(x: float, y: float) -> Floats:
    z, phi = 2 * x - 1, 2 * np.pi * y
    r = np.sqrt(max(0.0, 1 - z * z))
    v = np.array([r * np.cos(phi), r * np.sin(phi), z])
    return v / np.sqrt(v @ v)


def _power(x: float, least: float, most: float) -> float:
    return float(10.0 ** (least + (most - least) * x))


def _generic(u: Sequence[float]) -> World:
    """Nothing special; the others change one thing of it by the last four numbers."""
    tensor = np.array([0.1 + 1.9 * x for x in u[:3]])
    return World(
        tensor, 2 * u[3], _direction(u[4], u[5]), _direction(u[6], u[7]), 0.02 + 0.7 * u[8],
        _direction(u[9], u[10]), 0.1 + u[11],
    )  # fmt: skip


def _tiny(world: World, u: Sequence[float]) -> World:
    size = _power(u[0], -140, -6)
    return replace(world, half=size, size=size)


def _heavy(least: float, most: float) -> Callable[[World, Sequence[float]], World]:
    return lambda world, u: replace(world, D=_power(u[0], least, most))


def _spinning(world: World, u: Sequence[float]) -> World:
    """The rotation, and the free vector, almost about γ, at a large D: what cancels in 𝒦 = B(γ)q."""
    axis = world.gamma + _power(u[0], -17, -2) * world.tilt
    return replace(world, D=_power(u[1], 0, 14), axis=axis / np.sqrt(axis @ axis), tilt=axis / np.sqrt(axis @ axis))


def _along_an_axis(world: World, u: Sequence[float]) -> World:
    off = 0.0 if u[1] < 0.5 else _power(u[2], -20, -3)
    gamma = np.eye(3)[int(2.999 * u[0])] + off * world.tilt
    return replace(world, gamma=gamma / np.sqrt(gamma @ gamma))


def _near_fold(world: World, u: Sequence[float]) -> World:
    """A rotation whose tangent Jacobian is singular but for 1e-12 to 1e-3 of its angle, where its axis has one."""
    angles = np.linspace(0.05, np.pi / 2, 40)

    def determinant(half: float) -> float:
        q = replace(world, half=half).rotation
        return float(np.linalg.det(np.reshape(tangent_jacobian(*(*q, *world.gamma, *world.J, world.D)), (3, 3))))

    values = [determinant(x) for x in angles]
    at = next((i for i in range(1, len(angles)) if values[i] <= 0.0 < values[i - 1]), None)
    if at is None:
        return replace(world, half=float(np.pi / 2 * (1 - _power(u[0], -12, -3))))
    inside, outside = float(angles[at - 1]), float(angles[at])
    for _ in range(60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if determinant(middle) > 0 else (inside, middle)
    return replace(world, half=inside * (1 - _power(u[0], -12, -3)))


def _near_pi(world: World, u: Sequence[float]) -> World:
    return replace(world, half=float(np.pi / 2 - _power(u[0], -15, -2)))


def _nearly_equal(world: World, u: Sequence[float]) -> World:
    return replace(world, J=world.J[0] * (1 + 1e-15 * np.round(9 * np.array(u[:3]))))


def _flat(world: World, u: Sequence[float]) -> World:
    """One mass moment 0, or all but one of them nearly so: a needle."""
    tensor, axis = world.J.copy(), int(2.999 * u[0])
    if u[1] < 0.5:
        tensor[axis] = 0.0
    else:
        tensor[[i for i in range(3) if i != axis]] *= _power(u[2], -12, -3)
    return replace(world, J=tensor)


CHANGES: dict[str, Callable[[World, Sequence[float]], World]] = {
    "generic": lambda world, u: world,
    "tiny": _tiny,
    "D = 0": lambda world, u: replace(world, D=0.0),
    "D = 1e2 to 1e6": _heavy(2, 6),
    "D = 1e6 to 1e14": _heavy(6, 14),
    "spinning about γ": _spinning,
    "γ on an axis": _along_an_axis,
    "near a fold": _near_fold,
    "near a half turn": _near_pi,
    "nearly equal J": _nearly_equal,
    "flat or a needle": _flat,
}


def world_of(stratum: str, drawn: Sequence[float]) -> World:
    """The world of a stratum from `DRAWN` numbers in [0, 1]."""
    return CHANGES[stratum](_generic(drawn), drawn[14:])


def arguments(kernel: str, stratum: str, drawn: Sequence[float]) -> list[float]:
    """The flat arguments of a kernel: where one solves an equation, near its solution, as in use."""
    world, groups = world_of(stratum, drawn), TABLE[kernel][1]
    made = {name: _group(name, world, drawn) for name, _ in groups}
    if kernel == "residual":
        made["momentum"] = _momentum(world)
    return [float(x) for name, _ in groups for x in made[name]]


def _momentum(world: World) -> Floats:
    return np.array(momentum(*(*world.rotation, *world.gamma, *world.J, world.D)))


def _gibbs(world: World) -> Floats:
    q = world.rotation
    return q[1:] / q[0]


def _vertical(world: World, u: Sequence[float]) -> tuple[float, float]:
    """t = h/2 and v near the root of the level, ⟨γ,Λ⁻¹γ⟩ for a small step."""
    moments = world.J.sum() - world.J + world.D
    level = float((world.gamma**2 / moments).sum())
    t = float(moments.min()) * (world.half if world.half < 0.01 else 0.4 * u[12])
    return t, level * (1 + 0.1 * (t / float(moments.min())) ** 2 * u[13])


def _ordered(moments: np.ndarray) -> np.ndarray:
    """Three different moments, the largest first: a curve needs them."""
    largest = float(moments.max())
    return np.array([1.0, 0.5, 0.25]) * largest + np.sort(moments)[::-1]


def _group(name: str, world: World, u: Sequence[float]) -> Any:
    inertia = world.J.sum() - world.J
    free = world.size * world.tilt
    if name == "cofactors":
        half = _momentum(world) / (2 * world.rotation[0] ** 2 * (1 + _gibbs(world) @ _gibbs(world)))
        return gibbs_newton(*(*_gibbs(world), *half, *world.gamma, *inertia, world.D))[4:]
    t, v = _vertical(world, u)
    table: dict[str, Callable[[], Any]] = {
        "rotation": lambda: world.rotation,
        "gamma": lambda: world.gamma,
        "mass_tensor": lambda: world.J,
        "D": lambda: [world.D],
        "momentum": lambda: free,
        "omega": lambda: free,
        "rate": lambda: (0.1 + u[12]) * world.axis[[1, 2, 0]],  # not as ω: X₃(H) would underflow, or be 0
        "share": lambda: world.size * world.axis[[2, 0, 1]],
        "vector": lambda: free,
        "first": lambda: world.rotation,
        "second": lambda: np.array([np.cos(u[12]), *(np.sin(u[12]) * world.tilt)]),
        "gibbs": lambda: _gibbs(world),
        "half_momentum": lambda: _momentum(world) / 2,
        "correction": lambda: 1e-3 * np.abs(_gibbs(world)).max() * world.tilt,
        "next_correction": lambda: 1e-6 * np.abs(_gibbs(world)).max() * world.axis[[1, 2, 0]],
        "quaternion": lambda: (0.5 + u[12]) * world.rotation,
        "inertia": lambda: inertia,
        "ordered": lambda: _ordered(inertia + world.D),
        "inverse_square": lambda: [(u[12] + 0.01) / _ordered(inertia + world.D)[2]],
        "moment": lambda: inertia[:1],
        "Lambda": lambda: inertia + world.D,
        "scalars": lambda: [t, v],
        "level": lambda: [vertical_square(*world.gamma, *(inertia + world.D))],
        "sigma": lambda: [t, v * t * t],
    }
    return table[name]()
