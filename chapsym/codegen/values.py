"""The values of kernels at a rational point: they survive another order of the text."""

import ast
import hashlib
from fractions import Fraction
from functools import cache
from typing import Any

import sympy as sp

from .kernels import Kernel
from .passes import letters

DIGITS = 40
#: What a text calls in the place of its functions: no kernel may have a name that begins so.
LETTER = "__letter"


def at(name: str) -> Fraction:
    """The value of a name at the rational point, in (1/2, 3/2): it is seeded from the name."""
    seed = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big") % 1009
    return Fraction(1009 + 2 * seed, 2018)


def decimal(value: Fraction | sp.Rational) -> str:
    """40 significant digits of a rational number."""
    return str(sp.Rational(value).evalf(DIGITS))


@cache
def fingerprint(kernel: Kernel) -> list[str]:
    """The values of the expressions at the rational point, letters with values of their own, and of what these are."""
    point = {symbol: sp.Rational(at(symbol.name)) for symbol in (*kernel.inputs, *kernel.letters)}
    values = [decimal(e.xreplace(point)) for e in kernel.expressions]
    return values + [f"{function} {decimal(of.xreplace(point))}" for _, function, of in letters(kernel)]


def text_fingerprint(kernel: Kernel, text: str) -> list[str]:
    """The same values from the generated text, run on fractions."""
    module, found = ast.parse(text), list[str]()
    module.body = [node for node in module.body if not isinstance(node, ast.ImportFrom)]
    for node in ast.walk(module):
        if isinstance(node, ast.Assign) and isinstance(call := node.value, ast.Call):
            call.args[:0] = [ast.Constant(ast.unparse(part)) for part in (call.func, *node.targets)]
            call.func = ast.Name(LETTER, ast.Load())

    def letter(function: str, name: str, *of: Fraction) -> Fraction:
        found.append(f"{function} {decimal(Fraction(1) if function == 'pi' else of[0])}")
        return at(name)

    scope: dict[str, Any] = {LETTER: letter}
    exec(compile(ast.fix_missing_locations(module), f"{kernel.name}.py", "exec"), scope)  # our own text, never a user's
    result = scope[kernel.name](*(at(symbol.name) for symbol in kernel.inputs))
    return [decimal(value) for value in (result if isinstance(result, tuple) else (result,))] + found
