"""Statements in quotient rings, and their points, as theorems about every field of characteristic 0."""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from functools import reduce
from math import prod
from typing import Any

from .names import identifier, integer

#: An expression as the checker reads it; and an object of a certificate, with such expressions.
Tree = Any
Data = dict[str, Any]
#: The identifier of each variable, and its number from 1 on.
Variables = Mapping[str, tuple[str, int]]


def variables(names: Iterable[str]) -> dict[str, tuple[str, int]]:
    """The variables of an algebra."""
    return {name: (identifier(name), i) for i, name in enumerate(names, 1)}


def both(tree: Tree, names: Variables) -> tuple[str, str]:
    """An expression for a reader, in parentheses unless it is one name or number; and as data of type tree."""
    if isinstance(tree, str) and tree in names:
        return names[tree][0], f"(Var {names[tree][1]})"
    if not isinstance(tree, list):
        above, below = integer(Fraction(tree).numerator), Fraction(tree).denominator
        return (f"#{above}", f"(Int {above})") if below == 1 else (f"(#{above} / #{below})", f"(Rat {above} {below})")
    if tree[0] == "^":
        (text, of), power = both(tree[1], names), abs(tree[2])
        text, of = (text, of) if power == 1 else (f"({text} ^ {power})", f"(Pow {of} {power})")
        return (text, of) if tree[2] > 0 else (f"(/ {text})", f"(Inv {of})")
    return joined(*{"+": ("+", "Sum"), "*": ("*", "Prod")}[tree[0]], (both(part, names) for part in tree[1:]))


def joined(sign: str, operation: str, parts: Iterable[tuple[str, str]]) -> tuple[str, str]:
    """A sum or a product for a reader and as data."""
    texts, data = zip(*parts, strict=True)
    whole = f" {sign} ".join(texts)
    return f"({whole})" if len(texts) > 1 else whole, reduce(lambda a, b: f"({operation} {a} {b})", data)


def written(tree: Tree, names: Variables) -> str:
    """An expression, for a reader."""
    return both(tree, names)[0]


def data(tree: Tree, names: Variables) -> str:
    """An expression, as data of type tree."""
    return both(tree, names)[1]


def equation(left: Tree, right: Tree, names: Variables) -> str:
    """The equation left = right, for Rocq."""
    return f"{written(left, names)} = {written(right, names)} :> Field"


def names_in(tree: Tree) -> set[str]:
    """The names in a tree."""
    if isinstance(tree, list):
        return set().union(*map(names_in, tree[1:]))
    return {tree} if isinstance(tree, str) and tree[0] not in "-0123456789" else set()


def denominators(trees: Iterable[Tree]) -> list[Tree]:
    """The denominators that must not be 0 in these expressions, each once."""
    found: dict[str, Tree] = {}

    def below(tree: Tree, inverted: bool) -> None:
        if not isinstance(tree, list):
            if inverted and names_in(tree):
                found.setdefault(repr(tree), tree)
            return
        if tree[0] == "^":
            if inverted and tree[2] < 0:
                found.setdefault(repr(tree[1]), tree[1])
            below(tree[1], inverted != (tree[2] < 0))
            return
        if inverted and tree[0] == "+":
            found.setdefault(repr(tree), tree)
        for part in tree[1:]:
            below(part, inverted and tree[0] == "*")

    for tree in trees:
        below(tree, False)
    return list(found.values())


def conjunction(parts: list[str]) -> str:
    """A conjunction, with a line for each part."""
    return " /\\\n  ".join(parts)


def listed(parts: Iterable[str]) -> str:
    """A list, with a line for each item."""
    return "[" + ";\n    ".join(parts) + "]"


def value(tree: Tree, point: Mapping[str, Tree]) -> Fraction:
    """The value of an expression at rational numbers."""
    if not isinstance(tree, list):
        return Fraction(point.get(tree, tree))
    if tree[0] == "^":
        return value(tree[1], point) ** tree[2]
    parts = [value(part, point) for part in tree[1:]]
    return sum(parts, Fraction(0)) if tree[0] == "+" else prod(parts, start=Fraction(1))


def trees_of(one: Mapping[str, Tree]) -> list[Tree]:
    """All expressions of a statement: both sides, and the values of names."""
    return [*one["left"], *one["right"], *(tree for _, tree in one.get("definitions", []))]


def statement(name: str, one: Data, algebra: Data) -> str:
    """The theorem: the equations hold where the relations hold and no denominator vanishes; names have their values."""
    definitions = one.get("definitions", [])
    names = variables([*algebra["variables"], *(name for name, _ in definitions)])
    known = denominators(trees_of(one))
    hypotheses = [f"{written(r, names)} = zero ->" for r in algebra["relations"]]
    hypotheses += [f"{equation(name, tree, names)} ->" for name, tree in definitions]
    hypotheses += [f"{written(t, names)} <> zero :> Field ->" for t in known]
    equations = [equation(a, b, names) for a, b in zip(one["left"], one["right"], strict=True)]
    entries = [
        f"({data(a, names)}, {data(b, names)}, {listed(data(c, names) for c in cofactors)})"
        for a, b, cofactors in zip(one["left"], one["right"], one["cofactors"], strict=True)
    ]
    all_names = " ".join(identifier for identifier, _ in names.values())
    relations, nonzero = (listed(data(t, names) for t in trees) for trees in (algebra["relations"], known))
    defined = listed(f"({names[name][1]}%positive, {data(tree, names)})" for name, tree in definitions)
    return "\n".join([
        f"Theorem {name} : forall (Field : field) ({all_names} : Field),",
        *(f"  {hypothesis}" for hypothesis in hypotheses),
        f"  {conjunction(equations)}.",
        f"Proof.\n  intros Field {all_names}.",
        f"  exact (identity Field [{all_names.replace(' ', '; ')}]",
        f"    {relations}\n    {defined}\n    {nonzero}\n    {listed(entries)}",
        "    ltac:(vm_cast_no_check (eq_refl true))).\nQed.",
    ])  # fmt: skip


Fact = tuple[str, list[tuple[Tree, Tree]]]


def at_point(name: str, point: Mapping[str, Tree], facts: list[Fact]) -> str:
    """The theorem: numbers exist for which the facts ("=" all sides agree, "<>" not all do) are true."""
    names = variables(point)
    texts, trees = [], []
    for relation, sides in facts:
        equations = [equation(a, b, names) for a, b in sides]
        pairs = listed(f"({data(a, names)}, {data(b, names)})" for a, b in sides)
        negation, kind = ("", "Equal") if relation == "=" else ("~ ", "Unequal")
        texts.append(f"{negation}({conjunction(equations)})")
        trees.append(f"{kind} {pairs}")
    values = [Fraction(x) for x in point.values()]
    rationals = "; ".join(f"Qmake {integer(x.numerator)} {x.denominator}" for x in values)
    all_names = " ".join(identifier for identifier, _ in names.values())
    return "\n".join([
        f"Theorem {name} : forall Field : field, exists {all_names} : Field,",
        f"  {conjunction(texts)}.",
        f"Proof.\n  intros Field.\n  exact (some_point Field [{rationals}]\n    {listed(trees)}",
        "    ltac:(vm_cast_no_check (eq_refl true))).\nQed.",
    ])  # fmt: skip
