"""The motion of a ball as moving pictures, .gif or .mp4: the turning ball, above its path on the plane."""

import subprocess
import tempfile
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import animation
from PIL import Image

from chapsym import files
from chapsym.dynamics import BadInput, kernels
from chapsym.dynamics.ball import Floats

from .drawing import curves, reading
from .drawing.sphere import EYE, View
from .drawing.style import COLOURS, Picture, in_power, power, styled

if TYPE_CHECKING:
    from xarray import Dataset

FORMATS = ("gif", "mp4")
#: Pictures per second, and the largest number of them; a file of about 1 MB.
RATE, MOST = 20, 200
#: The largest rotation in radians between two pictures that the eye can follow.
TURN = 0.6
#: Pixels across the ball, and dots per inch.
ACROSS, DPI = 220, 80
#: Colours of a .gif.
SHADES = 64
#: Half the width of the lines between the octants of the ball, in radii.
LINE = 0.022
BLUE = np.array([0.25, 0.62, 0.92])
Progress = Callable[[int, int], None]


def missing(dataset: "Dataset") -> str | None:
    """Why the motion cannot be drawn, in a sentence; None if it can."""
    if "attitude" not in dataset:
        return 'no attitude: add "attitude" to run.outputs, and "contact" to see the way'
    if "quaternion" not in dataset["attitude"].dims:
        return "a rolling ball is drawn in three dimensions only"
    return None if reading.last_frames(dataset).max() > 0 else "a motion needs two frames"


def check_writer(form: str) -> None:
    """Raises BadInput for "mp4" if there is no ffmpeg."""
    if form == "mp4" and not animation.FFMpegWriter.isAvailable():
        raise BadInput("an .mp4 is written by ffmpeg, which is not installed here: install it, or write a .gif")


def save_motion(
    dataset: "Dataset", path: Path, ball: str | int | None = None, progress: Progress = lambda *_: None
) -> None:
    """Writes the motion of one ball, by default the first, to a .gif or, if ffmpeg is installed, an .mp4.

    It lasts at most 10 seconds; for a motion too fast for 200 pictures it shows the first part, with a note.
    progress: called with the number of pictures drawn so far, and the total number.
    Raises BadInput for a result without the attitude, and CannotWrite if the disk refuses.
    """
    form = path.suffix[1:]
    if form not in FORMATS:
        raise BadInput(f"{str(path)!r}: moving pictures end in .gif or .mp4")
    one = reading.begun(reading.with_balls(dataset, 0 if ball is None else ball))
    if (reason := missing(one)) is not None:
        raise BadInput(f"the motion cannot be drawn: {reason}")
    check_writer(form)
    files.check_destination(path)
    with tempfile.TemporaryDirectory() as folder, styled():
        whole = Path(folder) / f"motion.{form}"
        _film(one, whole, form, progress)
        files.write_whole(path, lambda stream: stream.write(whole.read_bytes()))


def _film(one: "Dataset", path: Path, form: str, progress: Progress) -> None:
    scene = _Scene(one)
    writer = (_Gif if form == "gif" else animation.FFMpegWriter)(fps=RATE)
    try:
        with writer.saving(scene.figure, path, DPI):
            for i in range(len(scene.t)):
                scene.show(i)
                writer.grab_frame()
                progress(i + 1, len(scene.t))
    except (subprocess.CalledProcessError, BrokenPipeError) as error:
        raise BadInput(f"ffmpeg could not write the motion ({error}); a .gif needs none") from None


