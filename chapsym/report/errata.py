"""The list of errata, short enough to cite: Markdown, and LaTeX that compiles by itself."""

from collections.abc import Callable, Sequence

from . import notation
from .records import Record, errors, label, truth

PAPER = "Yu.N. Fedorov, A Discretization of the Nonholonomic Chaplygin Sphere Problem, SIGMA 3 (2007), 044"
NOTE = (
    "Equations are named as in the paper, with a word for a display or a statement beside them. "
    "Each counterexample is exact: all hypotheses hold at the point, and the two sides of what is printed differ. "
    "There J is always the mass tensor of Sections 4 and 5, so that Λ = diag(J2+J3+D, J1+J3+D, J1+J2+D), "
    "and an index k-1, k, k+1 is the time."
)


def cite(version: str) -> str:
    """How to cite the list."""
    return f"Errata to SIGMA 3 (2007), 044, computed by chapsym {version}"


def reproduce(id: str) -> str:
    """The command that proves an entry again."""
    return f"chapsym prove {id} --explain"


def markdown(records: Sequence[Record], version: str) -> str:
    """The errata as Markdown, with formulas in dollars."""
    entries = [line for record in errors(records) for line in _markdown_entry(record)]
    return "\n".join(["# Errata", "", *_introduction(records, version, str), *entries])


def _introduction(records: Sequence[Record], version: str, written: Callable[[str], str]) -> list[str]:
    """What stands above the entries, a blank line after each paragraph."""
    return [
        f"To {written(PAPER)}.",
        "",
        f"{len(errors(records))} of {len(records)} judged claims are not true as printed. {written(NOTE)}",
        "",
        f"Cite as: {written(cite(version))}. Each entry names the command that proves it again.",
        "",
    ]


def _markdown_entry(record: Record) -> list[str]:
    formula, prose = truth(record)
    lines = [f"## {label(record['id'])}", "", record["evidence"]["title"], ""]
    lines.append(f"- Printed: ${record['printed']}$")
    if formula:
        lines.append(f"- True: ${formula}$")
    if prose:
        lines.append(f"- {'Condition' if record['verdict'] == 'conditional' else 'True'}: {prose}")
    for example in record["evidence"].get("counterexamples", []):
        point = ", ".join(f"{symbol} = {notation.plain(value)}" for symbol, value in notation.point(example["point"]))
        for sides in example["printed"]:
            left, right = (", ".join(map(notation.in_line, x)) for x in notation.sides(sides, compact=True))
            lines.append(f"- At `{point}`: `{sides['statement']}`; but `{left} ≠ {right}`")
    return [*lines, f"- Proof: `{reproduce(record['id'])}`", ""]


_PREAMBLE = r"""\documentclass[11pt]{article}
\usepackage[margin=25mm]{geometry}
\usepackage{amsmath,amssymb}
\setlength{\parindent}{0pt}
\setlength{\parskip}{3pt}
\raggedright
\begin{document}
"""


def latex(records: Sequence[Record], version: str) -> str:
    """The errata as one LaTeX document in ASCII, for any engine, with amsmath and amssymb."""
    head = [r"\section*{Errata}", *_introduction(records, version, notation.latex)]
    entries = [line for record in errors(records) for line in _latex_entry(record)]
    return _PREAMBLE + "\n".join([*head, *entries, r"\end{document}", ""])


def _latex_entry(record: Record) -> list[str]:
    formula, prose = truth(record)
    title = notation.latex(record["evidence"]["title"])
    lines = [r"\medskip", rf"\textbf{{{notation.latex(label(record['id']))}}}. {title}", ""]
    lines += _row("Printed", record["printed"])
    if formula:
        lines += _row("True", formula)
    if prose:
        name = "Condition" if record["verdict"] == "conditional" else "True"
        lines += [rf"\textit{{{name}:}} {notation.latex(prose)}", ""]
    for example in record["evidence"].get("counterexamples", []):
        point = ", ".join(
            f"${notation.symbol_latex(symbol)} = {notation.value_latex(value)}$"
            for symbol, value in notation.point(example["point"])
        )
        for sides in example["printed"]:
            both = notation.sides(sides, compact=True)
            left, right = (r",\allowbreak ".join(map(notation.shown_latex, x)) for x in both)
            statement = notation.latex(sides["statement"])
            lines += [rf"\textit{{At}} {point}: {statement}; but ${left}\neq {right}$", ""]
    return [*lines, rf"\textit{{Proof:}} \texttt{{{reproduce(record['id']).replace('--', '-{}-')}}}", ""]


def _row(name: str, formula: str) -> list[str]:
    return [rf"\textit{{{name}:}} $\displaystyle {formula}$", ""]
