"""Pictures of a result: one module for each kind of figure, each drawn only where its variables are there."""

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from chapsym import files
from chapsym.dynamics import BadInput

from ..drawing import reading

if TYPE_CHECKING:
    from xarray import Dataset

    from ..drawing.style import Picture

__all__ = ["FIGURES", "FORMATS", "available", "draw", "save", "save_all"]

#: The modules, which are the names of the figures, the most telling first.
FIGURES = ("contact", "spheres", "spread", "rotation", "phase", "omega", "attitude", "energy", "integrals")
FORMATS = ("svg", "png", "pdf")
#: Those that are curves between the frames; and those that say so where frames are too far apart for that.
CURVES = ("contact", "spheres", "omega", "attitude")
TELLING = (*CURVES, "energy")


def available(dataset: "Dataset") -> dict[str, str | None]:
    """Every figure by name: None where it can be drawn, else why not, in a sentence."""
    whole = reading.with_balls(dataset)
    return {name: _missing(whole, name) for name in FIGURES}


def draw(dataset: "Dataset", name: str, ball: str | int | None = None) -> "Picture":
    """A figure of a result, or of one of its balls (its name or index).

    Raises BadInput for a figure or ball that is not there, for one whose variables are missing, and where a frame that
    was reached is not finite.  The figure is a matplotlib Figure that notebooks show as it is; pyplot is not touched.
    """
    from ..drawing import curves
    from ..drawing.style import add_note, styled

    if name not in FIGURES:
        raise BadInput(f"there is no figure {name!r}; choose of {', '.join(FIGURES)}")
    chosen = reading.with_balls(dataset, ball)
    so_far = reading.unfinished(chosen)
    if so_far is not None:
        chosen = chosen.assign_attrs(title=f"{so_far}: {chosen.attrs.get('title') or 'a result'}")
    reason = _missing(chosen, name)
    if reason is not None:
        raise BadInput(f"{name}: {reason}")
    begun = reading.begun(chosen)
    with styled():
        figure: Picture = _module(name).draw(curves.finer(begun) if name in CURVES else begun)
        if name in TELLING:
            add_note(figure, curves.note(begun))
    return figure


def save(figure: "Picture", path: Path) -> None:
    """Writes a figure to .svg, .png or .pdf, whole; the same data give the same bytes.

    Raises BadInput and CannotWrite.
    """
    from ..drawing.style import write

    form = path.suffix[1:]
    if form not in FORMATS:
        raise BadInput(f"{str(path)!r}: a figure ends in .svg, .png or .pdf")
    files.write_whole(path, lambda stream: write(figure, stream, form))


def save_all(
    dataset: "Dataset", folder: Path, formats: Sequence[str] = ("svg",), *, names: Sequence[str] | None = None
) -> list[Path]:
    """Draws all figures that can be drawn, or those that are named, into a folder, which is made; the files written.

    Raises BadInput as `draw` does, and CannotWrite if the disk refuses.
    """
    wanted = [name for name, reason in available(dataset).items() if reason is None] if names is None else names
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise files.CannotWrite(f"{folder} cannot be made: {error.strerror or error}") from None
    written = []
    for name in wanted:
        figure = draw(dataset, name)
        for form in formats:
            written.append(folder / f"{name}.{form}")
            save(figure, written[-1])
    return written


def _missing(dataset: "Dataset", name: str) -> str | None:
    """Why a figure cannot be drawn: as its module says, or as the variable of this name is not there."""
    module = _module(name)
    if hasattr(module, "missing"):
        reason: str | None = module.missing(dataset)
        return reason
    return None if name in dataset else str(module.ABSENT)


def _module(name: str) -> Any:
    return import_module(f".{name}", __name__)
