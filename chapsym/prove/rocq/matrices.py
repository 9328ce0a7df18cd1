"""Points whose values are matrices, as theorems about matrices of rational numbers."""

from collections.abc import Mapping
from fractions import Fraction

from .names import identifier, integer
from .quotients import Fact, Tree, denominators


class Point:
    """Numbers and matrices by name."""

    def __init__(self, values: Mapping[str, Tree]):
        self.values = values

    def is_number(self, tree: Tree) -> bool:
        """Whether no matrix is in a tree."""
        if isinstance(tree, list):
            return tree[0] == "tr" or all(map(self.is_number, tree[1:2] if tree[0] == "^" else tree[1:]))
        return not (isinstance(tree, str) and isinstance(self.values.get(tree), list))

    def size(self, tree: Tree) -> tuple[int, int]:
        """The rows and columns of a matrix."""
        if isinstance(tree, str):
            return len(self.values[tree]), len(self.values[tree][0])
        sizes = [self.size(part) for part in tree[1:] if not isinstance(part, int) and not self.is_number(part)]
        return sizes[0][0], sizes[-1][1]

    def number(self, tree: Tree) -> str:
        """A number of Q."""
        if isinstance(tree, str) and tree in self.values:
            return identifier(tree)
        if not isinstance(tree, list):
            return quotient(tree)
        if tree[0] == "^":
            return f"({self.number(tree[1])} ^ {integer(tree[2])})"
        if tree[0] == "tr":
            return f"(trace {self.matrix(tree[1], self.size(tree[1])[0])})"
        return "(" + f" {tree[0]} ".join(map(self.number, tree[1:])) + ")"

    def matrix(self, tree: Tree, rows: int) -> str:
        """A matrix; a number is that multiple of the unit matrix."""
        if self.is_number(tree):
            unit = f"unit_matrix {rows}"
            return unit if tree == 1 else f"({self.number(tree)} *: {unit})"
        if isinstance(tree, str):
            return identifier(tree)
        if tree[0] == "+":
            return "(" + " + ".join(self.matrix(part, rows) for part in tree[1:]) + ")"
        if tree[0] == "^":
            return "(" + " * ".join([self.matrix(tree[1], rows)] * tree[2]) + ")"
        numbers = [self.number(part) for part in tree[1:] if self.is_number(part)]
        matrices = [self.matrix(part, self.size(part)[0]) for part in tree[1:] if not self.is_number(part)]
        product = f"({' * '.join(matrices)})" if len(matrices) > 1 else matrices[0]
        factor = f"({' * '.join(numbers)})" if len(numbers) > 1 else "".join(numbers)
        return f"({factor} *: {product})" if numbers else product

    def equation(self, left: Tree, right: Tree) -> str:
        """left == right, of numbers or of matrices."""
        if self.is_number(left) and self.is_number(right):
            return f"({self.number(left)} == {self.number(right)})%Q"
        rows, columns = self.size(right if self.is_number(left) else left)
        sides = (f"zero_matrix {rows} {columns}" if tree == 0 else self.matrix(tree, rows) for tree in (left, right))
        return f"({' == '.join(sides)})%M"


def quotient(x: str | int) -> str:
    """A rational number, for Rocq."""
    number = Fraction(x)
    return f"({number.numerator} # {number.denominator})"


def at_point(name: str, values: Mapping[str, Tree], facts: list[Fact], transposes: list[list[Tree]]) -> str:
    """The theorem: matrices exist for which the facts and the given transposes are true."""
    point = Point(values)
    texts = [f"({point.matrix(b, len(values[a][0]))} == transposed {identifier(a)})%M" for a, b in transposes]
    for relation, sides in facts:
        numbers = denominators(tree for pair in sides for tree in pair)
        texts += [f"~ {point.equation(tree, 0)}" for tree in numbers]
        equations = " /\\ ".join(point.equation(a, b) for a, b in sides)
        texts.append(equations if relation == "=" else f"~ ({equations})")
    binders = " ".join(f"({identifier(x)} : {'matrix' if isinstance(v, list) else 'Q'})" for x, v in values.items())
    witnesses = "\n".join(f"  pose ({identifier(x)} := {_value(v)})." for x, v in values.items())
    return "\n".join([
        f"Theorem {name} : exists {binders},",
        "  " + " /\\\n  ".join(dict.fromkeys(texts)) + ".",
        f"Proof.\n{witnesses}\n  exists {', '.join(map(identifier, values))}.\n  at_this_point.\nQed.",
    ])  # fmt: skip


def _value(value: Tree) -> str:
    if isinstance(value, list):
        return "[" + "; ".join("[" + "; ".join(map(quotient, row)) + "]" for row in value) + "]"
    return quotient(value)
