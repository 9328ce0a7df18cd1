"""The errors of every generated kernel in ulps, in sampled states of every stratum.

An ulp is 2^-52 of the largest component of the exact output; of 𝒦, or of the level, where the kernel is a residual;
and ⟨𝒦,γ⟩ is measured on the scale of 𝒦, whose own rounding moves it by as much.  The condition number κ is
Σⱼ |∂f/∂xⱼ||xⱼ| in the largest component, relative to that size: rounding every argument by half an ulp moves the output
by up to κ/2 ulps, so an error of a few κ is as good as one can ask.
"""

import json
import math
from collections.abc import Callable, Iterable, Sequence
from operator import attrgetter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from mpmath import MPContext, mpf

from chapsym import generated
from chapsym.dynamics.ball import Floats
from chapsym.files import Data
from chapsym.generated import TABLE, gibbs_newton, momentum, tangent_jacobian, vertical_square

from .harness import Say

#: Digits of the reference for the errors.
CONTEXT = MPContext()
CONTEXT.dps = 90
ULP = 2.0**-52
#: The relative change of an argument from which its derivative is taken: its error is of the same order.
NUDGE = CONTEXT.mpf(10) ** -25
SEED = 20071
#: States of a stratum: quick and full.
SAMPLED = {True: 2, False: 40}
MANIFEST = Path(generated.__file__).parent / "manifest.json"

Kernel = Callable[..., Any]
KERNELS: dict[str, Kernel] = {name: getattr(generated, name) for name in TABLE}
Groups = dict[str, Sequence[mpf]]
#: One view of an output: its values, and what its error is relative to.
Seen = tuple[Sequence[mpf], mpf]


class View(NamedTuple):
    """A part of a kernel's output that has a scale of its own, from the output and the arguments by group."""

    values: Callable[[Sequence[mpf], Groups], Sequence[mpf]] = lambda output, groups: output
    size: Callable[[Sequence[mpf], Groups], mpf] | None = None  # unless it is its own largest component


def _largest(values: Sequence[mpf], groups: Groups) -> mpf:
    return max(map(abs, values))


def _vertical(output: Sequence[mpf], groups: Groups) -> Sequence[mpf]:
    return [sum((a * b for a, b in zip(output, groups["gamma"], strict=True)), CONTEXT.mpf(0))]


def _rolled(output: Sequence[mpf], groups: Groups) -> mpf:
    state = ("rotation", "gamma", "mass_tensor", "D")
    return max(map(abs, generated.momentum(*(x for name in state for x in groups[name]))))


def _solved(output: Sequence[mpf], groups: Groups) -> mpf:
    return max(map(abs, groups["half_momentum"])) * (1 + sum(x * x for x in groups["gibbs"]))


def _part(first: int, last: int) -> View:
    return View(lambda output, groups: output[first:last])


VIEWS: dict[str, dict[str, View]] = {
    "momentum": {"𝒦": View(), "⟨𝒦,γ⟩": View(_vertical, _largest)},
    "contact_momentum": {"K": View(), "⟨K,γ⟩": View(_vertical, _largest)},
    "residual": {"r": View(size=_rolled), "⟨r,γ⟩": View(_vertical, _rolled)},
    "gibbs_residual": {"r": View(size=_solved), "⟨r,γ⟩": View(_vertical, _solved)},
    "invariants": {"h": _part(0, 1), "n": _part(1, 2), "unit": _part(2, 3)},
    "gibbs_newton": {"det": _part(0, 1), "N": _part(1, 4), "C": _part(4, 13)},
    "vertical_level": {
        "f": _part(0, 1)._replace(size=lambda output, groups: abs(groups["level"][0])),
        "fv": _part(1, 2),
    },
}


class Worst(NamedTuple):
    """An error that was met: in ulps, the condition number there, the stratum, and the arguments."""

    ulps: float
    condition: float
    stratum: str
    arguments: tuple[float, ...]

    @property
    def share(self) -> float:
        """The error in units of what a rounding of the arguments by an ulp does, or of an ulp if that is more."""
        return self.ulps / max(1.0, self.condition)

    def as_json(self) -> Data:
        """All of it, and its share; an error that is not finite is None."""
        return {name: finite(x) for name, x in (self._asdict() | {"share": self.share}).items()}


def finite(x: object) -> object:
    """None for a number that JSON has not."""
    return None if isinstance(x, float) and not math.isfinite(x) else x


def grouped(kernel: str, arguments: Sequence[mpf]) -> Groups:
    """Flat arguments by group."""
    rest = iter(arguments)
    return {name: [next(rest) for _ in range(length)] for name, length in TABLE[kernel][1]}


