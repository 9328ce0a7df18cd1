"""Writes the kernels, their manifest and their fingerprints; checks that what is committed is what is derived."""

import hashlib
import importlib.util
import json
import os
import tempfile
from collections.abc import Collection, Sequence
from fractions import Fraction
from pathlib import Path

import sympy as sp

from . import passes, printer
from .kernels import KERNELS, Kernel

MANIFEST, FINGERPRINTS = "manifest.json", "fingerprints.json"
DIGITS = 40
MEND = "chapsym codegen"


def folder() -> Path:
    """Where the generated package lies: `generated/` of a checkout, or the installed copy."""
    spec = importlib.util.find_spec("chapsym.generated")
    if spec is None or not spec.submodule_search_locations:
        raise FileNotFoundError("the package chapsym.generated is not installed; reinstall chapsym")
    return Path(next(iter(spec.submodule_search_locations)))


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
    lines = [
        f"def {kernel.name}({arguments}):",
        f'    """{kernel.summary}',
        "",
        *(f"    {name}: {', '.join(s.name for s in symbols)}" for name, symbols in kernel.groups),
        f"    Returns {', '.join(kernel.outputs)}{_shape_note(kernel)}.",
        '    """',
    ]
    lines += ["    # intermediate terms"] if terms else []
    lines += [f"    {symbol} = {printer.text(expr, how)}" for symbol, expr in terms]
    lines += ["    # outputs"]
    lines += [f"    {name} = {printer.text(expr, how)}" for name, expr in zip(outputs, rest, strict=True)]
    return "\n".join([*lines, f"    return {', '.join(outputs)}", ""])


def source(kernel: Kernel) -> tuple[str, dict]:
    """The module text of one kernel and its row of the manifest."""
    expressions = [sp.sympify(e) for e in kernel.build()]
    digest = hashlib.sha256("\n".join(sp.srepr(e) for e in expressions).encode()).hexdigest()
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


def _shape_note(kernel: Kernel) -> str:
    return "" if len(kernel.shape) < 2 else f", the {'×'.join(map(str, kernel.shape))} matrix row by row"


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


def point(symbols: Sequence[sp.Symbol]) -> dict[sp.Symbol, sp.Rational]:
    """A rational point seeded from the names of the symbols, each value in (1/2, 3/2)."""

    def value(name: str) -> sp.Rational:
        seed = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big") % 1009
        return sp.Rational(1009 + 2 * seed, 2018)

    return {symbol: value(symbol.name) for symbol in symbols}


def decimal(value: Fraction) -> str:
    """40 significant digits of a rational number."""
    return str(sp.Rational(value.numerator, value.denominator).evalf(DIGITS))


def fingerprint(kernel: Kernel) -> list[str]:
    """The values of the expressions at the rational point: they survive another order of the text."""
    values = point(kernel.inputs)
    exact = [sp.sympify(e).xreplace(values) for e in kernel.build()]
    return [decimal(Fraction(int(e.p), int(e.q))) for e in exact]


def text_fingerprint(kernel: Kernel, text: str) -> list[str]:
    """The same values from the generated text, run on fractions."""
    scope: dict = {}
    exec(compile(text, f"{kernel.name}.py", "exec"), scope)  # our own text, never a user's
    arguments = [Fraction(int(v.p), int(v.q)) for v in point(kernel.inputs).values()]
    result = scope[kernel.name](*arguments)
    return [decimal(value) for value in (result if isinstance(result, tuple) else (result,))]


def build(kernels: Sequence[Kernel] = KERNELS) -> dict[str, str]:
    """Every generated file but the fingerprints, by name.

    Raises ArithmeticError if a text does not compute its expression exactly.
    """
    files, rows = {}, {}
    for kernel in kernels:
        text, row = source(kernel)
        if text_fingerprint(kernel, text) != fingerprint(kernel):
            raise ArithmeticError(f"the text of {kernel.name} does not compute its expression")
        files[f"{kernel.name}.py"] = text
        rows[kernel.name] = {**row, "text_sha256": hashlib.sha256(text.encode()).hexdigest()}
    files["__init__.py"] = package_source(kernels)
    files[MANIFEST] = json.dumps({"sympy": sp.__version__, "kernels": rows}, indent=1, ensure_ascii=False) + "\n"
    return files


def stored_fingerprints(place: Path) -> dict[str, list[str]]:
    """The trusted values; empty if there are none."""
    path = place / FINGERPRINTS
    return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


def distrusted(place: Path, kernels: Sequence[Kernel] = KERNELS) -> list[str]:
    """What the trusted fingerprints say against the derivation, one sentence for each kernel."""
    trusted, problems = stored_fingerprints(place), []
    for kernel in kernels:
        if kernel.name not in trusted:
            problems.append(f"{kernel.name} has no trusted fingerprint; after review: {MEND} --trust {kernel.name}")
        elif trusted[kernel.name] != fingerprint(kernel):
            problems.append(f"{kernel.name} changed its value; if that is meant: {MEND} --trust {kernel.name}")
    known = {kernel.name for kernel in kernels}
    problems += [f"the fingerprint of {name} belongs to no kernel" for name in sorted(set(trusted) - known)]
    return problems


def check(place: Path) -> list[str]:
    """Compares a fresh build with `place`: listing, bytes and values; returns what is wrong."""
    with tempfile.TemporaryDirectory() as temporary:
        write(Path(temporary), build())
        fresh = {p.name: p.read_bytes() for p in Path(temporary).iterdir()}
    found = {p.name: p.read_bytes() for p in place.iterdir() if p.is_file()}
    found.pop(FINGERPRINTS, None)
    problems = [f"{name} is missing" for name in sorted(set(fresh) - set(found))]
    problems += [f"{name} is extra" for name in sorted(set(found) - set(fresh))]
    problems += [f"{name} is changed" for name in sorted(set(fresh) & set(found)) if fresh[name] != found[name]]
    for kernel in KERNELS:
        name = f"{kernel.name}.py"
        if name in found and found[name] != fresh[name]:
            problems += _value_note(kernel, found[name])
    return problems + distrusted(place)


def _value_note(kernel: Kernel, content: bytes) -> list[str]:
    """Whether a changed text still computes the derived value."""
    try:
        same = text_fingerprint(kernel, content.decode()) == fingerprint(kernel)
    except Exception as error:
        return [f"{kernel.name}.py does not run: {error}"]
    return [] if same else [f"{kernel.name}.py computes another value than the derivation"]


def check_names(trust: Sequence[str]) -> None:
    """Raises ValueError if a name in `trust` is no kernel's."""
    names = {kernel.name for kernel in KERNELS} | {"all"}
    for name in trust:
        if name not in names:
            listed = ", ".join(sorted(names))
            raise ValueError(f"--trust {name}: there is no such kernel; the names are {listed}")


def generate(place: Path, trust: Sequence[str] = ()) -> list[str]:
    """Writes every file into `place` and removes kernels that are no more; returns the names written.

    Raises ValueError, before anything is written, if a fingerprint is missing or contradicted and not
    named in `trust` ("all" names every kernel).
    """
    check_names(trust)
    names = {kernel.name for kernel in KERNELS}
    accepted = names if "all" in trust else set(trust)
    problems = [p for p in distrusted(place) if p.split()[0] not in accepted and not p.startswith("the fingerprint of")]
    if problems:
        raise ValueError("; ".join(problems))
    trusted = {**stored_fingerprints(place), **{k.name: fingerprint(k) for k in KERNELS if k.name in accepted}}
    files = build()
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
