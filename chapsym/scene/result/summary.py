"""Summaries for readers: the balls, starts and ranges of a scene, and the result of its run."""

import math
from collections.abc import Iterable
from dataclasses import asdict
from typing import TYPE_CHECKING

import numpy as np

from chapsym.accuracy.discretisation import read
from chapsym.dynamics import Ball, Status, kernels, step, step_n

from ..members.members import Members, bodies
from ..read.errors import Data
from ..read.ranges import Range
from ..read.scene import Scene
from ..read.tables import units_of

if TYPE_CHECKING:
    from xarray import Dataset

    from chapsym.dynamics.labelled import Arrays

#: The largest number of balls whose first step is tried.
TRIED = 20_000


def summary(scene: Scene, members: Members) -> list[tuple[str, str]]:
    """Rows of a key and a text."""
    rows = [("title", scene.title)] if scene.title else []
    first = 0
    for body in bodies(scene):
        count = len(body)
        name = body.name + (f" 1 (of {count})" if count > 1 else "")
        rows.append(("ball", f"{name}: {_ball(members, first)}"))
        rows.append(("start", _start(scene, members, first)))
        rows += [(key, _range(one, units_of(key))) for key, one in body.sweep.ranges.items()]
        first += count
    if any(one.drawn for body in bodies(scene) for one in body.sweep.ranges.values()):
        rows.append(("draws", f"{scene.sweep.samples} at each point of the other ranges, seed {scene.sweep.seed}"))
    rows.append(("run", _run(scene)))
    return rows


def _ball(members: Members, i: int) -> str:
    ball = members.ball
    words = f"J = {_vector(ball.mass_tensor[i])}"
    if isinstance(ball, Ball):
        words += f", I = {_vector(ball.inertia[i])}"
    words += f", D = {ball.D[i]:.6g} kg m²"
    if ball.radius is not None:
        words += f", radius {ball.radius[i]:.6g} m"
    if members.axes is not None:
        angle = 2 * np.degrees(np.arccos(min(abs(members.axes[i, 0]), 1.0)))
        words += f", principal axes turned by {angle:.4g}°" if angle else ""
    return words


def _start(scene: Scene, members: Members, i: int) -> str:
    task = scene.task()
    what, unit = ("𝒦", "kg m²") if task.accuracy is None else ("K", "kg m²/s")
    momentum = members.momentum[i] / (1.0 if task.accuracy is None else task.scale)
    size = math.hypot(*momentum.flat) / math.sqrt(momentum.ndim)  # a matrix has each component twice
    shown = f"{what} = {_vector(momentum)} {unit}, " if momentum.ndim == 1 else ""
    return f"{shown}|{what}| = {size:.6g} {unit}, γ = {_vector(members.gamma[i])}, in principal axes"


def _range(one: Range, units: str) -> str:
    unit = "" if units == "1" else f" {units}"
    if one.kind == "grid":
        shown = ", ".join(f"{x:.6g}" for x in one.values[:6]) + (", ..." if one.count > 6 else "")
        return f"{one.count} values: {shown}{unit}"
    first, second = (f"{x:.6g}" for x in one.values)
    if one.kind == "linspace":
        return f"{one.count} values from {first} to {second}{unit}"
    return f"drawn between {first} and {second}{unit}" if one.kind == "random" else (
        f"drawn, mean {first}, deviation {second}{unit}"
    )  # fmt: skip


def _run(scene: Scene) -> str:
    task = scene.task()
    if task.accuracy is not None:
        end = task.interval * (task.frames - 1)
        of = f"the {task.of}" if task.searched else "what is kept"
        return f"the motion of the ball for {end:.6g} s, to {task.accuracy:.3g} of {of}; {task.frames} frames"
    time = "" if task.time_step is None else f" of {task.time_step:.6g} s: {task.steps * task.time_step:.6g} s"
    order = "" if task.order == 2 else f", order {task.order}"
    precision = "" if task.precision == "double" else f", precision {task.precision}"
    last = "" if task.steps % task.every == 0 else f", the last after {(task.frames - 1) * task.every} steps"
    return f"{task.steps} steps{time}; {task.frames} frames{last}{order}{precision}"


def _vector(values: Iterable[float]) -> str:
    return "(" + ", ".join(f"{x:.6g}" for x in values) + ")"


def refusals(scene: Scene, members: Members) -> list[str]:
    """The balls that cannot take the first step: a sentence for each reason."""
    if not scene.maps or not scene.task().steps:
        return []
    some = members.of(slice(0, TRIED))
    ball, state = some.ball, (some.momentum, some.gamma)
    status = (step(ball, *state) if isinstance(ball, Ball) else step_n(ball, *state)).status
    words = []
    for reason in sorted(set(status[status != Status.TAKEN].tolist())):
        which = np.flatnonzero(status == reason)
        balls = some.names[which[0]] + ("" if len(which) == 1 else f" and {len(which) - 1} more of {len(some)}")
        words.append(f"{balls} cannot take the first step: {Status(reason).sentence}")
    return words


