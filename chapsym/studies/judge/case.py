"""A certified motion, read from the file that `benchmarks/rolling` holds of it."""

import json
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

from chapsym.dynamics.errors import BadInput


@dataclass(frozen=True, eq=False)
class Case:
    """The truth at the frames, in float64.

    mass in kg, radius in m, inertia: the principal moments about the centre in kg m², (3,).
    time in s, (frames,).  path: the point of contact in m, (frames, 2).  attitude: unit quaternions, scalar first, from
    the axes of the body to space, (frames, 4).  omega: rad/s in space, (frames, 3).
    """

    name: str
    mass: float
    radius: float
    inertia: np.ndarray
    time: np.ndarray
    path: np.ndarray
    attitude: np.ndarray
    omega: np.ndarray


def read_case(file: Path) -> Case:
    """Raises BadInput, one sentence, for a file that is none."""
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
        ball, frames = data["ball"], data["frames"]
        mass, radius, *inertia = (float(Fraction(x)) for x in (ball["mass"], ball["radius"], *ball["inertia"]))
        time = np.array([float(Fraction(frame["time"])) for frame in frames])
        path, attitude, omega = (
            np.array([[float(middle) for middle, _ in frame[part]] for frame in frames])
            for part in ("contact", "attitude", "omega")
        )
        shapes = [path.shape, attitude.shape, omega.shape]
        numbers = (mass, radius, *inertia, *time, *path.flat, *attitude.flat, *omega.flat)
        if shapes != [(len(time), n) for n in (2, 4, 3)] or len(inertia) != 3 or not np.isfinite(numbers).all():
            raise ValueError
        if len(time) < 2 or min(mass, radius) <= 0:
            raise ValueError
        return Case(str(data["case"]), mass, radius, np.array(inertia), time, path, attitude, in_space(attitude, omega))
    except OSError as error:
        raise BadInput(f"{file} cannot be read: {error.strerror or error}") from None
    except (ValueError, KeyError, TypeError, IndexError, ArithmeticError, RecursionError):
        raise BadInput(f"{file} is no case: it must be a file of benchmarks/rolling/data that ends in .json") from None


def in_space(attitude: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Vectors of the body, (..., 3), turned by unit quaternions, (..., 4)."""
    from chapsym import generated

    rows = np.stack(np.broadcast_arrays(*generated.rotation(*np.moveaxis(attitude, -1, 0))), axis=-1)
    return np.einsum("...ij,...j->...i", rows.reshape(*attitude.shape[:-1], 3, 3), vector)
