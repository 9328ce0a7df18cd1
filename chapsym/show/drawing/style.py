"""The style of the figures, and their bytes: colours for colour-blind readers, no dates in files."""

import io
import re
import textwrap
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import IO, Any

import numpy as np
from cycler import cycler
from matplotlib import style
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from .reading import RAISED, literal

#: Okabe and Ito's colours.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#F0E442")
#: The largest number of balls with a colour and a name each; more share a colour scale.
FEW = 6
#: The largest number of vertices in a vector layer; with more it is rasterised, so that an SVG stays below 1 MB.
VERTICES = 16_000
#: Width in inches: on a screen of 390 px the letters are still 10 px high.
WIDTH = 5.6
#: Inches of a figure for a desk, with two panels side by side.
WIDE = 10.4
MAP = "viridis"
#: The number of letters that fit below a figure.
LETTERS = 66

#: Changes to the defaults of matplotlib.
STYLE = {
    "font.family": ["DejaVu Sans"], "font.size": 11, "axes.titlesize": 11, "axes.labelsize": 11, "figure.titlesize": 12,
    "xtick.labelsize": 10, "ytick.labelsize": 10, "legend.fontsize": 10, "legend.frameon": False,
    "legend.handlelength": 1.4, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "0.9", "grid.linewidth": 0.8, "axes.axisbelow": True, "axes.formatter.useoffset": False,
    "lines.linewidth": 1.4, "axes.xmargin": 0.02, "axes.edgecolor": "0.3", "svg.hashsalt": "chapsym",
    "axes.prop_cycle": cycler(color=COLOURS), "savefig.dpi": 160,
}  # fmt: skip


@contextmanager
def styled() -> Iterator[None]:
    """A context with matplotlib's defaults and this style, independent of the settings of the user."""
    with style.context(["default", STYLE]):
        yield


def write(figure: Figure, stream: IO[bytes], form: str) -> None:
    """The bytes of a figure, "svg", "png" or "pdf": the same for the same data."""
    with styled(), warnings.catch_warnings():
        # Glyphs that the font lacks are drawn as boxes, for which matplotlib would warn five times.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        metadata = {"svg": ("Date", "Creator"), "png": ("Software",), "pdf": ("CreationDate", "Creator", "Producer")}
        figure.savefig(stream, format=form, metadata=dict.fromkeys(metadata[form]))


class Picture(Figure):
    """A `matplotlib.figure.Figure` with a display of its own."""

    def svg(self) -> str:
        """The figure as an SVG element for an HTML page, as wide as the page allows."""
        stream = io.BytesIO()
        write(self, stream, "svg")
        text = stream.getvalue().decode()
        return text[text.index("<svg") :].replace("<svg ", '<svg style="max-width: 100%; height: auto" ', 1)

    def _repr_svg_(self) -> str:
        return self.svg()


def empty(height: float, width: float = WIDTH) -> Picture:
    """A figure without axes, with this height and width in inches."""
    return Picture(figsize=(width, height), layout="constrained")


def new(
    title: str, rows: int = 1, columns: int = 1, height: float = 3.4, width: float = WIDTH, **options: Any
) -> tuple[Picture, list[Axes]]:
    """An empty figure, `height` inches high for each row, titled, with its axes."""
    figure = empty(height * rows + (0.35 if title else 0.0), width)
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    entitle(figure, title)
    return figure, list(axes.flat)


def entitle(figure: Figure, title: str) -> None:
    """The title of a scene above a figure, as written, in at most two lines."""
    if title:
        lines = textwrap.wrap(" ".join(title.split()), 56, max_lines=2, placeholder=" ...")
        figure.suptitle("\n".join(lines), parse_math=False)
    figure.get_layout_engine().set(w_pad=0.06, h_pad=0.07)  # type: ignore[union-attr, call-arg]


def add_note(figure: Figure, text: str) -> None:
    """Adds a line below the axes of a figure, after earlier notes, or above its legend."""
    if text and figure.legends:
        before = figure.legends[0].get_title().get_text()
        figure.legends[0].set_title("\n".join(filter(None, (before, text))))
        figure.legends[0].get_title().set_fontsize(10)
    elif text:
        figure.supxlabel("\n".join(filter(None, (figure.get_supxlabel(), text))), fontsize=10, color="0.35")


def legend(figure: Figure, axes: Sequence[Axes]) -> None:
    """One legend below the figure, each name once, in as many columns as fit."""
    found = {label: handle for axis in axes for handle, label in zip(*axis.get_legend_handles_labels(), strict=True)}
    if not found:
        return
    lengths = [len(re.sub(r"[${}_]", "", re.sub(r"\\[a-z]+", "", label))) + 5 for label in found]
    rows = 1 if sum(lengths) <= LETTERS else -(-len(found) // max(1, LETTERS // max(lengths)))
    columns, handles = -(-len(found) // rows), list(found.values())
    figure.legend(handles, list(found), loc="outside lower center", ncols=columns, columnspacing=1.2)


def power(size: float) -> tuple[float, str]:
    """The power of ten for short tick labels of values of this size, and its text: (1e-6, "10⁻⁶")."""
    if not np.isfinite(size) or size == 0.0 or 1e-2 <= size < 1e5:
        return 1.0, ""
    exponent = 3 * int(np.floor(np.log10(size) / 3))
    return 10.0**exponent, "10" + str(exponent).translate(RAISED)


def in_power(name: str, units: str, factor: str) -> str:
    """A label with its power of ten and unit: "x, 10⁻⁶ m"."""
    unit = " ".join(filter(None, (factor, literal(units))))
    return f"{name}, {unit}" if unit else name


def at_least(axis: Axes, span: float) -> None:
    """Widens the range of y to `span`, about its middle, so that smaller changes look flat."""
    low, high = axis.get_ylim()
    if high - low < span:
        middle = (low + high) / 2
        axis.set_ylim(middle - span / 2, middle + span / 2)


def colour_bar(mapped: ScalarMappable, axes: Sequence[Axes], label: str) -> None:
    """The meaning of the colours, below some axes."""
    bar = axes[0].figure.colorbar(mapped, ax=axes, location="bottom", aspect=40, pad=0.02, fraction=0.06)
    bar.set_label(label, parse_math=False)
    bar.outline.set_visible(False)


def scale(axes: Sequence[Axes], data: np.ndarray, label: str) -> Any:
    """A colour bar for some values; returns the map from values to colours."""
    finite = data[np.isfinite(data)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    mapped = ScalarMappable(Normalize(low, high if high > low else low + 1.0), MAP)
    colour_bar(mapped, axes, label)
    return mapped.to_rgba
