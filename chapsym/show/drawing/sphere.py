"""A unit sphere in a parallel projection, with the points behind it drawn fainter."""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from chapsym.dynamics.ball import Floats

from .style import VERTICES

#: The opacity of points behind the sphere, relative to those in front.
BEHIND = 0.28
CURVE = "#F5CE7E"
#: The largest angle in radians between neighbours of a line; beyond it they are points of a discrete orbit.
NEAR = 0.12
#: Radians of an orbit in a panel as wide as a figure: a longer line would fill the sphere.
LONGEST = 200.0
#: The number of points that show the rest of an orbit.
REST = 3000
#: The direction of view of the sphere of space.
EYE = np.array([0.8, -0.5, 0.5])


@dataclass(frozen=True, eq=False)
class View:
    """A parallel projection: right, up and towards the eye, orthonormal, each (3,)."""

    right: Floats
    up: Floats
    towards: Floats

    @classmethod
    def of(cls, points: Floats) -> Self:
        """A view with most of the points (n, 3) in front: from their mean, or across the plane of a great circle."""
        mean = points.mean(axis=0)
        if np.sqrt(mean @ mean) < 0.25:
            # 55° off the normal of the plane: an orbit around the sphere is a wide ellipse.
            _, axes = np.linalg.eigh(points.T @ points)
            normal, level = axes[:, 0], axes[:, 2]
            normal = normal * np.sign(normal[np.abs(normal).argmax()])
            mean = np.cos(0.95) * normal + np.sin(0.95) * level * np.sign(level[np.abs(level).argmax()])
        return cls.towards_eye(mean)

    @classmethod
    def towards_eye(cls, eye: Floats) -> Self:
        """The view from a direction, a little from above and from the side, with the third axis upwards."""
        upright = np.array([0.0, 0.0, 1.0])
        direction = eye / np.sqrt(eye @ eye)
        side = np.cross(upright, direction)
        if side @ side < 1e-4:
            side = np.array([0.0, 1.0, 0.0])
        direction = direction + 0.35 * side / np.sqrt(side @ side) + 0.3 * upright * np.sign(1e-9 + direction[2])
        direction /= np.sqrt(direction @ direction)
        right = np.cross(upright, direction)
        if right @ right < 1e-6:
            right = np.array([1.0, 0.0, 0.0])
        right /= np.sqrt(right @ right)
        return cls(right, np.cross(direction, right), direction)

    def project(self, points: Floats) -> tuple[Floats, Floats, Floats]:
        """x, y on paper and the depth towards the eye, (...), of points (..., 3)."""
        return points @ self.right, points @ self.up, points @ self.towards

    def disc(self, pixels: int) -> tuple[np.ndarray, Floats]:
        """Which pixels of a square from -1 to 1 show the sphere, and its points there, (n, 3)."""
        side = np.linspace(-1.0, 1.0, pixels)
        x, y = np.meshgrid(side, side)
        inside = x * x + y * y < 1.0
        x, y = x[inside, np.newaxis], y[inside, np.newaxis]
        return inside, x * self.right + y * self.up + np.sqrt(1.0 - x * x - y * y) * self.towards


def draw_globe(axis: Axes, view: View, names: tuple[str, str, str]) -> None:
    """The outline, circles every 30°, and the ends of the three axes."""
    axis.set_aspect("equal")
    axis.set_axis_off()
    axis.set(xlim=(-1.22, 1.22), ylim=(-1.22, 1.22))
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    cosine, sine = np.cos(turn), np.sin(turn)
    axis.fill(cosine, sine, facecolor="#f6f8fa", edgecolor="0.45", linewidth=0.9, zorder=0)
    tilts = np.deg2rad([-60, -30, 0, 30, 60])
    parallels = [np.stack([cosine * np.cos(a), sine * np.cos(a), 0.0 * turn + np.sin(a)], -1) for a in tilts]
    meridians = [np.stack([cosine * np.cos(a), cosine * np.sin(a), sine], -1) for a in np.deg2rad(range(0, 180, 30))]
    for circle in (*parallels, *meridians):
        _draw(axis, view, circle, color="0.78", linewidth=0.6, zorder=0.5)
    for end, name in zip(np.concatenate([np.eye(3), -np.eye(3)]), (*names, "", "", ""), strict=True):
        x, y, depth = view.project(end)
        front = depth >= -1e-9
        axis.plot(x, y, ".", color="0.35", markersize=5, alpha=1.0 if front else BEHIND, zorder=1)
        rim = x * x + y * y > 0.36  # beyond it a name is outside, else to the right of its point
        axis.annotate(
            name, (1.13 * x, 1.13 * y) if rim else (x, y), xytext=(0, 0) if rim else (7, 7),
            textcoords="offset points", ha="center", va="center", fontsize=10, color="0.25",
            alpha=1.0 if front else 0.55, zorder=6,
            path_effects=[withStroke(linewidth=2.5, foreground="white", alpha=0.8)],
        )  # fmt: skip


def _draw(axis: Axes, view: View, points: Floats, *, zorder: float, **options: Any) -> None:
    """Points or a line, (m, 3): in front of the sphere, and fainter behind it."""
    x, y, depth = view.project(points)
    for front in (False, True):
        there = (depth >= 0.0) == front
        axis.plot(
            np.where(there, x, np.nan), np.where(there, y, np.nan), alpha=1.0 if front else BEHIND,
            zorder=zorder + 0.3 * front, **options,
        )  # fmt: skip


def draw_curve(axis: Axes, view: View, points: Floats, label: str) -> None:
    """A curve that contains an orbit, (m, 3): broad, so that it is visible below the orbit."""
    _draw(axis, view, points, color=CURVE, linewidth=4.5, zorder=2)
    axis.plot([], [], color=CURVE, linewidth=4.5, label=label)


def draw_orbit(
    axis: Axes, view: View, points: Floats, colour: str, *, most: int = VERTICES, longest: float = LONGEST
) -> int:
    """An orbit, (frames, 3): a line where neighbours are near, else points; its start a ring, its end a square.

    A line ends at the length `longest`, and the rest is drawn as faint points.  Returns the number of frames of the
    line, or of the points.
    """
    apart = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=-1))
    near = len(points) > 2 and apart.max() < NEAR
    part = 1 + int(np.searchsorted(np.cumsum(apart), longest, side="right")) if near else len(points)
    shown, rest = points[:part], points[part :: max(1, (len(points) - part) // REST)]
    if len(shown) > 20 * most:
        shown, near = shown[np.linspace(0, part - 1, 20 * most).astype(int)], False
    form = {"linewidth": 1.2} if near else {
        "marker": "o", "linestyle": "", "markersize": 3.2 if len(shown) < 400 else 1.6, "markeredgewidth": 0,
    }  # fmt: skip
    _draw(axis, view, shown, color=colour, zorder=3, rasterized=len(shown) > most, **form)
    if len(rest):
        x, y, depth = view.project(rest[rest @ view.towards >= 0.0])
        axis.plot(x, y, ".", color=colour, markersize=1.5, alpha=0.35, zorder=2.5, rasterized=True)
    for end, marker, face in ((points[0], "o", "white"), (points[-1], "s", colour)):
        x, y, depth = view.project(end)
        alpha = 1.0 if depth >= 0 else 0.5
        axis.plot(x, y, marker, markersize=6, color=colour, markerfacecolor=face, zorder=5, alpha=alpha)
    return part
