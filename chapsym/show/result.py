"""A result in Python and in notebooks: a Dataset, displayed as a table, its most informative figure and its page."""

import os
import sys
import tempfile
import webbrowser
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym import __version__
from chapsym.dynamics import BadInput
from chapsym.dynamics.ball import brief, callback, is_a
from chapsym.dynamics.labelled import frame
from chapsym.dynamics.outputs import BOUND, LOW
from chapsym.scene import Scene, SceneError, checked, load
from chapsym.scene.plan.plan import plan_of
from chapsym.scene.result import formats
from chapsym.scene.result.dataset import grid
from chapsym.scene.result.digests import write_digests
from chapsym.scene.result.interpolation import interpolated
from chapsym.scene.result.proved import LIMIT, motion_to_prove, with_proof
from chapsym.scene.result.summary import sentence
from chapsym.scene.running import store
from chapsym.scene.running.sweep import run_in_memory

from . import figures
from .drawing import reading

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from pandas import DataFrame
    from xarray import Dataset

    from .drawing.style import Picture

PLACE = "path must name a file"
#: The largest number of values for which a table has the drift; more would take seconds.
MOST = 10_000_000


@dataclass(frozen=True, eq=False)
class Result:
    """The result of a scene, with its figures.

    Frames are indexed by their time: `result.dataset.sel(time=5.0, method="nearest")`.

    Attributes
    ----------
    dataset : xarray.Dataset
        With dimensions `ball` and `frame`.

    Examples
    --------
    >>> import chapsym
    >>> ball, start = {"mass_tensor": [1, 2, 4], "D": 3}, {"omega": [1, 0, 0], "gamma": [0, 0, 1]}
    >>> result = chapsym.run_scene({"ball": ball, "start": start, "run": {"time": 1.0, "time_step": 0.1}})
    >>> result.dataset.gamma.dims, result.dataset.sizes["frame"]
    (('ball', 'frame', 'axis'), 11)
    """

    dataset: "Dataset"

    def __post_init__(self) -> None:
        sizes = self.dataset.sizes if hasattr(type(self.dataset), "data_vars") else ()
        if not {"ball", "frame"} <= set(sizes):
            raise BadInput(f"dataset must be the dataset of a result, with ball and frame, not {brief(self.dataset)}")

    def to_xarray(self) -> "Dataset":
        """`dataset`, in the form of `Trajectory.to_xarray`."""
        return self.dataset

    def to_pandas(self, *, balls: bool = False) -> "DataFrame":
        """The table of the CSV, as `Trajectory.to_pandas`: a row per ball and frame, or per ball."""
        return frame(reading.with_balls(self.dataset), balls)

    def figures(self) -> dict[str, str | None]:
        """All figures by name: None if it can be drawn, else the reason, in a sentence."""
        return figures.available(self.dataset)

    def figure(self, name: str | None = None, ball: str | int | None = None) -> "Picture":
        """A figure of all balls or of one (name or index), by default the most informative one; raises BadInput."""
        reasons = self.figures()
        telling = next((one for one, reason in reasons.items() if reason is None), next(iter(reasons)))
        return figures.draw(self.dataset, telling if name is None else name, ball)

    def show(self, ball: str | int | None = None) -> None:
        """Displays all possible figures, in a notebook below the cell, elsewhere in a folder, which is opened.

        The folder is temporary, and its name is printed.

        Parameters
        ----------
        ball : str or int, optional
            The name or the index of one ball; by default all.
        """
        one = reading.with_balls(self.dataset, ball)
        wanted = [name for name, reason in figures.available(one).items() if reason is None]
        if in_notebook():
            from IPython.display import display

            for name in wanted:
                display(figures.draw(one, name))
            return
        folder = Path(tempfile.mkdtemp(prefix="chapsym-"))
        written = figures.save_all(one, folder, names=wanted)
        print(f"{len(written)} figures in {folder}")
        webbrowser.open(folder.as_uri())

    def at(self, times: "ArrayLike") -> "Dataset":
        """The result at any times between its frames, of order 6 in the time between frames: `chapsym.interpolated`.

        Parameters
        ----------
        times : array_like
            One number or a list, in seconds, or in steps if the run has no times.

        Returns
        -------
        xarray.Dataset
            The result, with these times as its frames.

        Raises
        ------
        BadInput
            As `chapsym.interpolated` does.
        """
        return interpolated(self.dataset, times)

    def save(self, path: str | Path) -> None:
        """Writes the whole result to .zarr, .nc, .csv, .parquet or .npz; raises SceneError if that fails."""
        path = _path(path, PLACE)
        if not (self.dataset.sizes["ball"] and self.dataset.sizes.get("frame", 1)):
            raise SceneError("a result without balls or without frames has nothing to save")
        try:
            formats.check_parts(self.dataset)
        except ValueError as error:
            raise SceneError(f"no file has this result: {error}") from None
        if path.suffix == ".zarr":
            _save_zarr(self.dataset, path)
        else:
            formats.save(self.dataset, path)

    def page(self, path: str | Path, ball: str | int | None = None) -> None:
        """Writes the page on which the ball rolls, one HTML file that needs no network; it needs the attitude."""
        from .rolling import write_page

        write_page(self.dataset, _path(path, PLACE), balls=None if ball is None else [ball])

    def grid(self) -> "Dataset":
        """The dataset of a sweep with a dimension for each range instead of `ball`, and `sample` for random samples.

        `grid()["energy"].sel({"start.omega.1": 3.0}, method="nearest")` is the energy for one value of a range.

        Returns
        -------
        xarray.Dataset

        Raises
        ------
        SceneError
            For a part of a sweep.
        """
        return grid(self.dataset)

    def animate(self, path: str | Path, ball: str | int | None = None) -> None:
        """Writes the motion of one ball as moving pictures, .gif or .mp4, as `chapsym show --format` does."""
        from .moving import save_motion

        save_motion(self.dataset, _path(path, PLACE), ball)

    def rows(self) -> list[tuple[str, str]]:
        """The short table: the balls, the duration, the stored variables, and the drift of the integrals."""
        return [row for row in _rows(reading.with_balls(self.dataset)) if row[1]]

    def __repr__(self) -> str:
        rows = self.rows()
        width = max(len(key) for key, _ in rows)
        title = reading.title(self.dataset) or "a result of chapsym"
        return "\n".join([title, *(f"  {key:{width}}  {text}" for key, text in rows)])

    def _repr_html_(self) -> str:
        title = escape(reading.title(self.dataset))
        cell = 'style="text-align: left; padding: 0.1em 1em 0.1em 0"'
        rows = "".join(f"<tr><th {cell}>{escape(k)}</th><td {cell}>{escape(v)}</td></tr>" for k, v in self.rows())
        begun = (reading.last_frames(reading.with_balls(self.dataset)) >= 0).any()
        drawable = begun and None in self.figures().values()
        picture = self.figure().svg() if drawable else ""
        caption = f"<caption {cell}>{title}</caption>" if title else ""
        return f"<table>{caption}<tbody>{rows}</tbody></table>{picture}{self._page()}"

    def _page(self) -> str:
        """The page on which the ball rolls, as an element; empty if it cannot be made."""
        from .rolling import inline

        try:
            return inline(self.dataset)
        except BadInput:
            return ""


