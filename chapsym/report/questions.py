"""The page about the two questions that the paper left open: the answers, their proofs, certificates and evidence."""

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from markupsafe import Markup

from . import page
from .page import FOLDER
from .records import Record

#: claim: what it asks, in words.
QUESTIONS = {
    "5.9-open": "Does the reduced map preserve an invariant measure?",
    "6-open": "Is there another integral that tends to the energy?",
}

#: What a certificate says about itself, beside its ball.
GIVEN = ("radius", "half_turns", "digits")


@dataclass(frozen=True)
class Evidence:
    """What a study found: its name, a title, sentences, and figures as (caption, SVG text)."""

    name: str
    title: str
    sentences: Sequence[str]
    figures: Sequence[tuple[str, str]] = field(default_factory=list)


@dataclass(frozen=True)
class Checked:
    """A certificate file: its name and content, and the numbers that are proved; or why the checker rejects it."""

    name: str
    data: Mapping[str, Any]
    proved: Mapping[str, str]
    rejected: str = ""


def html(
    records: Sequence[Record],
    certificates: Sequence[Checked],
    evidence: Sequence[Evidence],
    versions: Mapping[str, str],
) -> str:
    """The whole page; the same input gives the same bytes.

    records: of the two questions and of the lemmas that they use, as `chapsym prove --json` writes them.
    """
    found = page._Page(records, versions)
    style = "".join((FOLDER / name).read_text(encoding="utf-8") for name in ("style.css", "questions.css"))
    return found.render(
        "questions.html", style=Markup(style), questions=_questions(found),
        certificates=list(map(_shown, certificates)),
        evidence=[{"title": e.title, "name": e.name, "sentences": e.sentences, "figures": list(map(_figure, e.figures))}
                  for e in evidence],
        lemmas=[page.claim(found, record) for record in records if record["id"] not in QUESTIONS], versions=versions,
    )  # fmt: skip


def _questions(found: Any) -> list[dict[str, Any]]:
    by_id = {record["id"]: record for record in found.records}
    return [
        {"id": id, "question": question, "record": by_id[id], "shown": page.claim(found, by_id[id])}
        for id, question in QUESTIONS.items()
        if id in by_id
    ]


def _shown(checked: Checked) -> dict[str, Any]:
    """A certificate as rows of names and values."""
    data = checked.data
    given = {**data.get("ball", {}), **{name: data[name] for name in GIVEN if name in data}, **checked.proved}
    rows = [(name.replace("_", " "), ", ".join(v) if isinstance(v, list) else v) for name, v in given.items()]
    return {
        "name": checked.name, "statement": data.get("statement", ""), "rows": rows, "rejected": checked.rejected,
    }  # fmt: skip


def _figure(figure: tuple[str, str]) -> dict[str, str]:
    caption, svg = figure
    return {"caption": caption, "source": "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()}
