"""The elliptic phase u of a ball with vertical momentum and its increments, and the rotation number over a sweep."""

from contextlib import suppress

import numpy as np
from xarray import Dataset

from chapsym.dynamics import BadInput, Curve
from chapsym.dynamics.ball import Floats

from ..drawing import reading, series
from ..drawing.invariant import bodies_of
from ..drawing.style import COLOURS, VERTICES, Picture, at_least, in_power, legend, new, power, scale
from .over_time import ULP, ULPS


def draw_phase(dataset: Dataset) -> Picture:
    """u(t) above, without jumps by a period; below its increment per step, constant for D = 0, else a function of u.

    If the number of periods between two frames is unknown, u has its jumps, and its increments from frame to frame are
    shown without them.
    """
    t, label = reading.clock(dataset)
    stored, apart = reading.values(dataset, "phase"), np.diff(reading.steps(dataset))
    gained, known = gains(stored, apart, periods(dataset), reading.per_ball(dataset, "rotation_number"))
    u, each = stored.copy(), gained
    if known:
        u[:, 1:] = stored[:, :1] + np.cumsum(gained, axis=1)
        each = gained / apart
    u[:, :-1][np.isnan(gained)] = np.nan  # a gap where it jumps by a period
    figure, axes = new(reading.title(dataset), 2, height=2.4, sharex=True)
    names = reading.labels(dataset) if len(u) > 1 else [None] * len(u)
    panels = ("phase u", names), ("increment a step" if known else "gain a frame", [None] * len(u))
    for axis, array, (name, balls) in zip(axes, (u, each), panels, strict=True):
        factor, text = power(reading.size_of(array))
        series.balls(axis, t[: array.shape[1]], array / factor, COLOURS[0], balls)
        axis.set_ylabel(in_power(name, "", text))
    # Roundoff of u in an increment is flat, and so is a thousandth of the increment.
    largest, whole = (reading.size_of(array) for array in (each, u))
    at_least(axes[1], max(ULPS * ULP * whole, 1e-3 * largest) / power(largest)[0])
    axes[1].set_xlabel(label)
    legend(figure, axes[:1])
    return figure


def periods(dataset: Dataset) -> Floats | None:
    """4K(k) of the curve of each ball, (balls,), from J, D and γ at the start; None if the result lacks these."""
    bodies = bodies_of(dataset)
    if not bodies or "gamma" not in dataset:
        return None
    gamma = reading.values(dataset, "gamma")[:, 0]
    found = np.full(len(gamma), np.nan)
    for i, (body, start) in enumerate(zip(bodies, gamma, strict=True)):
        with suppress(BadInput):  # a fixed point has no curve
            found[i] = Curve.through(body.principal, body.to_principal(start)).period
    return found


def gains(u: Floats, apart: np.ndarray, period: Floats | None, turns: Floats | None) -> tuple[Floats, bool]:
    """The increment of u from frame to frame, (balls, frames - 1), and whether whole periods are counted.

    apart: steps between frames; period: of each ball, if known; turns: the rotation numbers, which give the number of
    periods between two frames.  Without them the increment of a step is assumed to be below half a period; the largest
    of 300 random balls, up to their folds, was 0.24 of it.
    """
    gained = np.diff(u, axis=1)
    if period is not None and np.isfinite(period).all() and (turns is not None or (apart == 1).all()):
        whole = period[:, np.newaxis]
        expected = 0.0 if turns is None else turns[:, np.newaxis] * whole * apart
        return gained - whole * np.round((gained - expected) / whole), True
    span = np.fmax.reduce(u, axis=1, keepdims=True) - np.fmin.reduce(u, axis=1, keepdims=True)
    ways = np.sign(np.nan_to_num(gained))
    monotone = ways.min(axis=1, keepdims=True) * ways.max(axis=1, keepdims=True) >= 0
    return np.where(~monotone & (np.abs(gained) > span / 2), np.nan, gained), False


def draw_rotation(dataset: Dataset) -> Picture:
    """Points over the first parameter, coloured by a second one; without parameters, over the number of the ball."""
    found = reading.per_ball(dataset, "rotation_number")
    assert found is not None
    name, data, units = reading.first_parameter(dataset)
    more = list(reading.parameters(dataset).items())[1:]
    figure, (axis,) = new(reading.title(dataset), height=4.0 if more else 3.4)
    factor, text = power(reading.size_of(data))
    dense = len(found) > VERTICES // 8
    if more:
        other, (values, other_units) = more[0]
        colours = scale([axis], values, reading.labelled(other, other_units))(values)
        axis.scatter(data / factor, found, c=colours, s=10, linewidths=0, rasterized=dense)
    else:
        order = np.argsort(data, kind="stable")
        style = "-" if len(found) > 40 else "o-"
        axis.plot(data[order] / factor, found[order], style, color=COLOURS[0], markersize=4, rasterized=dense)
    axis.set_xlabel(in_power(reading.literal(name), reading.readable(units), text))
    axis.set_ylabel("rotation number, turns a step")
    if lost := int((~np.isfinite(found)).sum()):
        axis.set_title(f"{lost} of {len(found)} balls have none (not on a closed curve)")
    return figure
