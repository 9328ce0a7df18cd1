"""The departure of an engine as curves, and as a page with the curves and one table."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from markupsafe import Markup

from chapsym import files
from chapsym.dynamics.errors import BadInput
from chapsym.show import figures, rendered
from chapsym.show.drawing.style import WIDE, Picture, legend, new, styled

from .judge import LIMITS, UNITS, Case, Convergence, Departure, limit_of, sentence, summary
from .judge_tables import Trajectory

FORMS = (".svg", ".png", ".pdf", ".html")
#: The convergence of the path, and of the attitude.
Known = Mapping[str, Convergence]


def check_output(output: Path) -> None:
    """Raises BadInput for another suffix, and CannotWrite if the file cannot be written."""
    if output.suffix not in FORMS:
        raise BadInput(f"{str(output)!r} must end in {', '.join(FORMS)}")
    files.check_destination(output)


def save(output: Path, case: Case, runs: Sequence[Trajectory], found: Sequence[Departure], known: Known) -> None:
    """Writes the curves, or the page, to what `check_output` takes; raises CannotWrite if the disk refuses."""
    data = {"case": case, "runs": runs, "found": found}
    with styled():
        picture = draw(data)
    if output.suffix == ".html":
        files.write_text(output, _page(case, runs, found, known, picture.svg()))
    else:
        figures.save(picture, output)


def draw(data: files.Data) -> Picture:
    """A panel for each part, a line for each run, over the time after the start; the limit of departure is dotted."""
    case, found = data["case"], data["found"]
    parts = [name for name in UNITS if any(name in one for one in found)]
    title = f"{case.name}: distance from the certified motion"
    figure, axes = new(title, -(-len(parts) // 2), 2, height=2.6, width=WIDE)
    for axis, name in zip(axes, parts, strict=False):
        for run, one in zip(data["runs"], found, strict=True):
            if name in one:
                label = Path(run.file).stem if run.step is None else f"step {run.step:g} s"
                away = one[name][1:]
                axis.plot(case.time[1:], away if name == "height" else np.abs(away), label=label)
        if name in LIMITS:
            axis.axhline(LIMITS[name], color="0.5", linestyle=":", linewidth=1)
        if name == "height":
            axis.axhline(0, color="0.5", linestyle=":", linewidth=1)
            axis.ticklabel_format(axis="y", scilimits=(-2, 3))
        elif any(np.any(line.get_ydata()) for line in axis.lines):  # otherwise nothing can be shown
            axis.set_yscale("log", nonpositive="mask")
        axis.set(ylabel=f"{name}, {UNITS[name]}", xlabel="t, s", xlim=(0, case.time[-1]))
    for axis in axes[len(parts) :]:
        axis.set_visible(False)
    legend(figure, axes)
    return figure


def _page(case: Case, runs: Sequence[Trajectory], found: Sequence[Departure], known: Known, curves: str) -> str:
    return rendered(
        Path(__file__).with_name("judge.html"), title=f"{case.name}: an engine, judged", curves=Markup(curves),
        limits=", ".join(f"{limit_of(name)} ({name})" for name in LIMITS),
        units={name: unit for name, unit in UNITS.items() if any(name in one for one in found)},
        rows=[(Path(run.file).name, run.step, summary(one, case.time)) for run, one in zip(runs, found, strict=True)],
        sentences=[f"{name}: {sentence(one, UNITS[name])}" for name, one in known.items()],
    )  # fmt: skip
