"""Derivations: expressions made step by step from premises, which the statements of a certificate may name.

A definition has a name, a text, the number of its algebra, an operation, and the operands of the operation:

written   a tree, in the letters of the algebra and in names defined before; without such names it is a premise
rate      of a name X, by [letter, tree]...: the derivative of X by Leibniz' rule, for these rates of the letters
replaced  of X, by [letter or parameter, tree]...: X with these substitutions, in the algebra of the definition
gradient  of X, by a letter Y: the G with tr X = tr(Gᵀ Y) + (terms without Y and its transpose)
dual      of X, by a letter ξ with ξᵀ = -ξ: the S = -Sᵀ with tr X = ½ tr(ξ S), so that tr X = 0 for all ξ if S = 0
having, lacking   of X, by letters: the terms of X with one of them, or with none; their sum is X
matrix, entry     X in coordinates (matrices.py)

Each definition but a matrix also has its value, a tree in the names of its algebra, for readers who skip the steps.

The checker repeats every step, each in its own algebra: a result made without a rule need not obey it.  Rates and
replacements must respect the rules and the transposes of the algebra of X.  A name is used in another algebra only if
that algebra has its letters and obeys their rules.  The texts are not checked.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

from .algebra import Algebra, about, having
from .document import Data
from .form import NUMBER, check_shape, names, once, text
from .interval import Rejected
from .matrices import Quotients, check_places, entry, placed
from .polynomial import Quotient
from .trees import Tree, check_known, check_name, check_tree, names_in
from .words import Matrix, Words

#: The most definitions of a derivation.
MOST_DEFINITIONS = 100
PAIRS, LETTER, LETTERS = ("rate", "replaced"), ("gradient", "dual"), ("having", "lacking")


class Defined(NamedTuple):
    """The value of a name: Words of an Algebra, a Matrix of Quotients or an entry; its tree, except for a matrix."""

    value: Any
    algebra: Any
    tree: Any


def check_pairs(data: Any, where: str) -> None:
    """Raises Rejected unless this is a non-empty list of pairs of a name and a tree, with no name twice."""
    check_shape(data, [(check_name, check_tree), ...], where)
    names([name for name, _ in data], where)


def check_letters(data: Any, where: str) -> None:
    """Raises Rejected unless this is a non-empty list of different names."""
    check_shape(data, [check_name, ...], where)
    names(data, where)


#: The form of the second operand ("by") of each operation.
BY = {
    "written": (),
    "rate": check_pairs,
    "replaced": check_pairs,
    "gradient": check_name,
    "dual": check_name,
    "having": check_letters,
    "lacking": check_letters,
    "matrix": check_places,
    "entry": (NUMBER, NUMBER),
}


def check_definition(data: Any, where: str) -> None:
    """Raises Rejected unless this is a step of a derivation."""
    operation = str(data.get("operation")) if isinstance(data, dict) else ""
    check_shape(operation, tuple(BY), f"the operation of {where}")
    value = {} if operation == "matrix" else {"value": check_tree}
    of = check_tree if operation == "written" else check_name
    head = {"name": check_name, "text": text, "algebra": NUMBER, "operation": str}
    check_shape(data, head | {"of": of, "by": BY[operation]} | value, where)


def values(data: Sequence[Data], algebras: Sequence[Algebra | Quotients]) -> dict[str, Defined]:
    """The value of each name of a derivation; raises Rejected for an invalid step."""
    if len(data) > MOST_DEFINITIONS:
        raise Rejected(f"the derivation has more than {MOST_DEFINITIONS} definitions")
    once([*(one["name"] for one in data), *set().union(*(algebra.names for algebra in algebras))], "the derivation")
    found: dict[str, Defined] = {}
    for one in data:
        algebra, operation, where = algebras[one["algebra"]], one["operation"], f"the definition of {one['name']}"
        match operation, None if operation == "written" else found.get(one["of"]), algebra:
            case "written", None, Algebra():
                made: Any = algebra.total([algebra.read(one["of"], named([one["of"]], algebra, found, where))])
            case "matrix", Defined(value=Words()) as of, Quotients():
                made = placed(of.tree, of.algebra, algebra, one["by"], where)
            case "entry", Defined(value=Matrix() as rows, algebra=there), Quotients() if there is algebra:
                made = entry(rows, one["by"], where)
            case _, Defined(value=Words()) as of, Algebra() if operation not in ("matrix", "entry"):
                made = _made(one, of, algebra, found, where)
            case _:
                raise Rejected(f"{where} is made from an undefined name, or in an algebra of another kind")
        if "value" in one and not algebra.is_value(one["value"], made):
            raise Rejected(f"{where} has another value than it says")
        found[one["name"]] = Defined(made, algebra, one.get("value"))
    return found


def valued(data: Sequence[Data]) -> Data:
    """The value trees by name, for the names that have one."""
    return {one["name"]: one["value"] for one in data if "value" in one}


def check_use(data: Sequence[Data], trees: Sequence[Tree]) -> None:
    """Raises Rejected if a definition is used neither in these trees nor, indirectly, by a definition that is."""
    known = used(data, trees)
    for one in data:
        if one["name"] not in known:
            raise Rejected(f"the definition of {one['name']} is not used")


def used(data: Sequence[Data], trees: Sequence[Tree]) -> set[str]:
    """The names in trees and, recursively, in the definitions of these names."""
    found = names_in([0, *trees])
    for one in reversed(data):
        if one["name"] in found:
            found |= names_in([0, one["of"]])
            if one["operation"] in PAIRS:
                found |= names_in([0, *(tree for _, tree in one["by"])])
    return found


def named(trees: Sequence[Tree], algebra: Algebra, defined: Mapping[str, Defined], where: str) -> dict[str, Words]:
    """The names of an algebra and the defined names in the trees, each with its words in that algebra."""
    used = ((name, defined[name]) for name in sorted(names_in([0, *trees]) & defined.keys()))
    brought = {name: _brought(of, algebra, where) for name, of in used if isinstance(of.value, Words)}
    return {**algebra.names, **brought}


def entries(trees: Sequence[Tree], defined: Mapping[str, Defined]) -> dict[str, Quotient]:
    """The values of the defined names in some trees that are entries of matrices."""
    used = ((name, defined[name].value) for name in names_in([0, *trees]) & defined.keys())
    return {name: value for name, value in used if isinstance(value, Quotient)}


def _brought(of: Defined, algebra: Algebra, where: str) -> Words:
    """The words in another algebra, which must have their names and obey the rules for shared letters."""
    if of.algebra is algebra:
        return of.value
    if of.algebra not in algebra.respected:
        shared = of.algebra.names.keys() & algebra.names.keys()
        for name in shared:
            if (name in of.algebra.letters) is not (name in algebra.letters):
                raise Rejected(f"{where} has {name} as a number in one algebra and as a matrix in another")
        _respects(of.algebra, shared, algebra, algebra.names, where)
        algebra.respected.append(of.algebra)
    return _image(of, algebra, algebra.names)


def _made(one: Data, of: Defined, algebra: Algebra, found: Mapping[str, Defined], where: str) -> Words:
    """The words that a definition makes from words."""
    operation, by = one["operation"], one["by"]
    if operation == "replaced":
        images = _places(by, of.algebra.names, algebra, found, where)
        if nothing := sorted(name for name in images.keys() & of.algebra.divisors if not images[name].terms):
            raise Rejected(f"{where} replaces {nothing[0]}, by which something is divided, by 0")
        images = {name: word for name, word in algebra.names.items() if name in of.algebra.names} | images
        if any(images[name].letters() for name in of.algebra.parameters if name in images):
            raise Rejected(f"{where} has a matrix in the place of a number")
        _respects(of.algebra, of.algebra.names, algebra, images, where)
        return _image(of, algebra, images)
    if of.algebra is not algebra:
        raise Rejected(f"{where} is in another algebra than what it is made from")
    if operation == "rate":
        rates = _places(by, algebra.letters, algebra, found, where)
        _respects_as_rates(algebra, rates, where)
        return algebra.rate(of.value, rates)
    if operation in LETTERS:
        check_known(by, algebra.letters, where)
        return having(of.value, by, without=operation == "lacking")
    return algebra.gradient(of.value, by) if operation == "gradient" else algebra.dual(of.value, by)


def _places(
    by: Sequence[tuple[str, Tree]], known: Collection[str], algebra: Algebra, found: Mapping[str, Defined], where: str
) -> dict[str, Words]:
    """The substitutes for known names, or their rates."""
    check_known([name for name, _ in by], known, where)
    names = named([tree for _, tree in by], algebra, found, where)
    return {name: algebra.read(tree, names) for name, tree in by}


def _image(of: Defined, algebra: Algebra, images: Mapping[str, Words]) -> Words:
    """The words with `images` substituted for letters and parameters."""
    algebra.divisors |= algebra.among(images[name] for name in of.algebra.divisors & images.keys())
    return algebra.total([algebra.read(of.tree, images)])


def _respects(
    source: Algebra, names: Collection[str], algebra: Algebra, images: Mapping[str, Words], where: str
) -> None:
    """Raises Rejected unless the images of some names satisfy the rules and transposes among these names."""
    rules, transposes = about(source.data, names, where)
    read = partial(algebra.read, names=images)
    _check_equal(
        [(RULE.format(a, b), read(["*", a, b]), read(c)) for a, b, c in rules]
        + [(TURNED.format(x), read(t), algebra.transposed(read(x))) for x, t in transposes],
        algebra, where,
    )  # fmt: skip


def _respects_as_rates(algebra: Algebra, rates: Mapping[str, Words], where: str) -> None:
    """Raises Rejected unless the rates are compatible with the rules and transposes among their letters."""
    rules, transposes = about(algebra.data, rates, where)

    def rate(tree: Tree) -> Words:
        return algebra.rate(algebra.read(tree, algebra.names), rates)

    _check_equal(
        [(RULE.format(a, b), rate(["*", a, b]), rate(c)) for a, b, c in rules]
        + [(TURNED.format(x), rate(t), algebra.transposed(rates[x])) for x, t in transposes],
        algebra, where,
    )  # fmt: skip


RULE, TURNED = "respect the rule for {} {}", "do to the transpose of {0} what it does to {0}"


def _check_equal(pairs: Sequence[tuple[str, Words, Words]], algebra: Algebra, where: str) -> None:
    """Raises Rejected unless the two sides of each pair are equal."""
    for what, made, claimed in pairs:
        if algebra.total([made - claimed]).terms:
            raise Rejected(f"{where} does not {what}")
