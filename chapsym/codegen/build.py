"""Writes the kernels, their manifest and their fingerprints; checks that what is committed is what is derived."""

import hashlib
import importlib.util
import json
import os
from collections.abc import Callable, Collection, Sequence
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
ALL_PROGRAMS = tuple(program for target in TARGETS for program in target.PROGRAMS)
MANIFEST, FINGERPRINTS = "manifest.json", "fingerprints.json"
MEND = "chapsym codegen"


def folder() -> Path:
    """Where the generated package lies: `generated/` of a checkout, or the installed copy."""
    spec = importlib.util.find_spec("chapsym.generated")
    if spec is None or not spec.submodule_search_locations:
        raise FileNotFoundError("the package chapsym.generated is not installed; reinstall chapsym")
    return Path(next(iter(spec.submodule_search_locations))).resolve()  # a checkout has a link there


def is_checkout(place: Path) -> bool:
    """Whether `place` belongs to a source checkout, where the kernels may be written."""
    return (place.parent / "pyproject.toml").is_file()


def code(kernel: Kernel, chosen: Collection[passes.Pass] = passes.PASSES) -> str:
    """The function of a kernel, with the passes that are chosen."""
    terms, rest = passes.lower(kernel, chosen)
    arguments = ", ".join(symbol.name for symbol in kernel.inputs)
    how = printer.Style(products=passes.POWERS in chosen, balanced=passes.BALANCED in chosen)
    # Outputs are named o_... so that an output may share its name with an input (K, in `residual`).
    outputs = [f"o_{name}" for name in kernel.outputs]
    body = ["# intermediate terms"] if terms else []
    body += [f"{symbol} = {printer.text(expr, how)}" for symbol, expr in terms]
    body += ["# outputs"]
    body += [f"{name} = {printer.text(expr, how)}" for name, expr in zip(outputs, rest, strict=True)]
    body += [f"return {', '.join(outputs)}"]
    matrix = f", the {'×'.join(map(str, kernel.shape))} matrix row by row" if len(kernel.shape) > 1 else ""
    notes = [f"Returns {', '.join(kernel.outputs)}{matrix}."]
    return ir.function(kernel.name, kernel.summary, kernel.groups, arguments, notes, body)


def source(kernel: Kernel) -> tuple[str, dict]:
    """The module text of one kernel and its row of the manifest."""
    digest = hashlib.sha256("\n".join(sp.srepr(e) for e in kernel.expressions).encode()).hexdigest()
    operations = passes.operations(passes.lower(kernel))
    header = [
        f'"""{kernel.summary}',
        "",
        "Written by `chapsym codegen`: do not edit; change the derivation and generate again.",
        f"Proved by: {', '.join(kernel.claims)}.  Operations: {operations}.  SymPy {sp.__version__}.",
        f"Expression: sha256 {digest}.",
        '"""',
        "",
        "",
    ]
    row = {
        "claims": list(kernel.claims),
        "inputs": {name: [s.name for s in symbols] for name, symbols in kernel.groups},
        "outputs": list(kernel.outputs),
        "shape": list(kernel.shape),
        "operations": operations,
        "saved_by": passes.saved(kernel),
        "expression_sha256": digest,
    }
    return "\n".join(header) + "\n" + code(kernel), row


def package_source(kernels: Sequence[Kernel]) -> str:
    """The text of `__init__.py`: every kernel, and the table the NumPy front reads."""
    names = sorted(kernel.name for kernel in kernels)
    lines = [
        '"""Kernels written by `chapsym codegen` from the proved expressions: do not edit."""',
        "",
        *(f"from .{name} import {name}" for name in names),
        "",
        "# name: (function, (argument group, length) ..., shape of the result)",
        "TABLE = {",
    ]
    for kernel in sorted(kernels, key=lambda k: k.name):
        groups = tuple((name, len(symbols)) for name, symbols in kernel.groups)
        lines.append(f'    "{kernel.name}": ({kernel.name}, {groups!r}, {kernel.shape!r}),')
    lines += ["}", ""]
    return "\n".join(lines)


@cache
def build() -> dict[str, str]:
    """Every generated file but the fingerprints, by name.

    Raises ArithmeticError if a text does not compute its expression exactly.
    """
    files, rows = {}, {}
    for kernel in KERNELS:
        text, row = source(kernel)
        if text_fingerprint(kernel, text) != fingerprint(kernel):
            raise ArithmeticError(f"the text of {kernel.name} does not compute its expression")
        files[f"{kernel.name}.py"] = text
        rows[kernel.name] = {**row, "text_sha256": hashlib.sha256(text.encode()).hexdigest()}
    files["__init__.py"] = package_source(KERNELS)
    table = {"sympy": sp.__version__, "kernels": rows}
    for target in TARGETS:
        files[target.FILE], table[target.KEY] = target_source(target)
    files |= c_files.build(partial(_text, files), KERNELS)
    files[MANIFEST] = json.dumps(table, indent=1, ensure_ascii=False) + "\n"
    return files


def _text(files: dict[str, str], path: str) -> str:
    """The text of a module that the loops are made of: of what is generated the one that is being built."""
    if path == "chapsym.generated":
        return "\n\n".join(files[f"{kernel.name}.py"] for kernel in KERNELS)
    package, _, name = path.rpartition(".")
    if package == "chapsym.generated":
        return files[f"{name}.py"]
    return Path(__file__).parents[1].joinpath(*path.split(".")[1:]).with_suffix(".py").read_text(encoding="utf-8")


@cache
def texts() -> dict[str, str]:
    """The functions of the kernels that programs call, by name."""
    wanted = {name for program in ALL_PROGRAMS for name in ir.called(program)}
    return {kernel.name: code(kernel) for kernel in KERNELS if kernel.name in wanted}


