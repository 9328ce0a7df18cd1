"""The figures of the study: one file each, the same bytes for the same data."""

from functools import partial
from io import BytesIO
from pathlib import Path
from typing import IO, Any

from chapsym import files
from chapsym.dynamics import BadInput

#: Okabe and Ito's colours, which the colour-blind tell apart.
BLUE, RED, GREEN, PINK, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
COLOURS = BLUE, RED, GREEN, PINK, ORANGE, SKY
GREY = "0.45"

STYLE = {
    "font.family": ["DejaVu Sans"], "font.size": 11, "axes.titlesize": 11, "axes.labelsize": 11, "legend.fontsize": 9.5,
    "legend.frameon": False, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "0.92", "axes.axisbelow": True, "lines.linewidth": 1.5, "mathtext.fontset": "dejavusans",
    "svg.fonttype": "path", "svg.hashsalt": "chapsym", "axes.formatter.useoffset": False, "axes.titlelocation": "left",
}  # fmt: skip


#: In the order in which they are shown.
NAMES = "staircase", "widths", "digits", "displacement", "numbers"


def save_figures(found: dict[str, Any], folder: Path) -> list[Path]:
    """Writes the figures as SVG, each whole; raises BadInput where the folder cannot be written to."""
    written = []
    for name in NAMES:
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

    from . import drawn_circle, drawn_plateaus

    module = drawn_plateaus if hasattr(drawn_plateaus, name) else drawn_circle
    stream = BytesIO()
    with style.context(["default", STYLE]):
        getattr(module, name)(found).savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def panels(rows: int, columns: int, width: float = 10.4, height: float = 3.7, **options: Any) -> tuple[Any, list[Any]]:
    """A matplotlib figure with axes, so many inches wide and, for each row, high."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height * rows), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)  # type: ignore[union-attr, call-arg]
    return figure, list(figure.subplots(rows, columns, squeeze=False, **options).flat)


def log10(text: str) -> float:
    """The decimal logarithm of |x|, which may be below the range of float64; -inf for 0."""
    from decimal import Decimal

    x = abs(Decimal(text))
    return float(x.log10()) if x else float("-inf")


def scaled(texts: list[str], power: int) -> list[float]:
    """Decimal numbers in units of 10^power."""
    from decimal import Decimal

    return [float(Decimal(x).scaleb(-power)) for x in texts]


def named(case: dict[str, Any], *names: str) -> str:
    """ "J = (1, 2, 4), D = 7, h = 12/5"."""
    told = {"J": "(" + ", ".join(map(str, case["tensor"])) + ")", "D": case["D"], "h": case["height"]}
    return ", ".join(f"{name} = {told[name]}" for name in names or ("J", "D", "h"))


def decimal(text: str) -> str:
    """ "9/20" as "0.45"."""
    from fractions import Fraction

    return f"{float(Fraction(text)):g}"