def last_state(data: "Dataset | Arrays") -> Data:
    """The end of the result of one ball: its steps, its last state, and the drift of the momentum integrals.

    The drift is the largest change of each at the stored frames, relative to the scale of the momentum.
    """
    one = data.isel(ball=0)
    taken = int(one["taken"].values)
    reached = slice(0, None) if "step" not in one.coords else slice(0, int((one["step"].values <= taken).sum()))
    kept = {name: one[name].values[reached] for name in ("momentum", "gamma", "contact") if name in one}
    found: Data = {"steps": taken, "final": {name: values[-1].tolist() for name, values in kept.items()}}
    if {"momentum", "gamma"} <= set(kept) and "row" not in one.dims and "step" in one.coords:
        size = float(abs(kept["momentum"][0]).max()) or 1.0
        invariants = kernels.invariants(kept["momentum"] / size, kept["gamma"])
        found["drift"] = [float(x) for x in abs(invariants - invariants[0]).max(axis=0)]
    return found


def stopped(data: "Dataset | Arrays") -> str:
    """Why balls stopped early: for each reason the number of balls, and the first of them."""
    status, taken, names = data["status"].values, data["taken"].values, data["ball"].values
    reasons = []
    for reason in sorted(set(map(int, status)) - {-1, int(Status.TAKEN)}):
        which = (status == reason).nonzero()[0]
        first = f"{names[which[0]]} at step {taken[which[0]]}"
        count = f"{len(which)} balls, the first {first}" if len(which) > 1 else first
        reasons.append(f"{count}: {Status(reason).sentence}")
    return "; ".join(reasons)


# The distance of a result from the motion of the ball: by its verified error, or as a map with its steps.


def far(data: "Dataset | Arrays") -> Data:
    """As plain data: `motion`, with the requested, estimated and chosen values; or `discretisation`; or nothing."""
    if (map_ := read(data.attrs.get("discretisation"))) is not None:
        return {"discretisation": asdict(map_)}
    if "error" not in data or "accuracy" not in data.attrs:
        return {}
    error = np.asarray(data["error"].values, dtype=float)
    there = ~np.isnan(error)  # balls that have not started, or that stopped
    if not there.any() or data.sizes.get("frame", 1) < 2:
        return {}
    accuracy, of = float(data.attrs["accuracy"]), str(data.attrs.get("accuracy_of"))
    chosen = {name: [int(f(data[name].values[there])) for f in (min, max)] for name in _CHOSEN if name in data}
    largest, worse = float(error[there].max()), int((error[there] > accuracy).sum())
    words = largest if math.isfinite(largest) else None
    return {"motion": {"accuracy": accuracy, "of": of, "error": words, "worse": worse, **chosen}}


_CHOSEN = ("order", "substeps")
#: The model to which an error refers; the error of the model itself is not estimated.
MODEL = "balanced, without slip"


def sentence(data: "Dataset | Arrays") -> tuple[str, str] | None:
    """The same for a reader, a key and a text; None if nothing is known."""
    map_, found = read(data.attrs.get("discretisation")), far(data).get("motion")
    if "row" in data.dims and "time" in data.coords:
        return "discretisation", "of a run of trajectory_n it is not estimated"
    if map_ is not None:
        return "discretisation", map_.sentence()
    if found is None:
        return None
    balls, unit = data.sizes["ball"], " m" if found["of"] == "contact" else ""
    error = "an error that is not known" if found["error"] is None else f"an estimated {found['error']:.1e}{unit}"
    about = f"of the ball to {error}" if balls == 1 else f"of the balls to {error}, the worst of {balls}"
    more = f"; {found['worse']} of them are not within it" if found["worse"] and balls > 1 else ""
    asked = f"{'not the ' if found['worse'] and balls == 1 else ''}{found['accuracy']:g} asked for{more}"
    how = _how(*(found[name] for name in _CHOSEN if name in found))
    return "motion", f"{about} ({asked}){how}{';' if how else ':'} {MODEL}"


def _how(order: tuple[int, int] = (0, 0), substeps: tuple[int, int] | None = None) -> str:
    """The chosen method, if known."""
    if substeps is None:
        return ""
    if order[1] == 0:
        return ": a steady rotation, in closed form"
    steps = _span(*substeps)
    return f": order {_span(*order)}, at most {steps} step{'s' if steps != '1' else ''} from frame to frame"


def _span(least: int, most: int) -> str:
    return f"{least}" if least == most else f"{least} to {most}"
