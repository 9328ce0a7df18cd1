"""What a certificate of kind register-claim says, to be read: each tree as a formula, in plain text."""

from collections.abc import Iterator
from typing import Any

from .derivation import LETTER, LETTERS


def formula(tree: Any, inside: str = "+") -> str:
    """A tree as text; in brackets where it stands in a product or under a power and needs them."""
    if not isinstance(tree, list):
        text = str(tree)
        return f"({text})" if inside != "+" and (text.startswith("-") or ("/" in text and inside == "^")) else text
    if tree[0] == "^":
        power = tree[2] if tree[2] > 0 else f"({tree[2]})"
        text = f"{formula(tree[1], '^')}^{power}"
        return f"({text})" if inside == "^" else text
    if tree[0] == "*":
        text = "·".join(formula(part, "*") for part in (tree[2:] if tree[1] == -1 else tree[1:]))
        text, level = (f"-{text}", 0) if tree[1] == -1 else (text, 1)
    else:
        first, *rest = map(formula, tree[1:])
        text, level = first + "".join(f" - {x[1:]}" if x.startswith("-") else f" + {x}" for x in rest), 0
    return f"({text})" if level < {"+": 0, "*": 1, "^": 2}[inside] else text


def definition(one: dict[str, Any]) -> str:
    """A step of a derivation."""
    operation, of, by = one["operation"], one["of"], one["by"]
    if operation == "written":
        return f"{one['name']} = {formula(of)}"
    if operation in LETTER:
        by = f" by {by}"
    elif operation in LETTERS:
        return f"{one['name']} = terms of {of} {operation} {' and '.join(by)}"
    elif operation == "entry":
        by = f" {by[0] + 1}, {by[1] + 1}"
    elif operation == "matrix":
        by = f" with matrices for {', '.join(name for name, _ in by[0])}"
    else:
        sign = "→" if operation == "replaced" else "has the rate"
        by = " where " + ", ".join(f"{name} {sign} {formula(tree)}" for name, tree in by)
    return f"{one['name']} = {operation} of {of}{by}"


def lines(data: dict[str, Any]) -> Iterator[str]:
    """Every premise, step and statement of a certificate that was accepted."""
    for one in data["derivation"]:
        yield f"{definition(one)}    [{one['text']}]"
    for one in data["statements"]:
        algebra = data["algebras"][one["algebra"]]
        sign = "=" if "refuted" not in one else "≠"
        traces = "the traces of " if algebra["kind"] == "traces" else ""
        yield f"{one['role']}: {one['text']}"
        for left, right in zip(one["left"], one["right"], strict=True):
            yield f"    {traces}{formula(left)} {sign} {formula(right)}"
        if algebra["kind"] == "quotient" and algebra["relations"]:
            yield "    where " + ", ".join(f"{formula(relation)} = 0" for relation in algebra["relations"])
        elif algebra["kind"] != "quotient" and algebra["rules"]:
            yield "    where " + ", ".join(f"{a}·{b} = {formula(image)}" for a, b, image in algebra["rules"])
