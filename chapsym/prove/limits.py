"""Limits of rational functions, as equations that exact arithmetic decides."""

from collections.abc import Iterable
from typing import Any

import sympy as sp

from .statements import Algebra, Equation


def tends(
    text: str, expression: Any, along: sp.Symbol, order: int, to: Any, algebra: Algebra
) -> tuple[Equation, Equation]:
    """That expression / along^order tends to something as along tends to 0, as two equations.

    Parameters
    ----------
    text : str
        What is said, in the certificate, too.
    expression, to : sympy.Expr, or a matrix or list of them
        What tends, rational in `along`, and what it tends to.
    along : sympy.Symbol
        What tends to 0; a variable of the algebra.
    order : int
        The power by which the expression is divided.
    algebra : Quotient
        Where the equations are decided.

    Returns
    -------
    expansion, limit : Equation
        The expression as a polynomial in `along` of this degree and a remainder of a higher order, which holds
        whatever the limit is, a lemma; and the coefficients of the polynomial, which are 0 but for the last.

    Raises
    ------
    ArithmeticError
        Where the expression has a pole at along = 0.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import tends
    >>> x, h = sp.symbols("x h")
    >>> expansion, limit = tends("(1 - 1/(1 + hx))/h", 1 - 1 / (1 + h * x), h, 1, x, Quotient((x, h)))
    >>> expansion.holds(), limit.holds(), limit.left
    (True, True, [0, x])
    """
    entries, ends = (list(v) if isinstance(v, sp.MatrixBase | Iterable) else [v] for v in (expression, to))
    expanded = [_expanded(sp.sympify(entry, strict=True), along, order) for entry in entries]
    coefficients = [c for found, _ in expanded for c in found]
    sums = [
        sp.Add(*(c * along**k for k, c in enumerate(found)), along ** (order + 1) * rest) for found, rest in expanded
    ]
    expected = [value for end in ends for value in [*[sp.S.Zero] * order, end]]
    return Equation(f"{text}: the expansion", entries, sums, algebra), Equation(text, coefficients, expected, algebra)


def _expanded(expression: sp.Expr, along: sp.Symbol, order: int) -> tuple[list[sp.Expr], sp.Expr]:
    """The first coefficients of Taylor's series in a variable, and what the rest is divided by its power."""
    above, below = (sp.Poly(part, along) for part in sp.fraction(sp.cancel(expression)))
    start = below.nth(0)
    if start == 0:
        raise ArithmeticError(f"there is no limit: the expression has a pole where {along} is 0")
    found: list[sp.Expr] = []
    for k in range(order + 1):
        known = sum(below.nth(i) * found[k - i] for i in range(1, k + 1))
        found.append(sp.cancel((above.nth(k) - known) / start))
    left = above.as_expr() - below.as_expr() * sp.Add(*(c * along**k for k, c in enumerate(found)))
    return found, sp.cancel(left / along ** (order + 1)) / below.as_expr()
