"""Limits of rational functions, as equations that exact arithmetic decides."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import sympy as sp

from chapsym.derive.quotient import Quotient, in_sympy

from .statements import Comparison, Equation, Side


@dataclass(frozen=True)
class Limit(Equation):
    """An equation for the limit of an expression as a variable tends to 0, for all values of the others."""

    along: sp.Symbol = sp.S.Zero

    def bound_by(self, assumed: Sequence[Comparison]) -> list[str]:
        """The hypotheses that may prevent the variable from tending to 0: all that contain it, except for its sign."""
        return [
            h.text
            for h in assumed
            for r in h.relations
            if r.has(self.along) and (isinstance(r, sp.Eq) or set(r.args) != {self.along, sp.S.Zero})
        ]


def tends(text: str, expression: sp.Expr, along: sp.Symbol, order: int, to: Side, ring: Quotient) -> Limit:
    """The statement that expression / along^order tends to `to` as along tends to 0.

    As an equation: the expression is along^order · (the limit) + along^(order + 1) · (a quotient), and the denominator
    of the quotient is start · (1 + along · ...), where start, a divisor, is not 0.

    Parameters
    ----------
    text : str
        The statement in words, also for the certificate.
    expression : sympy.Expr, or a matrix or list of them
        The expression, rational in `along`.
    along : sympy.Symbol
        The variable that tends to 0: a variable of the ring that is in none of its relations.
    order : int
        The power by which the expression is divided.
    to : sympy.Expr, or a matrix or list of them
        The limit.
    ring : Quotient
        The ring in which the equation is decided.

    Returns
    -------
    Equation
        The equation, with the expressions and the denominators on its left side.

    Raises
    ------
    ArithmeticError
        If the expression has a pole at along = 0.
    ValueError
        If it is not rational, or if a relation of the ring or the limit contains `along`.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient, in_sympy
    >>> from chapsym.prove import tends
    >>> x, h = sp.symbols("x h")
    >>> ring = Quotient((x, h))
    >>> one = tends("(1 - 1/(1 + hx))/h", 1 - 1 / (1 + h * x), h, 1, x, ring)
    >>> one.right[0], one.holds()
    (-h**2*x**2/(h*x + 1) + h*x, True)
    >>> tends("the same with another limit", 1 - 1 / (1 + h * x), h, 1, 2 * x, ring).holds()
    False
    """
    if bound := [relation for relation in ring.relations if relation.has(along)]:
        raise ValueError(f"{along} cannot tend to 0 by itself: the relation {bound[0]} has it")
    entries, ends = (list(v) if isinstance(v, sp.MatrixBase | Iterable) else [v] for v in (expression, to))
    if any(in_sympy(end).has(along) for end in ends):
        raise ValueError(f"what something tends to cannot have {along}, which tends to 0")
    left, right = [], []
    for entry, end in zip(entries, ends, strict=True):
        rest, below = _rest(in_sympy(entry), along, order)
        left.append(entry)
        right.append(along**order * end + along ** (order + 1) * rest / below.as_expr())
        if (start := below.nth(0)).free_symbols:
            later = sp.cancel((below.as_expr() - start) / along)
            left.append(below.as_expr() / start)
            right.append(1 + along * later / start)
    return Limit(text, left, right, ring, along)


def _rest(expression: sp.Expr, along: sp.Symbol, order: int) -> tuple[sp.Expr, sp.Poly]:
    """The numerator of the remainder after the first Taylor terms, divided by along^(order + 1), and the denominator.

    The last of these terms is part of the statement.
    """
    try:
        above, below = (sp.Poly(part, along) for part in sp.fraction(sp.cancel(expression)))
    except sp.PolynomialError:
        raise ValueError(f"{expression} is not a rational function of {along}") from None
    if (start := below.nth(0)) == 0:
        raise ArithmeticError(f"there is no limit: the expression has a pole where {along} is 0")
    found: list[sp.Expr] = []
    for k in range(order + 1):
        known = sum(below.nth(i) * found[k - i] for i in range(1, k + 1))
        found.append(sp.cancel((above.nth(k) - known) / start))
    left = above.as_expr() - below.as_expr() * sp.Add(*(c * along**k for k, c in enumerate(found)))
    return sp.cancel(left / along ** (order + 1)), below
