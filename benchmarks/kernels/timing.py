"""The time of a call: each text in C, in a loop over the columns of many states, all texts interleaved."""

import ast
import ctypes
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np

from chapsym.studies.harness import Contender, NotComparable, compiler, interleaved

from .states import DRAWN, arguments
from .texts import Text, outputs

#: So many states that the loop is what takes the time, and they stay in the cache.
STATES = 256
#: As the package is compiled, for this processor.
FLAGS = ("-O3", "-march=native", "-ffp-contract=off", "-fno-math-errno", "-shared", "-fPIC")
LOOP = """
void loop(const double *X, double *Y, long repeats) {{
    for (long r = 0; r < repeats; r++)
        for (long n = 0; n < {states}; n++)
            kernel({arguments}, Y + n, {states});
}}
"""


class _Powers(ast.NodeTransformer):
    """x**2 is pow(x, 2) in C, as in Python underneath."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        self.generic_visit(node)
        power = isinstance(node.op, ast.Pow)
        return ast.Call(ast.Name("pow"), [node.left, node.right], []) if power else node


def in_c(source: str) -> str:
    """A kernel's text in C, line by line: its sums, products and quotients are written alike in both languages."""
    tree = _Powers().visit(ast.parse(source)).body[-1]
    assert isinstance(tree, ast.FunctionDef)
    parameters = ", ".join(f"double {a.arg}" for a in tree.args.args)
    lines = [f"static __attribute__((noinline)) void kernel({parameters}, double *out, long apart) {{"]
    for statement in tree.body[1:]:  # after the docstring
        if isinstance(statement, ast.Assign):
            lines.append(f"    const double {ast.unparse(statement.targets[0])} = {ast.unparse(statement.value)};")
        elif isinstance(statement, ast.Return) and statement.value is not None:
            values = statement.value.elts if isinstance(statement.value, ast.Tuple) else [statement.value]
            lines += [f"    out[{i} * apart] = {ast.unparse(value)};" for i, value in enumerate(values)]
        else:
            raise TypeError(f"{tree.name} has a statement that is no assignment: {ast.unparse(statement)}")
    return "\n".join([*lines, "}", ""])


def _loop(text: Text, path: str, inputs: int) -> Callable[..., None]:
    """A compiled loop: X (inputs, states) to Y (outputs, states), `repeats` times."""
    columns = ", ".join(f"X[{i * STATES} + n]" for i in range(inputs))
    # The library stays loaded after its file is gone; a system that locks loaded files keeps the folder.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        source, built = Path(folder) / "kernel.c", Path(folder) / "kernel.so"
        source.write_text(
            "#include <math.h>\n" + in_c(text.source) + LOOP.format(states=STATES, arguments=columns), encoding="utf-8"
        )
        subprocess.run([path, *FLAGS, str(source), "-o", str(built), "-lm"], capture_output=True, check=True)
        loop = ctypes.CDLL(str(built)).loop
    array = np.ctypeslib.ndpointer(np.float64, ndim=2, flags="C")
    loop.argtypes, loop.restype = [array, array, ctypes.c_long], None
    return loop


def nanoseconds(texts: Sequence[Text], rounds: int, repeats: int) -> list[float]:
    """The median time of a call of each text, in generic states, in nanoseconds; NaN without a C compiler."""
    path = compiler()
    if path is None:
        return [float("nan")] * len(texts)
    rng = np.random.default_rng(20071)
    kernel = texts[0].kernel
    X = np.array([arguments(kernel, "generic", list(rng.uniform(size=DRAWN))) for _ in range(STATES)]).T.copy()
    Y = np.empty((outputs(kernel), STATES))
    contenders = []
    for text in texts:
        loop = _loop(text, path, len(X))
        loop(X, Y, 1)
        if not np.array_equal(Y[:, 0], np.atleast_1d(text.function(*X[:, 0].tolist()))):
            raise NotComparable(f"{kernel} is not the same in C")
        contenders.append(Contender(text.without, partial(loop, X, Y, repeats), STATES * repeats, time.thread_time))
    timings = interleaved(contenders, rounds)
    return [timings[text.without].median * 1e9 for text in texts]
