"""The page: data, style, scripts and three.js in one file, or packed in one element of another page."""

import base64
import gzip
import json
import re
from collections.abc import Sequence
from html import escape
from pathlib import Path
from urllib.parse import quote

import numpy as np
from markupsafe import Markup
from xarray import Dataset

from chapsym import files
from chapsym.dynamics import BadInput
from chapsym.scene.result.summary import sentence

from .. import rendered
from ..drawing import reading
from .motion import Motion, Rolling, motion

FOLDER = Path(__file__).parent
#: Files of the modules that a script imports.  three.js imports its core by a relative path, which no data: URL has.
MODULES = {"three": "three/three.module.min.js", "three-core": "three/three.core.min.js"}
MODULES |= {name: f"{name}.js" for name in ("eye", "motion", "ball", "floor", "stage")}
CORE = '"./three.core.min.js"'
#: The largest packed page, in bytes, that is displayed in a notebook, which stores it.
MOST = 2_000_000
#: Unpacks the page in its own frame, which is isolated from the scripts of the notebook.
LOADER = (
    "<!doctype html><meta charset=utf-8><script>(async () => {"
    'const bytes = Uint8Array.from(atob("PAGE"), (letter) => letter.charCodeAt(0));'
    'const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));'
    "const text = await new Response(stream).text();"
    "document.open(); document.write(text); document.close();"
    "})();</script>"
)


def write_page(dataset: Dataset, path: str | Path, *, balls: Sequence[str | int] | None = None) -> None:
    """Writes a result as an interactive page: the balls rolling in 3D, in one HTML file that needs no network.

    dataset: with attitude, radius and, for the rolling, contact.  balls: names or indices, at most 20; by default the
    first.
    Raises BadInput if the result lacks a variable, or the file cannot be written.
    """
    text = html(dataset, balls=balls)
    try:
        files.write_text(Path(path), text)
    except files.CannotWrite as error:
        raise BadInput(str(error)) from None


def inline(dataset: Dataset) -> str:
    """The page of a result as one HTML element, an iframe that needs no network and no file.

    Raises BadInput as `html` does.  A sentence replaces a page that is too large.
    """
    packed = gzip.compress(html(dataset).encode(), mtime=0)
    if len(packed) > MOST:
        return "<p>The page of this result is too large to stand here: write it with <code>page(path)</code>.</p>"
    source = escape(LOADER.replace("PAGE", base64.b64encode(packed).decode("ascii")))
    return (
        f'<iframe title="{escape(_title(dataset))}" sandbox="allow-scripts" loading="lazy" srcdoc="{source}" '
        'style="width: 100%; height: 40rem; border: 1px solid #888; border-radius: 6px"></iframe>'
    )


def html(dataset: Dataset, *, balls: Sequence[str | int] | None = None) -> str:
    """The text of the page; the same result gives the same bytes.  Raises BadInput as `write_page` does."""
    found = motion(dataset, balls)
    data = {"clock": _base64(found.clock, "<f8"), "unit": found.unit, "balls": list(map(_ball, found.balls))}
    modules = {"imports": {name: _module(file) for name, file in MODULES.items()}}
    return rendered(
        FOLDER / "page.html",
        title=_title(dataset),
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
        modules=Markup(_json(modules)),
        data=Markup(_json(data)),
        licence=Markup(_text("three/LICENSE").replace("--", "—")),
    )


def _title(dataset: Dataset) -> str:
    return reading.title(dataset) or "A rolling ball"


def _plan_line(dataset: Dataset, found: Motion) -> str:
    """The model, the steps or frames, and the time."""
    parts = [f"model: {dataset.attrs['model']}"] if dataset.attrs.get("model") else []
    span = dataset["time"].values[-1] if found.unit == "s" else found.clock[-1]
    if "step" in dataset.coords and "accuracy" not in dataset.attrs:  # otherwise the steps are only a clock
        count = int(dataset["step"].values[-1])
        steps = f"{count} step{'' if count == 1 else 's'}"
        parts.append(f"{steps} of {span / count:.6g} s" if found.unit == "s" and count else steps)
    else:
        parts.append(f"{dataset.sizes['frame']} frames" + (f" in {span:.6g} s" if found.unit == "s" else ""))
    return " · ".join(parts + ([f"{len(found.balls)} balls"] if len(found.balls) > 1 else []))


def _notes(found: Motion) -> list[str]:
    """The notes of the page: those of single balls under their names, common ones once."""
    every_note = [note for ball in found.balls for note in ball.notes]
    common = [note for note in dict.fromkeys(every_note) if every_note.count(note) == len(found.balls)]
    single = [f"{ball.name}: {note}" for ball in found.balls for note in ball.notes if note not in common]
    return [*found.notes, *common, *single]


def _ball(ball: Rolling) -> files.Data:
    """Rotations and vectors in float32; contact points in float64: the ball may be far away."""
    return {
        "name": ball.name,
        "radius": ball.radius,
        "attitude": _base64(ball.attitude, "<f4"),
        "turn": None if ball.turn is None else _base64(ball.turn, "<f4"),
        "contact": _base64(ball.contact, "<f8"),
        "vectors": {name: _base64(array, "<f4") for name, array in ball.vectors.items()},
        "inertia": None if ball.inertia is None else ball.inertia.tolist(),
        "axes": None if ball.axes is None else ball.axes.tolist(),
        "stops": any(note.startswith("it stops") for note in ball.notes),
    }


def _base64(array: np.ndarray, kind: str) -> str:
    with np.errstate(over="ignore", under="ignore"):
        found = np.ascontiguousarray(array, dtype=kind)
    if np.isinf(found).any() or (array.any() and not found.any()):
        raise BadInput("the page has the numbers of float32, from 1e-45 to 3.4e38; take other units")
    return base64.b64encode(found.tobytes()).decode("ascii")


def _module(file: str) -> str:
    text = _text(file).replace(CORE, '"three-core"')
    # Not in base64, which is longer and packs worse: only characters with a meaning in URLs are escaped.
    return "data:text/javascript;charset=utf-8," + re.sub(r"[%#\t\r\n]", lambda found: quote(found[0]), text)


def _text(file: str) -> str:
    return (FOLDER / file).read_text(encoding="utf-8")


def _json(value: object) -> str:
    """JSON for a script element."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