def run_scene(scene: "str | Path | Mapping[str, Any] | Scene", progress: Callable[[Any], None] | None = None) -> Result:
    """Runs a scene in memory on all cores.

    A ball that meets a fold stops there: `status` and `taken` in the result say so.

    Parameters
    ----------
    scene : str, Path, mapping or Scene
        A .toml file, the same as a dictionary, or the result of `chapsym.scene.load`.
    progress : callable, optional
        Called with the progress of the run: the `steps` taken by all balls together, the number `of` all steps, the
        number of `balls` that are done, and the number of those that `failed`, that is, stopped early.

    Returns
    -------
    Result

    Raises
    ------
    SceneError
        For a scene that cannot be run as written, or whose motion is not proved to its end, with `proved`.
    BadInput
        As the plan of the scene does.

    Examples
    --------
    >>> import chapsym
    >>> ball, start = {"mass_tensor": [1, 2, 4], "D": 3}, {"omega": [1, 0, 0], "gamma": [0, 0, 1]}
    >>> result = chapsym.run_scene({"ball": ball, "start": start, "run": {"time": 1.0, "time_step": 0.1}})
    >>> result.dataset.gamma.values[0, -1].round(6).tolist()
    [0.0, 0.841471, 0.540302]
    """
    if progress is not None:
        callback(progress)
    if is_a(scene, Mapping):
        scene = checked(dict(scene))
    elif not is_a(scene, Scene):
        scene = load(_path(scene, "scene must be a .toml file or a dictionary"))
    exact = motion_to_prove(scene)
    plan = plan_of(scene)
    data = run_in_memory(plan) if progress is None else run_in_memory(plan, progress)
    if exact is not None:
        data, motion = with_proof(data, exact, float(scene.run.limit or LIMIT), lambda sentence: None)
        if motion.stopped is not None:
            raise SceneError(f"the frames after {len(motion.times)} are not proved: {motion.stopped}")
    return Result(data)


