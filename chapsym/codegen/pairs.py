"""Kernels on double-double numbers: every operation of their text is one call of `chapsym.numbers.pairs`.

Each value is a float64 or a
pair of them, by its operands: a product of two floats is exact, a float beside a pair saves half the work.  Inside, the
operations are the loose ones; what a program returns is normalised, and so is a divisor before the division, and where
a program says so every sum.
"""

import ast
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache

from .ir import Folded, Function, Texts, numbered
from .printer import NotStraightLine
from .programs import PAIR_PROGRAMS, Program

#: The module, its key in the manifest, and what it says of itself.
FILE, KEY = "double_double.py", "pairs"
ABOUT = "The parts of a step on double-double numbers; x and x_ are the halves of x."
PROGRAMS = PAIR_PROGRAMS
#: What a call costs, in float64 operations.
COST = {
    "two_sum": 6, "two_product": 2, "loose_add": 8, "loose_subtract": 8, "loose_add_float": 7, "loose_multiply": 6,
    "loose_multiply_float": 4, "divide": 19,
}  # fmt: skip


class Printer:
    """Writes the operations of a program as calls; `lines` grows."""

    def __init__(self, floats: Sequence[str], normal: bool = False) -> None:
        self.floats, self.lines, self.normal = set(floats), list[str](), normal

    def pair(self, name: str) -> str:
        """The two halves of a value as arguments."""
        return f"{name}, {self.low(name)}"

    def low(self, name: str) -> str:
        """The second half of a value; 0 for a float."""
        return "0" if name in self.floats else f"{name}_"

    def call(self, target: str, function: str, *arguments: str) -> None:
        """One line."""
        self.lines.append(f"{target}, {target}_ = {function}({', '.join(arguments)})")
        if self.normal and function in ("loose_add", "loose_subtract", "loose_add_float"):
            self.lines.append(f"{target}, {target}_ = two_sum({self.pair(target)})")

    def operation(self, target: str, operation: str, a: str, b: str = "") -> None:
        """target = a operation b."""
        few = [x for x in (a, b) if x in self.floats]
        if operation == "negative" or (operation == "add" and a == b) or (operation, b) == ("divide", "2"):
            sign, rest = {"negative": ("-", ""), "add": ("2 * ", ""), "divide": ("", " / 2")}[operation]
            halves = [a] if a in self.floats else [a, f"{a}_"]
            self.floats |= {target} if a in self.floats else set()
            self.lines.append(
                f"{', '.join(h.replace(a, target, 1) for h in halves)} = {', '.join(sign + h + rest for h in halves)}"
            )
        elif operation == "divide":
            if b not in self.floats:
                self.call(f"{target}d", "two_sum", b, f"{b}_")
            self.call(target, "divide", self.pair(a), f"{target}d, {target}d_" if b not in self.floats else f"{b}, 0")
        elif operation == "multiply":
            self._scaled(target, "two_product", "loose_multiply_float", "loose_multiply", a, b)
        elif operation == "add":
            self._scaled(target, "two_sum", "loose_add_float", "loose_add", a, b)
        elif not few:
            self.call(target, "loose_subtract", self.pair(a), self.pair(b))
        elif b in few:
            exact = a in self.floats
            self.call(target, *(("two_sum", a, f"-{b}") if exact else ("loose_add_float", self.pair(a), f"-{b}")))
        else:
            self.call(target, "loose_add_float", f"-{b}", f"-{b}_", a)

    def _scaled(self, target: str, exact: str, mixed: str, full: str, a: str, b: str) -> None:
        """A commutative operation, by the kinds of its operands."""
        if a in self.floats and b in self.floats:
            self.call(target, exact, a, b)
        elif a in self.floats or b in self.floats:
            x, y = (b, a) if a in self.floats else (a, b)
            self.call(target, mixed, self.pair(x), y)
        else:
            self.call(target, full, self.pair(a), self.pair(b))


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


def arguments(program: Program) -> str:
    """The parameters: both halves of a pair, one of a float."""
    return ", ".join(name if name in program.floats else f"{name}, {name}_" for name in program.inputs)


def function(program: Program, texts: Texts) -> Function:
    """The function of a program."""
    lines = lowered(program, texts)
    kinds = f"  {', '.join(program.floats)}: float64; the others are pairs." if program.floats else ""
    notes = [f"Returns {', '.join(program.outputs)} as normalised pairs.{kinds}", f"Operations: {flops(lines)}."]
    body = [*lines, f"return {', '.join(f'o_{name}, o_{name}_' for name in program.outputs)}"]
    facts = {"floats": list(program.floats), "operations": flops(lines)}
    return Function(arguments(program), notes, body, facts)


def preamble(functions: Sequence[Function]) -> list[str]:
    """What the module has before the functions."""
    calls = {line.partition(" = ")[2].partition("(")[0] for function in functions for line in function.body}
    return [f"from chapsym.numbers.pairs import {', '.join(sorted(calls & COST.keys()))}"]


def _halves(value: Fraction) -> tuple[Fraction, Fraction]:
    """A number as a pair whose halves are both large: whoever takes one for the other is far off."""
    return value * Fraction(5, 7), value * Fraction(2, 7)


@cache
def exact_pairs() -> dict[str, Callable]:
    """The functions of `chapsym.numbers.pairs` that texts call, without a rounding, on fractions."""
    return {
        "two_sum": lambda a, b: _halves(a + b),
        "two_product": lambda a, b: _halves(a * b),
        "loose_add": lambda a, a_, b, b_: _halves(a + a_ + b + b_),
        "loose_subtract": lambda a, a_, b, b_: _halves(a + a_ - b - b_),
        "loose_add_float": lambda a, a_, b: _halves(a + a_ + b),
        "loose_multiply": lambda a, a_, b, b_: _halves((a + a_) * (b + b_)),
        "loose_multiply_float": lambda a, a_, b: _halves((a + a_) * b),
        "divide": lambda a, a_, b, b_: _halves(Fraction(a + a_) / (b + b_)),
    }


def text_values(program: Program, text: str, at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the generated text makes of the inputs that `at` gives, with exact operations on pairs of fractions."""
    module = ast.parse(text)
    module.body = [node for node in module.body if not isinstance(node, ast.ImportFrom)]
    scope: dict = dict(exact_pairs())
    exec(compile(module, FILE, "exec"), scope)  # our own text, never a user's
    inputs: list[Fraction] = []
    for name in program.inputs:
        inputs += [at(name)] if name in program.floats else _halves(at(name))
    found = scope[program.name](*inputs)
    return [a + a_ for a, a_ in zip(found[::2], found[1::2], strict=True)]
