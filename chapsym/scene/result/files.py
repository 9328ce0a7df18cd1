"""Trajectories on disk: NumPy's .npz, or .csv; each file is written whole, then renamed."""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import numpy as np

from chapsym import files
from chapsym.dynamics import Trajectory

from ..read.scene import SceneError


def columns(run: Trajectory) -> dict[str, np.ndarray]:
    """What a trajectory holds, by name, with units in the names where there are any."""
    found: dict[str, np.ndarray] = {"step": run.index}
    if run.time_step is not None:
        found["time_s"] = run.time
    found |= {"momentum": run.momentum, "gamma": run.gamma}
    if run.attitude is not None:
        found["attitude"] = run.attitude
    if run.contact is not None:
        found["contact_m"] = run.contact
    if run.low is not None:  # what double-double numbers have beyond float64
        low = {"momentum": run.low.momentum, "gamma": run.low.gamma, "attitude": run.low.attitude}
        low["contact_m"] = run.low.contact
        found |= {f"{name}_low": array for name, array in low.items() if array is not None}
    with run.precision.precision():
        return {name: _texts(run, array) if array.dtype == object else array for name, array in found.items()}


def _texts(run: Trajectory, array: np.ndarray) -> np.ndarray:
    """Numbers that no float holds, as decimal strings."""
    return np.vectorize(run.precision.write, otypes=[str])(array)


def check_destination(path: Path) -> None:
    """Raises SceneError, before anything is computed, if `path` cannot be written as it is named."""
    if path.suffix not in _WRITERS:
        raise SceneError(f"{str(path)!r}: the output must end in {' or '.join(_WRITERS)}")
    try:
        files.check_destination(path)
    except files.CannotWrite as error:
        raise SceneError(str(error)) from None


def save(run: Trajectory, path: Path) -> None:
    """Writes the trajectory to .npz or .csv; raises SceneError if the disk refuses."""
    check_destination(path)
    try:
        files.write_whole(path, lambda stream: _WRITERS[path.suffix](stream, columns(run)))
    except files.CannotWrite as error:
        raise SceneError(str(error)) from None


def _write_npz(stream: IO[bytes], data: dict[str, np.ndarray]) -> None:
    np.savez(stream, **data)  # type: ignore[arg-type]


def _write_csv(stream: IO[bytes], data: dict[str, np.ndarray]) -> None:
    import io

    text = io.TextIOWrapper(stream, encoding="utf-8", newline="")
    writer = csv.writer(text)
    header: list[Any] = []
    for name, values in data.items():
        header += [name] if values.ndim == 1 else [f"{name}_{i}" for i in range(values.shape[1])]
    writer.writerow(header)
    for frame in range(len(data["step"])):
        row: list[Any] = []
        for values in data.values():
            row += np.atleast_1d(values[frame]).tolist()
        writer.writerow(row)
    text.flush()
    text.detach()


_WRITERS: dict[str, Callable[[IO[bytes], dict[str, np.ndarray]], None]] = {".npz": _write_npz, ".csv": _write_csv}
