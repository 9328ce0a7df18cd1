"""Results as labelled arrays, or as an xarray.Dataset: with units, coordinates and provenance."""

import hashlib
import json
import re
from collections.abc import Hashable
from dataclasses import asdict, replace
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

import chapsym
from chapsym.accuracy.discretisation import discretisation
from chapsym.dynamics import Ball, labelled
from chapsym.dynamics.labelled import OUTCOME, TIME, Arrays, Labelled, about, with_clock
from chapsym.dynamics.outputs import BOUND, LOW, OUTPUTS, labels

from ..members.members import Body, bodies
from ..plan.models import Chosen, Moving, State
from ..plan.plan import Plan
from ..read.errors import Data, SceneError
from ..read.ranges import Range
from ..read.scene import from_source
from ..read.tables import units_of
from ..read.task import Columns

if TYPE_CHECKING:
    from xarray import Dataset, Variable

#: The variables of the state for each ball.
OF_BALLS = (*OUTCOME, "error", "order", "substeps")


# The result of a plan.


def layout(plan: Plan) -> dict[str, Labelled]:
    """The variables of a result that come from its run, before anything is computed, without memory of their own.

    By name: the requested outputs, then `taken` and `status`.
    """
    found: dict[str, Labelled] = {}
    n = plan.members.dimension
    length = {"ball": len(plan.members), "frame": plan.frames} | {dim: len(of) for dim, of in labels(n).items()}

    def add(name: str, dims: tuple[str, ...], attrs: labelled.Attributes, missing: float = labelled.NOT_RUN) -> None:
        found[name] = Labelled(dims, np.broadcast_to(missing, [length[dim] for dim in dims]), attrs)

    for name in plan.task.outputs:
        one = OUTPUTS[name]
        dims = (*(("ball",) if one.per_ball else ("ball", "frame")), *one.dims_in(n))
        followed = one.derive is None
        for end, has in (("", True), (LOW, plan.doubled and followed), (BOUND, plan.task.proved and followed)):
            if has:
                attrs = one.attrs(n, plan.task.accuracy is not None, f"{name}{end}")
                add(f"{name}{end}", dims[:2] if end == BOUND else dims, attrs, np.nan)
    for name, of in OUTCOME.items():
        add(name, ("ball",), of)
    if plan.task.accuracy is not None:
        unit = "m" if plan.task.of == "contact" else "1"
        add("error", ("ball",), about("estimate of the error, by comparison", unit), np.nan)
        if isinstance(plan.model, Moving):
            add("order", ("ball",), about("order of the composition"))
            add("substeps", ("ball",), about("its steps between two frames"))
    return found


def arrays(plan: Plan, columns: Columns, state: State) -> Arrays:
    """The result of a plan.

    columns: the outputs of all balls and frames, (balls, frames, ...), in the axes given.
    state: `taken` and `status` after the last frame, (balls,), and `error` of a run to an accuracy.
    The result depends only on these, the plan and the version: the same run gives the same bits.
    """
    variables = {
        name: replace(one, values=np.asarray((state if name in OF_BALLS else columns)[name]))
        for name, one in layout(plan).items()
    }
    variables |= labelled.bodies(plan.members.ball, plan.members.axes, (len(plan.members),))
    task, clock = plan.task, np.arange(plan.frames, dtype=np.int64)
    coords = labelled.coordinates(plan.members.names, variables, plan.members.dimension)
    if task.chosen and task.time is not None:
        coords["time"] = Labelled(("frame",), clock * task.time / max(plan.frames - 1, 1), TIME)
    else:
        coords |= labelled.moments(clock * task.every, task.time_step)
    for key, values in plan.members.parameters.items():
        coords[key] = Labelled(("ball",), values, about(key, units_of(key)))
    return Arrays(variables | coords, coords, provenance(plan) | _accuracy(plan))


def provenance(plan: Plan) -> Data:
    """The provenance of a result as attributes: the scene, the plan, and the versions."""
    balls = "1 ball" if len(plan.members) == 1 else f"{len(plan.members)} balls"
    kind = "Chaplygin ball" if isinstance(plan.model, Moving | Chosen) else "Discrete Chaplygin ball"
    found = {
        "title": plan.title or f"{kind}: {balls}, {plan.model.name}",
        "chapsym_version": chapsym.__version__,
        "scene": plan.scene,
        "model": plan.model.name,
        "plan": json.dumps(plan.describe()),
        "kernels": json.dumps({name: _code_hash(name) for name in plan.kernels()}),
        "inputs_sha256": _fingerprint(plan),
        "Conventions": "CF-1.11",
    }
    return found | ({} if plan.seed is None else {"seed": plan.seed})


