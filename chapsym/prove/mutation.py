"""False variants of a statement, generated automatically."""

from collections.abc import Iterator

import sympy as sp

from .statements import Equation


def mutations(statement: Equation, most: int = 4) -> list[Equation]:
    """Variants of an equation with the sign of one term of the right side changed: negative controls.

    Parameters
    ----------
    statement : Equation
        The equation; the terms are those of the sums and products of its right side, as written.
    most : int, optional
        The largest number of variants.

    Returns
    -------
    list of Equation
        Statements for `Proof.control`.  A term that is zero in the algebra is unchanged, as the variant would be true.

    Raises
    ------
    ValueError
        If no term can be changed.

    Examples
    --------
    >>> import sympy as sp
    >>> from chapsym.derive import Quotient
    >>> from chapsym.prove import equations, mutations
    >>> x, y = sp.symbols("x y")
    >>> equal = equations(Quotient((x, y)))
    >>> for one in mutations(equal("a square", (x + y) ** 2, x**2 + 2 * x * y + y**2)):
    ...     print(one.text, one.right, one.holds())
    a square, with the sign of x**2 turned [-x**2 + 2*x*y + y**2] False
    a square, with the sign of y**2 turned [x**2 + 2*x*y - y**2] False
    a square, with the sign of 2*x*y turned [x**2 - 2*x*y + y**2] False
    """
    right, found = statement.right, list[Equation]()
    for i, entry in enumerate(right):
        for term, turned in _turned(entry):
            if len(found) < most and not statement.algebra.is_zero(entry - turned):
                text = f"{statement.text}, with the sign of {term} turned"
                one = Equation(text, statement.left, [*right[:i], turned, *right[i + 1 :]], statement.algebra)
                found += [] if one.holds() else [one]  # a variant of a false statement may be true
    if not found:
        raise ValueError(f"no term of the right side of «{statement.text}» can be turned: give a false variant")
    return found


def _turned(expression: sp.Expr) -> Iterator[tuple[sp.Expr, sp.Expr]]:
    """Each term of the sums in an expression, and the expression with the sign of that term changed."""
    if not isinstance(expression, sp.Add):
        yield expression, -expression
        return
    for term in expression.args:
        yield term, expression - 2 * term
    for term in expression.args:
        for i, factor in enumerate(term.args if isinstance(term, sp.Mul) else ()):
            if isinstance(factor, sp.Add):
                for inner, turned in _turned(factor):
                    yield inner, expression - term + sp.Mul(*term.args[:i], turned, *term.args[i + 1 :])
