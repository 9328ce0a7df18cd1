"""The states of the matrix: balls and momenta at which formulas lose digits."""

from collections.abc import Callable, Iterable
from functools import cache
from math import nextafter, sqrt

import numpy as np

from chapsym.dynamics.loops.branch import small_rotation
from chapsym.dynamics.oracle import Oracle

from .folds import fold_at
from .levels import Level
from .truth import State, Vector, rotation_matrix, scaled

J, D, G, K = (1.0, 2.0, 4.0), 3.0, (2 / 7, 3 / 7, 6 / 7), (1.0, -0.5, 0.75)
#: A ball whose small rotations go up to π, and the axis of such a rotation.
SLENDER, LIGHT, TILTED = (0.25, 0.0003, 0.0002), 0.0252, (-0.859, -0.51, 0.032)
FLIP = (-0.74, -0.63, -0.235)
#: Exact multiples of it are exact at every precision, as those of γ = e₃ are.
DYADIC, AXIS = (1.0, -0.5, 0.25), (0.0, 0.0, 1.0)
SWEEP = (1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.99, 0.999)


def unit(v: Iterable[float]) -> Vector:
    """The unit vector, to float64."""
    array = np.array([*v], dtype=float)
    array = array / np.sqrt(array @ array)
    return scaled(array / np.sqrt(array @ array), 1.0)


@cache
def part(J: Vector, D: float, direction: Vector, g: Vector, share: float) -> State:
    """A momentum in this direction, a share of what the branch attains before it folds."""
    far = scaled(unit(direction), 100 * (sum(J) + D))
    reach = float(small_rotation(*far, *g, *J, D)[1])
    return State(J, D, scaled(far, reach * share), g)


def halfway(J: Vector, D: float, direction: Vector = K, g: Vector = G) -> State:
    """Half of what the branch attains."""
    return part(J, D, direction, g, 0.5)


def turned(J: Vector, D: float, g: Vector, axis: Vector, q0: float) -> State:
    """The state whose rotation has this q0, about this axis: its momentum, rounded to float64."""
    oracle = Oracle(J, D, g, 40)
    sine = oracle.mp.sqrt(1 - oracle.mp.mpf(q0) ** 2)
    moved = oracle.momentum(rotation_matrix(oracle.mp, [q0, *(sine * x for x in unit(axis))]))
    return State(J, D, scaled(map(float, oracle.components(moved)), 1.0), g)


@cache
def beside_fold(distance: float) -> State:
    """A momentum relatively so far from its fold, at a generic γ; positive is before it."""
    at = float(fold_at(J, D, K, G))
    return State(J, D, scaled(K, at * (1 - distance)), G, distance)


@cache
def next_to_fold(level: Level, side: int) -> State:
    """The number of the precision (float64 at most) next to the fold, before (-1) or beyond it (1)."""
    at = fold_at(J, D, DYADIC, AXIS)
    nearest = np.float32(float(at)) if float(level.unit) > 1e-10 else np.float64(float(at))
    towards = type(nearest)(side * np.inf)
    while (float(nearest) - at) * side <= 0:
        nearest = np.nextafter(nearest, towards)
    return State(J, D, scaled(DYADIC, float(nearest)), AXIS, float(1 - nearest / at))


def _across(g: Vector) -> Vector:
    """A direction at a right angle to g."""
    return unit(np.cross(g, (0.3, -0.5, 0.8)))


def _ulps(x: float, count: int) -> float:
    for _ in range(count):
        x = nextafter(x, 2 * x)
    return x


def _of(*states: State) -> Callable[[Level], list[State]]:
    return lambda level: [*states]


def _tiny(size: float) -> Callable[[Level], list[State]]:
    return _of(State(J, D, scaled(K, size), G), State((0.0, 1.0, 2.0), 0.0, scaled(K, size), G))


def _heavy(D: float) -> Callable[[Level], list[State]]:
    states = (halfway(J, D), halfway(J, D, G), halfway(J, D, K, AXIS))
    return _of(*states)


def _axes() -> list[Vector]:
    return [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), AXIS]


