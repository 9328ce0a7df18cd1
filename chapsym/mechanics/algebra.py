"""Expressions of a system in a ring: letters for sines, cosines and roots, with their relations and derivatives."""

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any

import sympy as sp

from chapsym.codegen.kernels import adjoined
from chapsym.derive import Quotient

from .system import BadSystem, System


class Letters:
    """Letters for the sines, cosines and square roots of expressions, in the order in which one needs another.

    Parameters
    ----------
    reserved : iterable of sympy.Symbol
        Symbols that the letters must not be called as.
    """

    def __init__(self, reserved: Iterable[sp.Symbol] = ()) -> None:
        self._taken = {x.name for x in reserved}
        self._of: dict[sp.Expr, sp.Symbol] = {}

    @property
    def meanings(self) -> dict[sp.Symbol, sp.Expr]:
        """What each letter stands for, in letters before it."""
        return {letter: stands for stands, letter in self._of.items()}

    def into(self, expr: Any) -> sp.Expr:
        """An expression with letters in the place of its functions; raises BadSystem for others than these."""
        expr = sp.sympify(expr)
        if expr.is_Atom:
            return self._letter(sp.pi) if expr is sp.pi else expr
        if isinstance(expr, sp.tan):
            return self.into(sp.sin(expr.args[0]) / sp.cos(expr.args[0]))
        parts = [self.into(x) for x in expr.args]
        if isinstance(expr, sp.sin | sp.cos):
            (of,) = parts
            for x in (sp.sin(of), sp.cos(of)):
                self._letter(x)
            return self._letter(expr.func(of))
        if isinstance(expr, sp.Pow) and not expr.exp.is_Integer:
            if not (expr.exp.is_Rational and expr.exp.q == 2):
                raise BadSystem(f"{expr} is not sin, cos, a square root or a whole power")
            return self._letter(sp.sqrt(parts[0])) ** expr.exp.p
        if not expr.is_Add and not expr.is_Mul and not expr.is_Pow:
            raise BadSystem(f"{expr} is not sin, cos, a square root or + - * /")
        return expr.func(*parts)

    def _letter(self, stands: sp.Expr) -> sp.Expr:
        if (parts := adjoined(stands)) is None:
            return -self._letter(-stands) if adjoined(-stands) else stands  # sin(-x), or a number
        if stands not in self._of:
            function, of = parts
            base = function + "".join(f"_{x}" for x in sorted(map(str, of.free_symbols)))[:24]
            names = (base if i == 1 else f"{base}_{i}" for i in range(1, 10**6))
            name = next(n for n in names if n not in self._taken and n not in ("sin", "cos", "sqrt", "pi"))
            self._taken.add(name)
            self._of[stands] = sp.Symbol(name)
        return self._of[stands]

    def derivative(self, expr: sp.Expr, x: sp.Symbol) -> sp.Expr:
        """∂/∂x of an expression in letters."""
        names = expr.free_symbols
        found = sp.diff(expr, x) if x in names else sp.S.Zero
        for letter, stands in self.meanings.items():
            if letter in names and (rate := self.rate(letter, stands, x)) != 0:
                found += sp.diff(expr, letter) * rate
        return found

    def rate(self, letter: sp.Symbol, stands: sp.Expr, x: sp.Symbol) -> sp.Expr:
        """∂/∂x of a letter."""
        function, of = adjoined(stands) or ("", sp.S.Zero)
        inner = self.derivative(of, x)
        if inner == 0:
            return sp.S.Zero
        if function == "sqrt":
            return inner / (2 * letter)
        return self._of[sp.cos(of)] * inner if function == "sin" else -self._of[sp.sin(of)] * inner

    @property
    def relations(self) -> list[sp.Expr]:
        """sin² + cos² - 1 of each argument, and √x² - x: polynomials, where x is one."""
        found = []
        for stands, letter in self._of.items():
            function, of = adjoined(stands) or ("", sp.S.Zero)
            if function == "sin":
                found.append(letter**2 + self._of[sp.cos(of)] ** 2 - 1)
            elif function == "sqrt":
                found.append(sp.fraction(sp.together(letter**2 - of))[0])
        return found


class Algebra:
    """The ring of a system: coordinates, velocities, parameters and letters.

    Angles are expanded: sin(a + 2 b) is made of the letters of a and b.
    """

    def __init__(self, system: System) -> None:
        self.system = system
        self.letters = Letters((*system.coordinates, *system.velocities, *system.parameters))
        self.holonomic = [self.into(one) for one in system.holonomic]
        self.rows: sp.Matrix = self.into(system.rows)

    def into(self, expr: Any) -> Any:
        """An expression, or a matrix of them, in letters."""
        if isinstance(expr, sp.MatrixBase):
            return expr.applyfunc(self.into)
        return self.letters.into(sp.expand_trig(sp.sympify(expr)))

    @cached_property
    def ring(self) -> Quotient:
        """The ring of the constraints: of the symbols that they have."""
        relations = [*self.letters.relations, *self.holonomic]
        known = set().union(self.rows.free_symbols, *(r.free_symbols for r in relations))
        order = (*self.system.coordinates, *self.system.parameters, *self.letters.meanings)
        return Quotient([x for x in order if x in known], relations)

    def normal(self, vector: Sequence[sp.Expr]) -> list[sp.Expr]:
        """The normal forms of a vector, times roots that it divides by: the span is the same."""
        found = [sp.sympify(x) for x in vector]
        for letter, stands in self.letters.meanings.items():
            while stands.is_Pow and not all(x.is_polynomial(letter) for x in found):
                found = [sp.expand(x * letter) for x in found]
        return [self.ring.normal(x) for x in found]