def _fingerprint(plan: Plan) -> str:
    """A hash of all inputs of the values: bodies, starts and the task."""
    members, ball, task = plan.members, plan.members.ball, asdict(plan.task)
    if not task["proved"]:  # older results, with the same values, lack it
        del task["proved"]
    found = hashlib.sha256(json.dumps([task, list(members.names)]).encode())
    starts = (members.momentum, members.gamma, members.axes, members.attitude, members.place)
    for array in (ball.mass_tensor, ball.D, ball.radius, *starts):
        found.update(b"none" if array is None else np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


@cache
def _code_hash(kernel: str) -> str:
    """The hash of a generated kernel without its docstrings, which have the digests of certificates."""
    text = files("chapsym.generated").joinpath(f"{kernel}.py").read_text(encoding="utf-8")
    return hashlib.sha256(re.sub(r'"""[\s\S]*?"""', "", text).encode()).hexdigest()


def _accuracy(plan: Plan) -> Data:
    """The attributes of a result on its error: the requested accuracy, or the estimate of a pilot."""
    members, task = plan.members, plan.task
    if task.accuracy is not None:
        return {"accuracy": task.accuracy, "accuracy_of": task.of}
    if task.time_step is None or not isinstance(members.ball, Ball):
        return {}
    found = discretisation(
        members.ball, members.momentum, members.gamma, task.time_step, task.steps, task.order, task.precision,
        attitude=bool(plan.needed & {"attitude", "contact"}), contact="contact" in plan.needed,
    )  # fmt: skip
    return {} if found is None else {"discretisation": found.write()}


# A sweep as a grid: its balls along a dimension for each range, random samples along one more.

#: The dimension of random samples.
SAMPLE = "sample"


def grid(data: "Dataset") -> "Dataset":
    """The result of a whole sweep, with the dimensions of the sweep instead of `ball`.

    Each range that spans a dimension, linspace or grid, is one, named by its key and with its values, such as
    "start.omega.1", in the order of the scene; `sample` is that of the draws, after them.  Of several [[ball]] with the
    same ranges `ball` stays, as the first, with their names.  The coordinate `name` is what each ball was called.
    Raises SceneError for a part of a sweep, and for balls with different ranges.
    """
    import xarray

    tables = _tables(data)
    spans = _spans(tables[0])
    lengths = {"ball": len(tables)} if len(tables) > 1 else {}
    lengths |= {key: one.count for key, one in spans.items()}
    if any(one.drawn for body in tables for one in body.sweep.ranges.values()):
        lengths[SAMPLE] = tables[0].sweep.shape[-1]
    whole: dict[object, object] = {key: _spread(one, lengths) for key, one in data.variables.items()}
    whole["name"] = whole.pop("ball")
    if len(tables) > 1:
        whole["ball"] = ("ball", np.array([body.name for body in tables], dtype=object))
    whole |= {key: (key, one.grid(), data[key].attrs) for key, one in spans.items()}
    coords = {key: whole.pop(key) for key in list(whole) if key in data.coords or key == "name"}
    return with_clock(xarray.Dataset(whole, coords, data.attrs))


def _spread(one: "Variable", lengths: dict[str, int]) -> "Variable | tuple[tuple[Hashable, ...], np.ndarray, dict]":
    """A variable with these dimensions instead of `ball`, if it has that one; others are unchanged."""
    if "ball" not in one.dims:
        return one
    one = one.transpose("ball", ...)
    return (*lengths, *one.dims[1:]), one.data.reshape((*lengths.values(), *one.shape[1:])), one.attrs


def _tables(data: "Dataset") -> list[Body]:
    """The tables of balls of the scene of a result; raises SceneError if they do not form one grid."""
    if not data.attrs.get("scene"):
        raise SceneError("the result does not say of which scene it is, so that its ranges are not known")
    tables = bodies(from_source(data.attrs["scene"]))
    if data["ball"].values.tolist() != [name for body in tables for name in body.names]:
        raise SceneError("this is a part of the sweep: make a grid of the whole result, then choose of that")
    if any((_spans(body), body.sweep.shape) != (_spans(tables[0]), tables[0].sweep.shape) for body in tables):
        raise SceneError("the balls of the scene have different ranges, which make no grid")
    return tables


def _spans(body: Body) -> dict[str, Range]:
    """The ranges that span a dimension, by key."""
    return {key: one for key, one in body.sweep.ranges.items() if not one.drawn}
