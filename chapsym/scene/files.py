"""Trajectories on disk: NumPy's .npz, or .csv; each file is written whole, then renamed."""

import csv
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import numpy as np

from chapsym.dynamics import Trajectory

from .scene import SceneError


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
    return found


def check_destination(path: Path) -> None:
    """Raises SceneError, before anything is computed, if `path` cannot be written as it is named."""
    if path.suffix not in _WRITERS:
        raise SceneError(f"{str(path)!r}: the output must end in {' or '.join(_WRITERS)}")
    folder = path.parent
    try:
        if not folder.is_dir():
            raise SceneError(f"{path}: the folder {folder} does not exist")
        if path.is_dir() or not os.access(folder, os.W_OK):
            raise SceneError(f"{path} cannot be written: choose a file in a folder that is writable")
    except OSError as error:
        raise SceneError(f"{path} cannot be written: {error.strerror or error}") from None
    except ValueError as error:  # a null byte in the name
        raise SceneError(f"{str(path)!r} cannot be written: {error}") from None


def save(run: Trajectory, path: Path) -> None:
    """Writes the trajectory to .npz or .csv; raises SceneError if the disk refuses."""
    check_destination(path)
    path = Path(os.path.realpath(path))  # a link stays a link; its file is replaced
    temporary = None
    try:
        with tempfile.NamedTemporaryFile("wb", dir=path.parent, prefix=f".{path.name}.", delete=False) as stream:
            temporary = Path(stream.name)
            _WRITERS[path.suffix](stream, columns(run))
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        raise SceneError(f"{path} cannot be written: {error.strerror or error}") from None
    finally:
        if temporary is not None:
            temporary.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


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
