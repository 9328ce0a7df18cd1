"""What is judged by the oracle: one step, where a branch folds, a few steps alone and in a batch, and long runs.

Of one step the rotation is to be within 4κ ulps, 𝒦 and γ within 4(1 + |q|κ).
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from mpmath import mpf

from chapsym import generated
from chapsym.dynamics import Ball, Status, StepNotTaken, Trajectory, fold, reverse, step, step_vertical, trajectory
from chapsym.dynamics.coefficients import COMPOSITIONS

from . import judging, states
from .judging import BUDGET, DOUBLE, FAILED, Judged, Level, compared, mp, number, refused, state, whole, worst
from .states import State, Truth, Vector, chain, fold_at, promised, reachable, scaled, truth, unit_gamma

#: Beyond this share of a rounding from the fold, a precision cannot tell the two sides.
BLUR = BUDGET
#: A state whose κ ulps are below this has half its digits and more at any precision: then it can be resolved.
RESOLVED = 1e-6
#: `fold_at` has 40 digits: half of them are left to a difference.
DIFFERENCE = mp.mpf(10) ** -15

#: q, 𝒦 and γ in the numbers of a precision.
Found = tuple[np.ndarray, np.ndarray, np.ndarray]
#: Balls of a batch: enough, with ten steps, for the loop over blocks of balls.
BATCH = 4096
STEPS = 10
TEN = (mp.one,) * STEPS
#: ⟨𝒦,γ⟩, |𝒦|² and |γ|² are restored after this many steps; in between sums are compensated, so that only the
#: roundings of their increments add up: half an ulp of the angle θ of a step each, like √n.  Pairs and the numbers
#: of any precision are summed as they are: half an ulp of the whole each.
RESTORED = 1024


def taken(level: Level, given: State) -> Found:
    """q, 𝒦 and γ after the step, in the numbers of the precision; raises BadInput and StepNotTaken."""
    found = step(given.ball, given.K, given.g, precision=level.precision)
    return whole(found, "rotation")[1:], whole(found, "momentum"), whole(found, "gamma")


def judge(given: State | Callable[[Level], State], level: Level, quick: bool) -> Judged:
    """The step of one state."""
    given = given(level) if callable(given) else given
    exact = truth(given)
    try:
        found = taken(level, given)
    except StepNotTaken as refusal:
        kappa, words = exact.condition if exact else None, str(refusal)
        lie = _lie(refusal.status, level, given, exact)
        if lie and exact and exact.condition * level.unit > judging.NO_DIGIT:
            lie, words = "", f"rounded to it this is another state, as κ = {kappa:.2g}, of which it says: {refusal}"
        return Judged(FAILED, condition_number=kappa, reason=lie) if lie else refused(words, kappa)
    if exact is None and blurred(level, given):  # right for a momentum that is less than a rounding smaller
        assert given.from_fold is not None
        nearer = scaled(given.K, 1.0 + 2.0 * given.from_fold)
        exact = truth(replace(given, K=nearer, from_fold=-given.from_fold))
        return beside(level, found, exact)
    judged = beside(level, found, exact)
    return worst([judged, *bounded(given, exact)]) if level is DOUBLE and exact is not None else judged


def bounded(given: State, exact: Truth) -> list[Judged]:
    """The proved bounds of a step in float64 that are wrong, being below the error."""
    found = step(given.ball, given.K, given.g, proved=True)
    assert found.proved is not None
    wrong = []
    for name, truths in (("momentum", exact.momentum), ("gamma", exact.gamma)):
        away = [number(x) - t for x, t in zip(getattr(found, name), truths, strict=True)]
        error, bound = mp.sqrt(sum(x * x for x in away)), float(getattr(found.proved, name))
        if error > bound * (1 + judging.KNOWN):
            wrong.append(Judged(FAILED, reason=f"{name} is wrong by {float(error):.3g}, where {bound:.3g} is proved"))
    return wrong


def beside(level: Level, found: Found, exact: Truth | None) -> Judged:
    """q, 𝒦 and γ compared with the truth; a precision with guard digits promises as if κ were 1."""
    if exact is None:
        return Judged(FAILED, reason="a rotation is given where the branch has folded: there is none")
    kappa = 1.0 if level.guarded else exact.condition
    q, extent = exact.q, float(max(map(abs, exact.q)))
    turned = sum(number(a) * b for a, b in zip(found[0], q, strict=True)) < 0
    if turned and exact.q0 <= BUDGET * kappa * number(level.unit):
        q = [-x for x in q]  # a rotation by π, to rounding: q and -q are the same, and q₀ ≥ 0 does not tell
    rotation = compared(level, exact.condition, "the rotation", found[0], q, BUDGET * kappa)
    moved = BUDGET * (1.0 + extent * kappa)
    return state(level, exact.condition, found[1:], (exact.momentum, exact.gamma), moved, rotation)


def _lie(status: Status, level: Level, given: State, exact: Truth | None) -> str:
    """The part of a refusal that is not true, or nothing."""
    out_of_reach = status in (Status.FOLDED, Status.UNREACHABLE) and not blurred(level, given)
    if exact is not None and (out_of_reach or status is Status.NO_INERTIA):
        return f'says "{status.sentence}", but the oracle reaches it'
    if exact is not None and status is Status.NOT_CONVERGED and exact.condition * level.unit < RESOLVED:
        return f'says "{status.sentence}", but κ is only {exact.condition:.3g}'
    if exact is None and status is Status.UNREACHABLE and reachable(given):
        return f'says "{status.sentence}", but other rotations have it'
    return ""


def blurred(level: Level, given: State) -> bool:
    """Whether the precision cannot tell on which side of the fold the momentum is."""
    return given.from_fold is not None and abs(given.from_fold) <= BLUR * float(level.unit)


def vertical(given: State, level: Level, quick: bool) -> Judged:
    """One step of `step_vertical`, judged as one of `step`."""
    height = float(np.dot(given.K, given.g))
    exact = truth(replace(given, K=tuple(mp.mpf(height) * x for x in unit_gamma(given.g))))
    found = step_vertical(given.ball, height, given.g)
    return beside(level, (found.rotation[1:], found.momentum, found.gamma), exact)


def fold_search(item: tuple[State, float], level: Level, quick: bool) -> Judged:
    """`fold`: the t at which the branch along t𝒦 folds, where so large a multiple of the momentum is given."""
    given, size = item
    found = fold(given.ball, scaled(given.K, size), given.g)
    if not np.isfinite(found.reach):
        return Judged(FAILED, reason="the reach is NaN, and nothing says why")

    def at(x: Sequence[mpf]) -> mpf:
        return mp.make_mpf(fold_at(tuple(x[6:9]), x[9], tuple(x[:3]), tuple(x[3:6]))._mpf_)

    inputs = [mp.mpf(x) for x in (*given.K, *given.g, *given.J, given.D)]
    exact = at(inputs)
    moved = [at([*inputs[:i], x * (1 + DIFFERENCE), *inputs[i + 1 :]]) for i, x in enumerate(inputs) if x]
    kappa = float(sum(abs(other - exact) for other in moved) / DIFFERENCE / abs(exact))  # Σ |∂t/∂x · x|/|t|
    judged = compared(level, kappa, "the reach", [number(found.reach) * mp.mpf(size)], [exact], BUDGET * (1 + kappa))
    if judged.verdict == FAILED and not found.settled:
        return refused("Newton settles on no simple fold: `settled` is False, and the reach a lower bound")
    return judged


# Runs: a few steps against a chain of the oracle's; orders, the way back; and long ones.


def ends(level: Level, given: State, stages: Vector, run: Trajectory) -> Judged:
    """𝒦 and γ after a run, of one ball or the first of a batch, compared with the end of the oracle's chain."""
    exact = chain(given, stages)
    last = [whole(run, name) for name in ("momentum", "gamma")]
    found = [array.reshape(-1, *array.shape[-2:])[0, -1] for array in last]
    end = [x / stages[-1] for x in exact[-1].momentum], exact[-1].gamma
    return state(level, max(one.condition for one in exact), found, end, promised(given, stages))