class _Gif(animation.PillowWriter):
    """All pictures share the colours of one of them, which takes a third of the bytes."""

    def finish(self) -> None:
        """Writes the file."""
        pictures = [picture.convert("RGB") for picture in self._frames]  # type: ignore[has-type]
        colours = pictures[len(pictures) // 2].quantize(SHADES)
        self._frames = [picture.quantize(palette=colours, dither=Image.Dither.NONE) for picture in pictures]
        super().finish()


class _Scene:
    """The figure, and at each picture the clock `t`, the attitude and, if known, the contact point.

    The pictures are evenly spread over the run, or over the part whose rotation can be followed: `span` is this part.
    """

    def __init__(self, one: "Dataset") -> None:
        fine = curves.finer(one)
        end = int(reading.last_frames(fine)[0]) + 1
        t, label = reading.clock(fine)
        q = reading.values(fine, "attitude")[0, :end]
        chosen = _pictures(t[:end], q)
        part = chosen[-1] + 1
        shown, whole = (reading.span(t[:n], label) for n in (part, end))
        self.span = "" if part == end else f"the first {shown} of {whole}"
        self.t, self.attitude, self.contact = t[chosen], q[chosen], None
        self.unit, text = power(float(self.t[-1])) if label == "time, s" else (1.0, "")
        self.form = " ".join(["{:.2f}", *filter(None, (text,)), "s"]) if label == "time, s" else "step {:.0f}"
        rolls = "contact" in fine
        self.figure = Picture(figsize=(4.0, 6.0 if rolls else 4.2))
        above = self.figure.add_axes((0.15, 0.42, 0.7, 0.47) if rolls else (0.1, 0.03, 0.8, 0.77))
        above.set(xlim=(-1.08, 1.08), ylim=(-1.08, 1.08), aspect="equal")
        above.set_axis_off()
        title = textwrap.fill(reading.title(one), 44, max_lines=2, placeholder=" …")
        self.figure.text(0.5, 0.985, title, ha="center", va="top", parse_math=False, fontsize=11)
        self.clock = self.figure.text(0.5, 0.915, "", ha="center", va="top", fontsize=10, color="0.35")
        self.view = View.towards_eye(EYE)
        self.inside, self.points = self.view.disc(ACROSS)
        turn = np.linspace(0.0, 2.0 * np.pi, 181)
        above.plot(np.cos(turn), np.sin(turn), color="0.15", linewidth=1.0)
        self.image = above.imshow(self._ball(q[0]), extent=(-1, 1, -1, 1), origin="lower")
        self.marks = [above.text(0, 0, i, ha="center", va="center", fontsize=13, weight="bold") for i in "123"]
        if rolls:
            whole = reading.values(fine, "contact")[0]
            self.factor, text = power(reading.size_of(whole))
            self.contact = whole[chosen] / self.factor
            below = self.figure.add_axes((0.17, 0.09, 0.76, 0.29))
            below.plot(*(whole[:end] / self.factor).T, color="0.75", linewidth=1.0)  # faint: the whole path
            (self.way,) = below.plot([], [], color=COLOURS[0], linewidth=1.6)
            (self.dot,) = below.plot([], [], "o", color=COLOURS[1], markersize=6)
            below.set_aspect("equal", adjustable="datalim")
            below.set_xlabel(in_power("x and y", "m", text), labelpad=2)
            below.tick_params(labelsize=9)

    def show(self, i: int) -> None:
        """Changes the figure to a picture."""
        self.clock.set_text(" · ".join(filter(None, (self.form.format(self.t[i] / self.unit), self.span))))
        self.image.set_data(self._ball(self.attitude[i]))
        for axis, mark in zip(kernels.rotate(self.attitude[i], np.eye(3)), self.marks, strict=True):
            x, y, depth = self.view.project(axis)
            mark.set(position=(0.93 * x, 0.93 * y), visible=bool(depth > 0.25))
        if self.contact is not None:
            self.way.set_data(*self.contact[: i + 1].T)
            self.dot.set_data(*self.contact[i : i + 1].T)

    def _ball(self, attitude: Floats) -> Floats:
        """The ball in octants of its body axes, as pixels (across, across, 4)."""
        body = self.points @ kernels.rotate(attitude, np.eye(3)).T
        light = 0.72 + 0.28 * (self.points @ self.view.towards)
        shade = np.where(body.prod(axis=-1) > 0, 1.0, 0.55)
        shade = np.where(np.abs(body).min(axis=-1) < LINE, 0.15, shade) * light
        ends = np.where((body > 0.975).any(axis=-1), 1.0, 0.0)
        found = np.zeros((ACROSS, ACROSS, 4))
        found[self.inside, :3] = np.maximum(shade[:, np.newaxis] * BLUE, ends[:, np.newaxis])
        found[self.inside, 3] = 1.0
        return found


def _pictures(t: Floats, attitude: Floats) -> np.ndarray:
    """Which frames are pictures, of the times (frames,) and attitudes (frames, 4) of a ball."""
    angle = 2.0 * np.arccos(np.minimum(np.abs((attitude[1:] * attitude[:-1]).sum(axis=-1)), 1.0))
    turned = np.concatenate([[0.0], np.cumsum(angle)])
    last = len(t) - 1
    if angle.max(initial=0.0) > TURN:  # too far apart to follow: the frames themselves
        return np.arange(max(1, min(MOST - 1, last)) + 1)
    end = max(1, min(int(np.searchsorted(turned, TURN * MOST, side="right")) - 1, last))
    count = min(MOST, max(2, RATE * 2, int(np.ceil(turned[end] / TURN * 2))))
    return np.unique(np.searchsorted(t[: end + 1], np.linspace(t[0], t[end], count)).clip(0, end))
