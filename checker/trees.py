"""Expressions as data: a name, a number, or a list of an operation and its operands.

    "q0"    -3    "2/5"    ["+", a, b, ...]    ["*", a, b, ...]    ["^", a, k]

A number is an integer, or a quotient in lowest terms, in quotes; k is an integer other than 0.  The order of factors
matters: they need not commute.
"""

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from operator import add, mul
from typing import Any

from .interval import Rejected
from .taylor import Dual

#: An expression.
Tree = int | str | list["Tree"]
#: Limits for the trees and values of a certificate, which bound time and memory.
MOST_DEPTH, MOST_OPERANDS, MOST_POWER, MOST_BITS, MOST_BITS_OF_VALUES = 60, 20_000, 60, 1_000, 2_000
#: The form of a name, such as q0, R_+ and Omega^T; none has the form of a power.
_NAME = re.compile(r"[A-Za-z_]\w*(_[+-])?(\^[A-Za-z])?", re.ASCII)
MOST_LETTERS_OF_A_NAME = 40
_fraction = lru_cache(Fraction)
_QUOTIENT = re.compile(r"-?[1-9]\d*/[1-9]\d*", re.ASCII)


def check_name(name: object, where: str) -> None:
    """Raises Rejected unless this is a valid name of a variable: at most 40 letters and digits, such as R_+ and R^T."""
    if not isinstance(name, str) or not _is_name(name):
        raise Rejected(f"{where} has an invalid name: {name!a:.40}")


def rational(x: object, where: str) -> Fraction:
    """The number at a leaf of a tree, which must have its unique form."""
    if type(x) is int and x.bit_length() <= MOST_BITS:
        return Fraction(x)
    if isinstance(x, str) and len(x) <= MOST_BITS and _QUOTIENT.fullmatch(x):
        number = Fraction(x)
        if number.denominator > 1 and str(number) == x and bits(number) <= MOST_BITS:
            return number
    raise Rejected(f"{where} has a number that is neither an integer nor a quotient such as 2/5 in lowest terms")


def bits(x: Fraction | int) -> int:
    """The bits of the numerator or of the denominator, whichever has more."""
    return max(x.numerator.bit_length(), x.denominator.bit_length())


def plain(x: Fraction) -> Fraction | int:
    """The number, as an int if it is an integer, which is faster; only for numbers that are not divisors."""
    return x.numerator if x.denominator == 1 else x


def bounded(x: Any) -> Any:
    """The value itself; raises Rejected for a rational number, or a dual of an interval, that is too large."""
    if (kind := type(x)) is Fraction or kind is int:
        size = bits(x)
    else:
        size = (x.value.most >> x.value.bits).bit_length() if kind is Dual else 0
    if size > MOST_BITS_OF_VALUES:
        raise Rejected("the certificate has a number too large to be checked")
    return x


def check_tree(tree: object, where: str, depth: int = 0) -> None:
    """Raises Rejected unless `tree` is an expression."""
    if not isinstance(tree, list):
        if not isinstance(tree, str) or not _is_name(tree):
            rational(tree, where)
        return
    if depth >= MOST_DEPTH:
        raise Rejected(f"{where} is deeper than {MOST_DEPTH}")
    if not 3 <= len(tree) <= MOST_OPERANDS or tree[0] not in ("+", "*", "^"):
        raise Rejected(f"{where} has a list that is no sum, product or power")
    if tree[0] == "^":
        if len(tree) != 3 or type(tree[2]) is not int or not 1 <= abs(tree[2]) <= MOST_POWER:
            raise Rejected(f"{where} has a power that is no integer from 1 to {MOST_POWER} or its negative")
        tree = tree[:2]
    for part in tree[1:]:
        check_tree(part, where, depth + 1)


def check_known(trees: Sequence[Tree], names: Collection[str], where: str) -> None:
    """Raises Rejected if expressions have other names than these."""
    if other := sorted(name for name in names_in([0, *trees]) if name not in names):
        raise Rejected(f"{where} has the name {other[0]!a:.40}, which is not among its variables")


def value(tree: Tree, names: Mapping[str, Any], number: Callable[[Fraction], Any]) -> Any:
    """The value of a tree in any arithmetic with + * **; `names`: values of names; `number`: converts rational numbers.

    Raises Rejected for a name without a value: so a tree can only have names that are known in its place.
    """
    if isinstance(tree, str) and tree in names:
        return names[tree]
    if not isinstance(tree, list):
        if isinstance(tree, str) and _is_name(tree):
            raise Rejected(f"the name {tree!a:.40} has no value where it stands")
        return number(_fraction(tree))
    if tree[0] == "^":
        return bounded(value(tree[1], names, number) ** tree[2])
    return _joined(add if tree[0] == "+" else mul, [value(part, names, number) for part in tree[1:]])


def _joined(operation: Callable[[Any, Any], Any], values: list[Any]) -> Any:
    """A long sum or product, computed by halves, so that no part of it is copied often."""
    if len(values) < 3:
        return bounded(operation(*values)) if len(values) > 1 else values[0]
    half = len(values) // 2
    return bounded(operation(_joined(operation, values[:half]), _joined(operation, values[half:])))


def names_in(tree: Tree) -> set[str]:
    """The names that occur in a checked tree."""
    found, pending = set[str](), [tree]
    while pending:
        part = pending.pop()
        if isinstance(part, list):
            pending += part[1:]
        elif isinstance(part, str) and part not in found and _is_name(part):
            found.add(part)
    return found


def divisors(tree: Tree) -> set[str]:
    """The names that occur in divisors of a tree."""
    match tree:
        case ["^", of, int(power)]:
            return names_in(of) if power < 0 else divisors(of)
        case [_, *parts]:
            return set().union(*map(divisors, parts))
    return set()


def size(tree: Any) -> int:
    """The number of parts of trees and of lists of trees; a power also counts its multiplications."""
    if not isinstance(tree, list):
        return 1
    times = abs(tree[2]) if tree and tree[0] == "^" else 1
    return times + sum(map(size, tree))


def _is_name(text: str) -> bool:
    return len(text) <= MOST_LETTERS_OF_A_NAME and bool(_NAME.fullmatch(text))
