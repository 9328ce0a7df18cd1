"""The files of a folder for Rocq: the libraries, the files of each claim, and a Makefile."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from errno import EEXIST
from pathlib import Path

from .claims import Claim
from .names import comment
from .quotients import Data

HERE = Path(__file__).resolve().parent
LIBRARIES = ("Identities", "Points", "Words", "Traces", "Matrices")
#: The head of a file and the suffix of its name, by the library that it needs.
HEADS = {
    "Points": "Require Import Points Identities ZArith List QArith.\nImport ListNotations.\n"
    "Open Scope nat_scope.\nOpen Scope field_of_0.",
    "Traces": 'Set Warnings "-notation-overridden,-ambiguous-paths".\n'
    "From mathcomp Require Import ssreflect ssrfun ssrbool eqtype ssrnat seq ssralg ssrint matrix.\n"
    "Require Import Words Traces.\nImport GRing.Theory.\nOpen Scope ring_scope.",
    "Matrices": "Require Import Matrices QArith List.\nImport ListNotations.\nOpen Scope Q_scope.",
}
ENDINGS = {"Points": "", "Traces": "_words", "Matrices": "_matrices"}


@dataclass
class Written:
    """The number of written statements, and the files by the library that they need, with their theorems."""

    claims: int = 0
    theorems: Counter[str] = field(default_factory=Counter)
    left_out: Counter[str] = field(default_factory=Counter)
    files: dict[str, dict[str, list[str]]] = field(default_factory=lambda: {library: {} for library in HEADS})

    def __str__(self) -> str:
        theorems = ", ".join(f"{n} {sort}" for sort, n in sorted(self.theorems.items(), reverse=True))
        left_out = "; ".join(f"{n}, because {reason}" for reason, n in self.left_out.items()) or "none"
        return (
            f"claims      {self.claims}\n"
            f"theorems    {self.theorems.total()}: {theorems}\n"
            f"statements left out: {left_out}"
        )


def _put(path: Path, text: str) -> None:
    """Writes a file whole, without the rest of chapsym: `python -m rocq` has Python alone."""
    part = path.with_name(f"{path.name}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def former(folder: Path) -> list[Path]:
    """The files of claims that `write` has written to a folder; raises FileExistsError for others of their names."""
    files = sorted(folder.glob("claim_*.v"))
    heads = dict.fromkeys(files, "(* Claim ") | {folder / "Makefile": MAKEFILE[:20], folder / "summary.txt": "claims  "}
    heads |= {folder / f"{library}.v": (HERE / f"{library}.v").read_text("utf-8")[:20] for library in LIBRARIES}
    for path, head in heads.items():
        if path.exists() and not path.read_bytes().startswith(head.encode()):
            raise FileExistsError(EEXIST, "it is not from chapsym prove --rocq: name another folder", str(path))
    return files


def write(certificates: Iterable[Data], folder: Path) -> Written:
    """Writes the files of accepted certificates to a folder; raises OSError if this fails, or as `former` does."""
    folder.mkdir(parents=True, exist_ok=True)
    for stem in (*(path.stem for path in former(folder)), *(f"axioms_{library}" for library in HEADS)):
        for old in folder.glob(f"{stem}.*"):
            old.unlink()
    written = Written()
    for data in certificates:
        claim = Claim(data)
        written.claims += bool(claim.theorems)
        written.theorems += claim.theorems
        written.left_out += claim.left_out
        for library, parts in claim.parts.items():
            name = claim.name + ENDINGS[library]
            begins = [comment(f"Claim {data['claim']}, from its certificate."), HEADS[library]]
            _put(folder / f"{name}.v", "\n\n".join([*begins, *parts]) + "\n")
            if theorems := claim.names.get(library):
                written.files[library][name] = theorems
    for library in LIBRARIES:
        text, path = (HERE / f"{library}.v").read_text(encoding="utf-8"), folder / f"{library}.v"
        if not path.exists() or path.read_bytes() != text.encode():  # unchanged files need not be judged again
            _put(path, text)
    for library, files in written.files.items():
        _put(folder / f"axioms_{library}.v", _axioms(files))
    _put(folder / "summary.txt", f"{written}\n")
    _put(folder / "Makefile", _makefile(written))
    return written


def _axioms(files: dict[str, list[str]]) -> str:
    """A file with which Rocq prints the axioms of all theorems of some files together, which is faster."""
    used = "".join(f"  let _ := {name}.{theorem} in\n" for name, theorems in files.items() for theorem in theorems)
    required = f"Require {' '.join(files)}.\n" if files else ""
    return f"{required}Definition theorems :=\n{used}  tt.\nPrint Assumptions theorems.\n"


def _makefile(written: Written) -> str:
    """Runs Rocq on every file, and prints its findings."""
    lists = "".join(
        f"{library.upper()} := {' '.join(files)}\n$({library.upper()}:%=%.vo): {library}.vo\n"
        f"axioms_{library}.out: $({library.upper()}:%=%.vo)\n"
        for library, files in written.files.items()
    )
    return MAKEFILE.format(lists=lists, everything=" ".join(f"axioms_{library}.out" for library in written.files))


MAKEFILE = """# make -j2: Rocq judges every file, and the axioms of each theorem are counted.

COQC ?= coqc
BEGAN := $(shell date +%s)
.DELETE_ON_ERROR:
.PHONY: judged
judged:

{lists}
judged: {everything}
	@cat summary.txt
	@echo "axioms      $$(cat $^ | grep -v '^Closed under the global context' | sort -u | grep . || echo none)"
	@echo "seconds     $$(($$(date +%s) - $(BEGAN)))"

Points.vo: Identities.vo
Traces.vo: Words.vo

%.vo: %.v
	$(COQC) -q -noglob $<

axioms_%.out: axioms_%.v
	$(COQC) -q -noglob $< > $@
"""
