"""The elliptic phase u of a ball with vertical momentum, and its increments."""

from contextlib import suppress

import numpy as np
from xarray import Dataset

from chapsym.dynamics import BadInput, Ball, Curve
from chapsym.dynamics.ball import Floats

from ..drawing import reading, series
from ..drawing.invariant import bodies_of
from ..drawing.style import COLOURS, FEW, Picture, at_least, in_power, legend, new, power
from . import change


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if "phase" not in dataset:
        return 'no phase: add "phase" to run.outputs (for vertical momentum)'
    return "an increment needs two frames" if dataset.sizes["frame"] < 2 else None


def draw(dataset: Dataset) -> Picture:
    """u(t) above, without its jumps by a period; below its increment a step, constant for D = 0, else a function of u.

    Where the steps between two frames do not tell how often u went round, it is drawn with its jumps, and below is what
    it gains from frame to frame, but for those jumps.
    """
    t, label = reading.clock(dataset)
    stored, apart = reading.values(dataset, "phase"), np.diff(reading.steps(dataset))
    gained, known = gains(stored, apart, periods(dataset), reading.per_ball(dataset, "rotation_number"))
    each = gained / apart if known else gained
    u = np.concatenate([stored[:, :1], stored[:, :1] + np.cumsum(gained, axis=1)], axis=1) if known else stored
    below_label = "increment a step" if known else "gain a frame"
    figure, (above, below) = new(str(dataset.attrs.get("title", "")), 2, height=2.4, sharex=True)
    for axis, array, when in ((above, _broken(u, gained), t), (below, each, t[:-1])):
        factor, text = power(float(np.nanmax(np.abs(array), initial=0.0)))
        if len(u) <= FEW:
            for i, one in enumerate(array):
                name = reading.labels(dataset)[i] if len(u) > 1 and axis is above else None
                series.line(axis, when, one / factor, COLOURS[i], name)
        else:
            series.fan(axis, when, array / factor, COLOURS[0])
        axis.set_ylabel(in_power("phase u" if axis is above else below_label, "", text))
    at_least(below, _flat(u, each))
    below.set_xlabel(label)
    legend(figure, [above])
    return figure


def periods(dataset: Dataset) -> Floats | None:
    """4K(k) of the curve of each ball, (balls,), from J, D and γ at the start; None if the result does not tell."""
    bodies = bodies_of(dataset)
    if not bodies or "gamma" not in dataset:
        return None
    gamma = reading.values(dataset, "gamma")[:, 0]
    found = np.full(len(gamma), np.nan)
    for i, (body, start) in enumerate(zip(bodies, gamma, strict=True)):
        with suppress(BadInput):  # a fixed point has no curve
            found[i] = Curve.through(Ball(body.mass_tensor, np.float64(body.D)), body.principal(start)).period
    return found


def gains(u: Floats, apart: np.ndarray, period: Floats | None, turns: Floats | None) -> tuple[Floats, bool]:
    """What u gains from frame to frame, (balls, frames - 1), and whether whole periods are counted.

    apart: steps between frames; period: of each ball, if known; turns: the rotation numbers, which tell how many pass
    between two frames.  Without them a step is taken to gain less than half a period; 300 random balls, up to their
    folds, gained 0.24 of it at most.
    """
    gained = np.diff(u, axis=1)
    if period is not None and np.isfinite(period).all() and (turns is not None or (apart == 1).all()):
        whole = period[:, np.newaxis]
        expected = 0.0 if turns is None else turns[:, np.newaxis] * whole * apart
        return gained - whole * np.round((gained - expected) / whole), True
    if np.isnan(u).all():
        return gained, False
    span = np.fmax.reduce(u, axis=1, keepdims=True) - np.fmin.reduce(u, axis=1, keepdims=True)
    monotone = (np.nan_to_num(gained) >= 0).all(axis=1, keepdims=True) | (np.nan_to_num(gained) <= 0).all(
        axis=1, keepdims=True
    )
    jumps = ~monotone & (np.abs(gained) > span / 2)
    return np.where(jumps, np.nan, gained), False


def _broken(u: Floats, gained: Floats) -> Floats:
    """u with a gap where it jumps by a period."""
    found = u.copy()
    found[:, :-1][np.isnan(gained)] = np.nan
    return found


def _flat(u: Floats, each: Floats) -> float:
    """Roundoff of u in an increment is flat: 20 ulps of u, and a thousandth of the increment, in the panel's unit."""
    largest = float(np.nanmax(np.abs(each), initial=0.0))
    factor, _ = power(largest)
    return max(change.ULPS * change.ULP * float(np.nanmax(np.abs(u), initial=0.0)), 1e-3 * largest) / factor