def ten_steps(given: State, level: Level, quick: bool, balls: int = 0) -> Judged:
    """Ten steps of `trajectory`, of one ball or of as many that are equal."""
    momentum = np.tile(given.K, (balls, 1)) if balls else given.K
    run = trajectory(given.ball, momentum, given.g, STEPS, every=STEPS, precision=level.precision)
    return ends(level, given, TEN, run)


def composed(item: State | Callable[[int], State], level: Level, quick: bool) -> Judged:
    """A step of order 8, 4 when quick, compared with the oracle's composition with the same decimal coefficients."""
    order = 4 if quick else 8
    given = item(order) if callable(item) else item
    stages = tuple(number(c) for c in COMPOSITIONS[order].exact)
    run = trajectory(given.ball, given.K, given.g, 1, order=order, precision=level.precision)
    return ends(level, given, stages, run)


def near_its_fold(order: int) -> State:
    """The state whose longest stage is at 0.9 of the fold."""
    longest = max(abs(c) for c in COMPOSITIONS[order].exact)
    return states.part(states.J, states.D, states.K, states.G, float(0.9 / longest))


def way_back(given: State, level: Level, quick: bool) -> Judged:
    """Ten steps and `reverse`: the start again, with the momentum reversed."""
    there = trajectory(given.ball, given.K, given.g, STEPS, precision=level.precision)
    back = reverse(there)
    start = [[number(x) for x in v] for v in (-there.momentum[0], there.gamma[0])]
    kappa = max(one.condition for one in chain(given, TEN))
    return state(level, kappa, (back.momentum[-1], back.gamma[-1]), start, 2 * promised(given, TEN))


def long_run(size: float, level: Level, quick: bool) -> Judged:
    """How far ⟨𝒦,γ⟩, |𝒦|² and |γ|² move in a long run with |𝒦| = size: in ulps of the precision."""
    steps = level.long[0 if quick else 1]
    ball, momentum = Ball((0.1, 0.5, 1.6), 0.7), scaled(states.unit((0.3, -0.2, 0.35)), size)
    run = trajectory(ball, momentum, states.G, steps, every=max(1, steps // 100), precision=level.precision)
    if int(run.taken) != steps:
        return Judged(FAILED, reason=f"{run.taken} of {steps} steps were taken")
    # a bound of the angle of a step, as the momentum is small
    angle = float(np.linalg.norm(momentum) / ball.inertia.min()) if level.compensated else 1.0
    drift = BUDGET * (1 + angle * RESTORED**0.5 / 2)
    frames = zip(whole(run, "momentum"), whole(run, "gamma"), strict=True)
    first, *later = [generated.invariants(*(number(x) for v in frame for x in v)) for frame in frames]
    return worst([
        compared(level, None, f"an integral after {done} steps", [now], [start], drift)
        for done, frame in zip(run.index[1:], later, strict=True)
        for start, now in zip(first, frame, strict=True)
    ])  # fmt: skip
