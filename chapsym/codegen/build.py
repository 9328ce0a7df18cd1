"""The generated package of the kernels of a register: built, checked against the derivation, and tied to claims.

A kernel is refused unless its text computes the expressions of its carrying statements.  The checker evaluates the
text, takes the expressions from the certificate of the claim, which is proved again here, and compares them as rational
functions.
"""

import ast
import hashlib
import importlib.util
import json
import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache, cached_property, partial
from pathlib import Path
from typing import Any

import sympy as sp

from chapsym.checker import Rejected
from chapsym.checker import kernels as binding
from chapsym.files import Data, alone, pasted, write_text
from chapsym.prove import PROOFS, NoRegister, Register, Verdict
from chapsym.prove.claims import Judgement, judgement_of, once
from chapsym.prove.trees import tree

from . import c_files, carriers, passes, printer, rounding
from .kernels import Kernel
from .passes import letters

MANIFEST, FINGERPRINTS = "manifest.json", "fingerprints.json"
EDIT = "Written by `chapsym codegen`: do not edit; change the derivation and generate again."
#: What is in the head of each file with a text.
HEAD = b"ritten by `chapsym codegen`"
#: The values of a kernel by the derivation, and a function that gives those of a text of its module.
Computed = tuple[list[str], Callable[[str], list[str]]]


class NoKernels(NoRegister):
    """A register without a list of kernels; the message gives the remedy."""


