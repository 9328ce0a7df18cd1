"""The values of kernels and programs at a rational point: they survive another order of the text."""

import hashlib
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from types import ModuleType

import sympy as sp

from . import ir
from .kernels import Kernel
from .programs import Program

DIGITS = 40


def point(symbols: Sequence[sp.Symbol]) -> dict[sp.Symbol, sp.Rational]:
    """A rational point seeded from the names of the symbols, each value in (1/2, 3/2)."""

    def value(name: str) -> sp.Rational:
        seed = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big") % 1009
        return sp.Rational(1009 + 2 * seed, 2018)

    return {symbol: value(symbol.name) for symbol in symbols}


def decimal(value: Fraction) -> str:
    """40 significant digits of a rational number."""
    return str(sp.Rational(value.numerator, value.denominator).evalf(DIGITS))


@cache
def fingerprint(kernel: Kernel) -> list[str]:
    """The values of the expressions at the rational point: they survive another order of the text."""
    values = point(kernel.inputs)
    exact = [e.xreplace(values) for e in kernel.expressions]
    return [decimal(Fraction(int(e.p), int(e.q))) for e in exact]


def text_fingerprint(kernel: Kernel, text: str) -> list[str]:
    """The same values from the generated text, run on fractions."""
    arguments = [Fraction(int(v.p), int(v.q)) for v in point(kernel.inputs).values()]
    result = _function(kernel.name, text)(*arguments)
    return [decimal(value) for value in (result if isinstance(result, tuple) else (result,))]


def _function(name: str, text: str) -> Callable:
    scope: dict = {}
    exec(compile(text, f"{name}.py", "exec"), scope)  # our own text, never a user's
    return scope[name]


def _at(name: str) -> Fraction:
    """The value of one name at the rational point."""
    value = point([sp.Symbol(name)])[sp.Symbol(name)]
    return Fraction(int(value.p), int(value.q))


def program_fingerprint(program: Program, texts: ir.Texts) -> list[str]:
    """The values of a program at the rational point, by its own text and those of the kernels."""
    kernels = {name: _function(name, texts[name]) for name in ir.called(program)}
    return [decimal(value) for value in ir.values(program, kernels, _at)]


def target_fingerprint(target: ModuleType, program: Program, text: str) -> list[str]:
    """The same values from the text of a backend, run on its numbers: pairs or integers of fractions."""
    return [decimal(value) for value in target.text_values(program, text, _at)]
