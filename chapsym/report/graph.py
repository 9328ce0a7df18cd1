"""The uses of claims, as an arc diagram: the claims down the left in the order of the paper, an arc for each use.

Plain SVG with class names: the style of the page has the colours, its script highlights.
"""

from collections.abc import Sequence
from pathlib import Path

from jinja2 import Template
from markupsafe import Markup

from .records import Record, sections, uses

WIDTH = 400
_ROW, _HEADING, _LETTER, _MARGIN = 19, 32, 7.9, 4
_TEXT = (Path(__file__).parent / "templates" / "graph.svg").read_text(encoding="utf-8")
_TEMPLATE = Template(_TEXT, autoescape=True, trim_blocks=True, lstrip_blocks=True)


def svg(records: Sequence[Record]) -> Markup:
    """The diagram; an arc runs from a claim to one that uses it, in the colour of the verdict of the first."""
    rows: dict[str, tuple[int, str]] = {}
    headings: list[tuple[int, int]] = []
    y = 0
    for section in sections(records):
        headings.append((y, section.number))
        y += _HEADING
        for record in section.records:
            rows[record["id"]] = y + _ROW // 2, record["verdict"]
            y += _ROW
        y += _MARGIN
    dots = _MARGIN + _LETTER * max(map(len, rows), default=0) + 12
    pairs = [(source, target) for target, those in uses(records).items() for source in those]
    heights = [abs(rows[a][0] - rows[b][0]) for a, b in pairs]
    # A cubic reaches 3/4 of the way to its control points.
    room, reach = (WIDTH - dots - _MARGIN) / 0.75, max(heights, default=1)
    arcs = [(*pair, dots + room * (height / reach) ** 0.5) for pair, height in zip(pairs, heights, strict=True)]
    sizes = {"width": WIDTH, "height": y, "dots": dots, "row": _ROW, "margin": _MARGIN}
    return Markup(_TEMPLATE.render(rows=rows, headings=headings, arcs=arcs, **sizes))


def titles(records: Sequence[Record]) -> dict[str, str]:
    """The title of each claim, which the script of the page shows."""
    return {record["id"]: record["evidence"]["title"] for record in records}