def seen(kernel: str, function: Kernel, point: Sequence[mpf | float], at: Sequence[mpf] = ()) -> dict[str, Seen]:
    """The views of the results of a kernel's text at a point, as mpf; `at`: the point as mpf, if it is of floats."""
    result, groups = function(*point), grouped(kernel, at or point)
    output = [CONTEXT.mpf(x) for x in (result if isinstance(result, tuple) else (result,))]
    found = {}
    for name, view in VIEWS.get(kernel, {"": View()}).items():
        values = view.values(output, groups)
        found[name] = values, view.size(output, groups) if view.size else max(map(abs, values))
    return found


def errors(kernel: str, function: Kernel, stratum: str, given: Sequence[float]) -> dict[str, Worst]:
    """The errors of a text of the kernel in floats at one point, by the view, against the kernel in mpmath."""
    point = [CONTEXT.mpf(x) for x in given]
    reference = KERNELS[kernel]
    exact, found = seen(kernel, reference, point), seen(kernel, function, given, point)
    moved = [seen(kernel, reference, [*point[:j], x * (1 + NUDGE), *point[j + 1 :]]) for j, x in enumerate(point) if x]
    worst = {}
    for name, (values, size) in exact.items():
        changes = (sum(abs(other[name][0][i] - x) for other in moved) for i, x in enumerate(values))
        condition = float(max(changes) / NUDGE / size) if size else 0.0
        worst[name] = Worst(_off(found[name][0], values, size), condition, stratum, tuple(given))
    return worst


def _off(found: Sequence[mpf], values: Sequence[mpf], size: mpf) -> float:
    if not all(CONTEXT.isfinite(x) for x in found):
        return math.inf
    off = max(abs(a - b) for a, b in zip(found, values, strict=True))
    return float(off / size) / ULP if size else (0.0 if off == 0 else math.inf)


def sampled(kernel: str, function: Kernel, states: int) -> dict[str, list[Worst]]:
    """The errors of a text of the kernel at a number of seeded states of each stratum, by the view."""
    found: dict[str, list[Worst]] = {}
    for index, stratum in enumerate(CHANGES):
        rng = np.random.default_rng([SEED, index])
        for _ in range(states):
            at = arguments(kernel, stratum, list(rng.uniform(size=DRAWN)))
            for view, one in errors(kernel, function, stratum, at).items():
                found.setdefault(view, []).append(one)
    return found


class Kernels:
    """The section of the trade: every kernel, or those that are named; a row for each part of the output of each.

    kernel, output: the kernel, and the part of its output ("" for all of it) that the errors are of.
    operations: + - * / in its text.  strata: the worst error of the states of each stratum, in ulps.
    worst, hardest: the state with the largest error, and that with the largest share of its condition number.
    """

    title = "kernels: errors in ulps"

    def __init__(self, quick: bool, say: Say, kernels: Sequence[str] = tuple(TABLE)) -> None:
        texts = json.loads(MANIFEST.read_text(encoding="utf-8"))["kernels"]
        self.rows: list[dict[str, Any]] = []
        for name in kernels:
            say(f"kernels: {name}")
            for view, met in sampled(name, KERNELS[name], SAMPLED[quick]).items():
                strata = {stratum: max(one.ulps for one in met if one.stratum == stratum) for stratum in CHANGES}
                worst, hardest = (max(met, key=attrgetter(measure)) for measure in ("ulps", "share"))
                self.rows.append({
                    "kernel": name, "output": view, "operations": texts[name]["operations"], "strata": strata,
                    "worst": worst, "hardest": hardest,
                })  # fmt: skip

    def table(self) -> list[Data]:
        """The worst error, the condition number there, and the worst error in units of it, for each row."""
        return [
            {
                **{name: row[name] for name in ("kernel", "output", "operations")}, "worst ulps": row["worst"].ulps,
                "condition": row["worst"].condition, "where": row["worst"].stratum,
                "ulps / condition": row["hardest"].share,
            }
            for row in self.rows
        ]  # fmt: skip

    def sentences(self) -> list[str]:
        """The meaning of the columns."""
        return ["errors against 90 digits"]

    def as_json(self) -> Data:
        """All that was measured, as plain data; an error that is not finite is None."""
        return {
            "title": self.title,
            "kernels": [
                row | {
                    "without": "",  # once the codegen pass that a text went without
                    "strata": {name: finite(x) for name, x in row["strata"].items()},
                    "worst": row["worst"].as_json(), "hardest": row["hardest"].as_json(),
                }
                for row in self.rows
            ],
        }  # fmt: skip


# Arguments of the kernels in every stratum, from numbers in [0, 1].

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


def _scalars(world: World, u: Sequence[float]) -> tuple[float, float]:
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
    t, v = _scalars(world, u)
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
    "scalars": _scalars,
    "level": lambda world, u: [vertical_square(*world.gamma, *(world.inertia + world.D))],
    "sigma": _sigma,
}