def open_result(path: str | Path) -> Result:
    """Opens a result; arrays of .zarr are read on first use.

    Parameters
    ----------
    path : str or Path
        A .zarr, .nc, .npz, .csv or .parquet.

    Returns
    -------
    Result

    Raises
    ------
    SceneError
        For a missing file, and for a file that is no result.

    Examples
    --------
    >>> import chapsym, tempfile
    >>> ball, start = {"mass_tensor": [1, 2, 4], "D": 3}, {"omega": [1, 0, 0], "gamma": [0, 0, 1]}
    >>> result = chapsym.run_scene({"ball": ball, "start": start, "run": {"time": 1.0, "time_step": 0.1}})
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     result.save(f"{folder}/ball.csv")
    ...     print(chapsym.open_result(f"{folder}/ball.csv").dataset.sizes["frame"])
    11
    """
    return Result(formats.load(_path(path, "path must name a result")))


def _path(given: Any, must: str) -> Path:
    if not (is_a(given, str) or is_a(given, os.PathLike)) or is_a(os.fspath(given), bytes):
        raise SceneError(f"{must}, not {brief(given)}")
    return Path(given)


def in_notebook() -> bool:
    """Whether this runs in a notebook."""
    if "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return shell is not None and hasattr(shell, "kernel")


def _save_zarr(dataset: "Dataset", path: Path) -> None:
    """Writes a whole new .zarr; raises SceneError if it cannot be written."""
    if path.exists():
        raise SceneError(f"{path} is there already; remove it, or choose another name")
    # The chunks of a part of another .zarr do not fit those of its files.
    attrs = {"complete": True, "chapsym_version": __version__} | dataset.attrs
    whole = dataset.drop_encoding().unify_chunks().assign_attrs(attrs)
    if whole.chunks:
        whole = whole.chunk({dim: max(lengths) for dim, lengths in whole.chunks.items()})

    def fill(place: Path) -> None:
        store.write(whole, place)
        store.consolidate(place)
        write_digests(place)

    store.created(path, fill)


def _rows(dataset: "Dataset") -> list[tuple[str, str]]:
    names = reading.ball_names(dataset)
    stopped = int(reading.stopped(dataset).sum())
    balls = names[0] if len(names) == 1 else f"{len(names)}" + (f", {stopped} of them stopped early" if stopped else "")
    varied = ", ".join(
        f"{name} from {data.min():.6g} to {data.max():.6g}{' ' + reading.readable(units) if units else ''}"
        for name, (data, units) in reading.parameters(dataset).items()
    )
    stored = [str(name) for name in dataset.data_vars if name not in _ASIDE and not str(name).endswith((LOW, BOUND))]
    return [
        ("ball" if len(names) == 1 else "balls", "" if balls == "ball" else balls),
        ("varied", varied),
        ("frames", _frames(dataset)),
        ("unfinished", reading.unfinished(dataset) or ""),
        ("model", str(dataset.attrs.get("model", ""))),
        ("stored", ", ".join(stored)),
        ("drift", _drift(dataset)),
        sentence(dataset) or ("", ""),
        ("stopped", f"after {int(dataset['taken'].values[0])} steps" if len(names) == 1 and stopped else ""),
    ]


_ASIDE = {"taken", "status", "mass_tensor", "D", "radius", "axes", "error", "order", "substeps"}


def _frames(dataset: "Dataset") -> str:
    if not dataset.sizes.get("frame"):
        return ""
    t, label = reading.clock(dataset)
    steps = f", {int(reading.steps(dataset)[-1])} steps" if "step" in dataset.coords else ""
    return f"{len(t)}{steps}" + (f", {t[-1]:.6g} s" if label == "time, s" else "")


def _drift(dataset: "Dataset") -> str:
    """The largest relative change of the momentum integrals, from the stored variables."""
    from .figures import over_time

    if not reading.reached(dataset).any():
        return ""
    if over_time.no_integrals(dataset) is None and dataset.sizes["ball"] * dataset.sizes["frame"] < MOST:
        found, names = over_time.stored(dataset)
    elif {"momentum", "gamma"} <= set(dataset.data_vars) and "row" not in dataset.dims and dataset["gamma"].size < MOST:
        with np.errstate(over="ignore", invalid="ignore"):
            K, g = reading.values(dataset, "momentum"), reading.values(dataset, "gamma")  # NaN where a ball has stopped
            found = np.stack([(x * y).sum(axis=-1) for x, y in ((K, g), (K, K), (g, g))], axis=-1)
        names = ["K.gamma", "K.K", "gamma.gamma"]
    else:
        return ""
    largest = max(reading.size_of(change) for change in over_time.drifts(found, names))
    return f"{largest:.1e} at most, of the momentum integrals, relatively"
