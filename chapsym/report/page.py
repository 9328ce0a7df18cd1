"""The page: one HTML file that opens from disk and contains its style, its script and its formulas.

A section that cannot be rendered shows its own error in its place, and the rest of the page stays.
"""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import groupby
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from chapsym.files import Data

from . import errata, formulas, graph, notation, symbols
from . import records as reading
from .records import FEDOROV, Record, Source

FOLDER = Path(__file__).parent / "templates"

_MANY = 8

#: The sections of the page: anchor, title, and template.
SECTIONS = {
    "errata": ("Errata", "errata.html"),
    "open": ("Open questions", "open.html"),
    "graph": ("What uses what", "graph.html"),
    "claims": ("Claims", "claims.html"),
    "symbols": ("Symbols", "symbols.html"),
}


def html(records: Sequence[Record], versions: Mapping[str, str], source: Source = FEDOROV) -> str:
    """The whole page; the same records and versions give the same bytes."""
    page = Page(records, versions, source)
    shown = {name: both for name, both in SECTIONS.items() if name != "symbols" or source == FEDOROV}
    return page.render(
        "page.html", style=style(), script=Markup((FOLDER / "script.js").read_text(encoding="utf-8")),
        body=[(name, title, page.section(name, title, template)) for name, (title, template) in shown.items()],
        summary=page.section("summary", "Summary", "summary.html"),
    )  # fmt: skip


def templates(*folders: Path) -> Environment:
    """The templates of this package, and of more folders."""
    found = Environment(
        loader=FileSystemLoader([*folders, FOLDER]), autoescape=True, undefined=StrictUndefined, trim_blocks=True,
        lstrip_blocks=True,
    )  # fmt: skip
    found.filters["prose"] = prose
    return found


def style(*more: Path) -> Markup:
    """The style of the pages, and more."""
    return Markup("".join(path.read_text(encoding="utf-8") for path in (FOLDER / "style.css", *more)))


class Page:
    """The records, and the templates with their functions."""

    def __init__(self, records: Sequence[Record], versions: Mapping[str, str], source: Source = FEDOROV) -> None:
        self._templates = templates()
        self._templates.globals |= {
            "records": records, "versions": versions, "source": source, "ours": source == FEDOROV, "MANY": _MANY,
            "uses": cache(lambda: reading.uses(records)), "users": cache(lambda: reading.users(records)),
            "claim": self.claim, "reading": reading,
            "graph": graph, "table": symbols, "notation": notation, "errata": errata, "by_method": by_method,
        }  # fmt: skip
        self._templates.filters |= {
            "formula": formulas.html, "value": value, "label": reading.label, "code": code, "symbols": symbols_html,
        }  # fmt: skip

    def render(self, template: str, **context: object) -> Markup:
        """A template of this package, rendered."""
        return Markup(self._templates.get_template(template).render(**context))

    def section(self, name: str, title: str, template: str, **context: object) -> Markup:
        """The section by its template, or a box with the reason why it is missing."""
        try:
            return self.render(template, **context)
        except Exception as error:  # whatever a record or a template does, the rest of the page stays
            return self.render("failure.html", name=name, title=title, error=f"{type(error).__name__}: {error}")

    def claim(self, record: Record) -> Markup:
        """A claim with all its evidence; links only to parts of the page."""
        return self.section(f"claim-{record['id']}", f"Claim {record['id']}", "claim.html", record=record)


def by_method(checks: Sequence[Data]) -> list[tuple[str, list[Data]]]:
    """Successive checks with the same method, under its name."""
    return [(method, list(those)) for method, those in groupby(checks, lambda check: str(check.get("method", "")))]


def code(text: str) -> Markup:
    """Text with `code` and **emphasis**, as in the Markdown of the same text."""
    parts = re.split(r"`([^`]*)`", text)
    marked = "".join(f"<code>{escape(x)}</code>" if i % 2 else prose(x) for i, x in enumerate(parts))
    return Markup(re.sub(r"\*\*([^*]*)\*\*", r"<b>\1</b>", marked))


_FRACTION = re.compile(r"(\d+)/(\d+)")
#: A hyphen that is a minus sign: not that of n-dimensional or of the claim 5.12-q0.
_MINUS = re.compile(r"(?<![A-Za-z0-9])-(?=[ \dA-Za-zΑ-ω])|-(?=[(⟨¼½√])|(?<=\b[A-Za-z])-(?=[a-z]?\d)")
#: An index, unless it is in a number, 1.6e7, or in a word, float64.
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
