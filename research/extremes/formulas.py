"""Closed formulas beside the same in mpmath: ω, the energy, 𝒦 of ω; the curve in Jacobi's functions, the exact top.

The condition number is componentwise: Σ |∂f/∂x · x|/|f| over the inputs, with γ kept a unit vector.  So nothing is
forgiven that a better formula would not lose: ω of a ball with D = 1e6 is as well conditioned as with D = 1.
The references of the curve take (5.7), (5.8) and (5.13) as they are, where nothing needs a stable form.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Curve, exact_top, increment, kernels, trajectory
from chapsym.dynamics.oracle import Oracle

from . import states
from .judging import BUDGET, Judged, Level, compared, mp, worst
from .states import AXIS, FLAT, RATIOS, ROD, D, G, J, K
from .truth import State, Vector, componentwise, scaled, unit_gamma

#: Parts of a quarter period at which points are taken, and some beyond the first period.
PARTS = (0.0, 0.3, 0.999999, 1.0, 1.7, 2.0, 3.1, 10.3)
STEPS = 50

Inputs = Sequence[Any]


def beside(
    level: Level, name: str, found: Any, function: Callable[[Inputs], list[Any]], inputs: Inputs, *,
    size: Any = None, times: int = 1, more: float = 0.0,
) -> Judged:  # fmt: skip
    """What was found beside a function of inputs, within 4(1 + κ + more)·times ulps."""
    truth, kappa = componentwise(function, inputs)
    return compared(level, kappa, name, np.atleast_1d(found), truth, times * BUDGET * (1 + kappa + more), size)


def moments(J: Inputs, D: Any) -> list[Any]:
    """Λ's entries."""
    return [J[1] + J[2] + D, J[0] + J[2] + D, J[0] + J[1] + D]


def angular_velocity(inputs: Inputs) -> list[Any]:
    """ω of K = Λω - D⟨ω,γ⟩γ, by the linear equations; of K, γ, J and D."""
    g, D = mp.matrix(unit_gamma(inputs[3:6])), inputs[9]
    return list(mp.lu_solve(mp.diag(moments(inputs[6:9], D)) - D * g * g.T, mp.matrix(inputs[:3])))


def energy(inputs: Inputs) -> list[Any]:
    """½⟨K,ω⟩."""
    return [sum(k * w for k, w in zip(inputs[:3], angular_velocity(inputs), strict=True)) / 2]


def contact_momentum(inputs: Inputs) -> list[Any]:
    """K = Λω - D⟨ω,γ⟩γ, of ω, γ, J and D."""
    omega, g, D = inputs[:3], unit_gamma(inputs[3:6]), inputs[9]
    along = sum(a * b for a, b in zip(omega, g, strict=True))
    return [m * w - D * along * c for m, w, c in zip(moments(inputs[6:9], D), omega, g, strict=True)]


#: A quantity, and the function that is the truth of the kernel of its name.
QUANTITIES = {"ω": angular_velocity, "energy": energy, "𝒦 of ω": contact_momentum}


def derived(item: tuple[str, State], level: Level, quick: bool) -> Judged:
    """A quantity of a state, whose vector is K, or ω."""
    quantity, state = item
    function = QUANTITIES[quantity]
    found = getattr(kernels, function.__name__)(state.K, state.g, state.J, state.D)
    return beside(level, quantity, found, function, (*state.K, *state.g, *state.J, state.D))


def _several(D: float, size: float = 1.0) -> list[State]:
    pairs = (K, G), (K, AXIS), (G, G), (states.ACROSS, G), (AXIS, AXIS), (K, states.unit((1e-6, -2e-6, 1.0)))
    return [State(J, D, scaled(v, size), g) for v, g in pairs]


DERIVED = {
    **{f"D = {D}": _several(float(D)) for D in ("3", "0", "1e6", "1e12")},
    "momentum 1e-300": _several(3.0, 1e-150),
    "a rod 1e-6 from upright": [State(ROD, D, K, states.unit((1e-6, 0.0, 1.0)))],
    "ratios of 1e12": [State(RATIOS, 1.0, K, G)],
}


