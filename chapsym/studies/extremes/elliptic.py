"""The elliptic path at its ends: the curve, its points, arguments and increments, beside mpmath's elliptic functions.

The reference takes (5.7), (5.8) and (5.13) as they are, with 140 digits, where nothing needs a stable form.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, Curve, exact_top, increment, trajectory
from chapsym.dynamics.oracle import Oracle

from . import states
from .cells import BUDGET, Compared, Judged, compared, worst
from .levels import Level, mp
from .steps import refused
from .truth import State, Vector, componentwise, unit_gamma

#: Parts of a quarter period at which points are taken, and some beyond the first period.
PARTS = (0.0, 0.3, 0.999999, 1.0, 1.7, 2.0, 3.1, 10.3)
STEPS = 50


def parameters(inputs: Sequence[Any], axes: tuple[int, int, int]) -> dict[str, Any]:
    """C_a, C_b, |C_c|, k², k'², l and |V| of the curve through γ, from γ, J and D, on given axes."""
    g, J, D = unit_gamma(inputs[0:3]), inputs[3:6], inputs[6]  # type: ignore[arg-type]
    moments = [sum(J) - x + D for x in J]
    La, Lb, Lc = (moments[i] for i in axes)
    level = sum(x * x / m for x, m in zip(g, moments, strict=True))
    upper, lower = 1 - Lc * level, La * level - 1
    return {
        "amplitudes": [mp.sqrt(x) for x in (La * upper / (La - Lc), Lb * upper / (Lb - Lc), Lc * lower / (La - Lc))],
        "modulus": mp.sqrt((La - Lb) * upper / ((Lb - Lc) * lower)),
        "complement": mp.sqrt((La - Lc) * (Lb * level - 1) / ((Lb - Lc) * lower)),
        "level": level,
        "rate": mp.sqrt((Lb - Lc) * lower / (La * Lb * Lc)),
    }


def _inputs(state: State) -> tuple[Any, ...]:
    return (*state.g, *state.J, state.D)


def the_curve(level: Level, state: State) -> Judged:
    """k, k', l, V and the amplitudes, each relative to itself."""
    try:
        curve = Curve.through(Ball(state.J, state.D), state.g)
    except BadInput as refusal:
        return refused(str(refusal), None)
    found = {
        "modulus": [curve.modulus], "complement": [curve.complement], "level": [curve.level],
        "rate": [abs(curve.rate)],
        **{f"C_{axis}": [abs(c)] for axis, c in zip("abc", curve.amplitudes, strict=True)},
    }  # fmt: skip
    judged = []
    for name, value in found.items():

        def exact(inputs: Sequence[Any], name: str = name) -> list[Any]:
            values = parameters(inputs, curve.axes)
            return [values["amplitudes"]["abc".index(name[-1])] if name[:2] == "C_" else values[name]]

        truth, kappa = componentwise(exact, _inputs(state))
        judged.append(compared(level, [Compared(name, value, truth, BUDGET * (1 + kappa))], kappa))
    return worst(judged)


def _point(inputs: Sequence[Any], u: Any, curve: Curve) -> list[Any]:
    """γ(u), with the signs and the axes of a curve."""
    values = parameters(inputs, curve.axes)
    k = values["modulus"]
    functions = [mp.ellipfun(name, u, k=k) for name in ("cn", "sn", "dn")]
    point = [mp.zero] * 3
    for axis, size, value in zip(curve.axes, values["amplitudes"], functions, strict=True):
        point[axis] = size * value
    if curve.amplitudes[2] < 0:
        point[curve.axes[2]] *= -1
    return point


def the_points(level: Level, state: State) -> Judged:
    """γ(u), in ulps of 1, and `argument` of γ by its point."""
    try:
        curve = Curve.through(Ball(state.J, state.D), state.g)
    except BadInput as refusal:
        return refused(str(refusal), None)
    quarter = min(curve.period / 4, 40.0)
    judged = []
    for part in PARTS:
        u = part * quarter
        truth, kappa = componentwise(lambda x: _point(x[1:], x[0], curve), (u, *_inputs(state)))
        found = curve.point(u)
        judged.append(compared(level, [Compared(f"γ({u:.3g})", found, truth, BUDGET * (1 + kappa), 1)], kappa))
    back, kappa = componentwise(lambda x: unit_gamma(x[:3]), _inputs(state))  # type: ignore[arg-type]
    found = curve.point(curve.argument(state.g))
    # u has its own rounding, |u| ulps: γ moves with |dγ/du| ≤ 1 of it
    promised = BUDGET * (1 + kappa + quarter)
    return worst([*judged, compared(level, [Compared("γ(u(γ))", found, back, promised, 1)], kappa)])


def the_increment(level: Level, state: State) -> Judged:
    """γ(u + 2δu) beside the oracle's step with the vertical momentum hγ, h = ⟨𝒦,γ⟩."""
    ball = Ball(state.J, state.D)
    height = float(np.dot(state.K, state.g))
    try:
        curve = Curve.through(ball, state.g)
        u = float(curve.argument(state.g))
        found = curve.point(u + increment(curve, height, u))
    except BadInput as refusal:
        return refused(str(refusal), None)

    def stepped(inputs: Sequence[Any]) -> list[Any]:
        h, *g = inputs[:4]
        g = unit_gamma(g)  # type: ignore[arg-type]
        step = Oracle(inputs[4:7], inputs[7], g, 80).step([h * x for x in g])
        return [mp.make_mpf(x._mpf_) for x in step.gamma]

    truth, kappa = componentwise(stepped, (height, *_inputs(state)))
    promised = BUDGET * (1 + kappa + abs(u))
    return compared(level, [Compared("γ(u + 2δu)", found, truth, promised, 1)], kappa)


