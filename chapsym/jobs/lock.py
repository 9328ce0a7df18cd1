"""One writer: a lock that the system lets go when its process ends, however it ends."""

import json
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from chapsym.dynamics import BadInput

try:
    import fcntl
except ImportError:  # Windows: two writers are not told apart there
    fcntl = None  # type: ignore[assignment]


@contextmanager
def held(path: Path, what: str) -> Iterator[None]:
    """Holds the lock file `path` of `what`; raises BadInput with the process that holds it, if another does."""
    try:
        stream = open(path, "a+", encoding="utf-8")  # noqa: SIM115
    except OSError as error:
        raise BadInput(f"{what} cannot be written: {error.strerror or error}") from None
    with stream:
        claim(stream, what, path)
        try:
            stream.truncate(0)
            stream.write(json.dumps({"pid": os.getpid(), "host": socket.gethostname()}))
            stream.flush()
        except OSError:  # a full disk: the lock holds all the same, but names nobody
            stream.truncate(0)
        yield


def claim(stream: IO[str], what: str, named: Path | None = None) -> None:
    """Locks an open file until it is closed; raises BadInput if another process has, which the file `named` tells."""
    try:
        if fcntl is not None:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        holder = "another process" if named is None else _holder(named)
        raise BadInput(f"{what} is being written by {holder}; wait for it, or choose another name") from None
    except OSError as error:
        raise BadInput(f"{what} cannot be locked: {error.strerror or error}") from None


def _holder(path: Path) -> str:
    """The process that wrote its name into a lock file."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
        return f"process {found['pid']} on {found['host']}"
    except (OSError, ValueError, KeyError, TypeError):
        return "another process"
