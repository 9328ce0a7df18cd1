"""The results of steps and runs: states of one ball or of a batch, at any precision."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import wraps
from inspect import signature
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import NAMED, Double, Pair, Precision, Single, is_a, named
from chapsym.numbers.pairs import add

from . import kernels, labelled, principal_axes
from .attitudes import initial_attitude
from .ball import Asked, Ball, Floats, batch, flag, in_shape, is_flag, numbers, one_of, unit_vertical
from .errors import BadInput, Status, StepNotTaken
from .interpolation import Moments, States, standing
from .n import so_n
from .shown import Brief, html

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset

#: A result of any kind: a dataclass of arrays with these vectors.
Run = TypeVar("Run", bound=Any)
#: The vectors of arguments and of results, by their names; and what is derived from K, γ, J and D.
VECTORS = ("momentum", "angular_momentum", "omega", "gamma")
DERIVED = {"omega": kernels.angular_velocity, "energy": kernels.kinetic_energy}


def _principal_arguments(ball: Ball, given: dict[str, Any]) -> dict[str, Any]:
    """The arguments that differ in principal axes, converted."""
    try:
        precision = named(given.get("precision", "double"))
    except ValueError as error:
        raise BadInput(str(error)) from None
    if not isinstance(precision, Single | Double):
        raise BadInput(
            "more digits than float64 has are kept in principal axes only: give the principal moments, and all vectors "
            "in their axes"
        )
    if flag(given.get("proved", False), "proved"):
        raise BadInput("what is proved is of principal axes: give the principal moments, and all vectors in their axes")
    assert ball.axes is not None
    vectors = {
        name: unit_vertical(given[name]) if name == "gamma" else numbers(given[name], name, 3)
        for name in VECTORS
        if name in given
    }
    shape, flat = batch(ball.principal, *vectors.values())
    vectors = {name: array.reshape(*shape, 3) for name, array in zip(vectors, flat, strict=False)}
    found = {name: ball.to_principal(vector) for name, vector in vectors.items()}
    attitude = given.get("attitude", False)
    if not is_flag(attitude) or attitude or flag(given.get("contact", False), "contact"):
        start = initial_attitude(attitude, vectors["gamma"])
        found["attitude"] = principal_axes.attitude_to_principal(ball.axes, start)
    return {"ball": ball.principal, **found}


def in_axes_of(ball: Ball, found: Run) -> Run:
    """A result, converted from principal axes to the axes of the ball."""
    frames = getattr(found, "index", None) is not None or np.ndim(getattr(found, "time", 0.0)) > 0
    assert ball.axes is not None
    axes = ball.axes[..., np.newaxis, :] if frames else ball.axes
    turned: dict[str, object] = {}
    for field in fields(found):
        value = getattr(found, field.name)
        if field.name == "ball":
            turned["ball"] = ball
        elif field.name in VECTORS:
            turned[field.name] = ball.from_principal(value, frames=frames).astype(value.dtype, copy=False)
        elif field.name == "attitude" and value is not None:
            turned["attitude"] = principal_axes.attitude_from_principal(axes, value).astype(value.dtype, copy=False)
        elif field.name == "rotation":
            vector = ball.from_principal(value[..., 1:]).astype(value.dtype, copy=False)
            turned["rotation"] = np.concatenate([value[..., :1], vector], axis=-1)
    return replace(found, **turned)


P = ParamSpec("P")
R = TypeVar("R")


def in_given_axes(function: Callable[P, R]) -> Callable[P, R]:
    """Makes `function` accept balls with axes: it gets ball.principal, and its arguments and results are converted.

    function: its arguments are a `ball`, body vectors named as in `VECTORS`, `gamma` among them, and possibly an
    `attitude`, `contact` and `precision`.  It returns a dataclass with such vectors, an `attitude`, a `rotation` or a
    `ball`.  A ball without axes is passed unchanged.  Raises BadInput for a precision beyond float64, as axes have
    float64 only.
    """

    @wraps(function)
    def taken(*args: P.args, **kwargs: P.kwargs) -> R:
        ball: Any = args[0] if args else kwargs.get("ball")
        if not is_a(ball, Ball) or ball.axes is None:
            return function(*args, **kwargs)
        call = signature(function).bind(*args, **kwargs)
        call.apply_defaults()
        call.arguments.update(_principal_arguments(ball, call.arguments))
        try:
            found: R = in_axes_of(ball, function(*call.args, **call.kwargs))
        except StepNotTaken as error:
            if error.trajectory is None:
                raise
            frames = in_axes_of(ball, error.trajectory)
            raise StepNotTaken(error.status, error.reach, error.index, frames) from None
        return found

    return taken


@dataclass(frozen=True, eq=False, repr=False)
class Bounds(Brief):
    """Proved upper bounds of the distance of a result from the exact orbit of the map, in the units of its arrays.

    The exact orbit of the map, or of its composition, starts at the given numbers in float64 (in a run, a momentum of
    Fractions is exact), with γ and the attitude divided by their lengths.  For `roll` it is the motion of the ball.  By
    default it starts at the attitude of frame 0: no bound includes the rounding of the least rotation to float64.  A
    bound is inf if none is proved, NaN without a frame.

    Attributes
    ----------
    momentum, gamma : ndarray
        For a run (..., frames); for a step (...).
    attitude, contact : ndarray or None
        For a run with these arrays (..., frames); else None.
    rotation : ndarray or None
        For a step (...); else None.
    steps : ndarray or None
        For a run, the last step up to which all is proved, (...); else None.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> run = chapsym.trajectory(ball, (0.1, 0.05, 0), (0, 0, 1), 20, every=10, proved=True)
    >>> run.proved.gamma.shape, int(run.proved.steps)
    ((3,), 20)
    >>> bool(run.proved.gamma.max() < 1e-15)
    True
    """

    momentum: Floats
    gamma: Floats
    attitude: Asked = None
    contact: Asked = None
    rotation: Asked = None
    steps: np.ndarray | None = None


@dataclass(frozen=True, eq=False, repr=False)
class Step(Brief):
    """The outcome of one step, for one ball or a batch with the leading axes (...).

    In n dimensions Ω and 𝒦 have the shape (..., n, n), and γ (..., n).

    Attributes
    ----------
    rotation : ndarray
        The Euler parameters (q0, q1, q2, q3) of the step in the body, q0 ≥ 0, shape (..., 4).
    momentum, gamma : ndarray
        𝒦 and γ after the step, shape (..., 3).
    status : ndarray
        A `Status` for each ball, shape (...); if it is not TAKEN, the numbers above are NaN.
    reach : ndarray
        The fraction of the momentum that the small-rotation branch attains, shape (...).
    precision : Precision
        That of the numbers.  The arrays are float32 for Single, objects (mpf, arb) for Digits and Enclosure.
    low : Step or None
        For DoubleDouble, the low halves of the numbers, as a Step; else None.
    proved : Bounds or None
        With `proved=True`, bounds of the errors of the numbers.

    References
    ----------
    Equations (5.2) and (5.3) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> after = chapsym.step(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1))
    >>> after.rotation.round(9).tolist(), float(after.reach)
    ([0.999979684, 0.005555672, 0.003125051, 5.787e-06], 1.0)
    >>> list(after.write())
    ['q0', 'q', 'momentum', 'gamma']
    """

    rotation: Floats
    momentum: Floats
    gamma: Floats
    status: np.ndarray
    reach: Floats
    precision: Precision = NAMED["double"]
    low: Step | Any = None
    proved: Bounds | None = None

    def write(self) -> dict[str, Any]:
        """q0, q, momentum and gamma of one ball after the step, as floats or decimal strings, and what is proved.

        Raises BadInput for a batch, and for a step in n dimensions.
        """
        if shape := np.shape(self.status):
            raise BadInput(f"write is of the step of one ball, and this is of a batch of shape {shape}")
        if self.rotation.ndim != 1:
            raise BadInput("write is of a step in three dimensions, and this is one of n")
        q0, *q = self._written("rotation")
        found = {"q0": q0, "q": q, "momentum": self._written("momentum"), "gamma": self._written("gamma")}
        if self.proved is None:
            return found
        bounds = {name: float(getattr(self.proved, name)) for name in ("rotation", "momentum", "gamma")}
        return found | {"proved": {name: x if math.isfinite(x) else None for name, x in bounds.items()}}

    def _written(self, name: str) -> list[Any]:
        values = getattr(self, name)
        if self.low is not None:
            values = map(Pair, values, getattr(self.low, name))
        with self.precision.working():
            return list(map(self.precision.write, values))


#: `Status.TAKEN`, which takes a microsecond to look up.
TAKEN = int(Status.TAKEN)
FRAMES = ("index", "momentum", "gamma", "attitude", "contact")


def some_frames(run: Run, which: np.ndarray | slice) -> Run:
    """Some of the frames of one ball, in a run of any kind, its low halves or its bounds."""
    names = {field.name for field in fields(run)}.intersection(FRAMES)
    kept = {name: array[which] for name in names if (array := getattr(run, name)) is not None}
    more = {name: getattr(run, name, None) for name in ("low", "proved")}
    return replace(run, **kept, **{name: some_frames(x, which) for name, x in more.items() if x is not None})


def put_at(run: Run, place: Floats) -> Run:
    """A run of any kind, with the contact point moved to start at `place`, (..., m); its bounds cover the rounding."""
    low, bounds, place = getattr(run, "low", None), getattr(run, "proved", None), place[..., np.newaxis, :]
    if low is None:
        run.contact[...] += place
    else:
        run.contact[...], low.contact[...] = add(run.contact, low.contact, place, 0.0)
    if bounds is None or not place.any():
        return run
    rounded = (2.0**-52 if low is None else 2.0**-103) * np.abs(run.contact).sum(axis=-1)
    return replace(run, proved=replace(bounds, contact=np.nextafter(bounds.contact, np.inf) + rounded))


def finished(run: Run, reach: Floats) -> Run:
    """The run, of any kind; raises StepNotTaken, with `reach` and the frames before, for a single ball that stopped."""
    if run.status.shape or run.status.item() == TAKEN:
        return run
    taken = int(run.taken)
    raise StepNotTaken(Status(int(run.status)), float(reach.flat[0]), taken, some_frames(run, run.index <= taken))


@dataclass(frozen=True, eq=False)
class Trajectory:
    """States of one ball, shape (frames, ...), or of a batch, shape (balls..., frames, ...).

    In n dimensions (`trajectory_n`) 𝒦 and the attitude R, R γ = eₙ, are (..., frames, n, n), γ is (..., frames, n), and
    the contact point (..., frames, n-1), from 0; there is no time step, and nothing that needs one.

    Attributes
    ----------
    ball : Ball
        The ball, or the balls.
    index : ndarray
        The step number of each frame, shape (frames,).
    momentum, gamma : ndarray
        𝒦 (kg m²) and γ, shape (..., frames, 3).
    attitude : ndarray or None
        Unit quaternions, body to space, scalar first, shape (..., frames, 4).
    contact : ndarray or None
        The contact point on the plane in metres, from (0, 0), shape (..., frames, 2).
    taken : ndarray
        The number of steps taken, shape (...); later frames are NaN.
    status : ndarray
        The `Status` of each ball, the reason why it stopped, shape (...).
    time_step : float or None
        ε in seconds, if the run has one.
    order : int
        The order of the composition; 2 for the map itself, 0 for the continuous motion (`roll`, `exact_top`), for which
        `index` counts time steps.
    precision : Precision
        That of the numbers.  The arrays are float32 for Single, objects (mpf, arb) for Digits and Enclosure.
    low : Trajectory or None
        For DoubleDouble, the low halves of the numbers, each at most half an ulp of its number:
        `momentum` + `low.momentum` is 𝒦, and so on; else None.
    error : ndarray or None
        For `roll`, an estimate of the largest error at any frame, shape (...); else None.
    proved : Bounds or None
        With `proved=True`, bounds of the error of each frame.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> run = chapsym.trajectory(ball, (0.1, 0.05, 0), (0, 0, 1), 4, every=2, time_step=0.5)
    >>> run.gamma.shape, run.index.tolist(), run.time.tolist()
    ((3, 3), [0, 2, 4], [0.0, 1.0, 2.0])
    """

    ball: Ball
    index: np.ndarray
    momentum: Floats
    gamma: Floats
    attitude: Asked
    contact: Asked
    taken: np.ndarray
    status: np.ndarray
    time_step: float | None = None
    order: int = 2
    precision: Precision = NAMED["double"]
    low: Trajectory | Any = None
    error: Asked = None
    proved: Bounds | None = None

    def __repr__(self) -> str:
        balls = f"{self.status.size} balls" if self.status.shape else "1 ball"
        end = f"{self.index[-1]} steps" + ("" if self.time_step is None else f" of {self.time_step:.6g} s")
        kept = [name for name in FRAMES[1:] if getattr(self, name) is not None]
        return f"<Trajectory of {balls}: {len(self.index)} frames in {end}; {', '.join(kept)}>"

    def _repr_html_(self) -> str:
        clock = {} if self.time_step is None else {"time": self.time}
        kept = clock | {name: getattr(self, name) for name in FRAMES}
        one = not self.status.shape
        return html(self, {name: values for name, values in kept.items() if one and values is not None})

    def to_xarray(self) -> Dataset:
        """The run as a Dataset, labelled as the result of a scene: SI units, names of axes, the ball; with `time` also
        `omega`, `energy` and K, `angular_momentum`.

        Its dimensions are `ball`, a single one for all axes of a batch, and `frame`; `chapsym.Result` draws and writes
        it.  `momentum` is K in kg m² s⁻¹ for the motion (`roll`), and 𝒦 in kg m² for the map, as its unit shows.
        Beyond float64 the numbers are objects of the precision, which xarray itself cannot write.  With `proved=True`
        there are bounds (ball, frame), such as `gamma_bound`; in double-double it bounds the error of `gamma` +
        `gamma_low`.

        Returns
        -------
        Dataset
            The frames, with the unit of each variable in its attributes.

        Raises
        ------
        MissingExtra
            Without xarray.

        Examples
        --------
        >>> import chapsym
        >>> ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
        >>> data = chapsym.roll(ball, (3, -2, 1), 0.01, 100, contact=True).to_xarray()
        >>> data.momentum.dims, data.momentum.units
        (('ball', 'frame', 'axis'), 'kg m2 s-1')
        >>> round(data.omega.sel(time=0, axis="3").item(), 9)
        1.0
        """
        return labelled.of_run(self).dataset()

    def to_pandas(self, *, balls: bool = False) -> DataFrame:
        """The run as a table with the columns of a result's CSV, a row for each ball and frame.

        Parameters
        ----------
        balls : bool, optional
            Whether to return the values per ball, such as J, D and the status, with a row for each ball.

        Returns
        -------
        DataFrame
            `attrs["units"]` has the unit of each column.

        Raises
        ------
        MissingExtra
            Without pandas.

        Examples
        --------
        >>> import chapsym
        >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1), 5)
        >>> list(run.to_pandas())
        ['ball', 'step', 'momentum_1', 'momentum_2', 'momentum_3', 'gamma_1', 'gamma_2', 'gamma_3']
        """
        return labelled.frame(labelled.of_run(self), balls)

    @property
    def discrete_momentum(self) -> Floats:
        """`momentum` by its full name: 𝒦 = εK of the map, in kg m², unlike the ball's angular momentum K."""
        return self.momentum

    @property
    def t(self) -> Floats:
        """`time`, by the name that `solve_ivp` uses."""
        return self.time

    @property
    def time(self) -> Floats:
        """The time of each frame in seconds; raises BadInput if the run has no time step."""
        return self.index * self._time_step()

    @np.errstate(under="ignore")
    def at(self, times: ArrayLike) -> Moments:
        """The states at any times between the frames, as the dense output of `solve_ivp`: 𝒦, γ, ω, attitude, contact.

        Between two frames each is a quintic through the states and their first two derivatives by (2.3), of order 6 in
        the time h between frames.  For alike moments the errors of γ, attitude and contact point (in radii) are about
        (|ω|h)⁶/46080; those of ω, and for unlike moments, are larger.  A run of the map is interpolated in the same
        way; its derivatives by (2.3) have the error of the map.  The result is in float64 at every precision.  Each
        call reads all frames: many times in one call take little more than one.

        Parameters
        ----------
        times : array_like
            One number or a list, in seconds, or in steps if the run has no time step.

        Returns
        -------
        Moments
            The states, (..., times, ...), or without that axis for one number.

        Raises
        ------
        BadInput
            For times beyond the frames, if a ball turns by more than 1.5 radians between frames, and in n dimensions.

        References
        ----------
        Equation (2.3) of Fedorov (2007).

        Examples
        --------
        >>> import chapsym
        >>> ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
        >>> run = chapsym.roll(ball, (3, -2, 1), 0.1, 10)
        >>> run.at([0.05, 0.15]).omega.shape
        (2, 3)
        >>> bool(abs(run.at(0.2).gamma - run.gamma[2]).max() < 1e-15)
        True
        """
        if not isinstance(self.ball, Ball):
            raise BadInput("the states between frames are found in three dimensions only")
        timed = self.time_step is not None
        momentum = self.angular_momentum() if timed else self.momentum
        there, frames = standing(momentum=momentum, gamma=self.gamma, attitude=self.attitude, contact=self.contact)
        clock, axes = np.asarray(self.time if timed else self.index, dtype=np.float64), self.ball.axes
        if axes is not None:
            frames |= {name: self.ball.to_principal(frames[name], frames=True) for name in ("momentum", "gamma")}
            if self.attitude is not None:
                frames["attitude"] = principal_axes.attitude_to_principal(axes[..., np.newaxis, :], frames["attitude"])
        found = States(self.ball.principal, clock, there, **frames).at(times)
        if axes is not None:
            found = in_axes_of(self.ball, found)
        return replace(found, momentum=found.momentum * self._time_step()) if timed else found

    def invariants(self) -> Floats:
        """⟨𝒦,γ⟩, ⟨𝒦,𝒦⟩ and ⟨γ,γ⟩ of each frame; for DoubleDouble in float64, of the high halves.

        Returns
        -------
        ndarray
            Shape (..., frames, 3); in n dimensions those of `invariants_n`, (..., frames, m).

        Raises
        ------
        BadInput
            If a ball stopped early.

        Examples
        --------
        >>> import chapsym
        >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.5, 0, 0), (0, 0, 1), 5)
        >>> abs(run.invariants()[-1]).round(12).tolist()
        [0.0, 0.25, 1.0]
        """
        self._check_finite()
        of = kernels.invariants if isinstance(self.ball, Ball) else so_n.invariants
        with self.precision.working(), np.errstate(all="ignore"):
            return self._in_range("an invariant", of(self.momentum, self.gamma))

    def angular_momentum(self) -> Floats:
        """K = 𝒦/ε in kg m²/s, (..., frames, 3)."""
        momentum, single = self.momentum, self.momentum.dtype == np.float32  # which may not represent ε
        with self.precision.working(), np.errstate(all="ignore"):
            K = (momentum.astype(np.float64) if single else momentum) / self._time_step()
            return self._in_range("K = 𝒦/ε", K.astype(momentum.dtype, copy=False))

    @property
    def omega(self) -> Floats:
        """ω in rad/s for K = 𝒦/ε, in body axes, (..., frames, 3); raises BadInput if the run has no time step."""
        self._check_finite()
        return self.derived("omega")["omega"]

    @property
    def energy(self) -> Floats:
        """`kinetic_energy()`."""
        return self.kinetic_energy()

    def kinetic_energy(self) -> Floats:
        """½⟨K, ω⟩ in joules for K = 𝒦/ε, (..., frames); the map keeps it up to an oscillation."""
        self._check_finite()
        return self.derived("energy")["energy"]

    def derived(self, *names: str) -> dict[str, Floats]:
        """`omega` and `energy`, or those named, NaN after a ball of a batch stopped.

        Raises BadInput without a time step, and for another name.
        """
        names = tuple(one_of(name, "a name", *DERIVED) for name in names or DERIVED)
        with self.precision.working():
            ball, missing = self.ball, self.index > self.taken[..., np.newaxis]
            K = np.where(missing[..., np.newaxis], 0.0, self.angular_momentum())
            gamma = np.where(missing[..., np.newaxis], [0.0, 0.0, 1.0], self.gamma)
            if ball.axes is not None:
                K, gamma = ball.to_principal(K, frames=True), ball.to_principal(gamma, frames=True)
            frames = K, gamma, ball.mass_tensor[..., np.newaxis, :], ball.D[..., np.newaxis]
            found: dict[str, Floats] = {}
            for name in names:
                values = np.array(DERIVED[name](*frames))
                if name in VECTORS and ball.axes is not None:
                    values = ball.from_principal(values, frames=True)
                values[missing] = np.nan
                found[name] = self._in_range(name, values)
            return found

    def _in_range(self, name: str, values: Floats) -> Floats:
        """The values; raises BadInput if those of a frame that was reached are beyond the range of floats."""
        if values.dtype != object and not np.isfinite(values[self.index <= self.taken[..., np.newaxis]]).all():
            raise BadInput(f"{name} is beyond the range of {values.dtype}; take other units")
        return values

    def _check_finite(self) -> None:
        if (self.taken < self.index[-1]).any():
            raise BadInput("a ball of the batch stopped early; choose the frames up to `taken` first")

    def _time_step(self) -> float:
        if self.time_step is None:
            raise BadInput("this trajectory has no time step: it was given 𝒦 = εK; use `roll`, or divide by your ε")
        return self.time_step


#: The first fields of a run: those that every run has.
ARRAYS = tuple(field.name for field in fields(Trajectory))[:8]


def of_balls(shape: tuple[int, ...], ball: object, index: np.ndarray, *flat: Asked, **more: Any) -> Trajectory:
    """A run from flat arrays (n, ...): momentum, gamma, attitude, contact, taken and status."""
    run = object.__new__(Trajectory)  # the constructor of a frozen class takes three times as long
    run.__dict__.update(zip(ARRAYS, (ball, index, *[in_shape(shape, x) for x in flat]), strict=True), **more)
    return run