def the_exact_top(level: Level, state: State) -> Judged:
    """𝒦/|𝒦| after fifty steps of the exact top, beside the continuous curve; D = 0."""
    ball = Ball(state.J, 0.0)
    axis = states.unit(state.g)
    try:
        top = exact_top(ball, states.scaled(axis, 0.05 * max(state.J)), axis)
    except BadInput as refusal:
        return refused(str(refusal), None)
    run = top.restore(trajectory(top.ball, top.momentum, axis, STEPS))
    found = run.momentum[-1] / np.sqrt((run.momentum[-1] ** 2).sum())
    speed, inputs = top.size, (*axis, *state.J)
    try:
        curve = Curve.through(ball, axis)
    except BadInput:  # it stays where it is
        return compared(level, [Compared("K", found, unit_gamma(axis), BUDGET * STEPS, 1)], 1.0)

    def moved(x: Sequence[Any]) -> list[Any]:
        full = (*x[:6], mp.zero)
        values = parameters(full, curve.axes)
        start = _argument(full, curve, values)
        sign = 1 if curve.rate > 0 else -1
        return _point(full, start + sign * values["rate"] * x[6] * STEPS, curve)

    truth, kappa = componentwise(moved, (*inputs, speed))
    return compared(level, [Compared("K", found, truth, BUDGET * STEPS * (1 + kappa), 1)], kappa)


def _argument(inputs: Sequence[Any], curve: Curve, values: dict[str, Any]) -> Any:
    """u of γ itself, from its sine and its sign of the cosine."""
    g = unit_gamma(inputs[:3])  # type: ignore[arg-type]
    a, b, _ = curve.axes
    cn, sn = g[a] / values["amplitudes"][0], g[b] / values["amplitudes"][1]
    return mp.ellipf(mp.atan2(sn, cn), values["modulus"] ** 2)


def _through(J: Vector, D: float, g: Vector, size: float = 0.3) -> State:
    unit = states.unit(g)
    return State(J, D, states.scaled(unit, size), unit)


def _near_separatrix(J: Vector, D: float, away: float, size: float = 0.3) -> State:
    """γ on the great circle of the separatrix, but for `away` times the second axis of it."""
    a, b, c = (sum(J) - x + D for x in J)  # decreasing for J increasing
    x, z = np.sqrt(a * (b - c)), np.sqrt(c * (a - b))
    return _through(J, D, (x * (1 + away), 0.4 * np.hypot(x, z), z), size)


J, D = states.J, states.D
CONDITIONS: dict[str, list[State]] = {
    "generic": [_through(J, D, states.G), _through(J, D, (0.9, 0.3, 0.2)), _through(J, 0.0, (0.1, 0.3, 0.9))],
    "k → 1, to 1e-4": [_near_separatrix(J, D, 1e-4), _near_separatrix(J, D, -1e-4)],
    "k → 1, to 1e-10": [_near_separatrix(J, D, 1e-10), _near_separatrix(J, 0.0, -1e-10)],
    "k → 1, to 1e-13": [_near_separatrix(J, D, 1e-13), _near_separatrix(J, 0.0, -1e-13)],
    "k → 0, moments 1e-9 apart": [_through((1.0, 1.0 + 1e-9, 4.0), D, states.G)],
    "k = 0, equal moments": [_through((1.0, 1.0, 4.0), D, states.G), _through((2.0, 1.0, 1.0), 0.0, states.G)],
    "moments 1e-15 apart": [_through((1.0, 1.0 + 1e-15, 1.0 + 3e-15), D, states.G)],
    "l at its upper end, 1e-8": [_through(J, D, (1e-8, 2e-8, 1.0))],
    "l at its lower end, 1e-8": [_through(J, D, (1.0, 2e-8, 1e-8))],
    "l at its ends, 1e-150": [_through(J, D, (1e-150, 2e-150, 1.0)), _through(J, D, (1.0, 2e-150, 1e-150))],
    "γ on an axis": [_through(J, D, (0.0, 0.0, 1.0)), _through(J, D, (1.0, 0.0, 0.0))],
    "γ on the middle axis": [_through(J, D, (0.0, 1.0, 0.0))],
    "1e-8 from the middle axis": [_through(J, D, (1e-8, 1.0, 2e-8))],
    "D = 1e6": [_through(J, 1e6, states.G)],
    "a flat body": [_through((0.0, 1.0, 2.0), D, states.G)],
    "increments 1e-12": [_through(J, D, states.G, 1e-12)],
}

QUANTITIES: dict[str, Callable[[Level, State], Judged]] = {
    "the curve": the_curve, "points": the_points, "increment": the_increment, "exact top": the_exact_top,
}  # fmt: skip


def of(quantity: str, condition: str, level: Level, quick: bool) -> Judged:
    """The worst of the states of a condition."""
    with mp.workdps(480 if "150" in condition else 140):  # there 1 - Λ_c l is 1e-300
        return worst([QUANTITIES[quantity](level, state) for state in CONDITIONS[condition]])