class Package:
    """The kernels of a register, the list KERNELS of its `kernels.py`, and the folder of the generated files.

    Raises NoKernels if there is no such list.
    """

    def __init__(self, register: Register = PROOFS) -> None:
        self.register = register
        self.claims = register.load(lemmas=True)
        found = register.kernels()
        if not isinstance(found, list | tuple) or not all(isinstance(one, Kernel) for one in found) or not found:
            raise NoKernels(f"{register.place} has no kernels.py with KERNELS, a list of Kernel")
        self.kernels: tuple[Kernel, ...] = tuple(found)
        names = [kernel.name for kernel in self.kernels]
        if twice := [name for name in names if names.count(name) > 1]:
            raise NoKernels(f"{register.place}: two kernels have the name {twice[0]}")

    @property
    def is_ours(self) -> bool:
        """Whether the loops of `dynamics` use these kernels."""
        return self.register == PROOFS

    @property
    def place(self) -> Path:
        """The folder of the package: `generated` of the register, or that of chapsym."""
        return folder() if self.is_ours else self.register.folder / "generated"

    @property
    def name(self) -> str:
        """The prefix of the package's functions in C: the name of the register's folder."""
        return "chapsym" if self.is_ours else re.sub(r"\W", "_", self.register.folder.name, flags=re.ASCII)

    @property
    def mend(self) -> str:
        """The command that writes the package."""
        return "chapsym codegen" + ("" if self.is_ours else f" --register {pasted(self.register.place)}")

    @cached_property
    def judged(self) -> dict[str, Judgement]:
        """The judgements, made now, of the claims that carry kernels."""
        wanted = {id for kernel in self.kernels for id in kernel.claims}
        known = self.claims if wanted <= self.claims.keys() else PROOFS.load(lemmas=True) | self.claims
        with once():
            return {id: judgement_of(known[id]) for id in sorted(wanted & known.keys())}

    def unproved(self) -> list[str]:
        """The reasons why kernels cannot be made: their errors, and the carrying claims that are not proved."""
        named = {id: kernel.name for kernel in self.kernels for id in kernel.claims}
        problems = []
        for id, kernel in named.items():
            if id not in self.judged:
                problems.append(f"{kernel} names the claim {id}, which no proof judges")
            elif self.judged[id].verdict is Verdict.OPEN or not self.judged[id].certificate:
                problems.append(f"{kernel} comes from the claim {id}, which is not proved")
        problems += [f"{kernel.name} is carried by no claim" for kernel in self.kernels if not kernel.claims]
        return problems + [f"{k.name}: {problem}" for k in self.kernels if (problem := k.problem())]

    def _digest(self, id: str) -> str:
        certificate = self.judged[id].certificate
        return certificate["digest"] if certificate else ""

    def source(self, kernel: Kernel) -> tuple[str, Data]:
        """The module of one kernel and its row of the manifest; raises Rejected unless it is carried."""
        digest = _hash("\n".join(sp.srepr(e) for e in kernel.expressions))
        operations = passes.operations(kernel)
        about = [
            f'"""{EDIT}',
            "",
            f"Proved by: {', '.join(kernel.claims)}.  Operations: {operations}.  SymPy {sp.__version__}.",
            f"Expression: sha256 {digest}.",
            *(f"Certificate of {id}: sha256 {self._digest(id)}." for id in kernel.claims),
            '"""',
        ]
        functions = ", ".join(sorted({function for _, function, _ in passes.letters(kernel)}))
        imports = f"\n\nfrom {printer.FUNCTIONS} import {functions}" if functions else ""
        text = "\n".join(about) + f"{imports}\n\n\n{code(kernel)}"
        roundings = rounding.count(kernel, run(kernel, text), [at(symbol.name) for symbol in kernel.inputs])
        row = {"claims": kernel.claims, "operations": operations, "roundings": roundings}
        row["saved_by"] = passes.saved(kernel)
        row |= {"expression_sha256": digest, "text_sha256": _hash(text)}
        row["inputs"] = [symbol.name for symbol in kernel.inputs]
        if kernel.letters:
            row["letters"] = [[x.name, function, tree(of)] for x, function, of in passes.letters(kernel)]
        row["carriers"] = [carrier.data(self._digest) for carrier in kernel.carriers]
        certificates = {f"{id} {self._digest(id)}": one.certificate or {} for id, one in self.judged.items()}
        row["carriers"] = carriers.completed(row, text, certificates, kernel.name)
        binding.check(row, text, certificates, kernel.name)
        return text, row

    @cached_property
    def files(self) -> dict[str, str]:
        """Every generated file but the fingerprints; raises ArithmeticError if a text computes something else."""
        files, rows = {"__init__.py": package_source(self.kernels)}, dict[str, Data]()
        for kernel in self.kernels:
            try:
                files[f"{kernel.name}.py"], rows[kernel.name] = self.source(kernel)
            except Rejected as error:
                if not (said := str(error)).startswith(f"{kernel.name} "):  # by its text or its carriers
                    said = f"{kernel.name}: {said.replace('the certificate has', 'it makes')}; divide less in it"
                raise ArithmeticError(said) from None
        for name, (derived, values) in self.computed.items():
            if values(files[f"{name}.py"]) != derived:
                raise ArithmeticError(f"the text of {name} does not compute its expression")
        roundings = {name: row["roundings"] for name, row in rows.items()}
        if self.is_ours:
            files |= c_files.build(partial(self.text, files), self.kernels, roundings)
        else:
            files |= c_files.kernels_alone(self.text(files, "chapsym.generated"), self.kernels, self.name, roundings)
        files[MANIFEST] = f'{{\n"sympy": "{sp.__version__}",\n"kernels": {_one_a_line(rows)}\n}}\n'
        return files

    def text(self, files: Mapping[str, str], path: str) -> str:
        """The text of a module of the loops; for generated modules the text that is being built."""
        if path == "chapsym.generated":
            return "\n\n".join(files[f"{kernel.name}.py"] for kernel in self.kernels)
        return Path(__file__).parents[1].joinpath(*path.split(".")[1:]).with_suffix(".py").read_text(encoding="utf-8")

    @cached_property
    def computed(self) -> dict[str, Computed]:
        """The expressions that the kernels compute."""
        return {kernel.name: (fingerprint(kernel), partial(text_fingerprint, kernel)) for kernel in self.kernels}

    @cached_property
    def fingerprints(self) -> dict[str, list[str]]:
        """The values of every kernel, by name."""
        return {name: derived for name, (derived, _) in self.computed.items()}

    def distrusted(self, place: Path) -> dict[str, str]:
        """The kernels whose trusted fingerprints contradict the derivation, with a sentence for each."""
        trusted, problems = stored_fingerprints(place), {}
        for name, value in self.fingerprints.items():
            if name not in trusted:
                problems[name] = f"{name} has no trusted fingerprint; after review: {self.mend} --trust {name}"
            elif trusted[name] != value:
                problems[name] = f"{name} changed its value; if that is meant: {self.mend} --trust {name}"
        return problems

    def check(self, place: Path) -> list[str]:
        """Compares a fresh build with `place`: listing, bytes and values; returns what is wrong."""
        fresh = {name: text.encode() for name, text in self.files.items()}
        there = list(place.iterdir()) if place.is_dir() else []
        found = {p.name: p.read_bytes() for p in there if p.is_file() and p.name != FINGERPRINTS}
        changed = [name for name in sorted(set(fresh) & set(found)) if fresh[name] != found[name]]
        problems = [f"{name} is missing" for name in sorted(set(fresh) - set(found))]
        folders = {p.name for p in there if p.is_dir()} - {"__pycache__"}
        problems += [f"{name} is extra" for name in sorted(set(found) - set(fresh) | folders)]
        problems += [f"{name} is changed" for name in changed]
        for name in changed:
            if name.removesuffix(".py") in self.computed:
                problems += _doubts(name, *self.computed[name.removesuffix(".py")], found[name])
        strangers = sorted(set(stored_fingerprints(place)) - set(self.fingerprints))
        problems += self.distrusted(place).values()
        return problems + [f"the fingerprint of {name} belongs to no kernel" for name in strangers]

    def check_names(self, trust: Sequence[str]) -> None:
        """Raises ValueError if a name in `trust` is not the name of a kernel."""
        names = {"all", *(kernel.name for kernel in self.kernels)}
        for name in trust:
            if name not in names:
                raise ValueError(f"--trust {name}: there is no such kernel; the names are {', '.join(sorted(names))}")

    def generate(self, place: Path, trust: Sequence[str] = ()) -> list[str]:
        """Writes every file into `place` and removes files of former kernels; returns the names written.

        Raises ValueError, before anything is written, if a fingerprint is missing or contradicted and not named in
        `trust` ("all" names every kernel), or if the folder has what no such command has written.  The first
        fingerprints of a folder are trusted.
        """
        self.check_names(trust)
        problems = {} if not (place / FINGERPRINTS).is_file() and not self.is_ours else self.distrusted(place)
        if left := [problem for name, problem in problems.items() if not {name, "all"} & set(trust)]:
            raise ValueError("; ".join(left))
        other = [] if not place.is_dir() else [p for p in place.iterdir() if p.name not in {*self.files, FINGERPRINTS}]
        if strange := sorted(path.name for path in other if path.name != "__pycache__" and not self._is_former(path)):
            raise ValueError(f"{place} has what chapsym codegen has not written, such as {strange[0]}: move it")
        files = {**self.files, FINGERPRINTS: _one_a_line(dict(sorted(self.fingerprints.items()))) + "\n"}
        with alone(place.parent):  # else another command takes its files in the making for former ones
            write(place, files)
            for path in place.iterdir():
                if path.name not in files and self._is_former(path):
                    path.unlink()
        return sorted(files)

    def _is_former(self, path: Path) -> bool:
        """Whether a file is of a former kernel, by its head, or was left by a command that was killed."""
        if not path.is_file():
            return False
        with path.open("rb") as stream:
            headed = path.suffix in (".py", ".c", ".h") and HEAD in stream.read(400)
        return headed or any(path.name.startswith(f".{name}.") for name in (*self.files, FINGERPRINTS))


