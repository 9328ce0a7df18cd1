"""Figures of a result, each drawn only if the result has its variables."""

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from chapsym import files
from chapsym.dynamics import BadInput
from chapsym.dynamics.ball import brief, plain_text

from ..drawing import curves, reading

if TYPE_CHECKING:
    from xarray import Dataset

    from ..drawing.style import Picture

__all__ = ["FORMATS", "available", "draw", "save", "save_all"]

FORMATS = ("svg", "png", "pdf")
#: A figure that results of chapsym do not have, as their balls roll.
SLIP = "slip"


class Kind(NamedTuple):
    """A kind of figure: its function, and one for the reason why a result cannot be drawn, in a sentence, or None.

    curve: whether it is a curve between the frames: of variables that `interpolated` has.  warns: whether it has a note
    if they are too far apart for this.
    """

    draw: "Callable[[Dataset], Picture]"
    missing: "Callable[[Dataset], str | None]"
    curve: bool = False
    warns: bool = False


def _needs(*needed: "tuple[Callable[[Dataset], Any], str]") -> "Callable[[Dataset], str | None]":
    """The needs of a figure, each with the sentence for a result without it."""
    return lambda dataset: next((sentence for there, sentence in needed if not there(dataset)), None)


def _any_of(*names: str) -> "Callable[[Dataset], bool]":
    return lambda dataset: any(name in dataset for name in names)


@cache
def kinds() -> dict[str, Kind]:
    """The kinds of figures by name, the most informative first; their modules, and matplotlib, are imported here."""
    from . import contact, over_time, phase, spheres

    timed = "(and give run.time_step)"
    no_contact = _needs((_any_of("contact"), 'no contact: add "contact" to run.outputs'))
    no_omega = _needs((_any_of("omega"), f'no ω: add "omega" to run.outputs {timed}'))
    no_energy = _needs((_any_of("energy"), f'no energy: add "energy" to run.outputs {timed}'))
    no_attitude = _needs(
        (_any_of("attitude"), 'no attitude: add "attitude" to run.outputs'),
        (lambda data: "quaternion" in data["attitude"].dims, "the attitude is drawn in three dimensions only"),
    )
    no_spread = _needs(
        (lambda data: data.sizes.get("ball", 1) > 2, "a spread needs at least three balls"),
        (_any_of("contact", "gamma"), 'no contact and no γ: add "contact" to run.outputs'),
        (lambda data: (reading.last_frames(data) > 0).sum() > 2, "a spread needs at least three balls that go on"),
    )
    no_phase = _needs(
        (_any_of("phase"), 'no phase: add "phase" to run.outputs (for vertical momentum)'),
        (lambda data: data.sizes["frame"] > 1, "an increment needs two frames"),
    )
    alone = "one ball has one rotation number: sweep a parameter to see it change"
    no_rotation = _needs(
        (_any_of("rotation_number"), 'no rotation number: add "rotation_number" to run.outputs'),
        (lambda data: data.sizes["ball"] > 1, alone),
    )
    return {
        "contact": Kind(contact.draw, no_contact, curve=True, warns=True),
        "spheres": Kind(spheres.draw, spheres.missing, curve=True, warns=True),
        "spread": Kind(over_time.draw_spread, no_spread),
        "rotation": Kind(phase.draw_rotation, no_rotation),
        "phase": Kind(phase.draw_phase, no_phase),
        SLIP: Kind(over_time.draw_slip, _needs((_any_of(SLIP), "slip is of trajectories of other programs"))),
        "omega": Kind(over_time.draw_omega, no_omega, curve=True, warns=True),
        "attitude": Kind(over_time.draw_attitude, no_attitude, curve=True, warns=True),
        "energy": Kind(over_time.draw_energy, no_energy, warns=True),
        "integrals": Kind(over_time.draw_integrals, over_time.no_integrals),
    }


def available(dataset: "Dataset") -> dict[str, str | None]:
    """All figures by name: None if it can be drawn, else the reason, in a sentence."""
    whole = reading.with_balls(dataset)
    return {name: kind.missing(whole) for name, kind in kinds().items() if name != SLIP or name in whole}


def draw(dataset: "Dataset", name: str, ball: str | int | None = None) -> "Picture":
    """A figure of a result, or of one of its balls (its name or index).

    Raises BadInput for an unknown figure or ball, for missing variables, and for a reached frame that is not finite.
    The figure is a matplotlib Figure that notebooks display; pyplot is not used.
    """
    from ..drawing.style import add_note, styled

    if (kind := kinds().get(plain_text(name) or "")) is None:
        raise BadInput(f"there is no figure {brief(name)}; choose of {', '.join(kinds())}")
    chosen = reading.with_balls(dataset, ball)
    if (so_far := reading.unfinished(chosen)) is not None:
        chosen = chosen.assign_attrs(title=f"{so_far}: {reading.title(chosen) or 'a result'}")
    if (reason := kind.missing(chosen)) is not None:
        raise BadInput(f"{name}: {reason}")
    begun = reading.begun(chosen)
    with styled(), np.errstate(over="ignore", invalid="ignore"):  # a damaged frame may have any numbers
        figure = kind.draw(curves.finer(begun) if kind.curve else begun)
        if kind.warns:
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
    """Draws all possible figures, or the named ones, into a folder, which is created; returns the written files.

    Raises BadInput as `draw` does, and CannotWrite if the disk refuses.
    """
    reasons = available(dataset)
    wanted = [name for name, reason in reasons.items() if reason is None] if names is None else names
    drawn = {name: draw(dataset, name) for name in wanted}  # before a folder is made
    files.made(folder)
    written = []
    for name, figure in drawn.items():
        for form in formats:
            written.append(folder / f"{name}.{form}")
            save(figure, written[-1])
    return written
