"""The picture of the layers, drawn from all imports of the packages: `make pictures` runs this; a second."""

import sys
from pathlib import Path

from chapsym import files

PICTURE = Path(__file__).parent / "layers.svg"
ROOT = Path(__file__).parents[2]
WIDTH, HEIGHT, COLUMN, ROW, TOP = 96, 30, 124, 78, 24
STYLE = (
    "rect{fill:#eef3fa;stroke:#4c6a92}text{font:13px sans-serif;text-anchor:middle;fill:#1b2a3d}"
    "path{fill:none;stroke:#8d99a8;stroke-width:1.1;marker-end:url(#a)}"
)


def packages() -> dict[str, set[str]]:
    """Each package, or file directly in chapsym, with those that its files import, lazily or not."""
    sys.path.append(str(ROOT / "tests"))
    from imported import imported, modules

    inside = {"checker", "generated", "proofs"}
    known = modules(ROOT / "chapsym", "chapsym") | {
        name: path for one in inside for name, path in modules(ROOT / one, f"chapsym.{one}").items()
    }
    own = {name: name.split(".")[1] for name in known if "." in name and not name.split(".")[1].startswith("__")}
    found = {package: set[str]() for package in own.values()}
    for name, package in own.items():
        found[package] |= {own[x] for x in imported(name, known[name], known) if x in own} - {package}
    return found


def layers(imports: dict[str, set[str]]) -> list[list[str]]:
    """The packages by their height, one above the highest that they import, each near what it imports."""
    height = dict[str, int]()
    while len(height) < len(imports):
        for one in imports.keys() - height.keys():
            if imports[one] <= height.keys():
                height[one] = 1 + max((height[x] for x in imports[one]), default=0)
    rows: list[list[str]] = [[] for _ in range(max(height.values()))]
    place = dict[str, float]()
    for one in sorted(imports, key=lambda x: (height[x], _middle(imports[x], place), x)):
        rows[height[one] - 1].append(one)
        of = sum(other == height[one] for other in height.values())
        place[one] = (len(rows[height[one] - 1]) - 0.5) / of
    return rows


def _middle(below: set[str], place: dict[str, float]) -> float:
    """The mean place of the packages below, as far as they have one."""
    known = [place[x] for x in below if x in place]
    return sum(known) / len(known) if known else 0.0


def nearest(imports: dict[str, set[str]]) -> dict[str, set[str]]:
    """The imports without those that another one has too: the picture's arrows."""

    def all_of(one: str) -> set[str]:
        return imports[one].union(*(all_of(x) for x in imports[one]))

    return {one: below.difference(*(all_of(x) for x in below)) for one, below in imports.items()}


def drawn() -> str:
    """The picture as SVG."""
    imports = packages()
    rows = layers(imports)
    most = max(map(len, rows))
    wide, high = most * COLUMN + 20, len(rows) * ROW + TOP
    centre = {
        one: (wide * (i + 0.5) / len(row), high - TOP / 2 - (k + 0.5) * ROW)
        for k, row in enumerate(rows)
        for i, one in enumerate(row)
    }
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:g} {high:g}" role="img">',
        "<title>The packages of chapsym in layers, and their imports</title>",
        f"<style>{STYLE}</style>",
        '<defs><marker id="a" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0L8 4L0 8z" style="fill:#8d99a8;stroke:none;marker-end:none"/></marker></defs>',
        f'<rect width="{wide:g}" height="{high:g}" style="fill:#fff;stroke:none"/>',
    ]
    for one, below in sorted(nearest(imports).items()):
        x, y = centre[one][0], centre[one][1] + HEIGHT / 2
        for other in sorted(below):
            u, v = centre[other][0], centre[other][1] - HEIGHT / 2
            parts.append(f'<path d="M{x:g} {y:g}C{x:g} {y + ROW / 3:g} {u:g} {v - ROW / 3:g} {u:g} {v:g}"/>')
    for one, (x, y) in sorted(centre.items()):
        parts.append(f'<rect x="{x - WIDTH / 2:g}" y="{y - HEIGHT / 2:g}" width="{WIDTH}" height="{HEIGHT}" rx="5"/>')
        parts.append(f'<text x="{x:g}" y="{y + 4:g}">{one}</text>')
    return "\n".join([*parts, "</svg>\n"])


if __name__ == "__main__":
    files.write_text(PICTURE, drawn())
