"""Compiled code that is kept on disk: closed to others, found by its content, compiled by one process for all.

What is kept is unpickled, so whoever can write there can run code as its reader: a folder is used only if it is the
user's own and closed.  Whatever is damaged, or cannot be read or written, is compiled again.
"""

import atexit
import hashlib
import logging
import os
import pickle
import shutil
import stat
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

try:
    import fcntl
except ImportError:  # Windows: two processes compile the same there
    fcntl = None  # type: ignore[assignment]

#: For so long a process waits for another that compiles the same, in pauses and seconds: that one may stand still.
PAUSES, PAUSE = 2400, 0.05
#: The bytes of a checksum, with which every file begins.
CHECKSUM = 32


def folder_for(name: str) -> Path:
    """The folder of this name under the user's cache, or under the temporary folder; else one for this process only."""
    user = os.getuid() if hasattr(os, "getuid") else "cache"
    for home, own in ((_user_cache, "chapsym"), (tempfile.gettempdir, f"chapsym-{user}")):
        with suppress(OSError, RuntimeError):  # it cannot be written, or there is no home
            base = Path(home()) / own
            if _closed(base) and _closed(base / name):
                with tempfile.TemporaryFile(dir=base / name):
                    return base / name
    return _passing()


def _user_cache() -> Path:
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    home.mkdir(parents=True, exist_ok=True)
    return home


def _closed(folder: Path) -> bool:
    """Whether a folder, which is made if it is missing, is the user's own, and nobody else can write there."""
    folder.mkdir(mode=0o700, exist_ok=True)
    if not hasattr(os, "getuid"):  # Windows: the user's cache and temporary folder are closed themselves
        return True
    found = folder.lstat()  # not through a link, which may point to another folder tomorrow
    good = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022
    if not good:
        _say(f"compiled code is not kept in {folder}: others may write there, or it is not a folder of yours")
    return good


@cache
def _passing() -> Path:
    folder = tempfile.mkdtemp(prefix="chapsym-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return Path(folder)


@cache
def _say(text: str) -> None:
    """Says something once; who wants to hear it listens to the logger "chapsym"."""
    logging.getLogger("chapsym").info(text)


def keep(function: Any, folder: Path, name: str, text: bytes) -> None:
    """Lets a function of numba's keep its code in a folder, by its name and the text of its file."""
    kept, compile_now = Kept(folder, name, text), function.compile

    def once(signature: Any) -> Any:
        with alone(folder / f"{name}.lock"):
            return compile_now(signature)

    function._cache, function.compile = kept, once


class Kept:
    """What numba asks of the cache of a function: its code for the types of its arguments and for this processor."""

    def __init__(self, folder: Path, name: str, text: bytes) -> None:
        self.cache_path, self._name, self._text = str(folder), name, text

    def _file(self, signature: Any, codegen: Any) -> Path:
        key = repr((self._text, sys.version, str(signature), codegen.magic_tuple()))
        return Path(self.cache_path) / f"{self._name}-{hashlib.sha256(key.encode()).hexdigest()[:16]}.code"

    def load_overload(self, signature: Any, context: Any) -> Any:
        """The code, or None where it must be compiled."""
        context.refresh()
        with suppress(Exception):  # damaged files fail in many ways
            data = self._file(signature, context.codegen()).read_bytes()
            if data[:CHECKSUM] == hashlib.sha256(data[CHECKSUM:]).digest():
                return CompileResult._rebuild(context, *pickle.loads(data[CHECKSUM:]))
        _say("compiling the map for this processor: some seconds, once")
        return None

    def save_overload(self, signature: Any, code: Any) -> None:
        """Keeps the code, if that is possible: it runs all the same."""
        temporary = None
        with suppress(Exception):
            if not code.library.has_dynamic_globals:  # addresses of this process
                path, data = self._file(signature, code.codegen), dumps(code._reduce())
                with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as stream:
                    temporary = Path(stream.name)
                    stream.write(hashlib.sha256(data).digest() + data)
                temporary.replace(path)
                temporary = None
        if temporary is not None:
            with suppress(OSError):
                temporary.unlink()


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """One process at a time holds the lock file `path`; one that cannot have it goes on without.

    The system lets it go when its process ends, however it ends.
    """
    try:
        stream = open(path, "ab")  # noqa: SIM115
    except OSError:
        yield
        return
    with stream:
        _wait_for(stream)
        yield


def _wait_for(stream: Any) -> None:
    for _ in range(PAUSES if fcntl is not None else 0):
        try:
            return fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            time.sleep(PAUSE)
        except OSError:  # a file system without locks
            return