def parameters(inputs: Inputs, axes: tuple[int, int, int]) -> dict[str, Any]:
    """C_a, C_b, |C_c|, k, k', l and |V| of the curve through γ, from γ, J and D, on given axes."""
    g, all_moments = unit_gamma(inputs[0:3]), moments(inputs[3:6], inputs[6])
    La, Lb, Lc = (all_moments[i] for i in axes)
    level = sum(x * x / m for x, m in zip(g, all_moments, strict=True))
    upper, lower = 1 - Lc * level, La * level - 1
    return {
        "modulus": mp.sqrt((La - Lb) * upper / ((Lb - Lc) * lower)),
        "complement": mp.sqrt((La - Lc) * (Lb * level - 1) / ((Lb - Lc) * lower)),
        "level": level,
        "rate": mp.sqrt((Lb - Lc) * lower / (La * Lb * Lc)),
        "C_a": mp.sqrt(La * upper / (La - Lc)),
        "C_b": mp.sqrt(Lb * upper / (Lb - Lc)),
        "C_c": mp.sqrt(Lc * lower / (La - Lc)),
    }


def _inputs(state: State) -> tuple[Any, ...]:
    return (*state.g, *state.J, state.D)


def the_curve(state: State, level: Level) -> Judged:
    """k, k', l, V and the amplitudes, each relative to itself."""
    curve = Curve.through(state.ball, state.g)
    found = {name: abs(getattr(curve, name)) for name in ("modulus", "complement", "level", "rate")}
    found |= {f"C_{axis}": abs(c) for axis, c in zip("abc", curve.amplitudes, strict=True)}
    return worst([
        beside(level, name, value, lambda x, name=name: [parameters(x, curve.axes)[name]], _inputs(state))  # type: ignore[misc]
        for name, value in found.items()
    ])  # fmt: skip


def _point(inputs: Inputs, u: Any, curve: Curve) -> list[Any]:
    """γ(u), with the signs and the axes of a curve."""
    values = parameters(inputs, curve.axes)
    point = [mp.zero] * 3
    for axis, name, function in zip(curve.axes, ("C_a", "C_b", "C_c"), ("cn", "sn", "dn"), strict=True):
        point[axis] = values[name] * mp.ellipfun(function, u, k=values["modulus"])
    if curve.amplitudes[2] < 0:
        point[curve.axes[2]] *= -1
    return point


def the_points(state: State, level: Level) -> Judged:
    """γ(u), in ulps of 1, and `argument` of γ by its point."""
    curve, inputs = Curve.through(state.ball, state.g), _inputs(state)
    quarter = min(curve.period / 4, 40.0)
    judged = [
        beside(level, f"γ({u:.3g})", curve.point(u), lambda x: _point(x[1:], x[0], curve), (u, *inputs), size=1)
        for u in (part * quarter for part in PARTS)
    ]
    # u has its own rounding, |u| ulps: γ moves with |dγ/du| ≤ 1 of it
    there = curve.point(curve.argument(state.g))
    back = beside(level, "γ(u(γ))", there, lambda x: unit_gamma(x[:3]), inputs, size=1, more=quarter)
    return worst([*judged, back])


def the_increment(state: State, level: Level) -> Judged:
    """γ(u + 2δu) beside the oracle's step with the vertical momentum hγ, h = ⟨𝒦,γ⟩."""
    height = float(np.dot(state.K, state.g))
    curve = Curve.through(state.ball, state.g)
    u = float(curve.argument(state.g))

    def stepped(inputs: Inputs) -> list[Any]:
        g = unit_gamma(inputs[1:4])
        step = Oracle(inputs[4:7], inputs[7], g, 80).step([inputs[0] * x for x in g])
        return [mp.make_mpf(x._mpf_) for x in step.gamma]

    found = curve.point(u + increment(curve, height, u))
    return beside(level, "γ(u + 2δu)", found, stepped, (height, *_inputs(state)), size=1, more=abs(u))


