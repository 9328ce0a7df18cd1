"""The intermediate form of a program: its operations, numbered, from which each backend writes its text.

The texts of the functions that a program calls are put in the place of the calls, and an operation that two of them
share is done once.
"""

import ast
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .kernels import Group
from .printer import NotStraightLine
from .programs import Program

OPERATIONS = {ast.Add: "add", ast.Sub: "subtract", ast.Mult: "multiply", ast.Div: "divide"}
COMMUTATIVE = ("add", "multiply")

Texts = Mapping[str, str]
#: An operation with the numbers of its operands; ("input", name) or ("constant", integer).
Node = tuple[str, *tuple[int | str, ...]]


class Folded:
    """The values of a program, numbered: the same operation on the same operands is the same value.

    A product by 1 is its other factor, and one by 2 a sum.
    """

    def __init__(self, texts: Texts) -> None:
        self.texts, self.nodes = texts, list[Node]()
        self._numbers: dict[Node, int] = {}

    def number(self, operation: str, *operands: int | str) -> int:
        """The number of an input, a constant or an operation."""
        if operation == "multiply":
            for factor, other in (operands, operands[::-1]):
                match self.nodes[int(factor)]:
                    case ("constant", 1):
                        return int(other)
                    case ("constant", 2):
                        return self.number("add", other, other)
        if operation in COMMUTATIVE:
            operands = tuple(sorted(operands, key=int))
        node: Node = (operation, *operands)
        if node not in self._numbers:
            self._numbers[node] = len(self.nodes)
            self.nodes.append(node)
        return self._numbers[node]

    def run(self, body: Sequence[ast.stmt], known: dict[str, int]) -> list[int]:
        """Numbers what the statements compute from the names that are known, and adds theirs; what they return."""
        for statement in body:
            match statement:
                case ast.Assign(targets=[ast.Name(id=name)], value=value):
                    known[name] = self.value(value, known)
                case ast.Assign(targets=[ast.Tuple(elts=names)], value=value):
                    several = self.several(value, known)
                    known.update(zip((n.id for n in names if isinstance(n, ast.Name)), several, strict=True))
                case ast.Return(value=ast.expr() as value):
                    return self.several(value, known)
                case ast.Expr(value=ast.Constant(value=str())):  # a docstring
                    continue
                case _:
                    raise NotStraightLine(f"a program may only assign and return, not {ast.unparse(statement)}")
        return []

    def several(self, expr: ast.expr, known: dict[str, int]) -> list[int]:
        """The values of a tuple, or of the call of a kernel."""
        if not isinstance(expr, ast.Call):
            return [self.value(e, known) for e in (expr.elts if isinstance(expr, ast.Tuple) else [expr])]
        name = ast.unparse(expr.func)
        if name not in self.texts:
            raise NotStraightLine(f"a program may call kernels, and {name} is none")
        function = next(s for s in ast.parse(self.texts[name]).body if isinstance(s, ast.FunctionDef))
        arguments = [self.value(a, known) for a in expr.args]
        return self.run(function.body, dict(zip((a.arg for a in function.args.args), arguments, strict=True)))

    def value(self, expr: ast.expr, known: dict[str, int]) -> int:
        """The value of an expression."""
        match expr:
            case ast.Name(id=name) if name in known:
                return known[name]
            case ast.Constant(value=int() as number):
                return self.number("constant", number)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return self.number("negative", self.value(operand, known))
            case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATIONS:
                return self.number(OPERATIONS[type(op)], self.value(left, known), self.value(right, known))
        raise NotStraightLine(f"{ast.unparse(expr)} is not a known name, an integer or + - * /")

    def needed(self, outputs: Sequence[int]) -> list[int]:
        """The operations that these values need, in order, and the inputs and constants."""
        found = set(outputs)
        for number in reversed(range(len(self.nodes))):
            if number in found and not self.leaf(number):
                found.update(map(int, self.nodes[number][1:]))
        return sorted(found)

    def leaf(self, number: int) -> bool:
        """Whether a value is an input or a constant."""
        return self.nodes[number][0] in ("input", "constant")


def numbered(program: Program, values: Folded) -> list[int]:
    """Numbers what a program computes; returns the numbers of its outputs."""
    known = {name: values.number("input", name) for name in program.inputs}
    values.run(ast.parse(program.text).body, known)
    return [known[name] for name in program.outputs]


def called(program: Program) -> list[str]:
    """The kernels that a program calls."""
    return sorted({ast.unparse(n.func) for n in ast.walk(ast.parse(program.text)) if isinstance(n, ast.Call)})


@dataclass(frozen=True)
class Function:
    """What a backend makes of a program: parameters, lines that say more than the groups, the body, and its facts."""

    arguments: str
    notes: Sequence[str]
    body: Sequence[str]
    facts: Mapping[str, Any]


def function(
    name: str, summary: str, groups: Sequence[Group], arguments: str, notes: Sequence[str], body: Sequence[str]
) -> str:
    """The text of a generated function."""
    lines = [
        f'"""{summary}',
        "",
        *(f"{group}: {', '.join(s.name for s in symbols)}" for group, symbols in groups),
        *notes,
        '"""',
        *body,
    ]
    return "\n".join([f"def {name}({arguments}):", *(f"    {line}".rstrip() for line in lines), ""])
