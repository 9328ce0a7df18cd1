"""One step at a precision, judged by the oracle: the rotation within 4κ ulps, 𝒦 and γ within 4(1 + |q|κ)."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from chapsym.dynamics import BadInput, Ball, Status, StepNotTaken, Trajectory, step
from chapsym.numbers import Pair

from .cells import BUDGET, FAILED, NO_DIGIT, REFUSED, Compared, Judged, compared, worst
from .levels import Level, number
from .truth import State, Truth, reachable, scaled, truth

#: Beyond this share of a rounding from the fold, a precision cannot tell the two sides.
BLUR = BUDGET
#: A state whose κ ulps are below this has half its digits and more at any precision: then it can be resolved.
RESOLVED = 1e-6


#: q, 𝒦 and γ in the numbers of a precision.
Found = tuple[Any, Any, Any]


def taken(level: Level, state: State) -> Found:
    """q, 𝒦 and γ after the step, in the numbers of the precision; raises BadInput and StepNotTaken."""
    ball = Ball(state.J, state.D)
    found = step(ball, state.K, state.g, precision=level.precision)
    q, momentum, gamma = found.rotation, found.momentum, found.gamma
    if found.low is None:
        return q[1:], momentum, gamma
    return both(q, found.low.rotation)[1:], both(momentum, found.low.momentum), both(gamma, found.low.gamma)


def judge(level: Level, state: State) -> Judged:
    """The step of one state."""
    exact = truth(state)
    try:
        found = taken(level, state)
    except BadInput as refusal:
        return refused(str(refusal), exact)
    except StepNotTaken as refusal:
        lie = _lie(refusal.status, level, state, exact)
        if lie and exact and exact.condition * level.unit > NO_DIGIT:
            told = f"rounded to it this is another state, as κ = {exact.condition:.2g}, of which it says: {refusal}"
            return refused(told, exact)
        if lie:
            return Judged(FAILED, condition=exact.condition if exact else None, reason=lie)
        return refused(str(refusal), exact)
    if exact is None and blurred(level, state):  # right for a momentum that is less than a rounding smaller
        exact = truth(mirrored(state))
    if exact is None:
        return Judged(FAILED, reason="a rotation is given where the branch has folded: there is none")
    return beside(level, found, exact)


def beside(level: Level, found: Found, exact: Truth) -> Judged:
    """q, 𝒦 and γ beside the truth; a precision with guard digits promises as if κ were 1."""
    kappa = 1.0 if level.guarded else exact.condition
    extent = float(max(map(abs, exact.q)))
    moved = BUDGET * (1.0 + extent * kappa)
    q = exact.q
    if (
        exact.q0 <= BUDGET * kappa * number(level.unit)
        and sum(number(a) * b for a, b in zip(found[0], q, strict=True)) < 0
    ):
        q = [-x for x in q]  # a rotation by π, to rounding: q and -q are the same, and q₀ ≥ 0 does not tell
    vectors = [
        Compared("the rotation", found[0], q, BUDGET * kappa),
        Compared("the momentum", found[1], exact.momentum, moved),
        Compared("gamma", found[2], exact.gamma, moved, 1),
    ]
    return compared(level, vectors, exact.condition)


def last_frame(run: Trajectory) -> tuple[Sequence[Any], Sequence[Any]]:
    """𝒦 and γ at the end of a run, of one ball or of the first of a batch; with both halves of a double-double."""
    momentum, gamma = (x.reshape(-1, *x.shape[-2:])[0, -1] for x in (run.momentum, run.gamma))
    if run.low is None:
        return momentum, gamma
    low = [x.reshape(-1, *x.shape[-2:])[0, -1] for x in (run.low.momentum, run.low.gamma)]
    return both(momentum, low[0]), both(gamma, low[1])


def both(high: Any, low: Any) -> list[Pair]:
    """The double-double numbers of their halves."""
    return [Pair(float(a), float(b)) for a, b in zip(high, low, strict=True)]


def refused(sentence: str, exact: Truth | None) -> Judged:
    """A refusal; one without a sentence is a failure."""
    clear = len(sentence.split()) >= 4
    kappa = exact.condition if exact else None
    return Judged(REFUSED if clear else FAILED, condition=kappa, reason=sentence or "refused without a reason")


def _lie(status: Status, level: Level, state: State, exact: Truth | None) -> str:
    """What is not true of a refusal, or nothing."""
    out_of_reach = status in (Status.FOLDED, Status.UNREACHABLE) and not blurred(level, state)
    if exact is not None and (out_of_reach or status is Status.NO_INERTIA):
        return f'says "{status.sentence}", but the oracle reaches it'
    if exact is not None and status is Status.NOT_CONVERGED and exact.condition * level.unit < RESOLVED:
        return f'says "{status.sentence}", but κ is only {exact.condition:.3g}'
    if exact is None and status is Status.UNREACHABLE and reachable(state):
        return f'says "{status.sentence}", but other rotations have it'
    return ""


def blurred(level: Level, state: State) -> bool:
    """Whether the precision cannot tell on which side of the fold the momentum is."""
    return state.from_fold is not None and abs(state.from_fold) <= BLUR * float(level.unit)


def mirrored(state: State) -> State:
    """The state as far before its fold as it is beyond it."""
    assert state.from_fold is not None
    shrink = 1.0 + 2.0 * state.from_fold
    return replace(state, K=scaled(state.K, shrink), from_fold=-state.from_fold)


def of(states: Callable[[Level], Sequence[State]], level: Level, quick: bool) -> Judged:
    """The worst of some states."""
    return worst([judge(level, state) for state in states(level)])