@cache
def ours() -> Package:
    """The kernels of the ball."""
    return Package()


def folder() -> Path:
    """The folder of the generated package of chapsym: `generated/` of a checkout, or the installed copy."""
    spec = importlib.util.find_spec("chapsym.generated")
    if spec is None or not spec.submodule_search_locations:
        raise FileNotFoundError("the package chapsym.generated is not installed; reinstall chapsym")
    return Path(next(iter(spec.submodule_search_locations))).resolve()  # a checkout has a link there


def is_checkout(place: Path) -> bool:
    """Whether `place` belongs to a source checkout, where the kernels may be written."""
    return (place.parent / "pyproject.toml").is_file()


def code(kernel: Kernel, chosen: tuple[str, ...] = passes.PASSES) -> str:
    """The function of a kernel, with the chosen passes."""
    terms, rest = passes.lower(kernel, chosen)
    # Outputs are named o_... so that an output may share its name with an input (K, in `residual`).
    outputs = [f"o_{name}" for name in kernel.outputs]
    body = ["# letters"] if kernel.letters else []
    for letter, function, of in passes.letters(kernel):
        given = [printer.text(of, chosen)] if function != "pi" else []
        given += [x.name for x in kernel.inputs if x.name not in given]  # these fix the number type
        body.append(f"{letter} = {function}({', '.join(given)})")
    body += ["# intermediate terms"] if terms else []
    body += [f"{symbol} = {printer.text(expr, chosen)}" for symbol, expr in terms]
    body += ["# outputs"]
    body += [f"{name} = {printer.text(expr, chosen)}" for name, expr in zip(outputs, rest, strict=True)]
    body += [f"return {', '.join(outputs)}"]
    matrix = f", the {'×'.join(map(str, kernel.shape))} matrix row by row" if len(kernel.shape) > 1 else ""
    arguments = ", ".join(symbol.name for symbol in kernel.inputs)
    groups = [f"{group}: {', '.join(s.name for s in symbols)}" for group, symbols in kernel.groups]
    returns = f"Returns {', '.join(kernel.outputs)}{matrix}."
    lines = [f'"""{kernel.summary}', "", *groups, returns, '"""', *body]
    return "\n".join([f"def {kernel.name}({arguments}):", *(f"    {line}".rstrip() for line in lines), ""])


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


