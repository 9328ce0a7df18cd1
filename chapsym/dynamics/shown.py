"""The display of results: a line in a terminal; in a notebook, a small table and the trace on the plane."""

from collections.abc import Mapping
from dataclasses import fields
from html import escape

import numpy as np

from chapsym.numbers import brief

#: The largest array that is shown by its numbers; larger ones are shown by their shape.
FEW = 4
#: The size of the picture of a trace, in pixels.
WIDTH, HEIGHT, MARGIN = 240, 160, 6


class Brief:
    """A record with a one-line repr: small arrays as numbers, larger ones as shapes; None fields are left out."""

    def __repr__(self) -> str:
        given = {field.name: getattr(self, field.name) for field in fields(self)}  # type: ignore[arg-type]
        shown = ", ".join(f"{name}={_short(value)}" for name, value in given.items() if value is not None)
        return f"{type(self).__name__}({shown})"


def _short(value: object) -> str:
    if isinstance(value, list | tuple) and len(value) > FEW:
        return f"<{len(value)}>"
    if not isinstance(value, np.ndarray | np.generic):
        try:
            return repr(value)
        except ValueError:  # integers with more digits than Python prints
            return brief(value)
    if value.size > FEW:
        return f"<{' × '.join(map(str, value.shape))}>"
    return str(value.item()) if value.size == 1 and not value.shape else str(tuple(value.tolist()))


def html(run: object, columns: Mapping[str, np.ndarray]) -> str:
    """A `Trajectory`: its line, its first and last frames, and, for one ball, the trace of the contact point.

    columns: the values shown for each frame, (frames, ...), for one ball; none for several.
    """
    rows = "".join(
        f"<tr><th>{escape(name)}</th>" + "".join(f"<td>{escape(_cell(values[i]))}</td>" for i in (0, -1)) + "</tr>"
        for name, values in columns.items()
    )
    table = f"<table><tr><th></th><th>first frame</th><th>last frame</th></tr>{rows}</table>" if rows else ""
    trace = columns.get("contact")
    return f"<p>{escape(repr(run))}</p>{table}{'' if trace is None else _curve(trace)}"


def _cell(value: np.ndarray) -> str:
    return ", ".join(f"{float(x):.6g}" for x in np.ravel(value))


def _curve(points: np.ndarray) -> str:
    """A curve in the plane, (points, 2), with one scale for both directions."""
    plane = np.asarray(points[:, :2], dtype=np.float64)
    least, size = plane.min(axis=0), np.ptp(plane, axis=0)
    scale = min((length - 2 * MARGIN) / max(part, 1e-300) for length, part in zip((WIDTH, HEIGHT), size, strict=True))
    x, y = (MARGIN + min(scale, 1e300) * (plane - least)).T
    line = " ".join(f"{a:.1f},{HEIGHT - b:.1f}" for a, b in zip(x, y, strict=True))
    return (
        f'<svg width="{WIDTH}" height="{HEIGHT}" role="img" aria-label="the trace on the plane">'
        f'<polyline points="{line}" fill="none" stroke="currentColor"/></svg>'
    )
