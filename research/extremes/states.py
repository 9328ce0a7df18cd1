"""The states of the matrix, balls and momenta at which formulas lose digits, and the truth of each from the oracle.

The oracle is the matrix equation (4.13) in mpmath: of a step, of a run, and where a branch folds.

    κ = 1 + |T⁻¹| (|𝒦| + 2 I_max |q|) / |q|,  T the tangent Jacobian in the Gibbs vector,

is the condition number of a step, as in `chapsym.studies.check`, here from the oracle's matrices.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from math import sqrt

import numpy as np
from mpmath import MPContext, matrix, mpf

from chapsym.dynamics import Ball, fold
from chapsym.dynamics.loops.branch import small_rotation
from chapsym.dynamics.oracle import Oracle, OracleFailed

from .judging import BUDGET, SINGLE, Level, mp

#: More than any precision has, and what the root near its fold, and the Euler parameters near π, cost: `KNOWN` is left.
DIGITS = 115
#: And of the fold, of which a difference takes half.
FOLD_DIGITS = 40
#: The start of a run is changed by this, relatively, in a direction that is none in particular.
RUN_CHANGE, DIRECTION = mp.mpf(10) ** -40, (1.0, -0.7, 0.4)

Vector = tuple[float, ...]


def scaled(v: Iterable[float], factor: float) -> Vector:
    """A vector times a number."""
    return tuple(factor * c for c in v)


@dataclass(frozen=True)
class State:
    """A ball and its state, in float64, exactly.

    from_fold: how far 𝒦 is from the fold, relatively: positive before it, negative beyond; None if it is far.
    """

    J: Vector
    D: float
    K: Vector
    g: Vector
    from_fold: float | None = None

    @property
    def ball(self) -> Ball:
        """The ball."""
        return Ball(self.J, self.D)


@dataclass(frozen=True)
class Truth:
    """The step: Euler parameters, 𝒦 and γ after it, all mpf; and κ."""

    q0: mpf
    q: list[mpf]
    momentum: list[mpf]
    gamma: list[mpf]
    condition: float


@cache
def truth(state: State) -> Truth | None:
    """The step of the state, with γ divided by its length; None where the branch has folded."""
    if state.from_fold is not None and state.from_fold < 0:
        return None  # known from `fold_at`; the oracle would search long
    oracle = Oracle(state.J, state.D, unit_gamma(state.g), DIGITS)
    try:
        step = oracle.step(state.K)
    except OracleFailed:
        return None
    q, momentum, gamma = ([mp.convert(x) for x in v] for v in (step.q, step.momentum, step.gamma))
    kappa = condition(state, oracle, oracle.tangent(step.rotation) * 2, max(map(abs, q)))
    return Truth(mp.convert(step.q0), q, momentum, gamma, kappa)


def condition(state: State, oracle: Oracle, tangent: matrix, extent: mpf) -> float:
    """κ of a state whose rotation has this tangent and extent."""
    largest = sum(sorted(state.J)[-2:])
    inverse = (tangent / largest) ** -1  # of T by the largest moment, so that it is a float
    stretch = float(np.linalg.norm(np.array(inverse.tolist(), dtype=float), 2))
    size = max(abs(mp.mpf(x)) for x in state.K)
    return 1.0 + stretch * (float(size / (extent * largest)) if extent else 0.0) + 2 * stretch


def unit_gamma(g: Iterable[float]) -> list[mpf]:
    """γ divided by its length."""
    exact = [mp.mpf(x) for x in g]
    length = mp.sqrt(sum(x * x for x in exact))
    return [x / length for x in exact]


@cache
def reachable(state: State) -> bool:
    """Whether any rotation has as much momentum in the direction of 𝒦: a quadratic form in the Euler parameters."""
    oracle = Oracle(state.J, state.D, unit_gamma(state.g), 40)
    K = [mp.mpf(x) for x in state.K]
    length = mp.sqrt(sum(x * x for x in K))

    def along(p: Sequence[mpf]) -> mpf:
        moved = oracle.components(oracle.momentum(rotation_matrix(oracle.mp, p)))
        return sum(k * x for k, x in zip(K, moved, strict=True)) / length

    basis = [[int(i == j) for j in range(4)] for i in range(4)]
    form = mp.matrix(4, 4)
    for i, a in enumerate(basis):
        for j, b in enumerate(basis):
            plus, minus = ([x + s * y for x, y in zip(a, b, strict=True)] for s in (1, -1))
            form[i, j] = (along(plus) - along(minus)) / 4
    return bool(length <= max(mp.eigsy(form, eigvals_only=True)) * (1 + mp.mpf("1e-12")))


def rotation_matrix(context: MPContext, p: Sequence[mpf]) -> matrix:
    """The matrix of Euler parameters of any length, times its square: quadratic in them."""
    a, x, y, z = (context.mpf(v) for v in p)
    return context.matrix([
        [a * a + x * x - y * y - z * z, 2 * (x * y - a * z), 2 * (x * z + a * y)],
        [2 * (x * y + a * z), a * a - x * x + y * y - z * z, 2 * (y * z - a * x)],
        [2 * (x * z - a * y), 2 * (y * z + a * x), a * a - x * x - y * y + z * z],
    ])  # fmt: skip


@cache
def fold_at(J: Vector, D: float, K: Vector, g: Vector) -> mpf:
    """The t at which the small-rotation branch along t𝒦 folds, as an mpf: 𝒦(q, γ) = t𝒦 and det T = 0.

    Solved by the oracle's matrices; `chapsym.fold` gives where to start.
    """
    near = fold(Ball(J, D), K, g)
    oracle = Oracle(J, D, g, FOLD_DIGITS)
    context = oracle.mp
    start = [context.mpf(float(x)) for x in near.rotation]
    largest = max(range(4), key=lambda i: abs(start[i]))

    def equations(*unknown: mpf) -> list[mpf]:
        *p, t = unknown
        full = [*p[:largest], start[largest], *p[largest:]]
        turned = rotation_matrix(context, full) / sum(x * x for x in full)
        moved = oracle.components(oracle.momentum(turned))
        gap = [x - t * k for x, k in zip(moved, map(context.mpf, K), strict=True)]
        return [*gap, 8 * context.det(oracle.tangent(turned))]

    first = [*start[:largest], *start[largest + 1 :], context.mpf(float(near.reach))]
    return context.findroot(equations, first, tol=context.mpf(10) ** (-2 * FOLD_DIGITS + 20))[3]


@cache
def chain(state: State, stages: Vector) -> list[Truth]:
    """The oracle's steps with the momenta cᵢ𝒦, one from the other; raises ArithmeticError where there is none."""
    steps: list[Truth] = []
    for c in stages:
        if (step := truth(replace(state, K=tuple(c * mp.mpf(x) for x in state.K)))) is None:
            raise ArithmeticError("the oracle meets a fold on the way")
        steps.append(step)
        state = replace(state, K=tuple(x / c for x in step.momentum), g=tuple(step.gamma))
    return steps


@cache
def promised(state: State, stages: Vector) -> float:
    """A Σ 4(1 + |q|κ) ulps: each step what a single one does, times A ≥ 1, what the run makes of a small change."""
    steps = chain(state, stages)
    size = max(abs(mp.mpf(x)) for x in state.K)
    moved = tuple(mp.mpf(x) + RUN_CHANGE * size * part for x, part in zip(state.K, DIRECTION, strict=True))
    end = chain(replace(state, K=moved), stages)[-1]
    gaps = [abs(a - b) / size for a, b in zip(end.momentum, steps[-1].momentum, strict=True)]
    gaps += [abs(a - b) for a, b in zip(end.gamma, steps[-1].gamma, strict=True)]
    stretch = max(1.0, float(max(gaps) / RUN_CHANGE))
    return stretch * sum(BUDGET * (1 + float(max(map(abs, step.q))) * step.condition) for step in steps)


# The states, by group and condition.

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
