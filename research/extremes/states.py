"""The states of the matrix: balls and momenta at which formulas lose digits."""

from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from math import sqrt

import numpy as np

from chapsym.dynamics.loops.branch import small_rotation
from chapsym.dynamics.oracle import Oracle

from .judging import SINGLE, Level
from .truth import State, Vector, fold_at, rotation_matrix, scaled

J, D, G, K = (1.0, 2.0, 4.0), 3.0, (2 / 7, 3 / 7, 6 / 7), (1.0, -0.5, 0.75)
FLAT, APART, RATIOS = (0.0, 1.0, 2.0), (2.0, 2.0 * (1 + 1e-15), 2.0 * (1 - 1e-15)), (1e-12, 1e-6, 1.0)
ROD = (0.0, 0.0, 1.0)
#: A ball whose small rotations go up to π, and the axis of such a rotation.
SLENDER, LIGHT, TILTED = (0.25, 0.0003, 0.0002), 0.0252, (-0.859, -0.51, 0.032)
FLIP = (-0.74, -0.63, -0.235)
#: Exact multiples of it are exact at every precision, as those of γ = e₃ are.
DYADIC, AXIS = (1.0, -0.5, 0.25), (0.0, 0.0, 1.0)
AXES = ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), AXIS)
SWEEP = (1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.99, 0.999)


def unit(v: Iterable[float]) -> Vector:
    """The unit vector, to float64."""
    array = np.array([*v], dtype=float)
    array = array / np.sqrt(array @ array)
    return scaled(array / np.sqrt(array @ array), 1.0)


#: A direction at a right angle to γ.
ACROSS = unit(np.cross(G, (0.3, -0.5, 0.8)))


@cache
def part(J: Vector, D: float, direction: Vector, g: Vector, share: float) -> State:
    """A momentum in this direction, a share of what the branch attains before it folds."""
    far = scaled(unit(direction), 100 * (sum(J) + D))
    reach = float(small_rotation(*[*far, *g, *J, D])[1])
    return State(J, D, scaled(far, reach * share), g)


def halfway(J: Vector = J, D: float = D, direction: Vector = K, g: Vector = G) -> State:
    """Half of what the branch attains."""
    return part(J, D, direction, g, 0.5)


def turned(q0: float) -> State:
    """The state of the slender ball whose rotation has this q0: its momentum, rounded to float64."""
    oracle = Oracle(SLENDER, LIGHT, unit(TILTED), 40)
    sine = oracle.mp.sqrt(1 - oracle.mp.mpf(q0) ** 2)
    moved = oracle.momentum(rotation_matrix(oracle.mp, [q0, *(sine * x for x in unit(FLIP))]))
    return State(SLENDER, LIGHT, scaled(map(float, oracle.components(moved)), 1.0), unit(TILTED))


@cache
def beside_fold(distance: float, level: Level | None = None) -> State:
    """A momentum relatively so far from its fold, at a generic γ; positive is before it."""
    return State(J, D, scaled(K, float(fold_at(J, D, K, G)) * (1 - distance)), G, distance)


@cache
def next_to_fold(side: int, level: Level) -> State:
    """The number of the precision (float64 at most) next to the fold, before (-1) or beyond it (1)."""
    at = fold_at(J, D, DYADIC, AXIS)
    nearest = np.float32(float(at)) if level is SINGLE else np.float64(float(at))
    towards = type(nearest)(side * np.inf)
    while (float(nearest) - at) * side <= 0:
        nearest = np.nextafter(nearest, towards)
    return State(J, D, scaled(DYADIC, float(nearest)), AXIS, float(1 - nearest / at))


def tiny(size: float) -> list[State]:
    """Momenta of this size."""
    return [State(J, D, scaled(K, size), G), State(FLAT, 0.0, scaled(K, size), G)]


TINY = ("1e-12", "1e-150", "1e-300", "subnormal, 5e-320")
SIDES = {"before": 1, "beyond": -1}
HEAVY = ("1e6", "1e12", "1e15")