def target_source(target: ModuleType) -> tuple[str, dict]:
    """A module that is written from programs and its rows of the manifest; raises as `build` does."""
    functions = [target.function(program, texts()) for program in target.PROGRAMS]
    written, rows = [], {}
    for p, made in zip(target.PROGRAMS, functions, strict=True):
        written.append(ir.function(p.name, p.summary, p.groups, made.arguments, made.notes, made.body))
        rows[p.name] = {
            "kernels": ir.called(p),
            "inputs": {name: [s.name for s in symbols] for name, symbols in p.groups},
            "outputs": list(p.outputs),
            **made.facts,
            "text_sha256": hashlib.sha256(written[-1].encode()).hexdigest(),
        }
    kernels = sorted({name for program in target.PROGRAMS for name in ir.called(program)})
    claims = sorted({id for kernel in KERNELS if kernel.name in kernels for id in kernel.claims})
    header = [
        f'"""{target.ABOUT}',
        "",
        "Written by `chapsym codegen`: do not edit; change the derivation and generate again.",
        f"From the kernels {', '.join(kernels)}.",
        f"Proved by: {', '.join(claims)}.",
        f"Programs: sha256 {ir.digest(target.PROGRAMS)}.",
        '"""',
    ]
    text = "\n\n".join(["\n".join(header), *filter(None, ["\n".join(target.preamble(functions))])])
    text += "\n\n\n" + "\n\n".join(written)
    for program in target.PROGRAMS:
        if target_fingerprint(target, program, text) != program_fingerprint(program, texts()):
            raise ArithmeticError(f"the text of {program.name} does not compute the program")
    return text, rows


@cache
def fingerprints() -> dict[str, list[str]]:
    """The values of every kernel and of every program, by name."""
    programs = {p.name: program_fingerprint(p, texts()) for p in ALL_PROGRAMS}
    return {k.name: fingerprint(k) for k in KERNELS} | programs


def stored_fingerprints(place: Path) -> dict[str, list[str]]:
    """The trusted values; empty if there are none."""
    path = place / FINGERPRINTS
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def distrusted(place: Path) -> list[str]:
    """What the trusted fingerprints say against the derivation, one sentence for each kernel or program."""
    trusted, derived, problems = stored_fingerprints(place), fingerprints(), []
    for name, value in derived.items():
        if name not in trusted:
            problems.append(f"{name} has no trusted fingerprint; after review: {MEND} --trust {name}")
        elif trusted[name] != value:
            problems.append(f"{name} changed its value; if that is meant: {MEND} --trust {name}")
    problems += [f"the fingerprint of {name} belongs to no kernel" for name in sorted(set(trusted) - set(derived))]
    return problems


def check(place: Path) -> list[str]:
    """Compares a fresh build with `place`: listing, bytes and values; returns what is wrong."""
    fresh = {name: text.encode() for name, text in build().items()}
    found = {p.name: p.read_bytes() for p in place.iterdir() if p.is_file()}
    found.pop(FINGERPRINTS, None)
    problems = [f"{name} is missing" for name in sorted(set(fresh) - set(found))]
    problems += [f"{name} is extra" for name in sorted(set(found) - set(fresh))]
    problems += [f"{name} is changed" for name in sorted(set(fresh) & set(found)) if fresh[name] != found[name]]
    for name in sorted(set(fresh) & set(found)):
        if found[name] != fresh[name]:
            problems += _value_notes(name, found[name].decode(errors="replace"))
    return problems + distrusted(place)


def _value_notes(name: str, text: str) -> list[str]:
    """Whether a changed text still computes the derived values: what is wrong with each of its functions."""
    notes = [_note(name, fingerprint(k), text_fingerprint, k, text) for k in KERNELS if name == f"{k.name}.py"]
    for target in TARGETS:
        if name == target.FILE:
            notes += [
                _note(f"{p.name} in {name}", program_fingerprint(p, texts()), target_fingerprint, target, p, text)
                for p in target.PROGRAMS
            ]
    return [note for note in notes if note]


def _note(what: str, derived: list[str], run: Callable[..., list[str]], *arguments: Any) -> str:
    try:
        return "" if run(*arguments) == derived else f"{what} computes another value than the derivation"
    except Exception as error:
        return f"{what} does not run: {error}"


def check_names(trust: Sequence[str]) -> None:
    """Raises ValueError if a name in `trust` is no kernel's and no program's."""
    names = _names() | {"all"}
    for name in trust:
        if name not in names:
            listed = ", ".join(sorted(names))
            raise ValueError(f"--trust {name}: there is no such kernel; the names are {listed}")


def _names() -> set[str]:
    return {kernel.name for kernel in KERNELS} | {program.name for program in ALL_PROGRAMS}


def generate(place: Path, trust: Sequence[str] = ()) -> list[str]:
    """Writes every file into `place` and removes kernels that are no more; returns the names written.

    Raises ValueError, before anything is written, if a fingerprint is missing or contradicted and not
    named in `trust` ("all" names every kernel).
    """
    check_names(trust)
    names = _names()
    accepted = names if "all" in trust else set(trust)
    problems = [p for p in distrusted(place) if p.split()[0] not in accepted and not p.startswith("the fingerprint of")]
    if problems:
        raise ValueError("; ".join(problems))
    trusted = {**stored_fingerprints(place), **{k: v for k, v in fingerprints().items() if k in accepted}}
    files = dict(build())
    files[FINGERPRINTS] = json.dumps({k: trusted[k] for k in sorted(names)}, indent=1) + "\n"
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
