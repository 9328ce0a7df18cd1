"""The list of errata, short enough to cite: Markdown, and LaTeX that compiles by itself."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from . import notation
from .records import Record, errors, kinds, label, slip_of, truth
from .source import FEDOROV, Source


def markdown(records: Sequence[Record], version: str, source: Source = FEDOROV) -> str:
    """The errata as Markdown, with formulas in dollars."""
    lines = ["# Errata", "", *_introduction(records, version, source, str)]
    for record in errors(records):
        lines += [f"## {label(record['id'])}", "", record["evidence"]["title"], ""]
        lines += [f"- {name}: {f'${text}$' if typed else text}" for name, text, typed in _said(record)]
        for named, statement, left, right in _examples(record, source):
            point = ", ".join(f"{symbol} = {notation.plain(value)}" for symbol, value in named)
            both = " ≠ ".join(", ".join(map(notation.in_line, side)) for side in (left, right))
            lines.append(f"- At `{point}`: `{statement}`; but `{both}`")
        lines += [f"- Proof: `{source.reproduce(record['id'])}`", ""]
    return "\n".join(lines)


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


def _said(record: Record) -> Iterator[tuple[str, str, bool]]:
    """What an entry says, each with its name, and whether it is a formula."""
    formula, words = truth(record)
    condition = "Condition" if record["verdict"] == "conditional" else "True"
    said = [
        ("Kind", kind(record), False), ("Printed", record["printed"], True), ("True", formula, True),
        (condition, words, False), *(("Hypothesis", text, False) for text in record["evidence"].get("hypotheses", [])),
    ]  # fmt: skip
    return filter(lambda one: one[1], said)


def _examples(record: Record, source: Source) -> Iterator[tuple[list[tuple[str, str]], str, Any, Any]]:
    """For each statement that fails at a point: the point, the statement, and what differs of its two sides."""
    for example in record["evidence"].get("counterexamples", []):
        for printed in example["printed"]:
            point = notation.point(example["point"], not source.register)
            yield point, printed["statement"], *notation.sides(printed, compact=True)


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
    lines = [r"\section*{Errata}", *_introduction(records, version, source, notation.latex)]
    for record in errors(records):
        name = notation.typed_latex(record["id"]) if source.register else notation.latex(label(record["id"]))
        lines += [r"\medskip", rf"\textbf{{{name}}}. {notation.latex(record['evidence']['title'])}", ""]
        for name, text, typed in _said(record):
            written = rf"$\displaystyle {text}$" if typed else notation.latex(text)
            lines += [rf"\textit{{{name}:}} {written}", ""]
        for named, statement, left, right in _examples(record, source):
            point = ", ".join(f"${notation.symbol_latex(x)} = {notation.value_latex(value)}$" for x, value in named)
            both = r"\neq ".join(r",\allowbreak ".join(map(notation.shown_latex, side)) for side in (left, right))
            lines += [rf"\textit{{At}} {point}: {notation.latex(statement)}; but ${both}$", ""]
        lines += [rf"\textit{{Proof:}} \texttt{{{notation.typed_latex(source.reproduce(record['id']))}}}", ""]
    return _PREAMBLE + "\n".join([*lines, r"\end{document}", ""])
