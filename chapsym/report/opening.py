"""Results from scenes and files, and to files: which room does it for which suffix."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from chapsym import files
from chapsym.scene import Scene, SceneError, checked, load

if TYPE_CHECKING:
    from xarray import Dataset

#: What a result may be written to and read from.
SUFFIXES = (".zarr", ".nc", ".npz", ".csv", ".parquet")


def run(scene: "str | Path | Mapping[str, Any] | Scene", progress: Callable[[Any], None] | None = None) -> "Dataset":
    """Runs a scene, a file or its tables, in memory; raises SceneError."""
    from chapsym.scene.expand import expand
    from chapsym.scene.plan import planned
    from chapsym.scene.sweep import run_in_memory

    if isinstance(scene, Mapping):
        scene = checked(dict(scene))
    elif not isinstance(scene, Scene):
        scene = load(Path(scene))
    plan = replace(planned(expand(scene), scene.task()), scene=scene.source, seed=scene.sweep.seed)
    dataset = run_in_memory(plan) if progress is None else run_in_memory(plan, progress)
    if scene.title:
        dataset.attrs["title"] = scene.title
    return dataset


def opened(path: Path) -> "Dataset":
    """The Dataset of a file; raises SceneError for what is not there, or is no result."""
    if path.suffix not in SUFFIXES:
        raise SceneError(f"{str(path)!r}: a result ends in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}")
    if not path.exists():
        raise SceneError(f"{path} does not exist")
    try:
        dataset = _read(path)
    except SceneError:
        raise
    except Exception as error:  # the libraries raise what they like for a file that is damaged or of something else
        told = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise SceneError(f"{path} cannot be read as a result: {told}") from None
    if "frame" not in dataset.dims and "rotation_number" not in dataset:
        raise SceneError(f'{path} is no result of chapsym: it has no dimension "frame"')
    return dataset


def _read(path: Path) -> "Dataset":
    import xarray

    if path.suffix == ".zarr":
        return xarray.open_dataset(path, engine="zarr", chunks=None)
    if path.suffix == ".nc":
        return xarray.open_dataset(path, engine="h5netcdf")
    from chapsym.scene.tables_out import read

    return read(path)


def save(dataset: "Dataset", path: Path) -> None:
    """Writes a Dataset whole; raises SceneError if the disk refuses."""
    if path.suffix not in SUFFIXES:
        raise SceneError(f"{str(path)!r}: a result ends in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}")
    from chapsym.scene.tables_out import write

    try:
        write(dataset, path)
    except files.CannotWrite as error:
        raise SceneError(str(error)) from None
