"""One writer a store: a lock file that the system lets go when its process ends, however it ends."""

import json
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...read.scene import SceneError

try:
    import fcntl
except ImportError:  # Windows: two writers are not told apart there
    fcntl = None  # type: ignore[assignment]


@contextmanager
def held(path: Path, what: str) -> Iterator[None]:
    """Holds the lock file `path` of `what`; raises SceneError with the process that holds it, if another does."""
    try:
        stream = open(path, "a+", encoding="utf-8")  # noqa: SIM115
    except OSError as error:
        raise SceneError(f"{what} cannot be written: {error.strerror or error}") from None
    with stream:
        try:
            if fcntl is not None:
                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise SceneError(
                f"{what} is being written by {_holder(path)}; wait for it, or choose another name"
            ) from None
        except OSError as error:
            raise SceneError(f"{what} cannot be locked: {error.strerror or error}") from None
        try:
            stream.truncate(0)
            stream.write(json.dumps({"pid": os.getpid(), "host": socket.gethostname()}))
            stream.flush()
        except OSError:  # a full disk: the lock holds all the same, but names nobody
            stream.truncate(0)
        yield


def _holder(path: Path) -> str:
    """The process that wrote its name into a lock file."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return f"process {found['pid']} on {found['host']}"
    except (OSError, ValueError, KeyError, TypeError):
        return "another process"
