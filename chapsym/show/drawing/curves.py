"""Curves through frames: the motion between frames is interpolated, if they are near enough."""

import numpy as np
from xarray import Dataset

from chapsym.dynamics.interpolation import MOST_TURN
from chapsym.scene.result.interpolation import FOLLOWED, interpolated, missing, turning

from . import reading

#: Radians of rotation between the points of a curve, and the largest number of points of all balls together.
FINE = 0.1
MOST_POINTS = 200_000
#: The largest number of balls with their own curves.
LINES = 60
#: The largest number of balls that determine the distance of frames.
SAMPLE = 50


def finer(dataset: Dataset, fine: float = FINE, most: int = MOST_POINTS) -> Dataset:
    """The result with the frames that its curves need, which include its own frames; or unchanged.

    fine: radians of rotation between the new frames; most: the largest number for all balls together.
    It is unchanged if its frames are near, or too far apart, or the points of a map without times.
    """
    balls, frames = dataset.sizes["ball"], dataset.sizes["frame"]
    if "time" not in dataset.coords or balls > LINES or missing(dataset) is not None or 2 * balls * frames > most:
        return dataset
    turn = turning(dataset)
    if turn is None or not fine < turn <= MOST_TURN:
        return dataset
    t, _ = reading.clock(dataset)
    parts = min(int(np.ceil(turn / fine)), most // (balls * frames))
    if parts < 2:
        return dataset
    times = np.interp(np.arange(parts * (len(t) - 1) + 1) / parts, np.arange(len(t)), t)
    times[::parts] = t
    found: Dataset = interpolated(dataset, times)
    return found if {name for name in FOLLOWED if name in dataset} <= set(found.data_vars) else dataset


def apart(dataset: Dataset) -> float:
    """A lower bound of the rotation between successive frames, in radians; 0 without times, or if it is unknown."""
    if "time" not in dataset.coords or dataset.sizes.get("frame", 0) < 2:
        return 0.0
    some = np.unique(np.linspace(0, dataset.sizes["ball"] - 1, min(dataset.sizes["ball"], SAMPLE)).round().astype(int))
    dataset = dataset.isel(ball=some, frame=slice(0, MOST_POINTS // len(some)))
    turn = turning(dataset)
    if turn is None and {"contact", "radius"} <= set(dataset.variables) and dataset.sizes.get("plane") == 2:
        way = np.diff(reading.values(dataset, "contact"), axis=1)  # a ball turns at least as far as it rolls
        radius = reading.per_ball(dataset, "radius")
        assert radius is not None
        turn = float(np.nanmax(np.hypot(way[..., 0], way[..., 1]) / radius[:, np.newaxis], initial=0.0))
    return turn or 0.0


def too_far(dataset: Dataset) -> bool:
    """Whether the frames are too far apart for lines between them."""
    return apart(dataset) > MOST_TURN


def note(dataset: Dataset) -> str:
    """The note on a figure of such frames; empty if they are near."""
    turn = apart(dataset)
    return f"frames are {turn:.2g} rad of turning apart: what is between is not seen" if turn > MOST_TURN else ""
