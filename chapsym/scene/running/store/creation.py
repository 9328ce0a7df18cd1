"""A new store: made beside its place with all its metadata, then renamed, so that it is there whole or not at all."""

import os
import shutil
import time
import warnings
from pathlib import Path

import numpy as np

from ...plan.plan import Plan
from ...read.task import Columns
from ...result.dataset import build, layout, sizes
from ...result.flat import plain
from . import marks
from .refusals import refusals


def create(path: Path, plan: Plan) -> None:
    """Puts a store without values at `path`, unless another process has; raises SceneError if the disk refuses."""
    remove_leftovers(path)
    beside = _beside(path)
    try:
        with refusals(path, creating=True):
            beside.mkdir()
            _fill(beside / path.name, plan)
            try:
                os.rename(beside / path.name, path)
            except OSError:
                if not path.exists():
                    raise
    finally:
        _remove(beside)


def discard(path: Path) -> None:
    """Removes a store: renamed first, so that no half of it stays under its name."""
    beside = _beside(path)
    with refusals(path):
        beside.mkdir()
        os.rename(path, beside / path.name)
        shutil.rmtree(beside, ignore_errors=True)


def remove_leftovers(path: Path) -> None:
    """Removes what creations that were killed have left beside `path`."""
    for left in path.parent.glob(f".{path.name}.new-*"):
        pid = left.name.rpartition("-")[2]
        if pid.isdigit() and not _alive(int(pid)):
            shutil.rmtree(left, ignore_errors=True)


def remove_partial(path: Path) -> None:
    """Removes the chunk files that a killed process has left half written."""
    for left in path.rglob("*.partial"):
        left.unlink(missing_ok=True)


def _remove(folder: Path) -> None:
    """Removes a folder, into which Zarr may still be writing after an error."""
    for _ in range(20):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(0.05)


def _beside(path: Path) -> Path:
    """A folder of this process, on the same disk."""
    return path.with_name(f".{path.name}.new-{os.getpid()}")


def _alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # of another user
        return True
    return True


def _fill(path: Path, plan: Plan) -> None:
    """The group with all metadata and coordinates; of the values only that there are none yet."""
    variables, length = layout(plan), sizes(plan)
    none: Columns = {
        name: np.broadcast_to(np.array(one.missing, one.dtype), [length[dim] for dim in one.dims])
        for name, one in variables.items()
    }
    whole = build(plan, none, none).assign_attrs(complete=False)
    whole.drop_vars(variables).to_zarr(path, zarr_format=3, consolidated=False)
    _add_arrays(path, plan)
    _consolidate(path)
    marks.folder(path).mkdir()


def _add_arrays(path: Path, plan: Plan) -> None:
    """The variables, without values, each unit a chunk."""
    import zarr

    length, units = sizes(plan), {"ball": _length(plan.chunks), "frame": _length(plan.segments)}
    group = zarr.open_group(path, mode="r+", use_consolidated=False)
    for name, one in layout(plan).items():
        shape = tuple(length[dim] for dim in one.dims)
        chunks = tuple(units.get(dim, length[dim]) for dim in one.dims)
        group.create_array(
            name, shape=shape, chunks=chunks, dtype=one.dtype, fill_value=one.missing, dimension_names=one.dims,
            attributes=plain(one.attrs),
        )  # fmt: skip


def _consolidate(path: Path) -> None:
    """One file of all metadata."""
    import zarr

    with warnings.catch_warnings():
        # Zarr says that other readers may not know it; they read those of each array.
        warnings.filterwarnings("ignore", message="Consolidated metadata")
        zarr.consolidate_metadata(path, zarr_format=3)


def _length(slices: list[slice]) -> int:
    """The common length of units, of which only the last may be shorter: Zarr's chunks are regular."""
    size = slices[0].stop - slices[0].start
    stops = np.minimum((np.arange(len(slices)) + 1) * size, slices[-1].stop)
    assert [(s.start, s.stop) for s in slices] == [(i * size, stop) for i, stop in enumerate(stops)]
    return size
