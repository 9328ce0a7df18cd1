"""What users hand over: arrays of every make give the same bits as plain ones, and what is no number is refused."""

from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from chapsym.dynamics import Ball, Trajectory, trajectory

from . import states
from .judging import FAILED, WITHIN, Judge, Judged, Level, number, whole

#: A state, and a batch of three.
ONE = (np.array(states.K), np.array(states.G))
MANY = (
    np.array([states.K, (0.3, 0.2, -0.1), (-0.4, 0.1, 0.2)]),
    np.array([states.G, (0.6, 0.0, 0.8), (0.0, 0.0, 1.0)]),
)
STEPS = 3
#: The ball of most of them.
BALL = Ball(states.J, states.D)
SAME = Judged(WITHIN, 0.0, 0.0)


def run(level: Level, momentum: Any, gamma: Any, J: Any = states.J, D: Any = states.D) -> Trajectory:
    """A short run at the precision."""
    return trajectory(Ball(J, D), momentum, gamma, STEPS, precision=level.precision)


def bits(found: Trajectory) -> list[Any]:
    """All numbers of a run, exactly."""
    return [number(x) for name in ("momentum", "gamma") for x in whole(found, name).flat]


def same(make: Callable[[np.ndarray], Any], level: Level, quick: bool) -> Judged:
    """The same bits from arrays that are made otherwise, for one state and for a batch."""
    for plain in (ONE, MANY):
        made = [make(x) for x in plain]
        before = [np.array(x, copy=True) for x in made]
        if bits(run(level, *made)) != bits(run(level, *plain)):
            return Judged(FAILED, reason="other numbers than from plain arrays")
        if any((np.asarray(x) != y).any() for x, y in zip(made, before, strict=True)):
            return Judged(FAILED, reason="the arrays that were given are changed")
    return SAME


def strided(x: np.ndarray) -> np.ndarray:
    """Every second element of a larger array, backwards in the components."""
    wide = np.zeros((*x.shape[:-1], 6))
    wide[..., ::-2] = x
    return wide[..., ::-2]


def read_only(x: np.ndarray) -> np.ndarray:
    """An array that cannot be written."""
    copy = x.copy()
    copy.flags.writeable = False
    return copy


MAKES: dict[str, Callable[[np.ndarray], Any]] = {
    "not contiguous, backwards": strided,
    "column order": np.asfortranarray,
    "wrong byte order": lambda x: x.astype(x.dtype.newbyteorder()),
    "read-only": read_only,
    "lists": lambda x: x.tolist(),
    "fractions": np.vectorize(Fraction, otypes=[object]),
    "decimals": np.vectorize(Decimal, otypes=[object]),
    "long doubles": lambda x: x.astype(np.longdouble),
    "memory views": lambda x: np.ascontiguousarray(x).data,
}


def float32(level: Level, quick: bool) -> Judged:
    """float32 arrays are the float64 numbers that they hold, and γ is a unit vector as far as they tell."""
    momentum, gamma = (x.astype(np.float32) for x in (np.array(states.K), np.array((0.6, 0.0, 0.8))))
    found = run(level, momentum, gamma, np.array(states.J, np.float32), np.float32(states.D))
    wide = gamma.astype(np.float64)
    plain = run(level, momentum.astype(np.float64), wide / np.sqrt(wide @ wide))
    ulps = float(max(abs(a - b) for a, b in zip(bits(found), bits(plain), strict=True))) * 2**23
    return Judged(WITHIN if ulps <= 16 else FAILED, ulps, 16.0, reason="" if ulps <= 16 else "not those numbers")


def empty(level: Level, quick: bool) -> Judged:
    """A batch of no balls, and a run of no steps."""
    for shape in ((0, 3), (2, 0, 3)):
        found = run(level, np.zeros(shape), states.G)
        if found.momentum.shape != (*shape[:-1], STEPS + 1, 3) or found.status.shape != shape[:-1]:
            return Judged(FAILED, reason=f"an empty batch {shape} has the shape {found.momentum.shape}")
    still = trajectory(BALL, states.K, states.G, 0, precision=level.precision)
    return SAME if still.momentum.shape == (1, 3) else Judged(FAILED, reason="0 steps have frames")


def huge(level: Level, quick: bool) -> Judged:
    """A batch of many balls, some of them beside themselves alone."""
    count = level.huge[0 if quick else 1]
    momentum = np.random.default_rng(7).uniform(-0.3, 0.3, (count, 3))
    options: dict[str, Any] = {"every": STEPS, "precision": level.precision}
    batch = trajectory(BALL, momentum, states.G, STEPS, **options)
    for i in range(0, count, max(1, count // 9)):
        alone = trajectory(BALL, momentum[i], states.G, STEPS, **options)
        if [number(x) for x in batch.momentum[i, -1]] != [number(x) for x in alone.momentum[-1]]:
            return Judged(FAILED, reason=f"ball {i} of {count} has other numbers than alone")
    return SAME


#: What is judged of arrays.
JUDGES: dict[str, Judge] = {
    **{name: partial(same, make) for name, make in MAKES.items()},
    "float32": float32, "empty": empty, "huge batch": huge,
}  # fmt: skip

#: Asks for a run that is to be refused.
Attempt = Callable[[Level], object]


def refusal(attempt: Attempt, level: Level, quick: bool) -> Judged:
    """The attempt must be refused."""
    attempt(level)
    return Judged(FAILED, reason="it is taken without a word")


def asking(momentum: Any = states.K, gamma: Any = states.G, J: Any = states.J, D: Any = states.D) -> Attempt:
    """A run of this."""
    return lambda level: run(level, momentum, gamma, J, D)


def anywhere(value: Any) -> Sequence[Attempt]:
    """A value in the place of a component of everything that is given."""
    bad = (value, -0.5, 0.75)
    return (
        asking(bad), asking(gamma=(0.6, value, 0.8)), asking(J=(value, 2.0, 4.0)), asking(D=value),
        asking([states.K, bad]),
    )  # fmt: skip


MASKED = np.ma.masked_array([1.0, 2.0, 3.0], mask=[False, True, False])

#: What is refused.
INPUT: dict[str, Sequence[Attempt]] = {
    "NaN": anywhere(float("nan")),
    "infinities": (*anywhere(float("inf")), *anywhere(float("-inf"))),
    "beyond float64": (asking((10**400, 0, 0)),),
    "complex numbers": anywhere(1j),
    "texts": anywhere("1"),
    "masked arrays": (asking(MASKED), asking([MASKED, MASKED]), asking((MASKED[1], 0.1, 0.2))),
    "zero-dimensional": (asking(np.array(1.0)), asking(gamma=1.0)),
    "wrong shapes": (
        asking((1.0, 2.0)), asking(np.zeros((2, 3)), np.tile(states.G, (3, 1))), asking([[1.0, 2.0, 3.0], [1.0]]),
    ),
    "gamma of length 0, 2 and 1 + 1e-9": [asking(gamma=np.array(states.G) * size) for size in (0.0, 2.0, 1 + 1e-9)],
    "negative moments": (asking(J=(-1e-300, 1.0, 2.0)), asking(D=-1e-300)),
    "more frames than memory": (
        lambda level: trajectory(BALL, states.K, states.G, 10**15, precision=level.precision),
    ),
    "invalid precision": (lambda level: trajectory(BALL, states.K, states.G, 1, precision="triple"),),
}  # fmt: skip
