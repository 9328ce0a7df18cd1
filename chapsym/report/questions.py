"""The page about the two questions that the paper left open: the answers, their proofs, certificates and evidence."""

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .page import FOLDER, Page, style
from .records import Record

#: claim: its question, in words.
QUESTIONS = {
    "5.9-open": "Does the reduced map preserve an invariant measure?",
    "6-open": "Is there another integral that tends to the energy?",
}

#: The fields of a certificate that are shown after its ball.
GIVEN = ("radius", "half_turns", "digits")


@dataclass(frozen=True)
class Evidence:
    """The findings of a study: its name, a title, sentences, and figures as (caption, SVG text)."""

    name: str
    title: str
    sentences: Sequence[str]
    figures: Sequence[tuple[str, str]] = field(default_factory=list)


@dataclass(frozen=True)
class Checked:
    """A certificate file: its name and content, and the proved numbers, or why the checker rejects it."""

    name: str
    data: Mapping[str, Any]
    proved: Mapping[str, str]
    rejected: str = ""

    def rows(self) -> list[tuple[str, str]]:
        """The rows of the certificate: names and values of its ball and of the proved numbers."""
        given = {name: self.data[name] for name in GIVEN if name in self.data}
        said = {**self.data.get("ball", {}), **given, **self.proved}
        return [(name.replace("_", " "), ", ".join(v) if isinstance(v, list) else v) for name, v in said.items()]


def html(
    records: Sequence[Record], certificates: Sequence[Checked], evidence: Sequence[Evidence], versions: dict[str, str]
) -> str:
    """The whole page; the same input gives the same bytes.

    records: of the two questions and of the lemmas that they use, as `chapsym prove --json` writes them.
    """
    by_id = {record["id"]: record for record in records}
    return Page(records, versions).render(
        "questions.html", style=style(FOLDER / "questions.css"), certificates=certificates,
        questions=[(id, question, by_id[id]) for id, question in QUESTIONS.items() if id in by_id],
        evidence=evidence, lemmas=[record for record in records if record["id"] not in QUESTIONS],
        source_of=lambda svg: "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode(),
    )  # fmt: skip
