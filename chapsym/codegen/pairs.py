"""Kernels on double-double numbers: every operation of their text is one call of `chapsym.numbers.pairs`.

Each value is a float64 or a pair of them, by its operands: a product of two floats is exact, a float with a pair saves
half the work.  Inside, the operations are the loose ones; what a program returns is normalised, and so is a divisor
before the division, and where a program says so every sum.
"""

import ast
from collections.abc import Callable, Sequence
from fractions import Fraction

from .ir import Folded, Function, Texts, numbered
from .printer import NotStraightLine
from .programs import Program

#: The module, its key in the manifest, and its first line.
FILE, KEY = "double_double.py", "pairs"
ABOUT = "The parts of a step on double-double numbers; x and x_ are the halves of x."
#: What a call costs, in float64 operations.
COST = {
    "two_sum": 6, "two_product": 2, "loose_add": 8, "loose_subtract": 8, "loose_add_float": 7, "loose_multiply": 6,
    "loose_multiply_float": 4, "divide": 19,
}  # fmt: skip


#: What adds, subtracts or multiplies: two floats, a pair and a float, two pairs.
FORMS = {
    "add": ("two_sum", "loose_add_float", "loose_add"),
    "subtract": ("", "", "loose_subtract"),
    "multiply": ("two_product", "loose_multiply_float", "loose_multiply"),
}
#: What is done to both halves.
SCALINGS = {"negative": "-{}", "add": "2 * {}", "divide": "{} / 2"}


class Printer:
    """Writes the operations of a program as calls; `lines` grows."""

    def __init__(self, floats: Sequence[str], normal: bool = False) -> None:
        self.floats, self.lines, self.normal = set(floats), list[str](), normal

    def halves(self, name: str) -> list[str]:
        """A value as arguments: the halves of a pair, or a float."""
        return [name] if name in self.floats else [name, f"{name}_"]

    def call(self, target: str, function: str, *arguments: str) -> None:
        """One line."""
        self.lines.append(f"{target}, {target}_ = {function}({', '.join(arguments)})")
        if self.normal and function in ("loose_add", "loose_subtract", "loose_add_float"):
            self.lines.append(f"{target}, {target}_ = two_sum({target}, {target}_)")

    def operation(self, target: str, operation: str, a: str, b: str = "") -> None:
        """target = a operation b."""
        first, second = self.halves(a), self.halves(b)
        if operation == "negative" or (operation == "add" and a == b) or (operation, b) == ("divide", "2"):
            self.floats |= {target} if a in self.floats else set()
            scaled = ", ".join(SCALINGS[operation].format(half) for half in first)
            self.lines.append(f"{', '.join(self.halves(target))} = {scaled}")
            return
        if operation == "divide":
            if len(second) == 2:
                self.call(f"{target}d", "two_sum", *second)
                second = [f"{target}d", f"{target}d_"]
            self.call(target, "divide", *[*first, "0"][:2], *[*second, "0"][:2])
            return
        if operation == "subtract" and len(first) + len(second) < 4:
            operation, second = "add", [f"-{half}" for half in second]
        if len(first) < len(second):  # the pair comes first
            first, second = second, first
        self.call(target, FORMS[operation][len(first) + len(second) - 2], *first, *second)


def lowered(program: Program, texts: Texts) -> list[str]:
    """The lines of the function's body, up to its return."""
    values = Folded(texts)
    outputs = numbered(program, values)
    names = dict[int, str]()
    constants = [str(x) for operation, *rest in values.nodes if operation == "constant" for x in rest]
    printer, count = Printer([*program.floats, *constants], program.normal), 0
    for number in values.needed(outputs):
        operation, *operands = values.nodes[number]
        if values.leaf(number):
            names[number] = str(operands[0])
            continue
        names[number], count = f"t{count}", count + 1
        printer.operation(names[number], operation, *(names[int(x)] for x in operands))
    for name, number in zip(program.outputs, outputs, strict=True):
        if names[number] in printer.floats:
            raise NotStraightLine(f"{program.name}: {name} is no pair")
        printer.call(f"o_{name}", "two_sum", names[number], f"{names[number]}_")
    return printer.lines


def flops(lines: Sequence[str]) -> int:
    """Float64 operations of the lines, a fused multiply-add as one."""
    return sum(COST.get(line.split(" = ")[1].split("(")[0], 2) for line in lines)


def function(program: Program, texts: Texts) -> Function:
    """The function of a program."""
    lines = lowered(program, texts)
    kinds = f"  {', '.join(program.floats)}: float64; the others are pairs." if program.floats else ""
    notes = [f"Returns {', '.join(program.outputs)} as normalised pairs.{kinds}", f"Operations: {flops(lines)}."]
    body = [*lines, f"return {', '.join(f'o_{name}, o_{name}_' for name in program.outputs)}"]
    arguments = ", ".join(name if name in program.floats else f"{name}, {name}_" for name in program.inputs)
    return Function(arguments, notes, body, {"operations": flops(lines)})


def preamble(functions: Sequence[Function]) -> list[str]:
    """What the module has before the functions."""
    calls = {line.partition(" = ")[2].partition("(")[0] for function in functions for line in function.body}
    return [f"from chapsym.numbers.pairs import {', '.join(sorted(calls & COST.keys()))}"]


def _halves(value: Fraction) -> tuple[Fraction, Fraction]:
    """A number as a pair whose halves are both large: whoever takes one for the other is far off."""
    return value * Fraction(5, 7), value * Fraction(2, 7)


def _total(*values: Fraction) -> tuple[Fraction, Fraction]:
    return _halves(Fraction(sum(values)))


#: The functions of `chapsym.numbers.pairs` that texts call, without a rounding, on fractions.
EXACT: dict[str, Callable] = {
    "two_sum": _total,
    "loose_add": _total,
    "loose_add_float": _total,
    "two_product": lambda a, b: _halves(a * b),
    "loose_subtract": lambda a, a_, b, b_: _halves(a + a_ - b - b_),
    "loose_multiply": lambda a, a_, b, b_: _halves((a + a_) * (b + b_)),
    "loose_multiply_float": lambda a, a_, b: _halves((a + a_) * b),
    "divide": lambda a, a_, b, b_: _halves(Fraction(a + a_) / (b + b_)),
}


def text_values(program: Program, text: str, at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the generated text makes of the inputs that `at` gives, with exact operations on pairs of fractions."""
    module = ast.parse(text)
    module.body = [node for node in module.body if not isinstance(node, ast.ImportFrom)]
    scope: dict = dict(EXACT)
    exec(compile(module, FILE, "exec"), scope)  # our own text, never a user's
    inputs: list[Fraction] = []
    for name in program.inputs:
        inputs += [at(name)] if name in program.floats else _halves(at(name))
    found = scope[program.name](*inputs)
    return [a + a_ for a, a_ in zip(found[::2], found[1::2], strict=True)]
