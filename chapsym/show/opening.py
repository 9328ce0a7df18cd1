"""Results in memory from scenes, and to and from files."""

import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from xarray import Dataset

from chapsym.scene import Scene, SceneError, checked, load
from chapsym.scene.result import formats
from chapsym.scene.running.source import plan_of
from chapsym.scene.running.sweep import run_in_memory


def run(scene: "str | Path | Mapping[str, Any] | Scene", progress: Callable[[Any], None] | None = None) -> Dataset:
    """Runs a scene, a file or its tables, in memory on all cores; raises SceneError, and BadInput as the plan does."""
    if isinstance(scene, Mapping):
        scene = checked(dict(scene))
    elif not isinstance(scene, Scene):
        scene = load(Path(scene))
    plan = plan_of(scene)
    return run_in_memory(plan) if progress is None else run_in_memory(plan, progress)


def save(dataset: Dataset, path: Path) -> None:
    """Writes a result whole, as `formats.save`, or to a new .zarr; raises SceneError if the disk refuses."""
    if path.suffix != ".zarr":
        formats.save(dataset, path)
        return
    if path.exists():
        raise SceneError(f"{path} is there already; remove it, or choose another name")
    try:
        with (
            TemporaryDirectory(dir=path.parent, prefix=f".{path.name}.", ignore_cleanup_errors=True) as temporary,
            warnings.catch_warnings(),
        ):
            # As the store of a run: other readers may not know its one file of metadata.
            warnings.filterwarnings("ignore", message="Consolidated metadata")
            whole = Path(temporary) / "whole"
            # Of a part of another .zarr the chunks do not fit those of its files.
            dataset = dataset.drop_encoding().unify_chunks()
            if dataset.chunks:
                dataset = dataset.chunk({dim: max(lengths) for dim, lengths in dataset.chunks.items()})
            dataset.assign_attrs({"complete": True} | dataset.attrs).to_zarr(whole, consolidated=True, zarr_format=3)
            whole.rename(path)
    except OSError as error:
        raise SceneError(f"{path} cannot be written: {error.strerror or error}") from None
