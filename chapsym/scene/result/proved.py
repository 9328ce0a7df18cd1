"""Distances of frames from a motion with proved digits, or from the orbit of the map: bounds, not estimates."""

import json
import math
from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from chapsym.dynamics import CertifiedMotion
from chapsym.dynamics.enclosed_motion import follow
from chapsym.dynamics.outputs import BOUND
from chapsym.numbers.precisions import flint_bits

from ..read.errors import SceneError

if TYPE_CHECKING:
    from xarray import Dataset

    from chapsym.dynamics.flow.start import Start
    from chapsym.dynamics.labelled import Arrays

    from ..read.scene import Scene

Data = TypeVar("Data", "Dataset", "Arrays")

#: The compared quantities, with their units.
UNITS = {"gamma": "", "omega": " rad/s", "attitude": "", "contact": " m"}
#: The quantities with bounds in a result of the map, with their units.
UNITS_OF_MAP = {"momentum": " kg m²", "gamma": "", "attitude": "", "contact": " m"}
#: Seconds within which a motion is proved, without a limit in the scene.
LIMIT = 600.0
#: The bits of the differences, so that they have no rounding of float64.
BITS = 128
#: The digits of the motion for a comparison with a result in float64, and the name of the bounds in its attributes.
DIGITS, PROVED = 18, "proved"


def check_outputs(outputs: Iterable[str]) -> None:
    """Raises SceneError if none of them can be compared."""
    if not set(outputs) & set(UNITS):
        raise SceneError(f"the result has none of {', '.join(UNITS)}: ask for one in its outputs")


def motion_to_prove(scene: "Scene") -> "tuple[Start, tuple[Fraction, ...]] | None":
    """The start and the times of a scene that wants its motion proved, else None; raises SceneError if it cannot be."""
    if not scene.run.proved or scene.maps:
        return None
    from ..members.exactly import exact_motion

    check_outputs(scene.run.names())
    return exact_motion(scene)


def with_proof(
    data: Data, exact: tuple[Any, tuple[Fraction, ...]], limit: float, progress: Callable[[str], None]
) -> tuple[Data, CertifiedMotion]:
    """A result with its bounds (`proved_errors`, null where there is none) in the attribute "proved", and the motion.

    exact: the start and the times of its scene (`members.exactly.exact_motion`).  limit: seconds.
    """
    found = follow(*exact, DIGITS, limit=limit, progress=progress)
    errors = {name: error if math.isfinite(error) else None for name, error in proved_errors(data, found).items()}
    return data.assign_attrs({PROVED: json.dumps(errors)}), found


def check_scene(dataset: "Dataset", scene: str) -> None:
    """Raises SceneError for a result of another scene, or with nothing to compare."""
    check_outputs(map(str, dataset))
    if dataset.attrs.get("scene") != scene:
        raise SceneError("the result is of another scene: run this one, and compare its result")


def bounds_of(data: "Dataset | Arrays") -> dict[str, float | None]:
    """The greatest bound at any frame of a result of the map with bounds; None if one is not finite."""
    greatest = {x: float(np.nanmax(data[x + BOUND].values)) for x in UNITS_OF_MAP if x + BOUND in data.variables}
    return {name: error if math.isfinite(error) else None for name, error in greatest.items()}


def proved_errors(dataset: "Dataset | Arrays", found: CertifiedMotion) -> dict[str, float]:
    """For each of UNITS that both have, a bound of the greatest distance of a component at the frames that are proved.

    dataset: a result of the scene of the motion, of one ball.  A quaternion and its negative are one attitude.  A frame
    that is NaN is infinitely far.
    """
    count, errors = len(found.times), {}
    for name in UNITS:
        if count and name in dataset and getattr(found, name) is not None:
            given = np.asarray(dataset[name].values, dtype=float).reshape(-1, *getattr(found, name).shape[1:])
            pairs = zip(given[:count], getattr(found, name)[:count], strict=True)
            errors[name] = max(_apart(x, true, name == "attitude") for x, true in pairs)
    return errors


def _apart(given: np.ndarray, true: np.ndarray, either: bool) -> float:
    """A bound of the greatest difference of a component; either: with the nearer of both signs."""
    from flint import arb

    signs = (1, -1) if either else (1,)
    bounds = []
    for sign in signs:
        with flint_bits(BITS):
            away = [(sign * arb(float(x)) - y).abs_upper() for x, y in zip(given, true, strict=True)]
        bounds.append(max(math.nextafter(float(x), math.inf) if x.is_finite() else math.inf for x in away))
    return min(bounds)
