"""The passes from the expressions of a kernel to assignments and outputs.

Each pass can be omitted: the manifest has the operations that it saves.
"""

import ast
from collections.abc import Collection, Iterator, Sequence
from functools import cache

import sympy as sp
from sympy.core.sorting import default_sort_key

from chapsym.derive.quotient import in_sympy

from . import printer
from .kernels import Kernel, adjoined
from .printer import BALANCED, POWERS

Assignments = list[tuple[sp.Symbol, sp.Expr]]

#: Compute by the steps of the derivation: entries, cofactors, determinant, one division.
FACTORED = "factored"
#: Name common subexpressions.
COMMON = "common"
#: All passes, in the order of application; the last two print (`printer`).
PASSES = (FACTORED, COMMON, POWERS, BALANCED)


@cache
def lower(kernel: Kernel, passes: tuple[str, ...] = PASSES) -> tuple[Assignments, list[sp.Expr]]:
    """The assignments of a kernel, in order, and its outputs by their names."""
    steps, outputs = kernel.steps if FACTORED in passes else ([], kernel.expressions)
    taken = {s.name for s in (*kernel.inputs, *kernel.letters, *(symbol for names, _ in steps for symbol in names))}
    fresh = (s for s in sp.numbered_symbols("t") if s.name not in taken)
    done: Assignments = []
    for names, values in steps:
        unique = dict(zip(names, values, strict=True))  # a symmetric matrix has an entry twice
        terms, rest = _simplified([in_sympy(e) for e in unique.values()], fresh, passes)
        done += [*terms, *zip(unique, rest, strict=True)]
    terms, rest = _simplified([in_sympy(e) for e in outputs], fresh, passes)
    return done + terms, rest


def _simplified(
    expressions: Sequence[sp.Expr], fresh: Iterator[sp.Symbol], passes: Collection[str]
) -> tuple[Assignments, list[sp.Expr]]:
    terms: Assignments = []
    rest = list(expressions)
    if COMMON in passes:
        terms, rest = sp.cse(rest, symbols=fresh, order="canonical")
    return _name_bases(terms, rest, fresh) if POWERS in passes else (terms, rest)


def _name_bases(
    terms: Assignments, rest: list[sp.Expr], fresh: Iterator[sp.Symbol]
) -> tuple[Assignments, list[sp.Expr]]:
    """Names every base of a power, since the product repeats it."""
    named: Assignments = []
    bases: dict[sp.Expr, sp.Symbol] = {}

    def name(expr: sp.Expr) -> sp.Expr:
        powers = [p for p in expr.atoms(sp.Pow) if not p.base.is_Symbol and abs(p.exp) > 1]
        for power in sorted(powers, key=default_sort_key):
            if power.base not in bases:
                bases[power.base] = next(fresh)
                named.append((bases[power.base], power.base))
            expr = expr.xreplace({power: bases[power.base] ** power.exp})
        return expr

    for symbol, term in terms:
        named.append((symbol, name(term)))
    return named, [name(expr) for expr in rest]


def letters(kernel: Kernel) -> list[tuple[sp.Symbol, str, sp.Expr]]:
    """The letters of a kernel, each with its function and argument."""
    found = ((letter, adjoined(stands)) for letter, stands in kernel.letters.items())
    return [(letter, *parts) for letter, parts in found if parts]


def operations(kernel: Kernel, chosen: tuple[str, ...] = PASSES) -> int:
    """The number of + - * / in the text, with powers as products, and of functions."""
    terms, rest = lower(kernel, chosen)
    return sum(map(_count, (*(e for _, e in terms), *rest))) + sum(1 + _count(x) for _, _, x in letters(kernel))


def _count(expr: sp.Expr) -> int:
    return sum(isinstance(part, ast.BinOp | ast.UnaryOp) for part in ast.walk(ast.parse(printer.text(expr))))


def saved(kernel: Kernel) -> dict[str, int]:
    """The operations that each pass saves in this kernel: those without it, less those with all passes."""
    full = operations(kernel)
    return {p: operations(kernel, tuple(x for x in PASSES if x != p)) - full for p in PASSES}
