"""Arguments of the kernels in every stratum, from numbers in [0, 1]."""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np

from chapsym.dynamics.ball import Floats
from chapsym.generated import TABLE, gibbs_newton, momentum, tangent_jacobian, vertical_square

#: How many numbers in [0, 1] make a state.
DRAWN = 18


class World(NamedTuple):
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

    @property
    def gibbs(self) -> Floats:
        """The Gibbs vector of the rotation."""
        return self.rotation[1:] / self.rotation[0]

    @property
    def inertia(self) -> Floats:
        """The principal moments."""
        return self.J.sum() - self.J

    @property
    def momentum(self) -> Floats:
        """𝒦 of the rotation."""
        return np.array(momentum(*(*self.rotation, *self.gamma, *self.J, self.D)))


def _unit(v: Floats) -> Floats:
    return v / np.sqrt(v @ v)


def _direction(x: float, y: float) -> Floats:
    z, phi = 2 * x - 1, 2 * np.pi * y
    r = np.sqrt(max(0.0, 1 - z * z))
    return _unit(np.array([r * np.cos(phi), r * np.sin(phi), z]))


def _power(x: float, least: float, most: float) -> float:
    return float(10.0 ** (least + (most - least) * x))


def _generic(u: Sequence[float]) -> World:
    """Nothing special; the others change one thing of it by the last four numbers."""
    return World(
        0.1 + 1.9 * np.array(u[:3]), 2 * u[3], _direction(u[4], u[5]), _direction(u[6], u[7]), 0.02 + 0.7 * u[8],
        _direction(u[9], u[10]), 0.1 + u[11],
    )  # fmt: skip


def _spinning(world: World, u: Sequence[float]) -> World:
    """The rotation, and the free vector, almost about γ, at a large D: what cancels in 𝒦 = B(γ)q."""
    axis = _unit(world.gamma + _power(u[0], -17, -2) * world.tilt)
    return world._replace(D=_power(u[1], 0, 14), axis=axis, tilt=axis)


def _near_fold(world: World, u: Sequence[float]) -> World:
    """A rotation whose tangent Jacobian is singular but for 1e-12 to 1e-3 of its angle, where its axis has one."""
    angles = np.linspace(0.05, np.pi / 2, 40)

    def determinant(half: float) -> float:
        q = world._replace(half=half).rotation
        return float(np.linalg.det(np.reshape(tangent_jacobian(*(*q, *world.gamma, *world.J, world.D)), (3, 3))))

    values = [determinant(x) for x in angles]
    at = next((i for i in range(1, len(angles)) if values[i] <= 0.0 < values[i - 1]), None)
    inside, outside = (np.pi / 2, np.pi / 2) if at is None else angles[[at - 1, at]]
    for _ in range(0 if at is None else 60):
        middle = (inside + outside) / 2
        inside, outside = (middle, outside) if determinant(middle) > 0 else (inside, middle)
    return world._replace(half=float(inside) * (1 - _power(u[0], -12, -3)))


def _flat(world: World, u: Sequence[float]) -> World:
    """One mass moment 0, or all but one of them nearly so: a needle."""
    axis = np.arange(3) == int(2.999 * u[0])
    factors = np.where(axis, 0.0, 1.0) if u[1] < 0.5 else np.where(axis, 1.0, _power(u[2], -12, -3))
    return world._replace(J=world.J * factors)


def _along_an_axis(world: World, u: Sequence[float]) -> World:
    off = 0.0 if u[1] < 0.5 else _power(u[2], -20, -3)
    return world._replace(gamma=_unit(np.eye(3)[int(2.999 * u[0])] + off * world.tilt))


CHANGES: dict[str, Callable[[World, Sequence[float]], World]] = {
    "generic": lambda world, u: world,
    "tiny": lambda world, u: world._replace(half=_power(u[0], -140, -6), size=_power(u[0], -140, -6)),
    "D = 0": lambda world, u: world._replace(D=0.0),
    "D = 1e2 to 1e6": lambda world, u: world._replace(D=_power(u[0], 2, 6)),
    "D = 1e6 to 1e14": lambda world, u: world._replace(D=_power(u[0], 6, 14)),
    "spinning about γ": _spinning,
    "γ on an axis": _along_an_axis,
    "near a fold": _near_fold,
    "near a half turn": lambda world, u: world._replace(half=float(np.pi / 2 - _power(u[0], -15, -2))),
    "nearly equal J": lambda world, u: world._replace(J=world.J[0] * (1 + 1e-15 * np.round(9 * np.array(u[:3])))),
    "flat or a needle": _flat,
}


