"""From a kernel's expressions to assignments and outputs: the passes, one by one.

Each can be left out, so that the manifest says what it saves in operations, and `chapsym bench kernels` in time.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cache

import sympy as sp
from sympy.core.sorting import default_sort_key

from .kernels import Kernel

Assignments = list[tuple[sp.Symbol, sp.Expr]]


@dataclass(frozen=True)
class Pass:
    """One way to save operations, and what it does."""

    name: str
    summary: str


FACTORED = Pass("factored", "compute by the derivation's own steps: entries, cofactors, determinant, one division")
COMMON = Pass("common", "name common subexpressions")
POWERS = Pass("powers", "print an integer power as a product, and name its base")
BALANCED = Pass("balanced", "print a sum as a balanced tree, so that fewer operations wait for each other")

#: In the order in which they are applied.
PASSES = (FACTORED, COMMON, POWERS, BALANCED)


def lower(kernel: Kernel, passes: Collection[Pass] = PASSES) -> tuple[Assignments, list[sp.Expr]]:
    """The assignments of a kernel, in order, and its outputs by their names."""
    return _lower(kernel, tuple(p for p in (FACTORED, COMMON, POWERS) if p in passes))


@cache
def _lower(kernel: Kernel, passes: tuple[Pass, ...]) -> tuple[Assignments, list[sp.Expr]]:
    steps, outputs = kernel.steps if FACTORED in passes else ([], kernel.expressions)
    taken = {s.name for s in (*kernel.inputs, *(symbol for names, _ in steps for symbol in names))}
    fresh = (s for s in sp.numbered_symbols("t") if s.name not in taken)
    done: Assignments = []
    for names, values in steps:
        unique = dict(zip(names, values, strict=True))  # a symmetric matrix names an entry twice
        terms, rest = _simplified([sp.sympify(e) for e in unique.values()], fresh, passes)
        done += [*terms, *zip(unique, rest, strict=True)]
    terms, rest = _simplified([sp.sympify(e) for e in outputs], fresh, passes)
    return done + terms, rest


def _simplified(
    expressions: Sequence[sp.Expr], fresh: Iterator[sp.Symbol], passes: Collection[Pass]
) -> tuple[Assignments, list[sp.Expr]]:
    terms: Assignments = []
    rest = list(expressions)
    if COMMON in passes:
        terms, rest = sp.cse(rest, symbols=fresh, order="canonical")
    return _name_bases(terms, rest, fresh) if POWERS in passes else (terms, rest)


def _name_bases(
    terms: Assignments, rest: list[sp.Expr], fresh: Iterator[sp.Symbol]
) -> tuple[Assignments, list[sp.Expr]]:
    """Gives every base of a power that is not a name one: the product of its copies repeats it."""
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


def operations(lowered: tuple[Assignments, list[sp.Expr]]) -> int:
    """The number of + - * / that the text has, each power as its products."""
    terms, rest = lowered
    return sum(_count(e) for e in (*(e for _, e in terms), *rest))


def _count(expr: sp.Expr) -> int:
    products = sum(abs(int(p.exp)) - 2 for p in expr.atoms(sp.Pow) if abs(p.exp) > 1)
    return int(sp.count_ops(expr)) + products


def saved(kernel: Kernel) -> dict[str, int]:
    """Operations without each pass, less those with all: what the pass saves in this kernel."""
    full = operations(lower(kernel))
    return {p.name: operations(lower(kernel, [x for x in PASSES if x is not p])) - full for p in PASSES}
