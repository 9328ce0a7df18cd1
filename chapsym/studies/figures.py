"""The figures of the studies, in the style of `chapsym show`."""

from collections.abc import Callable, Mapping
from importlib import import_module
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


def save_figures(package: str, drawn: Mapping[str, str], found: dict[str, Any], folder: Path) -> list[Path]:
    """The figures of a study by the names of their files; raises BadInput where the folder cannot be written to.

    drawn: what draws each, a function in a module of the study's package, "module:function".
    """
    try:
        for name, where in drawn.items():
            module, _, function = where.partition(":")
            save_figure(getattr(import_module(f"{package}.{module}"), function), found, folder / name)
    except files.CannotWrite as error:
        raise BadInput(str(error)) from None
    return [folder / name for name in drawn]
