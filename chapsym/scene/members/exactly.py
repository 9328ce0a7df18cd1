"""The motion of a scene with a single ball, from its numbers as written, not as floats: for certified digits."""

import tomllib
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from chapsym.dynamics.attitudes import roll_pitch_yaw
from chapsym.dynamics.enclosed_motion import decimal
from chapsym.dynamics.flow import start as starts
from chapsym.dynamics.flow.start import NO_ROTOR, Balls, Principal, Start, Turns, ball, balls, turning, upright
from chapsym.dynamics.levels.balls import unit
from chapsym.dynamics.map import check_body
from chapsym.rationals import mass_tensor_from

from ..read.bodies import PRESETS, keys_of
from ..read.errors import Data, SceneError
from ..read.scene import Scene
from ..read.tables import DIMENSIONS, SCALAR_FIRST
from ..read.units import MOMENT, RATE, Dimension, exact_number
from .members import expand


def exact_motion(scene: Scene) -> tuple[Start, tuple[Fraction, ...]]:
    """The start of the single ball of a scene file, and the times of its frames.

    Raises SceneError if the scene has several balls, uses the map, or has moments that, as written, no body has.
    """
    name = scene.name or "the scene"
    try:
        return _exact_motion(scene, name)
    except SceneError:
        raise
    except ValueError as error:
        raise SceneError(f"{name}: {error}") from None


def without_rotors(scene: Scene) -> Scene:
    """A scene without rotors, which runs in float64 refuse."""
    return scene.model_copy(update={"ball": tuple(one.model_copy(update={"rotor": None}) for one in scene.ball)})


def case_of(name: str, title: str | None, start: Start) -> Data:
    """The description of the ball in the file of a certified motion, which `chapsym judge --against` needs.

    Empty for a tensor that is not diagonal in the axes of the body: `judge` then needs the scene.
    """
    if start.axes is not None:
        return {}
    whole = sum(start.mass_tensor)
    body: Data = {"inertia": [decimal(whole - x) for x in start.mass_tensor]}
    if start.radius is not None:  # otherwise nothing touches the body
        body = {"mass": decimal(start.D / start.radius**2), "radius": decimal(start.radius)} | body
    if any(map(any, start.rotor)):
        body["rotor"] = [decimal(x.rational) for x in start.rotor]
    return {"case": name, "title": title, "ball": body}


def _exact_motion(scene: Scene, name: str) -> tuple[Start, tuple[Fraction, ...]]:
    if scene.toml is None:
        raise SceneError(f"{name}: certified digits need the numbers as a scene file writes them")
    if len(expand(without_rotors(scene))) != 1:
        raise SceneError(f"{name}: certified digits are of one ball; this scene has several, or a range")
    if scene.maps:
        clause = "is of the map; certify motion is of the continuous ball: give start.omega, or start.velocity"
        raise SceneError(f"{name} {clause}")
    data = tomllib.loads(scene.toml, parse_float=lambda text: text.replace("_", ""))
    table = data["ball"][0] if isinstance(data["ball"], list) else data["ball"]
    beginning = table.get("start") or data["start"]
    moments, D, axes = _body(table)
    if axes is None:
        check_body(moments, D)
    radius = _rational(table, "radius") if "radius" in table else None
    attitude = _attitude(beginning)
    rotor = _numbers(table, "rotor") if "rotor" in table else NO_ROTOR
    spin = _number(beginning.get("spin", 0), RATE)
    if "velocity" in beginning:
        assert radius is not None
        first, second = (x.rational for x in _numbers(beginning, "velocity"))
        momentum = turning((-second / radius, first / radius, spin), D, True, rotor)  # ω = (-v₂/ρ, v₁/ρ, spin) in space
    else:
        momentum = turning(_numbers(beginning, "omega"), D, beginning.get("axes") == "space", rotor)
    first, second = (x.rational for x in _numbers({"position": (0, 0)} | beginning, "position"))
    moving = _numbers(beginning, "velocity" if "velocity" in beginning else "omega")
    if any(map(any, rotor)) and not any(map(any, (*moving, spin))):
        raise SceneError(f"{name}: without angular velocity the ball stays at rest, whatever the rotor")
    start = Start(moments, D, attitude, momentum, radius, (first, second), rotor, axes)
    run, (steps, every) = data["run"], scene.run.counts()
    whole = _rational(run, "time_step") * every if "time_step" in run else _rational(run, "time") / steps
    return start, tuple(i * whole for i in range(steps // every + 1))


def _numbers(table: Data, key: str) -> tuple[Turns, ...]:
    return tuple(_number(x, DIMENSIONS[key]) for x in table[key])


def _number(value: Any, dimension: Dimension) -> Turns:
    return Turns(*exact_number(value, dimension))


def _rational(table: Data, key: str) -> Fraction:
    return _number(table[key], DIMENSIONS[key]).rational


#: The principal moments of ∫xxᵀdm and their axes, in balls at the precision that is set.
Axes = Callable[[], Principal]


def _body(table: Data) -> tuple[tuple[Fraction, ...], Fraction, Axes | None]:
    """Exact J and D; for a tensor that is not diagonal, its axes instead of J."""
    D = _rational(table, "D") if "D" in table else _rational(table, "mass") * _rational(table, "radius") ** 2
    if "mass_tensor" in table:
        return tuple(x.rational for x in _numbers(table, "mass_tensor")), D, None
    if "inertia" in table:
        rows = table["inertia"]
        if not isinstance(rows[0], list):
            return mass_tensor_from([x.rational for x in _numbers(table, "inertia")]), D, None
        matrix = [[_number(x, MOMENT).rational for x in row] for row in rows]
        half = sum((matrix[i][i] for i in range(3)), Fraction(0)) / 2
        whole = [[half * (i == j) - (matrix[i][j] + matrix[j][i]) / 2 for j in range(3)] for i in range(3)]
        if not any(whole[i][j] for i in range(3) for j in range(i)):
            return tuple(whole[i][i] for i in range(3)), D, None
        return (), D, lambda: starts.principal_exactly(whole)
    preset, keys = PRESETS[table["preset"]], ("mass", "radius", *keys_of(table["preset"]))
    given: Data = {key: _exactly(table, key) for key in keys if key in table}
    if "block_offset" not in given:
        return tuple(preset(**given)), D, None

    def axes() -> Principal:
        """With a root in it: the distance of the block."""
        inside = {key: np.vectorize(ball, otypes=[object])(x[np.newaxis]) for key, x in given.items()}  # a batch of one
        return starts.principal(preset(**inside)[0].tolist())

    return (), D, axes


def _exactly(table: Data, key: str) -> Any:
    """A number, or three, as an array of Fractions."""
    given = [x.rational for x in _numbers(table, key)] if isinstance(table[key], list) else _rational(table, key)
    return np.array(given, dtype=object)


def _attitude(start: Data) -> Callable[[], Balls]:
    """The quaternion in balls, of any length if given."""
    if "rpy" in start:
        angles = _numbers(start, "rpy")
        return lambda: unit(roll_pitch_yaw([(half.cos(), half.sin()) for half in (ball(x) / 2 for x in angles)]))
    for key, order in SCALAR_FIRST.items():
        if key in start:
            given = _numbers(start, key)
            return partial(balls, [given[i].rational for i in order])
    return upright(_numbers(start, "gamma") if "gamma" in start else (Fraction(0), Fraction(0), Fraction(1)))
