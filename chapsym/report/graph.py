"""The uses of claims, as an arc diagram: the claims down the left in the order of the paper, an arc for each use.

Plain SVG with class names: the style of the page has the colours, its script highlights.
"""

from collections.abc import Sequence

from markupsafe import Markup

from .records import Record, sections, uses

WIDTH = 400
_ROW, _HEADING, _LETTER, _MARGIN = 19, 32, 7.9, 4


def svg(records: Sequence[Record]) -> Markup:
    """The diagram; an arc runs from a claim to one that uses it, in the colour of the verdict of the first."""
    rows, headings, height = _rows(records)
    verdicts = {record["id"]: record["verdict"] for record in records}
    dots = _MARGIN + _LETTER * max(map(len, rows), default=0) + 12
    arcs = [(source, target) for target, those in uses(records).items() for source in those]
    reach = max((abs(rows[a] - rows[b]) for a, b in arcs), default=1)
    parts = [Markup('<line class="rule" x1="0" x2="{}" y1="{}" y2="{}"/>').format(WIDTH, y, y) for y, _ in headings]
    parts += [
        Markup('<text class="section" x="{}" y="{}">{}</text>').format(_MARGIN, y + 20, title) for y, title in headings
    ]
    parts += [_arc(a, b, verdicts[a], rows, dots, reach) for a, b in arcs]
    parts += [_node(id, verdicts[id], rows[id], dots) for id in rows]
    return Markup('<svg class="graph" viewBox="0 0 {} {}" role="group" aria-label="{}">{}</svg>').format(
        WIDTH, height, f"{len(rows)} claims and {len(arcs)} uses", Markup("\n").join(parts)
    )


def titles(records: Sequence[Record]) -> dict[str, str]:
    """The title of each claim, which the script of the page shows."""
    return {record["id"]: record["evidence"]["title"] for record in records}


def _rows(records: Sequence[Record]) -> tuple[dict[str, int], list[tuple[int, str]], int]:
    """The height of each claim and of each heading, and the whole height."""
    rows: dict[str, int] = {}
    headings: list[tuple[int, str]] = []
    y = 0
    for section in sections(records):
        headings.append((y, f"Section {section.number}"))
        y += _HEADING
        for record in section.records:
            rows[record["id"]] = y + _ROW // 2
            y += _ROW
        y += _MARGIN
    return rows, headings, y


def _arc(source: str, target: str, verdict: str, rows: dict[str, int], x: float, reach: int) -> Markup:
    start, end = rows[source], rows[target]
    room = WIDTH - x - _MARGIN
    bulge = room / 0.75 * (abs(end - start) / reach) ** 0.5  # a cubic reaches 3/4 of the way to its control points
    return Markup(
        '<path class="arc {}{}" data-from="{}" data-to="{}" d="M{:.1f} {}C{:.1f} {} {:.1f} {} {:.1f} {}">'
        "<title>{} is used by {}</title></path>"
    ).format(
        verdict, "" if end > start else " upwards", source, target,
        x, start, x + bulge, start, x + bulge, end, x, end, source, target,
    )  # fmt: skip


def _node(id: str, verdict: str, y: int, x: float) -> Markup:
    return Markup(
        '<a class="node {}" href="#claim-{}" data-id="{}" aria-label="{}, {}">'
        '<rect x="0" y="{}" width="{:.1f}" height="{}"/><text x="{}" y="{}">{}</text>'
        '<circle cx="{:.1f}" cy="{}" r="3.5"/></a>'
    ).format(verdict, id, id, id, verdict, y - _ROW // 2, x + 8, _ROW, _MARGIN, y + 4, id, x, y)