def the_exact_top(state: State, level: Level) -> Judged:
    """𝒦/|𝒦| after fifty steps of the exact top, beside the continuous curve; D = 0."""
    state = State(state.J, 0.0, state.K, states.unit(state.g))
    top = exact_top(state.ball, scaled(state.g, 0.05 * max(state.J)), state.g)
    run = top.restore(trajectory(top.ball, top.momentum, state.g, STEPS))
    found = run.momentum[-1] / np.sqrt((run.momentum[-1] ** 2).sum())
    try:
        curve = Curve.through(state.ball, state.g)
    except BadInput:  # it stays where it is
        return compared(level, 1.0, "K", found, unit_gamma(state.g), BUDGET * STEPS, 1)

    def moved(x: Inputs) -> list[Any]:
        inputs = (*x[:6], mp.zero)
        values = parameters(inputs, curve.axes)
        g, (a, b, _) = unit_gamma(inputs[:3]), curve.axes
        start = mp.ellipf(mp.atan2(g[b] / values["C_b"], g[a] / values["C_a"]), values["modulus"] ** 2)
        sign = 1 if curve.rate > 0 else -1
        return _point(inputs, start + sign * values["rate"] * x[6] * STEPS, curve)

    return beside(level, "K", found, moved, (*state.g, *state.J, top.size), size=1, times=STEPS)


ELLIPTIC: dict[str, Callable[[State, Level], Judged]] = {
    "the curve": the_curve, "points": the_points, "increment": the_increment, "exact top": the_exact_top,
}  # fmt: skip


def elliptic(item: tuple[str, State], level: Level, quick: bool) -> Judged:
    """A quantity of the curve through a state's γ."""
    quantity, state = item
    tiny = min(x for x in state.g if x) < 1e-100  # there 1 - Λ_c l is 1e-300
    with mp.workdps(480 if tiny else 140):
        return ELLIPTIC[quantity](state, level)


def through(g: Vector, J: Vector = J, D: float = D, size: float = 0.3) -> State:
    """A state with this γ, whose momentum is along it."""
    along = states.unit(g)
    return State(J, D, scaled(along, size), along)


def near_separatrix(away: float, D: float = D) -> State:
    """γ on the great circle of the separatrix, but for `away` times the second axis of it."""
    a, b, c = (float(x) for x in moments(J, D))  # decreasing, as J increases
    x, z = np.sqrt(a * (b - c)), np.sqrt(c * (a - b))
    return through((x * (1 + away), 0.4 * np.hypot(x, z), z), D=D)


CURVES = {
    "generic": [through(G), through((0.9, 0.3, 0.2)), through((0.1, 0.3, 0.9), D=0.0)],
    "k → 1, to 1e-4": [near_separatrix(1e-4), near_separatrix(-1e-4)],
    "k → 1, to 1e-10": [near_separatrix(1e-10), near_separatrix(-1e-10, D=0.0)],
    "k → 1, to 1e-13": [near_separatrix(1e-13), near_separatrix(-1e-13, D=0.0)],
    "k → 0, moments 1e-9 apart": [through(G, (1.0, 1.0 + 1e-9, 4.0))],
    "k = 0, equal moments": [through(G, (1.0, 1.0, 4.0)), through(G, (2.0, 1.0, 1.0), 0.0)],
    "moments 1e-15 apart": [through(G, (1.0, 1.0 + 1e-15, 1.0 + 3e-15))],
    "l at its upper end, 1e-8": [through((1e-8, 2e-8, 1.0))],
    "l at its lower end, 1e-8": [through((1.0, 2e-8, 1e-8))],
    "l at its ends, 1e-150": [through((1e-150, 2e-150, 1.0)), through((1.0, 2e-150, 1e-150))],
    "γ on an axis": [through((0.0, 0.0, 1.0)), through((1.0, 0.0, 0.0))],
    "γ on the middle axis": [through((0.0, 1.0, 0.0))],
    "1e-8 from the middle axis": [through((1e-8, 1.0, 2e-8))],
    "D = 1e6": [through(G, D=1e6)],
    "a flat body": [through(G, FLAT)],
    "increments 1e-12": [through(G, size=1e-12)],
}
