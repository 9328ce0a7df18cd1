"""What users hand over: arrays of every make give the same bits as plain ones, and what is no number is refused."""

from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, StepNotTaken, Trajectory, trajectory

from . import states
from .cells import FAILED, REFUSED, WITHIN, Judged, worst
from .levels import Level, number
from .steps import both

#: A state, and a batch of three.
ONE = (np.array(states.K), np.array(states.G))
MANY = (
    np.array([states.K, (0.3, 0.2, -0.1), (-0.4, 0.1, 0.2)]),
    np.array([states.G, (0.6, 0.0, 0.8), (0.0, 0.0, 1.0)]),
)
STEPS = 3

Make = Callable[[np.ndarray], Any]


#: The ball of most of them.
BALL = Ball(states.J, states.D)


def run(level: Level, momentum: Any, gamma: Any, J: Any = states.J, D: Any = states.D) -> Trajectory:
    """A short run at the precision."""
    return trajectory(Ball(J, D), momentum, gamma, STEPS, precision=level.precision)


def scaled_gamma(size: float) -> Callable[[Level], object]:
    """A run with a γ of this length."""
    return lambda level: run(level, states.K, np.array(states.G) * size)


def bits(found: Trajectory) -> list[Any]:
    """All numbers of a run, exactly."""
    parts = []
    for name in ("momentum", "gamma"):
        values = getattr(found, name).reshape(-1)
        if found.low is not None:
            values = both(values, getattr(found.low, name).reshape(-1))
        parts += [number(x) for x in values]
    return parts


def same(make: Make, level: Level, quick: bool) -> Judged:
    """The same bits from arrays that are made otherwise, for one state and for a batch."""
    for plain in (ONE, MANY):
        made = [make(x) for x in plain]
        before = [np.array(x, copy=True) for x in made]
        if bits(run(level, *made)) != bits(run(level, *plain)):
            return Judged(FAILED, reason="other numbers than from plain arrays")
        if any((np.asarray(x) != y).any() for x, y in zip(made, before, strict=True)):
            return Judged(FAILED, reason="the arrays that were given are changed")
    return Judged(WITHIN, 0.0, 0.0)


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


def objects(x: np.ndarray) -> np.ndarray:
    """Fractions."""
    return np.vectorize(Fraction, otypes=[object])(x)


def decimals(x: np.ndarray) -> np.ndarray:
    """Decimals."""
    return np.vectorize(Decimal, otypes=[object])(x)


SAME: dict[str, Make] = {
    "not contiguous, backwards": strided,
    "column order": np.asfortranarray,
    "wrong byte order": lambda x: x.astype(x.dtype.newbyteorder()),
    "read-only": read_only,
    "lists": lambda x: x.tolist(),
    "fractions": objects,
    "decimals": decimals,
    "long doubles": lambda x: x.astype(np.longdouble),
    "memory views": lambda x: np.ascontiguousarray(x).data,
}


def refusals(attempts: Sequence[Callable[[Level], object]], level: Level, quick: bool) -> Judged:
    """Every attempt must be refused with a sentence."""

    def one(attempt: Callable[[Level], object]) -> Judged:
        try:
            attempt(level)
        except (BadInput, StepNotTaken) as refusal:
            return Judged(REFUSED, reason=str(refusal))
        return Judged(FAILED, reason="it is taken without a word")

    return worst([one(attempt) for attempt in attempts])


def _with(value: Any) -> Sequence[Callable[[Level], object]]:
    """A value in the place of a component of everything that is given."""
    bad = (value, -0.5, 0.75)
    return (
        lambda level: run(level, bad, states.G),
        lambda level: run(level, states.K, (0.6, value, 0.8)),
        lambda level: run(level, states.K, states.G, (value, 2.0, 4.0)),
        lambda level: run(level, states.K, states.G, states.J, value),
        lambda level: run(level, [states.K, bad], states.G),
    )


def _masked() -> Any:
    return np.ma.masked_array([1.0, 2.0, 3.0], mask=[False, True, False])


