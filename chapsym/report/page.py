"""The page: one HTML file that opens from disk, with its style, its script and its formulas inside.

A section that cannot be rendered shows its own error in its place, and the rest of the page stays.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from itertools import groupby
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from . import errata, formulas, graph, notation, symbols
from . import records as reading
from .records import Record
from .source import FEDOROV, Source

FOLDER = Path(__file__).parent / "templates"

#: How many links a list shows before it folds.
_MANY = 8


def html(
    records: Sequence[Record], versions: Mapping[str, str], date: str | None = None, source: Source = FEDOROV
) -> str:
    """The whole page; the same records and versions give the same bytes."""
    page = _Page(records, versions, source)
    sections = {name: both for name, both in SECTIONS.items() if name != "symbols" or source == FEDOROV}
    return page.render(
        "page.html",
        style=Markup((FOLDER / "style.css").read_text(encoding="utf-8")),
        script=Markup((FOLDER / "script.js").read_text(encoding="utf-8")),
        body=[(name, title, page.section(name, title, write)) for name, (title, write) in sections.items()],
        summary=page.section("summary", "Summary", summary),
        versions=versions,
        date=date,
    )


def templates(*folders: Path) -> Environment:
    """The templates of the room, and of more folders."""
    return Environment(
        loader=FileSystemLoader([*folders, FOLDER]), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip


class _Page:
    """The records, and the templates with what they need to show them."""

    def __init__(self, records: Sequence[Record], versions: Mapping[str, str], source: Source = FEDOROV) -> None:
        self.records = records
        self.versions = versions
        self.source = source
        self._templates = templates()
        self._templates.globals |= {
            "VERDICTS": reading.VERDICTS, "MANY": _MANY, "source": source, "ours": source == FEDOROV,
            "point": lambda values: notation.point(values, not source.register),
            "sides": notation.sides, "differing": notation.differing, "reproduce": source.reproduce,
            "truth": reading.truth, "kind": errata.kind, "kinds": reading.kinds, "by_method": by_method,
            "value": notation.value,
        }  # fmt: skip
        self._templates.filters |= {
            "formula": formulas.html,
            "value": value,
            "label": reading.label,
            "code": code,
            "prose": prose,
            "symbols": symbols_html,
            "plain": notation.plain,
        }

    @cached_property
    def uses(self) -> dict[str, list[str]]:
        """What each claim uses."""
        return reading.uses(self.records)

    @cached_property
    def users(self) -> dict[str, list[str]]:
        """What uses each claim."""
        return reading.users(self.records)

    def render(self, template: str, **context: Any) -> Markup:
        """A template of the room's folder, filled in."""
        return Markup(self._templates.get_template(template).render(**context))

    def section(self, name: str, title: str, write: "Callable[[_Page], Markup]") -> Markup:
        """What `write` gives, or a box that says why there is nothing."""
        try:
            return write(self)
        except Exception as error:  # whatever a record or a template does, the rest of the page stays
            return self.render("failure.html", name=name, title=title, error=f"{type(error).__name__}: {error}")


def summary(page: _Page) -> Markup:
    """The counts by verdict."""
    return page.render(
        "summary.html", counts=reading.counts(page.records), total=len(page.records),
        unproved=reading.unproved(page.records), carried=reading.carried(page.records),
    )  # fmt: skip


def errata_table(page: _Page) -> Markup:
    """Every claim that is not true as printed, with what is true."""
    return page.render(
        "errata.html", errors=reading.errors(page.records), cite=page.source.cite(page.versions["chapsym"])
    )


def open_questions(page: _Page) -> Markup:
    """The claims that are open, with what was tried, and those that were open in the paper and are settled."""
    ordered = reading.in_paper_order(page.records)
    return page.render(
        "open.html",
        open=[r for r in ordered if r["verdict"] == "open"],
        settled=[r for r in ordered if r["verdict"] == "settled"],
    )


def dependencies(page: _Page) -> Markup:
    """The graph of what uses what."""
    titles = {record["id"]: record["evidence"]["title"] for record in page.records}
    return page.render("graph.html", graph=graph.svg(page.records), titles=titles)


