"""Kernels on columns of balls: every operation of their text is one NumPy call that writes into a buffer.

The texts of the kernels that a program calls are put in the place of the calls, an operation that two of them share
is done once, what no output needs is left out, and each value gets a buffer that no later one waits for.  So a few
buffers stay in the cache, where a kernel on whole arrays makes a new one at every operation.  The operations that
are left are those of the scalar text, with the same operands: so are the roundings.
"""

import ast
import hashlib
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

import numpy as np

from .printer import NotStraightLine
from .programs import PROGRAMS, Program

FILE = "columns.py"
#: Where the manifest has them.
KEY = "columns"
OPERATIONS = {ast.Add: "add", ast.Sub: "subtract", ast.Mult: "multiply", ast.Div: "divide"}
COMMUTATIVE = ("add", "multiply")

Texts = Mapping[str, str]
#: An operation with the numbers of its operands; ("input", name) or ("constant", integer).
Node = tuple[str, *tuple[int | str, ...]]
#: An operation, the names of its operands, and the name of what it writes.
Instruction = tuple[str, tuple[str, ...], str]


class Values:
    """The values of a program, numbered: the same operation on the same operands is the same value."""

    def __init__(self, texts: Texts) -> None:
        self.texts, self.nodes = texts, list[Node]()
        self._numbers: dict[Node, int] = {}

    def number(self, *node: int | str) -> int:
        """The number of an input, a constant or an operation."""
        operation, *operands = node
        if operation == "multiply" and ("constant", 2) in (self.nodes[int(x)] for x in operands):
            other = next((x for x in operands if self.nodes[int(x)] != ("constant", 2)), operands[0])
            operation, operands = "add", [other, other]  # the same value, and no constant to be read
        if operation in COMMUTATIVE:
            operands = sorted(operands, key=int)
        key: Node = (str(operation), *operands)
        if key not in self._numbers:
            self._numbers[key] = len(self.nodes)
            self.nodes.append(key)
        return self._numbers[key]

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


def lowered(program: Program, texts: Texts) -> list[Instruction]:
    """The operations that the outputs of a program need, in order, each with the buffer that it writes."""
    values = Values(texts)
    known = {name: values.number("input", name) for name in program.inputs}
    values.run(ast.parse(program.text).body, known)
    outputs = {known[name]: name for name in program.outputs}
    if len(outputs) < len(program.outputs) or any(values.nodes[n][0] in ("input", "constant") for n in outputs):
        raise NotStraightLine(f"{program.name}: every output must be a value of its own")
    needed, last = set(outputs), dict[int, int]()
    for number in reversed(range(len(values.nodes))):
        if number in needed and values.nodes[number][0] not in ("input", "constant"):
            for operand in values.nodes[number][1:]:
                needed.add(int(operand))
                last.setdefault(int(operand), number)
    return _allocated(values.nodes, sorted(needed), outputs, last)


def _allocated(
    nodes: Sequence[Node], needed: Sequence[int], outputs: Mapping[int, str], last: Mapping[int, int]
) -> list[Instruction]:
    """Gives each value that is no output the buffer that was left last: it is the likeliest to be in the cache."""
    places: dict[int, str] = {}
    free: list[str] = []
    used, done = 0, list[Instruction]()
    for number in needed:
        operation, *operands = nodes[number]
        if operation in ("input", "constant"):
            places[number] = str(operands[0])
            continue
        names = tuple(places[int(x)] for x in operands)
        free += sorted({n for x, n in zip(operands, names, strict=True) if last[int(x)] == number and n[:2] == "b_"})
        if number in outputs:
            places[number] = outputs[number]
        elif free:
            places[number] = free.pop()
        else:
            places[number], used = f"b_{used}", used + 1
        done.append((operation, names, places[number]))
    return done


def buffers(instructions: Sequence[Instruction]) -> int:
    """How many buffers the instructions need beside their arguments."""
    return len({target for _, _, target in instructions if target.startswith("b_")})


def code(program: Program, texts: Texts) -> str:
    """The function of a program: inputs, then the rows that it writes, then the pool of buffers."""
    instructions = lowered(program, texts)
    names = [f"b_{i}" for i in range(buffers(instructions))]
    lines = [
        f"def {program.name}({', '.join((*program.inputs, *program.outputs))}, pool):",
        f'    """{program.summary}',
        "",
        *(f"    {name}: {', '.join(s.name for s in symbols)}" for name, symbols in program.groups),
        f"    Writes {', '.join(program.outputs)}: rows that overlap no other; pool: {len(names)} more.",
        f"    Operations: {len(instructions)}.",
        '    """',
        f"    {', '.join(names)}, *_ = pool",
        *(f"    {operation}({', '.join((*operands, target))})" for operation, operands, target in instructions),
    ]
    return "\n".join([*lines, ""])


def called(program: Program) -> list[str]:
    """The kernels that a program calls."""
    return sorted({ast.unparse(node.func) for node in ast.walk(ast.parse(program.text)) if isinstance(node, ast.Call)})


def source(texts: Texts, claims: Mapping[str, Sequence[str]], programs: Sequence[Program] = PROGRAMS) -> str:
    """The text of the module with every program."""
    kernels = sorted({name for program in programs for name in called(program)})
    ids = sorted({id for name in kernels for id in claims[name]})
    digest = hashlib.sha256("\n".join(p.text for p in programs).encode()).hexdigest()
    functions = [code(program, texts) for program in programs]
    count = sum(len(lowered(program, texts)) for program in programs)
    pool = max(buffers(lowered(program, texts)) for program in programs)
    header = [
        '"""The rounds of a step on columns of balls: NumPy calls that write into a few buffers.',
        "",
        "Written by `chapsym codegen`: do not edit; change the derivation and generate again.",
        f"From the kernels {', '.join(kernels)}.",
        f"Proved by: {', '.join(ids)}.  Operations: {count}.",
        f"Programs: sha256 {digest}.",
        '"""',
        "",
        f"from numpy import {', '.join(sorted({*OPERATIONS.values(), 'negative'}))}",
        "",
        "#: The rows that the pool must have.",
        f"POOL = {pool}",
        "",
        "",
    ]
    return "\n".join(header) + "\n" + "\n\n".join(functions)


def manifest(texts: Texts, programs: Sequence[Program] = PROGRAMS) -> dict[str, dict]:
    """The rows of the manifest."""
    rows = {}
    for program in programs:
        instructions = lowered(program, texts)
        rows[program.name] = {
            "kernels": called(program),
            "inputs": {name: [s.name for s in symbols] for name, symbols in program.groups},
            "outputs": list(program.outputs),
            "operations": len(instructions),
            "buffers": buffers(instructions),
            "text_sha256": hashlib.sha256(code(program, texts).encode()).hexdigest(),
        }
    return rows


def values(program: Program, kernels: Mapping[str, Callable], at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the outputs of a program should be, at the point that `at` gives: its own text, with functions given."""
    scope: dict = {**kernels, **{name: at(name) for name in program.inputs}}
    exec(compile(program.text, program.name, "exec"), scope)  # our own text, never a user's
    return [scope[name] for name in program.outputs]


def text_values(program: Program, text: str, at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the generated text makes of them: the same NumPy calls, on columns of one fraction."""
    scope: dict = {}
    exec(compile(text, FILE, "exec"), scope)  # our own text, never a user's
    inputs = [np.array([at(name)], dtype=object) for name in program.inputs]
    outputs = [np.array([None], dtype=object) for _ in program.outputs]
    scope[program.name](*inputs, *outputs, [np.array([None], dtype=object) for _ in range(scope["POOL"])])
    return [column[0] for column in outputs]
