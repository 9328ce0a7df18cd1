"""Kernels on columns of balls: every operation of their text is one NumPy call that writes into a buffer.

Of the operations of a program (`ir`) what no output needs is left out, and each value gets a buffer that no later one
waits for.  So a few buffers stay in the cache, where a kernel on whole arrays makes a new one at every operation.  The
operations that are left are those of the scalar text, with the same operands: so are the roundings.
"""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

import numpy as np

from .ir import OPERATIONS, Node, Texts, Values, called, claims_of, digest, numbered
from .printer import NotStraightLine
from .programs import PROGRAMS, Program

FILE = "columns.py"
#: Where the manifest has them.
KEY = "columns"
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


def code(program: Program, texts: Texts) -> str:
    """The function of a program: inputs, then the rows that it writes, then the pool of buffers."""
    instructions = lowered(program, texts)
    names = [f"b_{i}" for i in range(buffers(instructions))]
    lines = [
        f"def {program.name}({', '.join((*program.inputs, *program.outputs))}, pool):",
        f'    """{program.summary}',
        "",
        *(f"    {name}: {', '.join(s.name for s in symbols)}" for name, symbols in program.groups),
        f"    Writes {', '.join(program.outputs)}: rows that overlap no other, nor an input that is read later;",
        f"    pool: {len(names)} more.",
        f"    Operations: {len(instructions)}.",
        '    """',
        f"    {', '.join(names)}, *_ = pool",
        *(f"    {operation}({', '.join((*operands, target))})" for operation, operands, target in instructions),
    ]
    return "\n".join([*lines, ""])


def source(texts: Texts, claims: Mapping[str, Sequence[str]], programs: Sequence[Program] = PROGRAMS) -> str:
    """The text of the module with every program."""
    kernels, ids = claims_of(programs, claims)
    functions = [code(program, texts) for program in programs]
    count = sum(len(lowered(program, texts)) for program in programs)
    pool = max(buffers(lowered(program, texts)) for program in programs)
    header = [
        '"""The rounds of a step on columns of balls: NumPy calls that write into a few buffers.',
        "",
        "Written by `chapsym codegen`: do not edit; change the derivation and generate again.",
        f"From the kernels {kernels}.",
        f"Proved by: {ids}.  Operations: {count}.",
        f"Programs: sha256 {digest(programs)}.",
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


def text_values(program: Program, text: str, at: Callable[[str], Fraction]) -> list[Fraction]:
    """What the generated text makes of them: the same NumPy calls, on columns of one fraction."""
    scope: dict = {}
    exec(compile(text, FILE, "exec"), scope)  # our own text, never a user's
    inputs = [np.array([at(name)], dtype=object) for name in program.inputs]
    outputs = [np.array([None], dtype=object) for _ in program.outputs]
    scope[program.name](*inputs, *outputs, [np.array([None], dtype=object) for _ in range(scope["POOL"])])
    return [column[0] for column in outputs]
