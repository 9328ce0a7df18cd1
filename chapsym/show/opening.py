"""Results in memory from scenes, and to and from files."""

import shutil
import tempfile
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
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
    temporary = None
    try:
        temporary = Path(tempfile.mkdtemp(dir=path.parent, prefix=f".{path.name}."))
        with warnings.catch_warnings():  # as the store of a run: other readers may not know its one file of metadata
            warnings.filterwarnings("ignore", message="Consolidated metadata")
            dataset.assign_attrs(complete=True).to_zarr(temporary / "whole", consolidated=True, zarr_format=3)
        (temporary / "whole").rename(path)
    except OSError as error:
        raise SceneError(f"{path} cannot be written: {error.strerror or error}") from None
    finally:
        if temporary is not None:
            shutil.rmtree(temporary, ignore_errors=True)
