"""The marks of a store: for each chunk how many segments are written, with the state for the next, in one file."""

import zipfile
from pathlib import Path

import numpy as np

from chapsym import files

from ...plan.models import State
from ...read.errors import SceneError

#: The name of the count in a mark; the rest is the state.
DONE = "segments_done"


def folder(store: Path) -> Path:
    """The folder of the marks and the lock, inside the store."""
    return store / ".chapsym"


def path_of(store: Path, chunk: int) -> Path:
    """The mark of a chunk."""
    return folder(store) / f"chunk-{chunk:06d}.npz"


def write(store: Path, chunk: int, done: int, state: State) -> None:
    """Replaces the mark of a chunk, whole; raises CannotWrite."""
    data = {DONE: np.array(done), **state}
    files.write_whole(path_of(store, chunk), lambda stream: np.savez(stream, **data))  # type: ignore[arg-type]


def read(store: Path, chunk: int) -> tuple[int, State] | None:
    """The segments done of a chunk and the state after them; None if none is.  Raises SceneError if it is damaged."""
    try:
        with np.load(path_of(store, chunk), allow_pickle=False) as data:
            state = {name: data[name] for name in data.files}
        return int(state.pop(DONE)), state
    except FileNotFoundError:
        return None
    # Of NumPy and of zip, by what is cut.
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):
        raise damaged(store, chunk) from None


def damaged(store: Path, chunk: int) -> SceneError:
    """The error for a mark that says nothing."""
    path = path_of(store, chunk)
    return SceneError(
        f"{path} is damaged; delete it, and the same command computes its balls anew and keeps the others"
    )
