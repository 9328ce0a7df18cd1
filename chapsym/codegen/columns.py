"""Kernels on columns of balls: every operation of their text is one NumPy call that writes into a buffer.

Of the operations of a program (`ir`) what no output needs is left out, and each value gets a buffer that no later one
waits for.  So a few buffers stay in the cache, where a kernel on whole arrays makes a new one at every operation.  The
operations that are left are those of the scalar text, with the same operands: so are the roundings.
"""

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

import numpy as np

from .ir import OPERATIONS, Function, Node, Texts, Values, numbered
from .printer import NotStraightLine
from .programs import COLUMN_PROGRAMS, Program

#: The module, its key in the manifest, and what it says of itself.
FILE, KEY = "columns.py", "columns"
ABOUT = "The rounds of a step on columns of balls: NumPy calls that write into a few buffers."
PROGRAMS = COLUMN_PROGRAMS
#: An operation, the names of its operands, and the name of what it writes.
Instruction = tuple[str, tuple[str, ...], str]


def lowered(program: Program, texts: Texts) -> list[Instruction]:
    """The operations that the outputs of a program need, in order, each with the buffer that it writes."""
    values = Values(texts)
    outputs = dict(zip(numbered(program, values), program.outputs, strict=True))
    if len(outputs) < len(program.outputs) or any(map(values.leaf, outputs)):
        raise NotStraightLine(f"{program.name}: every output must be a value of its own")
    needed = values.needed(list(outputs))
    last = {int(x): number for number in needed if not values.leaf(number) for x in values.nodes[number][1:]}
    return _allocated(values.nodes, needed, outputs, last)


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


def function(program: Program, texts: Texts) -> Function:
    """The function of a program: inputs, then the rows that it writes, then the pool of buffers."""
    instructions = lowered(program, texts)
    names = [f"b_{i}" for i in range(buffers(instructions))]
    notes = [
        f"Writes {', '.join(program.outputs)}: rows that overlap no other, nor an input that is read later;",
        f"pool: {len(names)} more.",
        f"Operations: {len(instructions)}.",
    ]
    calls = (f"{operation}({', '.join((*operands, target))})" for operation, operands, target in instructions)
    body = [f"{', '.join(names)}, *_ = pool", *calls]
    facts = {"operations": len(instructions), "buffers": len(names)}
    return Function(f"{', '.join((*program.inputs, *program.outputs))}, pool", notes, body, facts)


def preamble(functions: Sequence[Function]) -> list[str]:
    """What the module has before the functions."""
    return [
        f"from numpy import {', '.join(sorted({*OPERATIONS.values(), 'negative'}))}",
        "",
        "#: The rows that the pool must have.",
        f"POOL = {max(function.facts['buffers'] for function in functions)}",
    ]


def text_values(program: Program, text: str, at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the generated text makes of them: the same NumPy calls, on columns of one fraction."""
    scope: dict = {}
    exec(compile(text, FILE, "exec"), scope)  # our own text, never a user's
    inputs = [np.array([at(name)], dtype=object) for name in program.inputs]
    outputs = [np.array([None], dtype=object) for _ in program.outputs]
    scope[program.name](*inputs, *outputs, [np.array([None], dtype=object) for _ in range(scope["POOL"])])
    return [column[0] for column in outputs]
