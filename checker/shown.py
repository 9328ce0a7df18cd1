"""The contents of a certificate of kind register-claim as plain text, with each tree as a formula."""

from collections.abc import Iterator
from typing import Any

from .derivation import LETTER, LETTERS
from .document import Data
from .trees import Tree


def formula(tree: Tree, inside: str = "+") -> str:
    """A tree as text; `inside`: the operation around it, which may need brackets."""
    if not isinstance(tree, list):
        text = str(tree)
        return f"({text})" if inside != "+" and (text.startswith("-") or ("/" in text and inside == "^")) else text
    if tree[0] == "^":
        power = str(tree[2])
        text = f"{formula(tree[1], '^')}^{f'({power})' if power.startswith('-') else power}"
        return f"({text})" if inside == "^" else text
    if tree[0] == "*":
        text = "·".join(formula(part, "*") for part in (tree[2:] if tree[1] == -1 else tree[1:]))
        text, level = (f"-{text}", 0) if tree[1] == -1 else (text, 1)
    else:
        first, *rest = map(formula, tree[1:])
        text, level = first + "".join(f" - {x[1:]}" if x.startswith("-") else f" + {x}" for x in rest), 0
    return f"({text})" if level < {"+": 0, "*": 1, "^": 2}[inside] else text


def definition(one: Data) -> str:
    """A step of a derivation, as text."""
    operation, of, by = one["operation"], one["of"], one["by"]
    if operation == "written":
        return f"{one['name']} = {formula(of)}"
    if operation in LETTERS:
        return f"{one['name']} = terms of {of} {operation} {' or '.join(by)}"
    if operation in LETTER:
        by = f" by {by}"
    elif operation == "entry":
        by = f" in row {by[0] + 1}, column {by[1] + 1}"
    elif operation == "matrix":
        by = " where " + ", ".join(f"{name} is {_place(place)}" for name, place in by[0])
    else:
        sign = "→" if operation == "replaced" else "has the rate"
        by = " where " + ", ".join(f"{name} {sign} {formula(tree)}" for name, tree in by)
    return f"{one['name']} = {operation} of {of}{by}"


def _place(place: Any) -> str:
    if isinstance(place, list) and place and isinstance(place[0], list):
        return "[" + "; ".join(", ".join(map(formula, row)) for row in place) + "]"
    return formula(place)


def assumed(algebra: Data) -> str:
    """The assumptions of an algebra, as text: its relations, or its rules and transposes."""
    if algebra["kind"] == "quotient":
        return ", ".join(f"{formula(relation)} = 0" for relation in algebra["relations"])
    transposes = [f"{letter} transposed = {formula(image)}" for letter, image in algebra["transposes"]]
    return ", ".join([f"{a}·{b} = {formula(image)}" for a, b, image in algebra["rules"]] + transposes)


def lines(data: Data, parts: bool = True) -> Iterator[str]:
    """Every premise, step, statement and counterexample of an accepted certificate; `parts`: definitions, too."""
    for i, algebra in enumerate(data["algebras"]):
        yield f"algebra {i} ({algebra['kind']}): {assumed(algebra) or 'nothing is assumed'}"
    for one in data["derivation"]:
        yield f"{definition(one)}    [{one['text']}; in algebra {one['algebra']}]"
        if "value" in one and one["operation"] != "written":
            yield f"    = {formula(one['value'])}"
    for one in data["statements"]:
        algebra = data["algebras"][one["algebra"]]
        traces = "the traces of " if algebra["kind"] == "traces" else ""
        false = f", not all of these, at counterexample {one['refuted']}" if "refuted" in one else ""
        words = ", which only words of the formula say" if one.get("words") else ""
        yield f"{one['role']}: {one['text']}    [in algebra {one['algebra']}{false}{words}]"
        definitions = one.get("definitions", ())
        if definitions and not parts:
            yield f"    with {len(definitions)} names for parts, which checker --show prints"
        for name, tree in definitions if parts else ():
            yield f"    {name} is {formula(tree)}"
        for left, right in zip(one["left"], one["right"], strict=True):
            yield f"    {traces}{formula(left)} = {formula(right)}"
    for one in data["counts"]:
        at = "".join(f", {name} = {_place(value)}" for name, value in data["points"][one["point"]].items())
        yield f"{one['role']}: {one['text']}    [solutions ({' : '.join(one['unknowns'])}){at}]"
        yield "    " + ", ".join(f"{formula(tree)} = 0" for tree in one["equations"])
        yield from (f"    at none {formula(tree)} = 0" for tree in one["nonzero"])
        said = " and ".join(f"{formula(a)} {relation} {formula(b)}" for relation, a, b in one["relations"])
        yield f"    {said}" if one["holds"] else f"    false: {said}"
    for part in ("comparisons", "hypotheses"):
        for one in data[part]:
            yield f"{part[:-1]}{', which fails' if 'refuted' in one else ''}: {one['text']}"
            yield from (f"    {formula(a)} {relation} {formula(b)}" for relation, a, b in one["relations"])
    for one in data["zeros"]:
        at = ", ".join(f"{name} = {data['points'][one['point']][name]}" for name in one["unknowns"])
        yield f"{one['role']}: {one['text']}    [one solution within {one['radius']} of {at}]"
        yield from (f"    {name} is {formula(tree)}" for name, tree in (one["definitions"] if parts else ()))
        yield from (f"    {formula(tree)} = 0" for tree in one["equations"])
        yield from (f"    and there {formula(tree)} ≠ 0" for tree in one["nonzero"])
    for one in data["rests"]:
        yield f"{one['role']}: {one['text']}    [by the certificate {one['certificate']}]"
    for i, one in enumerate(data["counterexamples"]):
        yield f"counterexample {i}: " + ", ".join(f"{name} = {_place(value)}" for name, value in one["point"].items())
        for hypothesis in one["hypotheses"]:
            for left, right in zip(hypothesis["left"], hypothesis["right"], strict=True):
                yield f"    with {formula(left)} = {formula(right)}    [{hypothesis['text']}]"