def stored_fingerprints(place: Path) -> dict[str, list[str]]:
    """The trusted values; empty if there are none.  Raises ValueError for a file with other contents."""
    path = place / FINGERPRINTS
    try:
        found = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    except ValueError:
        found = None
    if not isinstance(found, dict):
        raise ValueError(f"{path} is not what chapsym codegen has written: delete it to trust the values of now")
    return found


def write(place: Path, texts: Mapping[str, str]) -> None:
    """Writes each file whole."""
    place.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        write_text(place / name, text)


def _hash(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _one_a_line(table: Mapping[str, object]) -> str:
    """An object of JSON, one key a line."""
    return "{\n" + ",\n".join(f'"{key}": {json.dumps(value)}' for key, value in table.items()) + "\n}"


def _doubts(what: str, derived: list[str], values: Callable[[str], list[str]], text: bytes) -> list[str]:
    """The differences of a changed text from the derivation, if any."""
    try:
        return [] if values(text.decode()) == derived else [f"{what} computes another value than the derivation"]
    except Exception as error:
        return [f"{what} does not run: {error}"]


DIGITS = 40
#: The prefix of names that replace functions in a text; no kernel may have a name with it.
LETTER = "__letter"


def at(name: str) -> Fraction:
    """The value of a name at the rational point, in (1/2, 3/2): it is seeded from the name."""
    seed = int.from_bytes(hashlib.sha256(name.encode()).digest()[:4], "big") % 1009
    return Fraction(1009 + 2 * seed, 2018)


def decimal(value: Fraction | sp.Rational) -> str:
    """40 significant digits of a rational number."""
    return str(sp.Rational(value).evalf(DIGITS))


@cache
def fingerprint(kernel: Kernel) -> list[str]:
    """The values of the expressions at the rational point, with independent letters, and those of their meanings."""
    point = {symbol: sp.Rational(at(symbol.name)) for symbol in (*kernel.inputs, *kernel.letters)}
    values = [decimal(e.xreplace(point)) for e in kernel.expressions]
    return values + [f"{function} {decimal(of.xreplace(point))}" for _, function, of in letters(kernel)]


def text_fingerprint(kernel: Kernel, text: str) -> list[str]:
    """The values of `fingerprint` from the generated text, run on fractions."""
    found = list[str]()

    def letter(function: str, name: str, *of: Fraction) -> Fraction:
        found.append(f"{function} {decimal(Fraction(1) if function == 'pi' else of[0])}")
        return at(name)

    result = run(kernel, text, letter)(*(at(symbol.name) for symbol in kernel.inputs))
    return [decimal(value) for value in (result if isinstance(result, tuple) else (result,))] + found


def run(kernel: Kernel, text: str, letter: Callable[..., Any] | None = None) -> Callable[..., Any]:
    """The function of a generated module; `letter` gives the value of a letter from its function and name."""
    module = ast.parse(text)
    module.body = [node for node in module.body if not isinstance(node, ast.ImportFrom)]
    for node in ast.walk(module):
        if isinstance(node, ast.Assign) and isinstance(call := node.value, ast.Call):
            call.args[:0] = [ast.Constant(ast.unparse(part)) for part in (call.func, *node.targets)]
            call.func = ast.Name(LETTER, ast.Load())

    scope: dict[str, Any] = {LETTER: letter}
    exec(compile(ast.fix_missing_locations(module), f"{kernel.name}.py", "exec"), scope)  # our own text, never a user's
    return scope[kernel.name]
