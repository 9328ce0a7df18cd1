"""The figures of the studies, in the style of `chapsym show`."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from chapsym import files
from chapsym.dynamics import BadInput
from chapsym.show.drawing.style import Picture, styled, write

#: Draws what a study found.
Draw = Callable[[dict[str, Any]], Picture]


def save_figure(draw: Draw, found: dict[str, Any], path: Path) -> None:
    """Draws a figure and writes it whole, the same bytes for the same data; raises CannotWrite if the disk refuses."""
    with styled():
        figure = draw(found)
    files.write_whole(path, lambda stream: write(figure, stream, path.suffix[1:]))


def save_figures(draw: Mapping[str, Draw], found: dict[str, Any], folder: Path) -> list[Path]:
    """The figures of a study by the names of their files; raises BadInput where the folder cannot be written to."""
    try:
        for name, one in draw.items():
            save_figure(one, found, folder / name)
    except files.CannotWrite as error:
        raise BadInput(str(error)) from None
    return [folder / name for name in draw]
