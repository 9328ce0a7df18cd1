"""Derivations as data, which can be read and checked: defined letters, each with the step that makes it.

A letter denotes an expression.  The expression is either written in symbols (a premise, if it has no other defined
letter) or made from a defined letter by one operation on words.  Formulas use the letter; words.py expands it.  A
certificate contains the steps, and the checker repeats them.

The operations, on the sum X of words that a letter denotes:

rate      the derivative of X by Leibniz' rule, from the rates of the letters: also the variation of X
replaced  X with letters and parameters replaced by expressions
gradient  G with tr X = tr(Gᵀ Y) + (terms without Y), for a letter Y
dual      the skew S with tr X = ½ tr(ξ S) for a skew letter ξ in which X is linear; tr X = 0 for every ξ if S = 0
having, lacking   the terms of X with, or without, one of some letters
matrix, entry     X at explicit matrices, which satisfy the rules in a quotient ring, and an entry of this matrix

These operations express a principle of mechanics for any system and every n.  The rate of an action, for free
increments, is its variation.  On solutions it vanishes for all increments that satisfy the constraints: by multipliers
(`equations`), or by the dual after substitution of increments that satisfy the constraints (`allowed`).
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from .quotient import Quotient
from .words import DEFINED, WordAlgebra, evaluate, unfolded

Places = Mapping[sp.Symbol, sp.Expr]


@dataclass(frozen=True)
class Step:
    """The step that defines a letter: its meaning in words, its algebra, the operation and its operands."""

    text: str
    algebra: Any
    operation: str
    of: Any
    by: Any = None


STEPS: dict[sp.Symbol, Step] = {}


def _defined(name: str, step: Step, value: sp.Expr) -> sp.Symbol:
    letter = sp.Symbol(name, commutative=step.operation == "entry")
    if letter in STEPS and (STEPS[letter] != step or DEFINED[letter] != value):
        raise ValueError(f"the letter {name} is defined twice")
    STEPS[letter], DEFINED[letter] = step, value
    return letter


def written(name: str, text: str, expr: sp.Expr, algebra: WordAlgebra) -> sp.Symbol:
    """A new letter for an expression in symbols."""
    return _defined(name, Step(text, algebra, "written", expr), algebra.normal(expr))


def rate(name: str, text: str, of: sp.Symbol, rates: Places) -> sp.Symbol:
    """A new letter for the rate of a defined letter."""
    algebra = STEPS[of].algebra
    return _defined(name, Step(text, algebra, "rate", of, dict(rates)), algebra.rate(of, rates))


def replaced(name: str, text: str, of: sp.Symbol, places: Places, algebra: WordAlgebra) -> sp.Symbol:
    """A new letter for a defined letter with expressions substituted for its letters, in the algebra of these."""
    whole = {letter: unfolded(image) for letter, image in places.items()}
    value = algebra.normal(sp.expand(DEFINED[of].xreplace(whole)))
    return _defined(name, Step(text, algebra, "replaced", of, dict(places)), value)


def gradient(name: str, text: str, of: sp.Symbol, letter: sp.Symbol) -> sp.Symbol:
    """A new letter for the gradient of tr(a defined letter)."""
    algebra = STEPS[of].algebra
    return _defined(name, Step(text, algebra, "gradient", of, letter), algebra.gradient(DEFINED[of], letter))


def dual(name: str, text: str, of: sp.Symbol, xi: sp.Symbol) -> sp.Symbol:
    """A new letter for the skew matrix that vanishes exactly when tr(a defined letter) does for every skew ξ."""
    algebra = STEPS[of].algebra
    value = algebra.dual_of_skew(algebra.trace(DEFINED[of]), xi)
    return _defined(name, Step(text, algebra, "dual", of, xi), value)


def terms(name: str, text: str, of: sp.Symbol, letters: Collection[sp.Symbol], having: bool = True) -> sp.Symbol:
    """A new letter for the terms of a defined letter that have one of some letters, or none."""
    step = Step(text, STEPS[of].algebra, "having" if having else "lacking", of, tuple(letters))
    chosen = (term for term in sp.Add.make_args(DEFINED[of]) if term.has(*letters) is having)
    return _defined(name, step, sp.Add(*chosen))


def equations(
    varied: sp.Symbol, holding: sp.Symbol, increments: Mapping[str, sp.Symbol], algebra: WordAlgebra
) -> list[sp.Symbol]:
    """Letters for the gradients of tr(variation) minus those of the multiplier terms: they vanish on solutions."""
    found = []
    for name, by in increments.items():
        slope = gradient(f"slope_{name}", f"of tr variation in {by}", varied, by)
        held = gradient(f"held_{name}", f"of tr holding in {by}", holding, by)
        found.append(written(f"equation_{name}", "it vanishes on solutions", slope - held, algebra))
    return found


def allowed(name: str, text: str, turn: Places, rolling: sp.Symbol, dr: sp.Symbol, algebra: WordAlgebra) -> Places:
    """Increments `turn`, and dr from a constraint `rolling` = 0, the sum of dr and terms in the other increments."""
    turn = algebra.with_transposes(turn)
    turning = terms(f"turning{name}", f"-{dr} by that", rolling, [dr], having=False)
    slipping = replaced(f"slipping{name}", f"-{dr} for {text}", turning, turn, algebra)
    return {**turn, **algebra.with_transposes({dr: -slipping})}


def coordinates(name: str, text: str, of: sp.Symbol, places: Mapping[sp.Symbol, Any], ring: Quotient) -> sp.Symbol:
    """A letter for the matrix of a defined letter, for matrices of its letters that satisfy the rules in the ring."""
    value = sp.ImmutableMatrix(evaluate(DEFINED[of], places).applyfunc(sp.expand))
    return _defined(name, Step(text, ring, "matrix", of, dict(places)), value)


def entry(name: str, text: str, of: sp.Symbol, row: int, column: int) -> sp.Symbol:
    """A commuting letter for an entry of a named matrix."""
    return _defined(name, Step(text, STEPS[of].algebra, "entry", of, (row, column)), DEFINED[of][row, column])


def needed(expressions: Collection[sp.Expr]) -> Iterator[sp.Symbol]:
    """The defined letters in some expressions, and all letters of their definitions, each after those that it needs."""
    seen: dict[sp.Symbol, None] = {}

    def visit(expr: Any) -> None:
        for letter in sorted(expr.free_symbols & STEPS.keys(), key=str):
            if letter not in seen:
                visit(STEPS[letter].of)
                by = STEPS[letter].by
                for image in by.values() if isinstance(by, dict) else ():
                    visit(image)
                seen[letter] = None

    for expr in expressions:
        visit(expr)
    yield from seen