def world_of(stratum: str, drawn: Sequence[float]) -> World:
    """The world of a stratum from `DRAWN` numbers in [0, 1]."""
    return CHANGES[stratum](_generic(drawn), drawn[14:])


def arguments(kernel: str, stratum: str, drawn: Sequence[float]) -> list[float]:
    """The flat arguments of a kernel: where one solves an equation, near its solution, as in use."""
    world, groups = world_of(stratum, drawn), TABLE[kernel][1]
    special = {"momentum": lambda world, u: world.momentum} if kernel == "residual" else {}
    return [float(x) for name, _ in groups for x in (ARGUMENTS | special)[name](world, drawn)]


def _cofactors(world: World, u: Sequence[float]) -> tuple[float, ...]:
    half = world.momentum / (2 * world.rotation[0] ** 2 * (1 + world.gibbs @ world.gibbs))
    return gibbs_newton(*(*world.gibbs, *half, *world.gamma, *world.inertia, world.D))[4:]


def _vertical(world: World, u: Sequence[float]) -> tuple[float, float]:
    """t = h/2 and v near the root of the level, ⟨γ,Λ⁻¹γ⟩ for a small step."""
    moments = world.inertia + world.D
    level = float((world.gamma**2 / moments).sum())
    t = float(moments.min()) * (world.half if world.half < 0.01 else 0.4 * u[12])
    return t, level * (1 + 0.1 * (t / float(moments.min())) ** 2 * u[13])


def _ordered(world: World, u: Sequence[float]) -> Floats:
    """Three different moments, the largest first: a curve needs them."""
    moments = world.inertia + world.D
    return np.array([1.0, 0.5, 0.25]) * float(moments.max()) + np.sort(moments)[::-1]


def _sigma(world: World, u: Sequence[float]) -> tuple[float, float]:
    t, v = _vertical(world, u)
    return t, v * t * t


def _free(world: World, u: Sequence[float]) -> Floats:
    return world.size * world.tilt


#: A group of arguments, from the world and what it was drawn from.
ARGUMENTS: dict[str, Callable[[World, Sequence[float]], Iterable[float]]] = {
    "momentum": _free,
    "omega": _free,
    "vector": _free,
    "rate": lambda world, u: (0.1 + u[12]) * world.axis[[1, 2, 0]],  # not as ω: X₃(H) would underflow, or be 0
    "share": lambda world, u: world.size * world.axis[[2, 0, 1]],
    "gamma": lambda world, u: world.gamma,
    "mass_tensor": lambda world, u: world.J,
    "D": lambda world, u: [world.D],
    "rotation": lambda world, u: world.rotation,
    "first": lambda world, u: world.rotation,
    "second": lambda world, u: np.array([np.cos(u[12]), *(np.sin(u[12]) * world.tilt)]),
    "quaternion": lambda world, u: (0.5 + u[12]) * world.rotation,
    "gibbs": lambda world, u: world.gibbs,
    "half_momentum": lambda world, u: world.momentum / 2,
    "cofactors": _cofactors,
    "correction": lambda world, u: 1e-3 * np.abs(world.gibbs).max() * world.tilt,
    "next_correction": lambda world, u: 1e-6 * np.abs(world.gibbs).max() * world.axis[[1, 2, 0]],
    "inertia": lambda world, u: world.inertia,
    "moment": lambda world, u: world.inertia[:1],
    "Lambda": lambda world, u: world.inertia + world.D,
    "ordered": _ordered,
    "inverse_square": lambda world, u: [(u[12] + 0.01) / _ordered(world, u)[2]],
    "scalars": _vertical,
    "level": lambda world, u: [vertical_square(*world.gamma, *(world.inertia + world.D))],
    "sigma": _sigma,
}
