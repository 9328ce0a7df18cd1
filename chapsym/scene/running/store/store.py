"""The store of a run: where it goes on, what is written, and that it is whole."""

import json
import os
import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, Self

import numpy as np

from chapsym import files, jobs

from ...plan.models import State
from ...plan.plan import Plan
from ...read.errors import SceneError
from ...read.task import Columns
from ...result import group
from ...result.dataset import OUTCOME, layout
from . import creation, identity, marks
from .refusals import refusals


class Store:
    """A Zarr group with the Dataset of a plan, and the marks of its units in a folder inside.

    `Store.of` makes it or goes on with it; `start` says where a chunk goes on, `write` writes a unit, `mark` says so,
    `finish` that all is there.  Every error of the disk is a SceneError, and loses nothing that was written.
    """

    def __init__(self, path: Path, plan: Plan) -> None:
        self.path, self.plan = path, plan

    @classmethod
    @contextmanager
    def of(cls, path: Path, plan: Plan, fresh: bool = False) -> Iterator[Self]:
        """The store of a plan, new or as it was left, locked unless it is complete; `fresh` discards what was there.

        Raises BadInput if there is something else, or if another process is writing it.
        """
        path = Path(os.path.realpath(path))
        check_place(path)
        with ExitStack() as stack:
            if path.exists() and not fresh:
                identity.check_same(path, plan)
                if group.attributes(path).get("complete"):
                    yield cls(path, plan)
                    return
            elif path.exists():
                with _locked(path):
                    creation.discard(path)
            if not path.exists():
                creation.create(path, plan)
            stack.enter_context(_locked(path))
            creation.remove_partial(path)
            yield cls(path, plan)

    @property
    def complete(self) -> bool:
        """Whether every unit is there."""
        return bool(group.attributes(self.path).get("complete"))

    def start(self, chunk: int) -> tuple[int, State | None]:
        """How many segments of a chunk are done, and the state after them; 0 and None if none is."""
        found = marks.read(self.path, chunk)
        if found is None:
            return 0, None
        done, state = found
        balls = self.plan.chunks[chunk].stop - self.plan.chunks[chunk].start
        if not 0 < done <= len(self.plan.segments) or any(array.shape[:1] != (balls,) for array in state.values()):
            raise marks.damaged(self.path, chunk)
        return done, state

    def write(self, chunk: int, segment: int, columns: Columns) -> None:
        """Writes the values of a unit."""
        write_region(self.path, self.plan, chunk, segment, columns)

    def mark(self, chunk: int, segment: int, state: State) -> None:
        """The mark of a unit whose region is written, after how its balls fared.

        That changes from segment to segment, so only the process that holds the lock writes it: a worker may be late.
        """
        write_region(self.path, self.plan, chunk, segment, {name: state[name] for name in OUTCOME if name in state})
        with refusals(self.path, layout(self.plan)):
            marks.write(self.path, chunk, segment + 1, state)

    def finish(self) -> None:
        """Says that all is there; the marks go."""
        with refusals(self.path):
            document = json.loads((self.path / "zarr.json").read_text(encoding="utf-8"))
            document["attributes"]["complete"] = True
            text = json.dumps(document, indent=2).encode()
            files.write_whole(self.path / "zarr.json", lambda stream: stream.write(text))
            shutil.rmtree(marks.folder(self.path), ignore_errors=True)


def write_region(path: Path, plan: Plan, chunk: int, segment: int, values: Columns) -> None:
    """Writes variables of one unit, which share no Zarr chunk with those of another; raises SceneError."""
    import zarr

    variables = {name: one for name, one in layout(plan).items() if name in values}
    where = {"ball": plan.chunks[chunk], "frame": plan.segments[segment]}
    with refusals(path, variables):
        (path / "zarr.json").stat()
        try:
            group = zarr.open_group(path, mode="r+", use_consolidated=False)
            arrays: dict[str, Any] = {name: group[name] for name in variables}
        except (KeyError, ValueError, TypeError):
            (path / "zarr.json").stat()
            raise SceneError(f"{path} is damaged, or is being deleted; replace it with --fresh") from None
        for name, one in variables.items():
            arrays[name][tuple(where.get(dim, slice(None)) for dim in one.dims)] = np.asarray(values[name], one.dtype)
        (path / "zarr.json").stat()  # of a store that was deleted since, Zarr has made these folders anew


def check_place(path: Path) -> None:
    """Raises SceneError, before anything is computed, if `path` cannot be a store."""
    if not path.parent.is_dir():
        raise SceneError(f"{path}: the folder {path.parent} does not exist")
    if path.exists():
        group.check_ours(path)
    elif os.path.lexists(path) or not os.access(path.parent, os.W_OK):
        raise SceneError(f"{path} cannot be written: choose a name in a folder that is writable")


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    with refusals(path):
        marks.folder(path).mkdir(exist_ok=True)
    with jobs.held(marks.folder(path) / "lock", str(path)):
        yield
