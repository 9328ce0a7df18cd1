"""The values of kernels and programs at a rational point: they survive another order of the text."""

import hashlib
from collections.abc import Callable
from fractions import Fraction
from functools import cache
from types import ModuleType

import sympy as sp

from . import ir
from .kernels import Kernel
from .programs import Program

DIGITS = 40


def at(name: str) -> Fraction:
    """The value of a name at the rational point, in (1/2, 3/2): it is seeded from the name."""
    seed = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big") % 1009
    return Fraction(1009 + 2 * seed, 2018)


def decimal(value: Fraction | sp.Rational) -> str:
    """40 significant digits of a rational number."""
    return str(sp.Rational(value).evalf(DIGITS))


@cache
def fingerprint(kernel: Kernel) -> list[str]:
    """The values of the expressions at the rational point."""
    point = {symbol: sp.Rational(at(symbol.name)) for symbol in kernel.inputs}
    return [decimal(e.xreplace(point)) for e in kernel.expressions]


def text_fingerprint(kernel: Kernel, text: str) -> list[str]:
    """The same values from the generated text, run on fractions."""
    result = _function(kernel.name, text)(*(at(symbol.name) for symbol in kernel.inputs))
    return [decimal(value) for value in (result if isinstance(result, tuple) else (result,))]


def _function(name: str, text: str) -> Callable:
    scope: dict = {}
    exec(compile(text, f"{name}.py", "exec"), scope)  # our own text, never a user's
    return scope[name]


def program_fingerprint(program: Program, texts: ir.Texts) -> list[str]:
    """The values of a program at the rational point, by its own text and those of the kernels."""
    scope: dict = {name: _function(name, texts[name]) for name in ir.called(program)}
    scope |= {name: at(name) for name in program.inputs}
    exec(compile(program.text, program.name, "exec"), scope)  # our own text, never a user's
    return [decimal(scope[name]) for name in program.outputs]


def target_fingerprint(target: ModuleType, program: Program, text: str) -> list[str]:
    """The same values from the text of a backend, run on its numbers: pairs or integers of fractions."""
    return [decimal(value) for value in target.text_values(program, text, at)]
