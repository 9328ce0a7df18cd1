"""Writes the LaTeX source of the note from the register and the certificates: python docs/note/make.py FOLDER."""

import re
import shutil
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from chapsym import checker, files
from chapsym.proofs.open import certified, energy, measure, readings
from chapsym.prove import prove_all
from chapsym.report.notation import latex as typeset
from chapsym.report.notation import typed_latex

HERE = Path(__file__).parent
LEMMAS = tuple({**measure.LEMMAS, **energy.LEMMAS})


def main(folder: Path, records: Sequence[dict[str, Any]] | None = None) -> None:
    """Writes note.tex and what it reads; records: of the lemmas and the questions, made now if they are not given."""
    folder.mkdir(parents=True, exist_ok=True)
    made = {record["id"]: record for record in records or prove_all([*LEMMAS, *readings.READINGS])}
    if failed := [id for id, record in made.items() if record["verdict"] not in ("holds", "settled")]:
        sys.exit(f"not proved: {', '.join(failed)}; the note has proved statements only")
    texts = {
        "lemmas": "\n".join(_lemma(made[id]) for id in LEMMAS),
        "theorems": "\n".join(_question(made[id]) for id in readings.READINGS),
        "numbers": _numbers(),
    }
    for name, text in texts.items():
        files.write_whole(folder / f"{name}.tex", lambda stream, text=text: stream.write(text.encode("ascii")))
    shutil.copy(HERE / "note.tex", folder)
    shutil.copy(HERE.parent / "references.bib", folder)


def _lemma(record: dict[str, Any]) -> str:
    """What a lemma says, and its proof."""
    evidence = record["evidence"]
    name = typed_latex(record["id"])
    lines = [rf"\begin{{lemma}}[\texttt{{{name}}}]\label{{lem:{record['id']}}}", latex(evidence["title"])]
    lines += [rf"\begin{{quote}}\raggedright {_breakable(record['printed'])}\end{{quote}}"]
    lines += ["Throughout:", *_list(map(latex, evidence["hypotheses"]))] if evidence["hypotheses"] else []
    for stated in evidence["theorems"]:
        lines += _stated(stated)
    uses = ", ".join(rf"Lemma~\ref{{lem:{id}}}" if id in LEMMAS else typed_latex(id) for id in evidence["uses"])
    return "\n".join([*lines, r"\end{lemma}", *_proof(record, f"It uses {uses}." if uses else "")])


def _breakable(formula: str) -> str:
    """A formula that may be longer than a line: its words stand outside of mathematics."""
    return re.sub(r"\\text\{([^{}]*)\}", r"$ \1 $\\displaystyle ", rf"$\displaystyle {formula}$")


def latex(text: str) -> str:
    """A text as LaTeX, with breaks after commas: numbers may be long."""
    return typeset(text).replace(", ", r",\allowbreak{} ")


def _question(record: dict[str, Any]) -> str:
    """The words of the paper, the theorems of its readings, what is open, and the proof of its own parts."""
    evidence = record["evidence"]
    words, where = readings.QUESTIONS[record["id"]]
    lines = [
        r"\begin{quote}",
        f"``{latex(words.strip('“”'))}'' ({latex(where)} of \\cite{{fedorov2007}})",
        r"\end{quote}",
    ]
    for row in evidence["readings"]:
        if row["theorem"]:
            lines += [rf"\begin{{theorem}}[{{{row['answer']}: {latex(row['asked'])}}}]"]
            lines += _stated(row["theorem"])
            by = (rf"Lemma~\ref{{lem:{id}}}" if id in LEMMAS else latex(f"part {id}") for id in row["by"])
            lines += [r"\end{theorem}", rf"\begin{{proof}} By {', '.join(by)}. \end{{proof}}"]
    left = (latex(row["asked"]) for row in evidence["readings"] if not row["theorem"])
    lines += ["Open are these readings:", *_list(left)]
    counted = latex(evidence["settled"]["text"].partition("; in the proofs")[0])
    return "\n".join([*lines, *_proof(record, f"Of the parts; with the lemmas, {counted}.")])


def _stated(theorem: dict[str, Any]) -> list[str]:
    """The quantifiers, then hypotheses and conclusions as lists."""
    lines = [latex(f"{text[:1].upper()}{text[1:]}:") for text in theorem["quantifiers"]]
    given = theorem["hypotheses"]
    lines += ["suppose that" if lines else "Suppose that", *_list(map(latex, given))] if given else []
    begins = "Then" if given else "it holds that" if lines else "It holds that"
    return [*lines, begins, *_list(map(latex, theorem["conclusions"]))]


def _list(items: Iterable[str]) -> list[str]:
    return [r"\begin{itemize}", *(rf"\item {item}" for item in items), r"\end{itemize}"]


def _proof(record: dict[str, Any], first: str) -> list[str]:
    """The derivation without its controls: sentences as paragraphs, what is decided, what follows, what is shown."""
    lines, said = [r"\begin{proof}", first], list[str]()
    for line in [*record["evidence"]["derivation"], "  end"]:
        marked = line.startswith(("  ✓ ", "  ⊢ ", "  control: ", "  second route: ", "    ", "  end"))
        if not marked or (line.startswith("   ") and " = " not in line):
            said.append(line)
            continue
        lines += [latex(" ".join(said))] if said else []
        said.clear()
        if line.startswith("  ✓ "):
            lines.append(rf"\decided{{{latex(line[4:].removeprefix('printed: ').removeprefix('second route: '))}}}")
        elif line.startswith("  ⊢ "):
            lines.append(rf"\follows{{{latex(line[4:])}}}")
        elif line.startswith("    "):
            lines.append(rf"\begin{{quote}}\small {latex(line)}\end{{quote}}")
        elif line.startswith("  second"):
            lines.append(latex(f"A second proof: {line.partition(': ')[2]}."))
    return [*lines, r"\end{proof}", ""]


def _numbers() -> str:
    """Every certificate: its ball, and the sentence that the checker accepts."""
    rows = []
    for file in sorted(certified.FOLDER.glob("*.json")):
        data = checker.read(file)
        rows.append(rf"\texttt{{{typed_latex(file.stem)}}} & {latex(checker.check(data).statement)} \\")
    return "\n".join([r"\begin{longtable}{p{.3\linewidth}p{.62\linewidth}}", *rows, r"\end{longtable}", ""])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
