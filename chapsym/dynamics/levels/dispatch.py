"""A run at any precision: the level that takes the steps, and the arrays of its frames."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Enclosure, Precision, Single, named
from chapsym.numbers.precisions import MOST_BITS

from ..ball import Asked, in_shape
from ..coefficients import substeps
from ..errors import BadInput, Status, StepNotTaken
from ..loops import double_double as pairs_loop
from ..results import Bounds, Step
from . import double, double_double, proved
from .frames import Balls, Frames, untaken
from .start import exponent_of, fraction

#: The levels whose only numbers are floats.
LEVELS: dict[type[Precision], Callable[..., None]] = {
    Single: double.run_single, Double: double.run, DoubleDouble: double_double.run,
}  # fmt: skip


def precision_of(precision: str | Precision) -> Precision:
    """The precision with this name; raises BadInput for anything else."""
    if type(precision) is str and precision in NAMED:
        return NAMED[precision]
    try:
        return named(precision)
    except ValueError as error:
        raise BadInput(str(error)) from None


def begun(precision: Precision, balls: Balls, count: int, attitude: Asked = None, least: bool = False) -> Frames:
    """Frames of a precision, NaN after the first, or BadInput; attitude: at the start, (n, 4), if it is followed."""
    n, body = len(balls.D), 0 if attitude is None else count
    shapes = (n, count, 3), (n, count, 3), (n, body, 4), (n, body, 2)
    try:
        low = begun(NAMED["double"], balls, count, attitude) if isinstance(precision, DoubleDouble) else None
        momenta, verticals, attitudes, traces = arrays = [np.empty(shape, precision.dtype) for shape in shapes]
        for array in arrays:
            array.fill(np.nan)
    except (MemoryError, ValueError):
        raise no_room(count, n) from None
    frames = Frames(momenta, verticals, attitudes, traces, *untaken(n), attitude is not None, low, least)
    with np.errstate(over="ignore", under="ignore"):  # a precision of a smaller range refuses numbers beyond it
        frames.momentum[:, 0], frames.gamma[:, 0] = balls.momentum, balls.gamma
        if attitude is not None:
            frames.attitude[:, 0], frames.contact[:, 0] = attitude, 0.0
    return frames


def no_room(frames: int, balls: int) -> BadInput:
    """The error for frames that do not fit into memory."""
    return BadInput(f"{frames} frames of {balls} balls do not fit into memory; keep fewer with every=")


def run(
    precision: Precision, balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int,
    progress: Callable[[int], None],
) -> None:  # fmt: skip
    """`double.run` at a precision.  Frame 0 is given in float64; other levels rewrite it, γ divided by its length."""
    substeps(order)  # raises BadInput for another order
    if isinstance(precision, Digits | Enclosure):
        from .balls import run as run_in_arb  # takes 40 ms, with mpmath and flint

        run_in_arb(precision, balls, steps, every, frames, order, progress)
    else:
        LEVELS[type(precision)](balls, steps, every, frames, order, threads, progress)


def run_proved(
    precision: Precision, balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int,
    progress: Callable[[int], None],
) -> Bounds:  # fmt: skip
    """`run` in float64 or double-double, with proved bounds of the errors of its frames, (n, frames) each.

    A run in double-double carries the proof; a run in float64 is compared with it.  Raises BadInput for others.
    """
    if not isinstance(precision, Double | DoubleDouble):
        raise BadInput(
            'proved=True takes the precisions "double" and "double-double"; Enclosure(bits) is a proof of its own, and '
            "`certify` bounds what a run at any other is off by"
        )
    n, count, stages = *frames.momentum.shape[:2], len(substeps(order))
    pairs = frames
    try:
        spread = np.full((n, count, 4), np.inf)
        spread[:, 0] = proved.PAIR
        if isinstance(precision, Double):
            run(precision, balls, steps, every, frames, order, threads, lambda done: progress(0))
            start = frames.attitude[:, 0] if frames.with_body else None
            pairs = begun(NAMED["double-double"], balls, count, start)
        double_double.run(balls, steps, every, pairs, order, threads, progress, spread)
        found = proved.errors(balls, np.arange(0.0, count) * every, frames, pairs, spread, stages)
    except MemoryError:
        raise no_room(count, n) from None
    open_at = np.logical_or.reduce([~np.isfinite(x) for x in found if x is not None])
    first = np.where(open_at.any(axis=1), open_at.argmax(axis=1), count)
    bounds = dict(zip(("momentum", "gamma", "attitude", "contact"), found, strict=True))
    return Bounds(**bounds, steps=np.maximum(first - 1, 0) * every)


#: The bits of a small rotation beyond those that its size costs.
FINER = 200


def step(precision: Precision, shape: tuple[int, ...], balls: Balls, order: int, with_proof: bool = False) -> Step:
    """The first step of a run of each ball, with the leading axes `shape` of the result; with_proof: in float64.

    The rotation is the attitude of a run that starts at the identity; for floats, the map gives it directly.
    """
    low, bounds = None, None
    if len(substeps(order)) == 1 and isinstance(precision, Single | Double):
        of = (double.rounded(balls), double.SINGLE) if isinstance(precision, Single) else (balls, double.DOUBLE)
        q, K, g, status, reach = double.step_all(*of)
        if with_proof:
            momentum, gamma, rotation = (in_shape(shape, x) for x in proved.of_step(balls, q, K, g).T.copy())
            bounds = Bounds(momentum, gamma, rotation=rotation)
    else:
        frames = _after_one(precision, balls, order)
        q, K, g, status, reach = *_vectors(frames), frames.status, frames.reach
        low = None if frames.low is None else _vectors(frames.low)
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))

    def result(q: np.ndarray, K: np.ndarray, g: np.ndarray, low: Step | None = None) -> Step:
        q, K, g = (in_shape(shape, x) for x in (q, K, g))
        return Step(q, K, g, status.reshape(shape), reach.reshape(shape), precision, low, bounds)

    return result(q, K, g, None if low is None else result(*low))


@np.errstate(under="ignore")
def _after_one(precision: Precision, balls: Balls, order: int) -> Frames:
    """The two frames of a run of one step; the attitudes are the identity and the rotation."""
    frames = _two_frames(precision, balls, order)
    if isinstance(precision, Enclosure):  # these bits are relative to 1, but needed of a small rotation
        lacking = max(map(partial(_lacking, precision.bits), frames.attitude[frames.status == 0, 1, 1:]), default=0)
        if lacking:
            finer = replace(precision, bits=min(precision.bits + lacking, MOST_BITS))
            frames.attitude[:] = _two_frames(finer, balls, order).attitude
    if frames.low is not None:  # tiny momenta were scaled by 2^beyond
        beyond = [pairs_loop.scales(*ball)[1] for ball in zip(balls.momentum, balls.mass_tensor, balls.D, strict=True)]
        for of in (frames, frames.low):
            of.attitude[:, 1, 1:] = np.ldexp(of.attitude[:, 1, 1:], -np.array(beyond, np.int64)[:, np.newaxis])
    return frames


def _two_frames(precision: Precision, balls: Balls, order: int) -> Frames:
    frames = begun(precision, balls, 2, [1.0, 0, 0, 0])
    run(precision, balls, 1, 1, frames, order, 1, lambda done: None)
    return frames


def _lacking(bits: int, vector: np.ndarray) -> int:
    """The number of bits that an enclosed vector lacks for `bits` bits relative to its length."""
    size = max(abs(x.mid()) for x in vector)
    if not any(x.rad() > size * 2.0 ** (3 - bits) for x in vector):
        return 0
    return FINER - exponent_of(fraction(size))


def _vectors(frames: Frames) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The rotation, 𝒦 and γ of the last frame."""
    return frames.attitude[:, 1], frames.momentum[:, 1], frames.gamma[:, 1]
