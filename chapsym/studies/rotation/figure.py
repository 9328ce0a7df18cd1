"""The figures of the study: one file each, the same bytes for the same data."""

from collections.abc import Callable
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import IO, Any

from chapsym import files
from chapsym.dynamics import BadInput

from . import drawn_circle, drawn_plateaus

STYLE = {
    "font.family": ["DejaVu Sans"], "font.size": 11, "axes.titlesize": 11, "axes.labelsize": 11, "legend.fontsize": 9.5,
    "legend.frameon": False, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "0.92", "axes.axisbelow": True, "lines.linewidth": 1.5, "mathtext.fontset": "dejavusans",
    "svg.fonttype": "path", "svg.hashsalt": "chapsym", "axes.formatter.useoffset": False, "axes.titlelocation": "left",
}  # fmt: skip


#: In the order in which they are shown.
FIGURES: dict[str, Callable[[dict[str, Any]], Any]] = {
    "staircase": drawn_plateaus.staircase, "widths": drawn_plateaus.widths, "digits": drawn_plateaus.digits,
    "displacement": drawn_circle.displacement, "numbers": drawn_circle.numbers,
}  # fmt: skip


def save_figures(found: dict[str, Any], folder: Path) -> list[Path]:
    """Writes the figures as SVG, each whole; raises BadInput where the folder cannot be written to."""
    written = []
    for name in FIGURES:
        path, content = folder / f"rotation-{name}.svg", drawn(found, name)
        try:
            files.write_whole(path, partial(_into, content))
        except files.CannotWrite as error:
            raise BadInput(str(error)) from None
        written.append(path)
    return written


def _into(content: bytes, stream: IO[bytes]) -> None:
    stream.write(content)


def drawn(found: dict[str, Any], name: str) -> bytes:
    """A figure as SVG."""
    from matplotlib import style

    stream = BytesIO()
    with style.context(["default", STYLE]):
        FIGURES[name](found).savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()