#: Each condition of a single step, by group: its states, at a precision.
CONDITIONS: dict[str, dict[str, Callable[[Level], list[State]]]] = {
    "momentum": {
        "generic": lambda level: [halfway(J, D), halfway((0.1, 0.5, 1.6), 0.7, (0.3, 0.2, -1.0))],
        "at rest": _of(State(J, D, (0.0, 0.0, 0.0), G)),
        "1e-12": _tiny(1e-12),
        "1e-150": _tiny(1e-150),
        "1e-300": _tiny(1e-300),
        "subnormal, 5e-320": _tiny(5e-320),
        "subnormal, 4e-313, D = 100": _of(State((1.0, 1.0, 1.0), 100.0, (4.4500984e-313, 0.0, 0.0), (1.0, 0.0, 0.0))),
        "components from 1 to 1e-300": _of(
            State(J, D, (0.5, 1e-150, 1e-300), G), State(J, D, (1e-300, 0.5, 0.0), AXIS),
        ),
        "from 1e-12 of the fold to 0.999": lambda level: [part(J, D, K, G, share) for share in SWEEP],
    },
    "rotation": {
        "by 90°": lambda level: [turned(SLENDER, LIGHT, unit(TILTED), FLIP, sqrt(0.5))],
        "90° about an axis, its fold, less 1e-8": lambda level: [
            State(J, D, (0.0, 0.0, 3.0 * (1 - 1e-8)), AXIS, 1e-8),
            State(J, 0.0, (6.0 * (1 - 1e-8), 0.0, 0.0), AXIS, 1e-8),
        ],
        "by π less 1e-4": lambda level: [turned(SLENDER, LIGHT, unit(TILTED), FLIP, 5e-5)],
        "by π less 1e-8": lambda level: [turned(SLENDER, LIGHT, unit(TILTED), FLIP, 5e-9)],
        "by π, to rounding": lambda level: [turned(SLENDER, LIGHT, unit(TILTED), FLIP, 0.0)],
    },
    "fold": {
        "1e-8 before it": lambda level: [beside_fold(1e-8)],
        "1e-8 beyond it": lambda level: [beside_fold(-1e-8)],
        "1e-12 before it": lambda level: [beside_fold(1e-12)],
        "1e-12 beyond it": lambda level: [beside_fold(-1e-12)],
        "one ulp before it": lambda level: [next_to_fold(level, -1)],
        "one ulp beyond it": lambda level: [next_to_fold(level, 1)],
        "twice as far": lambda level: [beside_fold(-1.0)],
        "more than any rotation has": _of(State(J, D, scaled(K, 1e3), G, -1e3), State(J, D, scaled(K, 1e300), G, -1e3)),
    },
    "D": {
        "D = 0": lambda level: [halfway(J, 0.0), halfway(J, 0.0, G)],
        "D = 1e-12": lambda level: [halfway(J, 1e-12), halfway(J, 1e-12, G)],
        "D = 1e6": _heavy(1e6),
        "D = 1e12": _heavy(1e12),
        "D = 1e15": _heavy(1e15),
        "D = 1e6, momentum horizontal": lambda level: [halfway(J, 1e6, _across(G))],
        "D = 1e12, momentum horizontal": lambda level: [halfway(J, 1e12, _across(G))],
        "D = 1e15, momentum horizontal": lambda level: [halfway(J, 1e15, _across(G))],
    },
    "inertia": {
        "one ulp apart": lambda level: [
            halfway((1.0, _ulps(1.0, 1), _ulps(1.0, 2)), D), halfway((1.0, 1.0, _ulps(1.0, 5)), 0.0),
        ],
        "1e-15 apart": lambda level: [halfway((2.0, 2.0 * (1 + 1e-15), 2.0 * (1 - 1e-15)), D)],
        "equal": lambda level: [halfway((1.0, 1.0, 1.0), D), halfway((1.0, 1.0, 1.0), 0.0, G)],
        "a flat body, one J = 0": lambda level: [halfway((0.0, 1.0, 2.0), D), halfway((1.0, 0.0, 1.0), D, G, AXIS)],
        "a rod, two J = 0": lambda level: [
            halfway((0.0, 0.0, 1.0), D), halfway((0.0, 0.0, 1.0), D, K, (1.0, 0.0, 0.0)),
        ],
        "a rod upright: no inertia about the vertical": _of(State((0.0, 0.0, 1.0), D, (0.1, 0.0, 0.0), AXIS)),
        "a rod 1e-6 from upright": lambda level: [halfway((0.0, 0.0, 1.0), D, K, unit((1e-6, 0.0, 1.0)))],
        "ratios of 1e12": lambda level: [
            halfway((1e-12, 1.0, 1.0), D), halfway((1e-12, 1e-6, 1.0), 1.0), halfway((1.0, 1e-12, 1e-12), 0.0),
        ],
        "a ball of size 1e-150": lambda level: [halfway(scaled(J, 1e-150), 3e-150)],
        "a ball of size 1e150": lambda level: [halfway(scaled(J, 1e150), 3e150)],
        "a ball of size 1e-300": lambda level: [halfway(scaled(J, 1e-300), 3e-300)],
        "a ball of size 1e300": lambda level: [State(scaled(J, 1e300), 3e300, scaled(K, 1e300), G)],
    },
    "directions": {
        "γ along an axis": lambda level: [halfway(J, D, K, axis) for axis in _axes()],
        "γ 1e-9 from an axis": lambda level: [halfway(J, D, K, unit((1e-9, -1e-9, 1.0)))],
        "momentum vertical": lambda level: [halfway(J, D, G), halfway(J, D, (0.0, 0.0, 1.0), AXIS)],
        "momentum 1e-9 from vertical": lambda level: [halfway(J, D, (G[0] + 1e-9, G[1], G[2]))],
        "momentum horizontal": lambda level: [halfway(J, D, _across(G)), halfway(J, D, (1.0, 0.0, 0.0), AXIS)],
        "momentum 1e-9 from horizontal": lambda level: [halfway(J, D, tuple(_across(G) + 1e-9 * np.array(G)))],
        "momentum along an axis": lambda level: [halfway(J, D, axis) for axis in _axes()],
    },
}  # fmt: skip
