"""Arguments and results of functions of a ball in principal axes, turned for a ball with axes of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from inspect import signature
from typing import Any

import numpy as np

from chapsym.numbers import Double, Single, named

from . import principal_axes
from .attitudes import initial_attitude
from .ball import Ball, batch, numbers, unit_vertical
from .errors import BadInput, StepNotTaken

#: The vectors of arguments and of results, by their names.
VECTORS = ("momentum", "angular_momentum", "omega", "gamma")


def in_axes(function: Callable[..., Any], ball: Ball, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
    """What a function of a ball in principal axes answers for a ball with axes of its own, in these."""
    call = signature(function).bind(*args, **kwargs)
    call.apply_defaults()
    call.arguments.update(_principal_arguments(ball, call.arguments))
    try:
        return in_axes_of(ball, function(*call.args, **call.kwargs))
    except StepNotTaken as error:
        if error.trajectory is None:
            raise
        frames = in_axes_of(ball, error.trajectory)
        raise StepNotTaken(error.status, error.reach, error.index, frames) from None


def _principal_arguments(ball: Ball, given: dict[str, Any]) -> dict[str, Any]:
    """The arguments that are others in principal axes."""
    try:
        precision = named(given.get("precision", "double"))
    except ValueError as error:
        raise BadInput(str(error)) from None
    if not isinstance(precision, Single | Double):
        raise BadInput(
            "more digits than float64 has are kept in principal axes only: give the principal moments, and all vectors "
            "in their axes"
        )
    assert ball.axes is not None
    vectors = {
        name: unit_vertical(given[name]) if name == "gamma" else numbers(given[name], name, 3)
        for name in VECTORS
        if name in given
    }
    shape, flat = batch(ball.principal, *vectors.values())
    vectors = {name: array.reshape(*shape, 3) for name, array in zip(vectors, flat, strict=False)}
    found: dict[str, Any] = {name: ball.to_principal(vector) for name, vector in vectors.items()}
    attitude = given.get("attitude", False)
    if not isinstance(attitude, bool | np.bool_) or attitude or given.get("contact"):
        start = initial_attitude(attitude, vectors["gamma"])
        found["attitude"] = principal_axes.attitude_to_principal(ball.axes, start)
    return {"ball": ball.principal, **found}


def in_axes_of(ball: Ball, found: Any) -> Any:
    """A result in principal axes, in those of the ball."""
    frames = getattr(found, "index", None) is not None or np.ndim(getattr(found, "time", 0.0)) > 0
    assert ball.axes is not None
    axes = ball.axes[..., np.newaxis, :] if frames else ball.axes
    turned: dict[str, Any] = {}
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
