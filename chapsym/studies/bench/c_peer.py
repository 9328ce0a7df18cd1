"""The loop of `gibbs.c`, compiled by the system's compiler for this processor."""

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path

import numpy as np

from .harness import compiler

FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")


class NoCompiler(Exception):
    """There is no C compiler, or it refuses; the message says which."""


def march() -> Callable[[np.ndarray, np.ndarray, np.ndarray, float, int], int]:
    """The compiled function (momentum, gamma, J, D, steps) -> steps taken; it moves its first two arguments, (3,).

    Raises NoCompiler.
    """
    library = _compiled()
    function = library.gibbs_march
    pointer = np.ctypeslib.ndpointer(np.float64, shape=(3,), flags="C")
    function.argtypes = [pointer, pointer, pointer, ctypes.c_double, ctypes.c_long]
    function.restype = ctypes.c_long
    return function


def _compiled() -> ctypes.CDLL:
    path = compiler()
    if path is None:
        raise NoCompiler("no C compiler: neither CC nor cc, gcc or clang is there")
    source = files(__package__) / "gibbs.c"
    # The library stays loaded after its file is gone; a system that locks loaded files keeps the folder.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        written, built = Path(folder) / "gibbs.c", Path(folder) / "gibbs.so"
        written.write_text(source.read_text(encoding="utf-8"), encoding="utf-8")
        done = subprocess.run(
            [path, *FLAGS, str(written), "-o", str(built), "-lm"], capture_output=True, text=True, check=False
        )
        if done.returncode:
            raise NoCompiler(f"{path} does not compile gibbs.c: {(done.stderr.splitlines() or ['no reason given'])[0]}")
        return ctypes.CDLL(str(built))
