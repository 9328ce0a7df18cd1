"""The page itself: data, style, scripts and three.js in one file."""

import base64
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from xarray import Dataset

from chapsym import files
from chapsym.scene.result.far import sentence

from .motion import Motion, ReportError, Rolling, motion

FOLDER = Path(__file__).parent
#: What a script imports: its file.  three.js imports its core by a relative path, which no data: URL has.
MODULES = {
    "three": "three/three.module.min.js",
    "three-core": "three/three.core.min.js",
    "eye": "eye.js",
    "motion": "motion.js",
    "ball": "ball.js",
    "floor": "floor.js",
    "stage": "stage.js",
}
CORE = '"./three.core.min.js"'


def write_page(dataset: Dataset, path: str | Path, *, balls: Sequence[str | int] | None = None) -> None:
    """Writes a result as an interactive page: the balls rolling in 3D, in one HTML file that needs no network.

    dataset: with attitude, radius and, to see them roll, contact.  balls: names or indices, at most 20; the first by
    default.  Raises ReportError if the result lacks what is needed, or the file cannot be written.
    """
    text = html(dataset, balls=balls)
    try:
        files.write_whole(Path(path), lambda stream: stream.write(text.encode()))
    except files.CannotWrite as error:
        raise ReportError(str(error)) from None


def html(dataset: Dataset, *, balls: Sequence[str | int] | None = None) -> str:
    """The text of the page; the same result gives the same bytes.  Raises ReportError as `write_page` does."""
    found = motion(dataset, balls)
    data = {"clock": _base64(found.clock, "<f8"), "unit": found.unit, "balls": list(map(_ball, found.balls))}
    templates = Environment(
        loader=FileSystemLoader(FOLDER),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return templates.get_template("page.html").render(
        title=str(dataset.attrs.get("title") or "A rolling ball"),
        plan=_plan_line(dataset, found),
        notes=_notes(found),
        far=sentence(dataset),
        between=found.between,
        balls=found.balls,
        rolls="contact" in dataset,
        vectors=[name for name in ("gamma", "omega", "momentum") if any(name in ball.vectors for ball in found.balls)],
        ellipsoid=any(ball.inertia is not None for ball in found.balls),
        style=Markup(_text("page.css")),
        script=Markup(_text("page.js")),
        modules=Markup(_json({"imports": {name: _module(file) for name, file in MODULES.items()}})),
        data=Markup(_json(data)),
        licence=Markup(_text("three/LICENSE").replace("--", "—")),
    )


def _plan_line(dataset: Dataset, found: Motion) -> str:
    """The model, the steps or frames, and the time."""
    parts = [f"model: {dataset.attrs['model']}"] if dataset.attrs.get("model") else []
    span = dataset["time"].values[-1] if found.unit == "s" else found.clock[-1]
    if "step" in dataset.coords and "accuracy" not in dataset.attrs:  # else the steps are no more than a clock
        count = int(dataset["step"].values[-1])
        steps = f"{count} step{'' if count == 1 else 's'}"
        parts.append(f"{steps} of {span / count:.6g} s" if found.unit == "s" and count else steps)
    else:
        parts.append(f"{dataset.sizes['frame']} frames" + (f" in {span:.6g} s" if found.unit == "s" else ""))
    return " · ".join(parts + ([f"{len(found.balls)} balls"] if len(found.balls) > 1 else []))


def _notes(found: Motion) -> list[str]:
    """What the page must say, of single balls under their names, of all of them once."""
    told = [note for ball in found.balls for note in ball.notes]
    common = [note for note in dict.fromkeys(told) if told.count(note) == len(found.balls)]
    single = [f"{ball.name}: {note}" for ball in found.balls for note in ball.notes if note not in common]
    return [*found.notes, *common, *single]


def _ball(ball: Rolling) -> dict[str, Any]:
    """Rotations and vectors in float32; contact points in float64: the ball may be far away."""
    vectors = {name: _base64(array, "<f4") for name, array in ball.vectors.items()}
    return {
        "name": ball.name,
        "radius": ball.radius,
        "attitude": _base64(ball.attitude, "<f4"),
        "turn": None if ball.turn is None else _base64(ball.turn, "<f4"),
        "contact": _base64(ball.contact, "<f8"),
        "vectors": vectors,
        "inertia": None if ball.inertia is None else ball.inertia.tolist(),
        "axes": None if ball.axes is None else ball.axes.tolist(),
        "stops": any(note.startswith("it stops") for note in ball.notes),
    }


def _base64(array: np.ndarray, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(array, dtype=kind).tobytes()).decode("ascii")


def _module(file: str) -> str:
    text = _text(file)
    if file == MODULES["three"]:
        text = text.replace(CORE, '"three-core"')
    # Not in base64, which is longer, and cannot be packed as well: only what a URL would lose or read otherwise.
    return "data:text/javascript;charset=utf-8," + re.sub(r"[%#\t\r\n]", lambda found: quote(found[0]), text)


def _text(file: str) -> str:
    return (FOLDER / file).read_text(encoding="utf-8")


def _json(value: Any) -> str:
    """JSON that may stand inside a script element."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
