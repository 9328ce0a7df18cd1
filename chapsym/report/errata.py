"""The list of errata, short enough to cite: Markdown, LaTeX that compiles by itself, and JSON."""

import hashlib
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from chapsym import files

from . import formulas, notation
from .records import FEDOROV, Record, Source, errors, kinds, label, section, slip_of, slips, truth

FORMAT = "chapsym errata 1"
WITHDRAWN = "withdrawn"

Entry = files.Data
State = files.Data


def markdown(records: Sequence[Record], version: str, source: Source = FEDOROV) -> str:
    """The errata as Markdown, with formulas in dollars."""
    write = {"words": notation.markdown, "formula": "${}$".format, "typed": notation.code}
    lines = ["# Errata", "", *_introduction(records, version, source, notation.markdown)]
    for record in errors(records):
        lines += [
            f"## {notation.markdown(label(record['id']))}",
            "",
            notation.markdown(record["evidence"]["title"]),
            "",
        ]
        lines += [f"- {name}: {write[sort](text)}" for name, text, sort in _said(record)]
        for named, statement, sign, left, right in _examples(record, source):
            point = ", ".join(f"{symbol} = {notation.plain(value)}" for symbol, value in named)
            both = f"{sign} ".join(", ".join(map(notation.in_line, side)) for side in (left, right))
            lines.append("- At {}: {}; but {}".format(*map(notation.code, (point, statement, both))))
        lines += [f"- Proof: {notation.code(source.reproduce(record['id']))}", ""]
    return "\n".join(lines)


def _introduction(records: Sequence[Record], version: str, source: Source, written: Callable[[str], str]) -> list[str]:
    """The text above the entries, a blank line after each paragraph."""
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
    """The kind of error, and the error from which it follows; empty if no kind is given."""
    name, follows = slip_of(record)
    return f"{name}{', follows from ' if follows else ''}{' and '.join(map(label, follows))}"


def _said(record: Record) -> Iterator[tuple[str, str, str]]:
    """The parts of an entry, each with its name and sort: a formula, typed text that is not read as one, or words."""
    formula, words = truth(record)
    printed, true = ("formula" if formulas.is_whole(text) else "typed" for text in (record["printed"], formula))
    condition = "Condition" if record["verdict"] == "conditional" else "True"
    said = [
        ("Kind", kind(record), "words"), ("Printed", record["printed"], printed), ("True", formula, true),
        (condition, words, "words"),
        *(("Hypothesis", text, "words") for text in record["evidence"].get("hypotheses", [])),
    ]  # fmt: skip
    return filter(lambda one: one[1], said)


def _examples(record: Record, source: Source) -> Iterator[tuple[list[tuple[str, str]], str, str, Any, Any]]:
    """For each statement that fails at a point: the point, the statement, its sign, what differs of its two sides."""
    for example in record["evidence"].get("counterexamples", []):
        for printed in example["printed"]:
            point = notation.point(example["point"], not source.register)
            yield point, printed["statement"], notation.sign(printed), *notation.sides(printed, compact=True)


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
    write = {"words": notation.latex, "formula": notation.formula_latex, "typed": notation.code_latex}
    lines = [r"\section*{Errata}", *_introduction(records, version, source, notation.latex)]
    for record in errors(records):
        name = notation.typed_latex(record["id"]) if source.register else notation.latex(label(record["id"]))
        lines += [r"\medskip", rf"\textbf{{{name}}}. {notation.latex(record['evidence']['title'])}", ""]
        for name, text, sort in _said(record):
            lines += [rf"\textit{{{name}:}} {write[sort](text)}", ""]
        for named, statement, sign, left, right in _examples(record, source):
            point = ", ".join(f"${notation.symbol_latex(x)} = {notation.value_latex(value)}$" for x, value in named)
            shown, other = (r",\allowbreak ".join(map(notation.shown_latex, side)) for side in (left, right))
            words = notation.latex(", ".join(map(notation.in_line, right)))
            both = rf"${shown}\neq {other}$" if sign == " ≠" else f"${shown}${sign} {words}"
            lines += [rf"\textit{{At}} {point}: {notation.latex(statement)}; but {both}", ""]
        lines += [rf"\textit{{Proof:}} {notation.code_latex(source.reproduce(record['id']))}", ""]
    return _PREAMBLE + "\n".join([*lines, r"\end{document}", ""])


