"""The list of errata, short enough to cite: Markdown, and LaTeX that compiles by itself."""

from collections.abc import Callable, Sequence

from . import notation
from .records import Record, errors, kinds, label, slip_of, truth
from .source import FEDOROV, Source


def markdown(records: Sequence[Record], version: str, source: Source = FEDOROV) -> str:
    """The errata as Markdown, with formulas in dollars."""
    entries = [line for record in errors(records) for line in _markdown_entry(record, source)]
    return "\n".join(["# Errata", "", *_introduction(records, version, source, str), *entries])


def _introduction(records: Sequence[Record], version: str, source: Source, written: Callable[[str], str]) -> list[str]:
    """What stands above the entries, a blank line after each paragraph."""
    by_kind = kinds(records)
    return [
        f"To {written(source.paper)}.",
        "",
        f"{len(errors(records))} of {len(records)} judged claims are not true as printed. {written(source.note)}",
        "",
        *([f"By kind, in our judgement: {by_kind}.", ""] if by_kind else []),
        f"Cite as: {written(source.cite(version))}. Each entry names the command that proves it again.",
        "",
    ]


def kind(record: Record) -> str:
    """What kind of error it is, and from which it follows; empty where no kind is given."""
    name, follows = slip_of(record)
    return f"{name}{', follows from ' if follows else ''}{' and '.join(map(label, follows))}"


def _markdown_entry(record: Record, source: Source) -> list[str]:
    formula, prose = truth(record)
    lines = [f"## {label(record['id'])}", "", record["evidence"]["title"], ""]
    lines += [f"- Kind: {said}"] if (said := kind(record)) else []
    lines.append(f"- Printed: ${record['printed']}$")
    if formula:
        lines.append(f"- True: ${formula}$")
    if prose:
        lines.append(f"- {'Condition' if record['verdict'] == 'conditional' else 'True'}: {prose}")
    lines += [f"- Hypothesis: {text}" for text in record["evidence"].get("hypotheses", [])]
    for example in record["evidence"].get("counterexamples", []):
        named = notation.point(example["point"], not source.register)
        point = ", ".join(f"{symbol} = {notation.plain(value)}" for symbol, value in named)
        for sides in example["printed"]:
            left, right = (", ".join(map(notation.in_line, x)) for x in notation.sides(sides, compact=True))
            lines.append(f"- At `{point}`: `{sides['statement']}`; but `{left} ≠ {right}`")
    return [*lines, f"- Proof: `{source.reproduce(record['id'])}`", ""]


_PREAMBLE = r"""\documentclass[11pt]{article}
\usepackage[margin=25mm]{geometry}
\usepackage{amsmath,amssymb}
\setlength{\parindent}{0pt}
\setlength{\parskip}{3pt}
\raggedright
\begin{document}
"""


def latex(records: Sequence[Record], version: str, source: Source = FEDOROV) -> str:
    """The errata as one LaTeX document in ASCII, for any engine, with amsmath and amssymb."""
    head = [r"\section*{Errata}", *_introduction(records, version, source, notation.latex)]
    entries = [line for record in errors(records) for line in _latex_entry(record, source)]
    return _PREAMBLE + "\n".join([*head, *entries, r"\end{document}", ""])


def _latex_entry(record: Record, source: Source) -> list[str]:
    formula, prose = truth(record)
    title = notation.latex(record["evidence"]["title"])
    name = notation.typed_latex(record["id"]) if source.register else notation.latex(label(record["id"]))
    lines = [r"\medskip", rf"\textbf{{{name}}}. {title}", ""]
    lines += [rf"\textit{{Kind:}} {notation.latex(said)}", ""] if (said := kind(record)) else []
    lines += _row("Printed", record["printed"])
    if formula:
        lines += _row("True", formula)
    if prose:
        name = "Condition" if record["verdict"] == "conditional" else "True"
        lines += [rf"\textit{{{name}:}} {notation.latex(prose)}", ""]
    for text in record["evidence"].get("hypotheses", []):
        lines += [rf"\textit{{Hypothesis:}} {notation.latex(text)}", ""]
    for example in record["evidence"].get("counterexamples", []):
        point = ", ".join(
            f"${notation.symbol_latex(symbol)} = {notation.value_latex(value)}$"
            for symbol, value in notation.point(example["point"], not source.register)
        )
        for sides in example["printed"]:
            both = notation.sides(sides, compact=True)
            left, right = (r",\allowbreak ".join(map(notation.shown_latex, x)) for x in both)
            statement = notation.latex(sides["statement"])
            lines += [rf"\textit{{At}} {point}: {statement}; but ${left}\neq {right}$", ""]
    return [*lines, rf"\textit{{Proof:}} \texttt{{{notation.typed_latex(source.reproduce(record['id']))}}}", ""]


def _row(name: str, formula: str) -> list[str]:
    return [rf"\textit{{{name}:}} $\displaystyle {formula}$", ""]