def claims(page: _Page) -> Markup:
    """Every claim with all its evidence, by section of the paper."""
    found = [(section, [claim(page, one) for one in section.records]) for section in reading.sections(page.records)]
    return page.render("claims.html", sections=found, counts=reading.counts(page.records), total=len(page.records))


def claim(page: _Page, record: Record) -> Markup:
    """A claim with all its evidence; links only to what is on the page."""
    id = record["id"]
    return page.section(
        f"claim-{id}", f"Claim {id}",
        lambda page: page.render(
            "claim.html", record=record, evidence=record["evidence"], uses=page.uses[id], users=page.users[id]
        ),
    )  # fmt: skip


def symbol_table(page: _Page) -> Markup:
    """The table of symbols, the meaning beside the symbol."""
    order = ("paper", "meaning", "where", "chapsym", "unit")
    rows = [symbol._asdict() for symbol in symbols.SYMBOLS]
    return page.render("symbols.html", order=order, rows=rows, text=symbols)


#: The sections of the page: anchor, title, and what writes it.
SECTIONS: dict[str, tuple[str, Callable[[_Page], Markup]]] = {
    "errata": ("Errata", errata_table),
    "open": ("Open questions", open_questions),
    "graph": ("What uses what", dependencies),
    "claims": ("Claims", claims),
    "symbols": ("Symbols", symbol_table),
}


def by_method(checks: Sequence[Mapping[str, Any]]) -> list[tuple[str, list[Mapping[str, Any]]]]:
    """Checks that follow each other with one method, under its name."""
    return [(method, list(those)) for method, those in groupby(checks, lambda check: str(check.get("method", "")))]


def code(text: str) -> Markup:
    """Text with `code` and **emphasis**, as in the Markdown of the same text."""
    parts = re.split(r"`([^`]*)`", text)
    marked = "".join(f"<code>{escape(x)}</code>" if i % 2 else prose(x) for i, x in enumerate(parts))
    return Markup(re.sub(r"\*\*([^*]*)\*\*", r"<b>\1</b>", marked))


_FRACTION = re.compile(r"(\d+)/(\d+)")
#: A hyphen that is a minus sign: not that of n-dimensional or of the claim 5.12-q0.
_MINUS = re.compile(r"(?<![A-Za-z0-9])-(?=[ \dA-Za-zΑ-ω])|-(?=[(⟨¼½√])|(?<=\b[A-Za-z])-(?=[a-z]?\d)")
#: An index, unless it stands in a number, 1.6e7, or in a word, float64.
_INDEX = re.compile(
    r"\d[\d.]*e\d+|(?<![A-Za-z])[A-Za-z]{3,}\d+|_(?:\{([^{}]*)\}|\(([^()]*)\)|([A-Za-z0-9]{1,3}|[α-ω]))|(?<=[A-Za-zΑ-ω𝒟ℰ])(?<!\d-[A-Za-z])(?<!\d-[A-Za-z]{2})(\d+)"
)


def prose(text: str) -> Markup:
    """Plain text with its indices lowered and true minus signs: R_(k+1), C1 - 2."""
    safe = _MINUS.sub("−", str(escape(text))).replace("≠", '<span class="unequal">≠</span>')
    return Markup(_INDEX.sub(_lowered, safe))


def _lowered(found: re.Match[str]) -> str:
    index = next(filter(None, found.groups()), None)
    return found.group() if index is None else f"<sub>{index.replace('-', '−')}</sub>"


def symbols_html(text: str) -> Markup:
    """A list of symbols, each as a formula."""
    return Markup(", ").join(Markup(formulas.mathml(notation.symbol_latex(symbol))) for symbol in text.split(", "))


def value(text: str | notation.Matrix) -> Markup:
    """A value of a point or of a side: text with true minus signs, or a matrix as a formula."""
    shown = notation.value(text) if isinstance(text, str) else text
    if isinstance(shown, str):
        return prose(shown)
    rows = r"\\".join("&".join(_FRACTION.sub(r"\\tfrac{\1}{\2}", entry) for entry in row) for row in shown)
    return Markup(formulas.mathml(rf"\begin{{pmatrix}}{rows}\end{{pmatrix}}"))