# As data: each entry with its counterexamples, its users, and its states by release, as in `docs/errata.schema.json`.
# An entry keeps its earlier states if the same file is written again.


class NotErrata(ValueError):
    """A text is not a list of errata as `data` writes it."""


def data(records: Sequence[Record], version: str, earlier: Mapping[str, Entry], source: Source = FEDOROV) -> str:
    """The errata as JSON; `earlier` are the entries of the file that this one replaces, see `entries`."""
    current = [_with_states(_entry(record, source), record["verdict"], earlier, version) for record in errors(records)]
    document = {
        "format": FORMAT,
        "paper": source.paper,
        "note": source.note,
        "cite": source.cite(version),
        "chapsym": version,
        "claims": len(records),
        "kinds": {
            kind: {"entries": number, "independent": independent}
            for kind, (number, independent) in slips(records).items()
        },
        "errata": current,
        "withdrawn": _withdrawn(earlier, {entry["id"] for entry in current}, version),
    }
    return json.dumps(document, ensure_ascii=False, indent=1) + "\n"


def entries(written: str) -> dict[str, Entry]:
    """The entries of a list that `data` wrote, withdrawn ones too, by id; raises NotErrata if it is none."""
    try:
        document = json.loads(written)
        if document["format"] != FORMAT:
            raise NotErrata(f"its format is {document['format']!r}, not {FORMAT!r}")
        found = {entry["id"]: entry for entry in [*document["errata"], *document["withdrawn"]]}
        for entry in found.values():
            _ = entry["states"][-1], [(state["since"], state["verdict"], state["digest"]) for state in entry["states"]]
    except NotErrata:
        raise
    except (ValueError, LookupError, TypeError, RecursionError) as error:
        raise NotErrata("it is no list of errata") from error
    return found


def _entry(record: Record, source: Source) -> Entry:
    """The parts of an entry without its states."""
    formula, prose = truth(record)
    number, title = section(record) or (None, None)
    conditional = record["verdict"] == "conditional"
    kind, follows = slip_of(record)
    return {
        "id": record["id"],
        "label": label(record["id"]),
        "section": number,
        "section_title": title,
        "title": record["evidence"]["title"],
        "kind": kind or None,
        "follows": follows,
        "printed": record["printed"],
        "true": formula or None,
        "condition": prose or None if conditional else None,
        "true_in_words": None if conditional else prose or None,
        "hypotheses": record["evidence"].get("hypotheses", []),
        "counterexamples": [_example(example, source) for example in record["evidence"].get("counterexamples", [])],
        "downstream": record["evidence"].get("downstream", []),
        "proof": source.reproduce(record["id"]),
    }


def _example(example: files.Data, source: Source) -> files.Data:
    """An exact point, and both sides of the printed statement there."""
    named = notation.point(example["point"], not source.register)
    printed = []
    for one in example["printed"]:
        left, right = ([notation.in_line(value) for value in side] for side in notation.sides(one))
        printed.append({"statement": one["statement"], "left": left, "right": right})
    return {"point": {symbol: notation.plain(value) for symbol, value in named}, "printed": printed}


def _with_states(entry: Entry, verdict: str, earlier: Mapping[str, Entry], version: str) -> Entry:
    digest = hashlib.sha256(files.encoded(json.dumps(entry, ensure_ascii=False, sort_keys=True))).hexdigest()[:16]
    before = earlier.get(entry["id"], {}).get("states", [])
    return entry | {"states": _states(before, verdict, digest, version)}


def _withdrawn(earlier: Mapping[str, Entry], current: set[str], version: str) -> list[Entry]:
    """The entries of a release that are no longer errors."""
    return [
        entry | {"states": _states(entry["states"], WITHDRAWN, entry["states"][-1]["digest"], version)}
        for id, entry in earlier.items()
        if id not in current and any(state["since"] != version for state in entry["states"])
    ]


def _states(earlier: list[State], verdict: str, digest: str, version: str) -> list[State]:
    """The states with the newest last: a new state is added, or replaces another one of the same release."""
    released = [state for state in earlier if state["since"] != version]
    for known in (earlier, released):
        if known and (known[-1]["verdict"], known[-1]["digest"]) == (verdict, digest):
            return known
    return [*released, {"version": len(released) + 1, "since": version, "verdict": verdict, "digest": digest}]
