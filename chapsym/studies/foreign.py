"""Trajectories of other programs as results that can be drawn, and results of chapsym as trajectories to judge."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym import files
from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.labelled import TIME, Arrays, Labelled, about, coordinates, is_ours
from chapsym.dynamics.outputs import OUTPUTS

from .judge import rolling
from .judge_tables import JUDGED, MORE, NEEDED, Table, in_space, read_table

if TYPE_CHECKING:
    from xarray import Dataset

#: The conjugate of a quaternion, as a product by components.
BACK = np.array([1.0, -1.0, -1.0, -1.0])
#: The model of a trajectory of another program.
FOREIGN = "none: a trajectory of another program"
#: The formats of results of chapsym that are no text.
BINARY = (".npz", ".nc", ".parquet", ".zarr")
#: The parts of a trajectory that the figures need.
PLANE = NEEDED[:3]


def table_of(file: Path) -> Table:
    """The trajectory of a file: a result of chapsym with one ball, or a table of another program.

    Raises BadInput, one sentence, for anything else.
    """
    if not _is_result(file):
        return read_table(file, JUDGED)
    from chapsym.scene.result import formats  # needs an extra

    data = formats.load(file)
    if lacking := [name for name in ("time", "attitude", "contact", "radius") if name not in data.variables]:
        clause = 'a trajectory needs outputs = ["attitude", "omega", "contact"] in [run] of its scene, and times'
        raise BadInput(f"{file} has no {lacking[0]}: {clause}")
    if data.sizes.get("ball", 1) != 1:
        raise BadInput(f"{file} has {data.sizes['ball']} balls: a trajectory is of one")
    return _as_table(file, data)


def _is_result(file: Path) -> bool:
    if file.suffix != ".csv":
        return file.suffix in BINARY
    try:
        files.check_source(file)
        with file.open(encoding="utf-8") as stream:
            return is_ours(stream.readline(files.MOST_LINE))
    except (OSError, UnicodeDecodeError, files.CannotRead):
        return False


def _as_table(file: Path, data: "Dataset") -> Table:
    values = {
        name: np.asarray(data[name].values, dtype=np.float64).reshape(data.sizes["frame"], -1)
        for name in ("time", "contact", "attitude", "omega")
        if name in data.variables
    }
    if "step" in data.coords and "taken" in data:
        reached = data["step"].values <= data["taken"].values.ravel()[0]
        values = {name: array[reached] for name, array in values.items()}
    radius = float(data["radius"].values.ravel()[0])
    centre = np.concatenate([values["contact"], np.full((len(values["time"]), 1), radius)], axis=1)
    parts = [values["time"], centre, values["attitude"]]
    if "omega" in values:
        omega = in_space(values["attitude"], values["omega"])
        parts += [rolling(radius, omega), omega]
    columns = dict(zip((*NEEDED, *MORE), np.concatenate(parts, axis=1).T, strict=False))
    return Table(file, columns, [repr(float(at)) for at in columns["time"]], None, {})


def result_of(file: Path) -> "Dataset":
    """The trajectory of another program as a result: its contact point, attitude, γ, ω and slip, if any.

    The radius is the height of the centre in the first row.
    Raises BadInput if it is no trajectory.
    """
    table = read_table(file, PLANE).from_zero()
    time, contact = table.columns["time"], table.vectors(PLANE[1:])
    height, velocity, omega = (table.vectors(names) for names in (["z"], MORE[:3], MORE[3:]))
    found: dict[str, Any] = {"contact": contact}
    if table.vectors(NEEDED[4:]) is not None:
        back = table.attitudes() * BACK
        found |= {"attitude": back * BACK, "gamma": in_space(back, np.array([0.0, 0.0, 1.0]))}
        found |= {} if omega is None else {"omega": in_space(back, omega)}
    variables = {
        name: Labelled(("ball", "frame", *OUTPUTS[name].dims), values[np.newaxis], OUTPUTS[name].attrs(3, motion=True))
        for name, values in found.items()
    }
    if height is not None and len(height) and height[0, 0] > 0:
        radius = height[0]
        variables["radius"] = Labelled(("ball",), radius, about("height of the centre at the start", "m"))
        if velocity is not None and omega is not None:
            slip = np.linalg.norm(velocity - rolling(float(radius[0]), omega), axis=-1)
            variables["slip"] = Labelled(("ball", "frame"), slip[np.newaxis], about("speed at the contact", "m s-1"))
    coords = coordinates([file.stem], variables, 3) | {"time": Labelled(("frame",), time, TIME)}
    return Arrays(variables | coords, coords, {"title": file.name, "model": FOREIGN}).dataset()
