"""Writes the kernels, their manifest and their fingerprints; checks that what is committed is what is derived."""

import hashlib
import importlib.util
import json
import os
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from types import ModuleType
from typing import Any

import sympy as sp

from . import c_files, ir, pairs, passes, printer
from .kernels import KERNELS, Kernel
from .values import fingerprint, program_fingerprint, target_fingerprint, text_fingerprint

#: What is written from programs, each into a module of its own.
TARGETS: tuple[ModuleType, ...] = (pairs,)
MANIFEST, FINGERPRINTS = "manifest.json", "fingerprints.json"
MEND = "chapsym codegen"
EDIT = "Written by `chapsym codegen`: do not edit; change the derivation and generate again."


def folder() -> Path:
    """Where the generated package lies: `generated/` of a checkout, or the installed copy."""
    spec = importlib.util.find_spec("chapsym.generated")
    if spec is None or not spec.submodule_search_locations:
        raise FileNotFoundError("the package chapsym.generated is not installed; reinstall chapsym")
    return Path(next(iter(spec.submodule_search_locations))).resolve()  # a checkout has a link there


def is_checkout(place: Path) -> bool:
    """Whether `place` belongs to a source checkout, where the kernels may be written."""
    return (place.parent / "pyproject.toml").is_file()


def code(kernel: Kernel, chosen: tuple[str, ...] = passes.PASSES) -> str:
    """The function of a kernel, with the passes that are chosen."""
    terms, rest = passes.lower(kernel, chosen)
    # Outputs are named o_... so that an output may share its name with an input (K, in `residual`).
    outputs = [f"o_{name}" for name in kernel.outputs]
    body = ["# intermediate terms"] if terms else []
    body += [f"{symbol} = {printer.text(expr, chosen)}" for symbol, expr in terms]
    body += ["# outputs"]
    body += [f"{name} = {printer.text(expr, chosen)}" for name, expr in zip(outputs, rest, strict=True)]
    body += [f"return {', '.join(outputs)}"]
    matrix = f", the {'×'.join(map(str, kernel.shape))} matrix row by row" if len(kernel.shape) > 1 else ""
    notes = [f"Returns {', '.join(kernel.outputs)}{matrix}."]
    arguments = ", ".join(symbol.name for symbol in kernel.inputs)
    return ir.function(kernel.name, kernel.summary, kernel.groups, arguments, notes, body)


def source(kernel: Kernel) -> tuple[str, dict[str, Any]]:
    """The module of one kernel and its row of the manifest."""
    digest = _hash("\n".join(sp.srepr(e) for e in kernel.expressions))
    operations = passes.operations(passes.lower(kernel))
    proved = f"Proved by: {', '.join(kernel.claims)}.  Operations: {operations}.  SymPy {sp.__version__}."
    row = {
        "claims": kernel.claims,
        "operations": operations,
        "saved_by": passes.saved(kernel),
        "expression_sha256": digest,
    }
    text = _module([EDIT, "", proved, f"Expression: sha256 {digest}."], [], [code(kernel)])
    return text, {**row, "text_sha256": _hash(text)}


def target_source(target: ModuleType) -> tuple[str, dict[str, dict[str, Any]]]:
    """A module that is written from programs and its rows of the manifest."""
    functions = [target.function(program, texts()) for program in target.PROGRAMS]
    written, rows = [], {}
    for p, made in zip(target.PROGRAMS, functions, strict=True):
        written.append(ir.function(p.name, p.summary, p.groups, made.arguments, made.notes, made.body))
        rows[p.name] = {"kernels": ir.called(p), **made.facts, "text_sha256": _hash(written[-1])}
    kernels = sorted({name for row in rows.values() for name in row["kernels"]})
    claims = sorted({id for kernel in KERNELS if kernel.name in kernels for id in kernel.claims})
    programs = "\n".join(program.text for program in target.PROGRAMS)
    about = [target.ABOUT, "", EDIT, f"From the kernels {', '.join(kernels)}.", f"Proved by: {', '.join(claims)}."]
    about.append(f"Programs: sha256 {_hash(programs)}.")
    return _module(about, target.preamble(functions), written), rows


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _module(about: Sequence[str], preamble: Sequence[str], functions: Sequence[str]) -> str:
    head = ["\n".join([f'"""{about[0]}', *about[1:], '"""']), *filter(None, ["\n".join(preamble)])]
    return "\n\n".join(head) + "\n\n\n" + "\n\n".join(functions)


def package_source(kernels: Sequence[Kernel]) -> str:
    """The text of `__init__.py`: every kernel, and the table the NumPy front reads."""
    kernels = sorted(kernels, key=lambda kernel: kernel.name)
    groups = {k.name: tuple((name, len(symbols)) for name, symbols in k.groups) for k in kernels}
    lines = [
        '"""Kernels written by `chapsym codegen` from the proved expressions: do not edit."""',
        "",
        *(f"from .{k.name} import {k.name}" for k in kernels),
        "",
        "# name: (function, (argument group, length) ..., shape of the result)",
        "TABLE = {",
        *(f'    "{k.name}": ({k.name}, {groups[k.name]!r}, {k.shape!r}),' for k in kernels),
        "}",
        "",
    ]
    return "\n".join(lines)


@cache
def texts() -> dict[str, str]:
    """The functions of the kernels that programs call, by name."""
    wanted = {name for target in TARGETS for program in target.PROGRAMS for name in ir.called(program)}
    return {kernel.name: code(kernel) for kernel in KERNELS if kernel.name in wanted}


