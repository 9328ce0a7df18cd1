"""A result at any times between its frames: the quintics of `chapsym.dynamics.interpolation`, on labelled arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import BadInput, Ball, kernels
from chapsym.dynamics.ball import Floats, brief, numbers
from chapsym.dynamics.interpolation import States, standing
from chapsym.dynamics.principal_axes import attitude_from_principal, attitude_to_principal, from_principal, to_principal

if TYPE_CHECKING:
    from xarray import Dataset

#: The interpolated variables; energy, integrals and phase are known only at the frames.
FOLLOWED = ("momentum", "gamma", "omega", "attitude", "contact")
#: The attributes on errors at the frames.
ERRORS = ("accuracy", "accuracy_of", "discretisation", "proved")
#: The variables of K, which are not multiplied by the step.
RATE = "kg m2 s-1"


def interpolated(run: Any, times: ArrayLike) -> Any:
    """The states of a run at any times between its frames, as the dense output of `solve_ivp`.

    𝒦, γ, ω, attitude and contact are interpolated as by `Trajectory.at`, with order 6 in the time between frames;
    variables that are known only at the frames are omitted, as are estimates of their errors.  The result must have γ
    or the attitude, and 𝒦 or ω.  The contact point is omitted if 𝒦 is vertical and there is no attitude.

    Parameters
    ----------
    run : Result, Dataset or Trajectory
        The result of a scene, or its Dataset; or a `Trajectory`, for which this is `Trajectory.at`.
    times : array_like
        One number or a list, in seconds, or in steps if the run has no times.

    Returns
    -------
    Dataset
        The result, with these times as its frames; for a `Trajectory` the result of its `at`.

    Raises
    ------
    BadInput
        If the result lacks a needed variable, for times beyond the frames, and for frames with a rotation of more than
        1.5 radians between them.

    Examples
    --------
    >>> import chapsym
    >>> ball, start = {"mass_tensor": [1, 2, 4], "D": 3}, {"omega": [1, 0, 0], "gamma": [0, 0, 1]}
    >>> result = chapsym.run_scene({"ball": ball, "start": start, "run": {"time": 1.0, "time_step": 0.1}})
    >>> chapsym.interpolated(result, [0.25, 0.5]).gamma.values[0].round(6).tolist()
    [[0.0, 0.247404, 0.968912], [0.0, 0.479426, 0.877583]]
    """
    if callable(getattr(type(run), "at", None)):
        return run.at(times)
    if not hasattr(type(run), "data_vars"):
        raise BadInput(f"run must be a result, its Dataset, or a Trajectory, not {brief(run)}")
    dataset = run if "ball" in run.dims else run.expand_dims("ball")
    if (reason := missing(dataset)) is not None:
        raise BadInput(f"there is nothing between the frames: {reason}")
    frames, per_step = _states(dataset)
    found = frames.at(np.atleast_1d(numbers(times, "times")))
    axes = _axes(dataset)
    values: dict[str, Floats | None] = {
        "momentum": from_principal(axes, found.momentum * per_step), "gamma": from_principal(axes, found.gamma),
        "omega": from_principal(axes, found.omega), "contact": found.contact,
        "attitude": None if found.attitude is None else attitude_from_principal(axes, found.attitude),
    }  # fmt: skip
    kept = dataset.drop_vars(
        [name for name, one in dataset.variables.items() if "frame" in one.dims or name == "error"]
    )
    kept.attrs = {name: one for name, one in kept.attrs.items() if name not in ERRORS}
    for name in FOLLOWED:
        if name in dataset and values[name] is not None:
            dims = ("ball", "frame", *(dim for dim in dataset[name].dims if dim not in ("ball", "frame")))
            kept[name] = dims, values[name], dataset[name].attrs
    for name in ("step", "time"):
        if name in dataset.coords:
            there = np.interp(found.time, frames.clock, np.asarray(dataset[name].values, dtype=np.float64))
            kept = kept.assign_coords({name: ("frame", there, dataset[name].attrs)})
    return kept


def missing(dataset: Dataset) -> str | None:
    """Why the motion between the frames of a result is not known, in a sentence; None if it is."""
    if "row" in dataset.dims or dataset.sizes.get("axis", 3) != 3:
        return "it is known in three dimensions only"
    if not {"gamma", "attitude"} & set(dataset.data_vars):
        return 'no γ: add "gamma" to run.outputs'
    if "momentum" not in dataset and not ("omega" in dataset and "time" in dataset.coords):
        return 'no 𝒦 and no ω: add "momentum" to run.outputs'
    if not {"mass_tensor", "D"} <= set(dataset.variables):
        return "the result does not know J and D"
    return None


def turning(dataset: Dataset) -> float | None:
    """The largest rotation between successive frames of all balls, in radians; None if it is unknown."""
    if missing(dataset) is not None or not dataset.sizes.get("frame"):
        return None
    frames, _ = _states(dataset if "ball" in dataset.dims else dataset.expand_dims("ball"))
    return frames.turning()


def _states(dataset: Dataset) -> tuple[States, float]:
    """The frames in principal axes, and the factor from K (in radians per unit of the clock) to the momentum."""
    timed, stepped = "time" in dataset.coords, "step" in dataset.coords
    step = np.asarray(dataset["step"].values if stepped else np.arange(dataset.sizes["frame"]), dtype=np.float64)
    clock = np.asarray(dataset["time"].values, dtype=np.float64) if timed else step
    per_step = 1.0
    if "momentum" in dataset and timed and dataset["momentum"].attrs.get("units") != RATE:
        per_step = clock[-1] / step[-1] if step[-1] else 1.0
    axes, J, D = _axes(dataset), per_ball(dataset, "mass_tensor"), per_ball(dataset, "D")
    assert J is not None
    assert D is not None
    there, given = standing(**{name: _frames(dataset, name) for name in FOLLOWED})
    attitude, gamma = given["attitude"], given["gamma"]
    attitude = None if attitude is None else attitude_to_principal(axes, attitude)
    if gamma is None:
        assert attitude is not None
        gamma = kernels.transport(attitude, np.broadcast_to([0.0, 0.0, 1.0], (*attitude.shape[:-1], 3)))
    else:
        gamma = to_principal(axes, gamma)
    ball = Ball(J, D, per_ball(dataset, "radius"))
    momentum, omega = given["momentum"], given["omega"]
    if momentum is not None:
        K = to_principal(axes, momentum) / per_step
    else:
        assert omega is not None
        K = kernels.contact_momentum(to_principal(axes, omega), gamma, J[:, np.newaxis], D[:, np.newaxis])
    return States(ball, clock, there, K, gamma, attitude, None if ball.radius is None else given["contact"]), per_step


def _frames(dataset: Dataset, name: str) -> Floats | None:
    """A variable as float64, (balls, frames, ...), NaN after the last step of a ball; None if it is missing."""
    if name not in dataset:
        return None
    found = np.array(dataset[name].transpose("ball", "frame", ...).values, dtype=np.float64)
    if "taken" in dataset and "step" in dataset.coords:
        found[dataset["step"].values > np.atleast_1d(dataset["taken"].values)[:, np.newaxis]] = np.nan
    return found


def per_ball(dataset: Dataset, name: str) -> Floats | None:
    """A variable with one row per ball, (balls, ...), as float64; None if the result has none."""
    if name not in dataset.variables:
        return None
    array = dataset[name] if "ball" in dataset[name].dims else dataset[name].expand_dims("ball")
    return np.asarray(array.transpose("ball", ...).values, dtype=np.float64)


def _axes(dataset: Dataset) -> Floats:
    """The unit quaternions from principal axes to those of the result, (balls, 1, 4)."""
    axes = per_ball(dataset, "axes")
    return np.array([[[1.0, 0.0, 0.0, 0.0]]]) if axes is None else axes[:, np.newaxis]