@cache
def conditions() -> dict[str, dict[str, Sequence[State | Callable[[Level], State]]]]:
    """The states of a single step, by group and condition; those near a fold are made for a precision."""
    return {
        "momentum": {
            "generic": [halfway(), halfway((0.1, 0.5, 1.6), 0.7, (0.3, 0.2, -1.0))],
            "at rest": [State(J, D, (0.0, 0.0, 0.0), G)],
            **{name: tiny(float(name.removeprefix("subnormal, "))) for name in TINY},
            "subnormal, 4e-313, D = 100": [State((1.0, 1.0, 1.0), 100.0, (4.4500984e-313, 0.0, 0.0), (1.0, 0.0, 0.0))],
            "components from 1 to 1e-300": [
                State(J, D, (0.5, 1e-150, 1e-300), G),
                State(J, D, (1e-300, 0.5, 0.0), AXIS),
            ],
            "from 1e-12 of the fold to 0.999": [part(J, D, K, G, share) for share in SWEEP],
        },
        "rotation": {
            "by 90°": [turned(sqrt(0.5))],
            "90° about an axis, its fold, less 1e-8": [
                State(J, D, (0.0, 0.0, 3.0 * (1 - 1e-8)), AXIS, 1e-8),
                State(J, 0.0, (6.0 * (1 - 1e-8), 0.0, 0.0), AXIS, 1e-8),
            ],
            "by π less 1e-4": [turned(5e-5)],
            "by π less 1e-8": [turned(5e-9)],
            "by π, to rounding": [turned(0.0)],
        },
        "fold": {
            **{
                f"{off} {where} it": [partial(beside_fold, side * float(off))]
                for off in ("1e-8", "1e-12")
                for where, side in SIDES.items()
            },
            **{f"one ulp {where} it": [partial(next_to_fold, -side)] for where, side in SIDES.items()},
            "twice as far": [partial(beside_fold, -1.0)],
            "more than any rotation has": [
                State(J, D, scaled(K, 1e3), G, -1e3),
                State(J, D, scaled(K, 1e300), G, -1e3),
            ],
        },
        "D": {
            "D = 0": [halfway(D=0.0), halfway(D=0.0, direction=G)],
            "D = 1e-12": [halfway(D=1e-12), halfway(D=1e-12, direction=G)],
            **{
                f"D = {D}": [halfway(D=float(D)), halfway(D=float(D), direction=G), halfway(D=float(D), g=AXIS)]
                for D in HEAVY
            },
            **{f"D = {D}, momentum horizontal": [halfway(D=float(D), direction=ACROSS)] for D in HEAVY},
        },
        "inertia": {
            "one ulp apart": [halfway((1.0, 1 + 2.0**-52, 1 + 2.0**-51)), halfway((1.0, 1.0, 1 + 5 * 2.0**-52), 0.0)],
            "1e-15 apart": [halfway(APART)],
            "equal": [halfway((1.0, 1.0, 1.0)), halfway((1.0, 1.0, 1.0), 0.0, G)],
            "a flat body, one J = 0": [halfway(FLAT), halfway((1.0, 0.0, 1.0), D, G, AXIS)],
            "a rod, two J = 0": [halfway(ROD), halfway(ROD, g=(1.0, 0.0, 0.0))],
            "a rod upright: no inertia about the vertical": [State(ROD, D, (0.1, 0.0, 0.0), AXIS)],
            "a rod 1e-6 from upright": [halfway(ROD, g=unit((1e-6, 0.0, 1.0)))],
            "ratios of 1e12": [halfway((1e-12, 1.0, 1.0)), halfway(RATIOS, 1.0), halfway((1.0, 1e-12, 1e-12), 0.0)],
            **{
                f"a ball of size {size}": [halfway(scaled(J, float(size)), 3 * float(size))]
                for size in ("1e-150", "1e150", "1e-300")
            },
            "a ball of size 1e300": [State(scaled(J, 1e300), 3e300, scaled(K, 1e300), G)],
        },
        "directions": {
            "γ along an axis": [halfway(g=axis) for axis in AXES],
            "γ 1e-9 from an axis": [halfway(g=unit((1e-9, -1e-9, 1.0)))],
            "momentum vertical": [halfway(direction=G), halfway(direction=AXIS, g=AXIS)],
            "momentum 1e-9 from vertical": [halfway(direction=(G[0] + 1e-9, G[1], G[2]))],
            "momentum horizontal": [halfway(direction=ACROSS), halfway(direction=AXES[0], g=AXIS)],
            "momentum 1e-9 from horizontal": [halfway(direction=tuple(ACROSS + 1e-9 * np.array(G)))],
            "momentum along an axis": [halfway(direction=axis) for axis in AXES],
        },
    }


@cache
def starts() -> dict[str, list[State]]:
    """The states of the runs."""
    return {
        "generic": [halfway()],
        "tiny momentum": [State(J, D, scaled(K, 1e-300), G)],
        "at 0.8 of the fold": [part(J, D, K, G, 0.8)],
        "D = 1e6": [halfway(D=1e6)],
        "D = 0": [halfway(D=0.0)],
        "a flat body": [halfway(FLAT)],
        "inertia 1e-15 apart": [halfway(APART)],
        "momentum vertical": [halfway(direction=G)],
        "γ along an axis": [halfway(g=AXIS)],
    }


def upright(J: Vector = J, D: float = D, g: Vector = G, share: float = 0.5) -> State:
    """A momentum along γ, a share of what the branch attains."""
    return part(J, D, g, g, share)


@cache
def upright_states() -> dict[str, list[State]]:
    """States whose momentum is h γ; only ⟨𝒦,γ⟩ = h is taken from them."""
    return {
        "generic": [upright(share=share) for share in (0.01, 0.5, 0.9)],
        "h 1e-300": [State(J, D, scaled(G, 1e-300), G)],
        "h 5e-320": [State(J, D, scaled(AXIS, 5e-320), AXIS)],
        "1e-6 before the fold": [upright(share=1 - 1e-6)],
        "D = 0": [upright(D=0.0)],
        "D = 1e6": [upright(D=1e6), upright(D=1e6, g=AXIS)],
        "D = 1e12": [upright(D=1e12), upright(D=1e12, g=AXIS)],
        "inertia 1e-15 apart": [upright(APART)],
        "a flat body": [upright(FLAT)],
        "ratios of 1e12": [upright(RATIOS, 1.0)],
        "γ along an axis": [upright(g=AXIS)],
    }


@cache
def folds() -> dict[str, list[tuple[State, float]]]:
    """Balls and directions whose folds are searched for, and by how much the momentum that is given is larger."""
    return {
        "generic": [(State(J, D, K, G), 1.0)],
        **{f"momentum {size}": [(State(J, D, K, G), float(size))] for size in ("1e-300", "1e300")},
        **{f"D = {D}": [(State(J, float(D), K, G), 1.0)] for D in ("0", "1e3", "1e6")},
        "a flat body": [(State(FLAT, D, K, G), 1.0)],
        "γ along an axis": [(State(J, D, K, AXIS), 1.0)],
        "momentum and γ along an axis": [(State(J, D, AXIS, AXIS), 1.0)],
    }