REFUSED_INPUT: dict[str, Sequence[Callable[[Level], object]]] = {
    "NaN": _with(float("nan")),
    "infinities": (*_with(float("inf")), *_with(float("-inf"))),
    "beyond float64": (lambda level: run(level, (10**400, 0, 0), states.G),),
    "complex numbers": _with(1j),
    "texts": _with("1"),
    "masked arrays": (
        lambda level: run(level, _masked(), states.G),
        lambda level: run(level, [_masked(), _masked()], states.G),
        lambda level: run(level, (_masked()[1], 0.1, 0.2), states.G),
    ),
    "zero-dimensional": (lambda level: run(level, np.array(1.0), states.G), lambda level: run(level, states.K, 1.0)),
    "wrong shapes": (
        lambda level: run(level, (1.0, 2.0), states.G),
        lambda level: run(level, np.zeros((2, 3)), np.tile(states.G, (3, 1))),
        lambda level: run(level, [[1.0, 2.0, 3.0], [1.0]], states.G),
    ),
    "gamma of length 0, 2 and 1 + 1e-9": tuple(map(scaled_gamma, (0.0, 2.0, 1 + 1e-9))),
    "negative moments": (
        lambda level: run(level, states.K, states.G, (-1e-300, 1.0, 2.0)),
        lambda level: run(level, states.K, states.G, states.J, -1e-300),
    ),
    "more frames than memory": (
        lambda level: trajectory(BALL, states.K, states.G, 10**15, precision=level.precision),
    ),
    "invalid precision": (
        lambda level: trajectory(BALL, states.K, states.G, 1, precision="triple"),
    ),
}  # fmt: skip


def empty(level: Level, quick: bool) -> Judged:
    """A batch of no balls, and a run of no steps."""
    for shape in ((0, 3), (2, 0, 3)):
        found = run(level, np.zeros(shape), states.G)
        if found.momentum.shape != (*shape[:-1], STEPS + 1, 3) or found.status.shape != shape[:-1]:
            return Judged(FAILED, reason=f"an empty batch {shape} has the shape {found.momentum.shape}")
    still = trajectory(BALL, states.K, states.G, 0, precision=level.precision)
    return Judged(WITHIN, 0.0, 0.0) if still.momentum.shape == (1, 3) else Judged(FAILED, reason="0 steps have frames")


#: Balls of a huge batch, quick and full, by precision.
HUGE = {"single": (100_000, 4_000_000), "double": (100_000, 4_000_000), "quad": (5000, 400_000)}


def huge(level: Level, quick: bool) -> Judged:
    """A batch of many balls, every 997th beside itself alone."""
    count = HUGE.get(level.name, (20, 200))[0 if quick else 1]
    momentum = np.random.default_rng(7).uniform(-0.3, 0.3, (count, 3))
    options: dict[str, Any] = {"every": STEPS, "precision": level.precision}
    whole = trajectory(BALL, momentum, states.G, STEPS, **options)
    for i in range(0, count, max(1, count // 9)):
        alone = trajectory(BALL, momentum[i], states.G, STEPS, **options)
        if [number(x) for x in whole.momentum[i, -1]] != [number(x) for x in alone.momentum[-1]]:
            return Judged(FAILED, reason=f"ball {i} of {count} has other numbers than alone")
    return Judged(WITHIN, 0.0, 0.0)


def float32(level: Level, quick: bool) -> Judged:
    """float32 arrays are the float64 numbers that they hold, and γ is a unit vector as far as they tell."""
    momentum, gamma = (x.astype(np.float32) for x in (np.array(states.K), np.array((0.6, 0.0, 0.8))))
    try:
        found = run(level, momentum, gamma, np.array(states.J, np.float32), np.float32(states.D))
    except BadInput as refusal:
        return Judged(REFUSED, reason=str(refusal))
    wide = gamma.astype(np.float64)
    plain = run(level, momentum.astype(np.float64), wide / np.sqrt(wide @ wide))
    away = max(abs(a - b) for a, b in zip(bits(found), bits(plain), strict=True))
    ulps = float(away) * 2**23
    return Judged(WITHIN if ulps <= 16 else FAILED, ulps, 16.0, reason="" if ulps <= 16 else "not those numbers")
