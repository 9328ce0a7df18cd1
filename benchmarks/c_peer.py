"""chapsym's loop in C: `gibbs.c` and the generated kernels, compiled by the system's compiler for this processor."""

import ast
import ctypes
import inspect
import subprocess
import tempfile
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from textwrap import dedent
from typing import Any

import numpy as np

from chapsym import generated
from chapsym.dynamics.loops import gibbs
from chapsym.studies.harness import NotComparable, compiler

FLAGS = ("-O3", "-march=native", "-shared", "-fPIC")
KERNELS: tuple[Callable[..., Any], ...] = (generated.gibbs_newton, generated.gibbs_second, generated.turn)


class NoCompiler(Exception):
    """There is no C compiler, or it refuses; the message says which."""


def loop() -> Callable[[np.ndarray, np.ndarray, np.ndarray, float, int], tuple[np.ndarray, np.ndarray]]:
    """The compiled loop (K, g, J, D, steps) -> the last (K, g); raises NoCompiler."""
    march = _compiled().gibbs_march
    vector = np.ctypeslib.ndpointer(np.float64, shape=(3,), flags="C")
    march.argtypes = [vector, vector, vector, *3 * [ctypes.c_double], ctypes.c_long]
    march.restype = ctypes.c_long

    def run(K: np.ndarray, g: np.ndarray, J: np.ndarray, D: float, steps: int) -> tuple[np.ndarray, np.ndarray]:
        k, g, inertia = K / 2, g.copy(), J.sum() - J
        radius, enough = gibbs.certificate(*map(float, (*k, *inertia, D)))
        if march(k, g, inertia, D, radius, enough, steps) != steps:
            raise NotComparable("the loop in C does not converge")
        return 2 * k, g

    return run


def in_c(kernel: Callable[..., Any]) -> str:
    """A generated kernel in C, line by line: its sums, products and quotients are written alike in both languages."""
    tree = ast.parse(dedent(inspect.getsource(kernel))).body[0]
    assert isinstance(tree, ast.FunctionDef)
    parameters = ", ".join(f"double {a.arg}" for a in tree.args.args)
    lines = [f"static inline void {kernel.__name__}({parameters}, double *out) {{"]
    for statement in tree.body[1:]:  # after the docstring
        if isinstance(statement, ast.Assign):
            lines.append(f"    const double {ast.unparse(statement.targets[0])} = {ast.unparse(statement.value)};")
        elif isinstance(statement, ast.Return) and isinstance(statement.value, ast.Tuple):
            lines += [f"    out[{i}] = {ast.unparse(value)};" for i, value in enumerate(statement.value.elts)]
        else:
            raise TypeError(f"{kernel.__name__} has a statement that is no assignment: {ast.unparse(statement)}")
    return "\n".join([*lines, "}", ""])


def _compiled() -> ctypes.CDLL:
    path = compiler()
    if path is None:
        raise NoCompiler("no C compiler: neither CC nor cc, gcc or clang is there")
    # The library stays loaded after its file is gone; a system that locks loaded files keeps the folder.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        source, built = Path(folder) / "gibbs.c", Path(folder) / "gibbs.so"
        source.write_text((files(__package__) / "gibbs.c").read_text(encoding="utf-8"), encoding="utf-8")
        (Path(folder) / "kernels.h").write_text("\n".join(map(in_c, KERNELS)), encoding="utf-8")
        command = [path, *FLAGS, str(source), "-o", str(built), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise NoCompiler(f"{path} does not compile gibbs.c: {(done.stderr.splitlines() or ['no reason given'])[0]}")
        return ctypes.CDLL(str(built))