@cache
def build() -> dict[str, str]:
    """Every generated file but the fingerprints, by name.

    Raises ArithmeticError if a text does not compute its expression exactly.
    """
    files, rows = {"__init__.py": package_source(KERNELS)}, dict[str, dict[str, Any]]()
    for kernel in KERNELS:
        files[f"{kernel.name}.py"], rows[kernel.name] = source(kernel)
    table = {"kernels": rows}
    for target in TARGETS:
        files[target.FILE], table[target.KEY] = target_source(target)
    for name, functions in computed().items():
        for function, (derived, values) in functions.items():
            if values(files[name]) != derived:
                raise ArithmeticError(f"the text of {function} in {name} does not compute its expression")
    files |= c_files.build(partial(_text, files), KERNELS)
    parts = [f'"{key}": {_one_a_line(part)}' for key, part in table.items()]
    files[MANIFEST] = "{\n" + ",\n".join([f'"sympy": "{sp.__version__}"', *parts]) + "\n}\n"
    return files


def _one_a_line(table: Mapping[str, Any]) -> str:
    """An object of JSON, one key a line."""
    return "{\n" + ",\n".join(f'"{key}": {json.dumps(value)}' for key, value in table.items()) + "\n}"


def _text(files: dict[str, str], path: str) -> str:
    """The text of a module that the loops are made of: of what is generated the one that is being built."""
    if path == "chapsym.generated":
        return "\n\n".join(files[f"{kernel.name}.py"] for kernel in KERNELS)
    package, _, name = path.rpartition(".")
    if package == "chapsym.generated":
        return files[f"{name}.py"]
    return Path(__file__).parents[1].joinpath(*path.split(".")[1:]).with_suffix(".py").read_text(encoding="utf-8")


#: The values of functions as derived, and as a text of their module has them, by name.
Computed = dict[str, tuple[list[str], Callable[[str], list[str]]]]


@cache
def computed() -> dict[str, Computed]:
    """What the functions of each module in Python compute."""
    found: dict[str, Computed] = {
        f"{kernel.name}.py": {kernel.name: (fingerprint(kernel), partial(text_fingerprint, kernel))}
        for kernel in KERNELS
    }
    for target in TARGETS:
        found[target.FILE] = {
            program.name: (program_fingerprint(program, texts()), partial(target_fingerprint, target, program))
            for program in target.PROGRAMS
        }
    return found


@cache
def fingerprints() -> dict[str, list[str]]:
    """The values of every kernel and of every program, by name."""
    return {name: derived for functions in computed().values() for name, (derived, _) in functions.items()}


def stored_fingerprints(place: Path) -> dict[str, list[str]]:
    """The trusted values; empty if there are none."""
    path = place / FINGERPRINTS
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def distrusted(place: Path) -> dict[str, str]:
    """What the trusted fingerprints say against the derivation: a sentence for each kernel or program."""
    trusted, derived, problems = stored_fingerprints(place), fingerprints(), {}
    for name, value in derived.items():
        if name not in trusted:
            problems[name] = f"{name} has no trusted fingerprint; after review: {MEND} --trust {name}"
        elif trusted[name] != value:
            problems[name] = f"{name} changed its value; if that is meant: {MEND} --trust {name}"
    return problems


def check(place: Path) -> list[str]:
    """Compares a fresh build with `place`: listing, bytes and values; returns what is wrong."""
    fresh = {name: text.encode() for name, text in build().items()}
    found = {p.name: p.read_bytes() for p in place.iterdir() if p.is_file() and p.name != FINGERPRINTS}
    changed = [name for name in sorted(set(fresh) & set(found)) if fresh[name] != found[name]]
    problems = [f"{name} is missing" for name in sorted(set(fresh) - set(found))]
    problems += [f"{name} is extra" for name in sorted(set(found) - set(fresh))]
    problems += [f"{name} is changed" for name in changed]
    for name in changed:
        for function, (derived, values) in computed().get(name, {}).items():
            problems += _doubts(
                name if name == f"{function}.py" else f"{function} in {name}", derived, values, found[name]
            )
    strangers = sorted(set(stored_fingerprints(place)) - set(fingerprints()))
    problems += distrusted(place).values()
    return problems + [f"the fingerprint of {name} belongs to no kernel" for name in strangers]


def _doubts(what: str, derived: list[str], values: Callable[[str], list[str]], text: bytes) -> list[str]:
    """What a changed text does otherwise than the derivation, if anything."""
    try:
        return [] if values(text.decode()) == derived else [f"{what} computes another value than the derivation"]
    except Exception as error:
        return [f"{what} does not run: {error}"]


def check_names(trust: Sequence[str]) -> None:
    """Raises ValueError if a name in `trust` is no kernel's and no program's."""
    programs = (program.name for target in TARGETS for program in target.PROGRAMS)
    names = {"all", *(kernel.name for kernel in KERNELS), *programs}
    for name in trust:
        if name not in names:
            raise ValueError(f"--trust {name}: there is no such kernel; the names are {', '.join(sorted(names))}")


def generate(place: Path, trust: Sequence[str] = ()) -> list[str]:
    """Writes every file into `place` and removes kernels that are no more; returns the names written.

    Raises ValueError, before anything is written, if a fingerprint is missing or contradicted and not
    named in `trust` ("all" names every kernel).
    """
    check_names(trust)
    problems = [problem for name, problem in distrusted(place).items() if not {name, "all"} & set(trust)]
    if problems:
        raise ValueError("; ".join(problems))
    files = {**build(), FINGERPRINTS: _one_a_line(dict(sorted(fingerprints().items()))) + "\n"}
    write(place, files)
    for path in place.iterdir():
        if path.is_file() and path.name not in files:
            path.unlink()
    return sorted(files)


def write(place: Path, files: dict[str, str]) -> None:
    """Writes each file whole: to a temporary name in the same folder, then renamed."""
    place.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        partial = place / f".{name}.partial"
        partial.write_text(text, encoding="utf-8", newline="\n")
        os.replace(partial, place / name)
