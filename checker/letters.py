"""Letters of a kernel: its names for the sine, cosine or square root of an expression, or for π.

The checker uses only the relations sin² + cos² = 1, for equal arguments, and √x² = x.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from .form import anything, check_shape, names
from .interval import Rejected
from .polynomial import Quotient, Ring
from .rational import rate, with_powers
from .trees import check_known, check_name, check_tree, value

FUNCTIONS = ("sin", "cos", "sqrt", "pi")
#: The module from which a text imports the functions.
MODULE = "chapsym.numbers.functions"
LETTERS = [(check_name, FUNCTIONS, anything)]


class Letter(NamedTuple):
    """A letter, its function, and the argument, which is 1 for π."""

    name: str
    function: str
    of: Quotient


def check_form(rows: Any, inputs: Sequence[str], where: str) -> list[str]:
    """The names of the letters; raises Rejected unless each row is [name, function, tree]."""
    check_shape(rows, LETTERS, f"a letter of {where}")
    known = list(inputs)
    for name, _, tree in rows:
        try:
            check_tree(tree, where)
            check_known([tree], known, where)
        except Rejected:
            raise Rejected(f"{where} has a letter {name!a:.40} for an expression with unknown names") from None
        known.append(name)
    names(known, where)
    return known[len(inputs) :]


def read(rows: Sequence[Any], ring: Ring, where: str) -> list[Letter]:
    """The letters in a ring that has them as variables; raises Rejected if two have the same meaning."""
    found = list[Letter]()
    for name, function, tree in rows:
        one = Letter(name, function, value(tree, ring.names(), ring.number))
        if twin := [x for x in found if x.function == function and not (x.of - one.of).numerator.terms]:
            raise Rejected(f"{where} has the letters {twin[0].name} and {name} for one thing")
        found.append(one)
    return found


def relations(letters: Sequence[Letter], ring: Ring) -> list[Quotient]:
    """The relations of the letters, as polynomials that vanish."""
    found = []
    for letter in letters:
        if (square := _square(letter, letters, ring)) is not None:
            found.append(Quotient((ring.names()[letter.name] ** 2 - square).numerator, 1, {}))
    return found


def follows(relation: Quotient, letters: Sequence[Letter]) -> bool:
    """Whether a relation has no letter, or is 0 by the relations of the letters."""
    ring = relation.numerator.ring
    if not any(rate(relation, {x.name: ring.number(Fraction(1))}).numerator.terms for x in letters):
        return True
    for letter in reversed(letters):  # its argument may have earlier letters
        square = _square(letter, letters, ring)

        def power(name: str, n: int, letter: Letter = letter, square: Quotient | None = square) -> Quotient:
            own = ring.names()[name]
            return own**n if name != letter.name or square is None else own ** (n % 2) * square ** (n // 2)

        relation = with_powers(relation.numerator, power)
    return not relation.numerator.terms


def check_point(letters: Sequence[Letter], point: Mapping[str, Fraction], where: str) -> None:
    """Raises Rejected if a square root is negative at a point."""
    if negative := [x.name for x in letters if x.function == "sqrt" and point[x.name] < 0]:
        raise Rejected(f"{where} has a point at which the root {negative[0]} is negative")


def check_moves(letters: Sequence[Letter], moves: Sequence[Mapping[str, Quotient]], where: str) -> None:
    """Raises Rejected if the rate of a letter is not the derivative of its function, for these rates of variables."""
    for move in moves:
        for letter in letters:
            ring = letter.of.numerator.ring
            own, zero = ring.names()[letter.name], ring.number(Fraction(0))
            inner, found = rate(letter.of, move), move.get(letter.name, zero)
            if letter.function == "sqrt":
                wrong = own * found + own * found - inner
            elif letter.function == "pi" or not inner.numerator.terms:
                wrong = found
            elif (other := _other(letter, letters)) is None:
                raise Rejected(f"{where} moves the letter {letter.name}, whose derivative is no letter")
            else:
                slope = ring.names()[other.name] * inner
                wrong = found - slope if letter.function == "sin" else found + slope
            if wrong.numerator.terms:
                raise Rejected(f"{where} moves the letter {letter.name} at another rate than its expression")


def imported(node: ast.stmt, where: str) -> set[str]:
    """The functions that a text imports; raises Rejected for any other statement."""
    names = node.names if isinstance(node, ast.ImportFrom) and (node.module, node.level) == (MODULE, 0) else []
    if names and all(one.name in FUNCTIONS and one.asname is None for one in names):
        return {one.name for one in names}
    raise Rejected(f"{where} has more than a docstring, functions of {MODULE} and one function")


def check_names(function: ast.FunctionDef, known: set[str], where: str) -> None:
    """Raises Rejected if a function calls a name that is not imported, or uses a name of FUNCTIONS otherwise."""
    if function.name in FUNCTIONS:
        raise Rejected(f"{where} has {function.name} as a name of something else")
    for node in ast.walk(function):
        if isinstance(node, ast.Call) and not (isinstance(node.func, ast.Name) and node.func.id in known):
            raise Rejected(f"{where} calls what it does not import")
        if isinstance(node, ast.Call) and (node.keywords or any(isinstance(x, ast.Starred) for x in node.args)):
            raise Rejected(f"{where} has a call that is none of numbers")
        stored = isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load)
        name = node.arg if isinstance(node, ast.arg) else node.id if isinstance(node, ast.Name) and stored else ""
        if name in FUNCTIONS:
            raise Rejected(f"{where} has {name} as a name of something else")


def _square(letter: Letter, letters: Sequence[Letter], ring: Ring) -> Quotient | None:
    """The square of a letter in other letters: of a root; of a cosine, if its sine is a letter, too; else None."""
    if letter.function == "sqrt":
        return letter.of
    if letter.function == "cos" and (other := _other(letter, letters)) is not None:
        return ring.number(Fraction(1)) - ring.names()[other.name] ** 2
    return None


def _other(letter: Letter, letters: Sequence[Letter]) -> Letter | None:
    """The letter for the cosine with the argument of a sine, or the reverse."""
    function = {"sin": "cos", "cos": "sin"}.get(letter.function)
    same = (x for x in letters if x.function == function and not (x.of - letter.of).numerator.terms)
    return next(same, None)
