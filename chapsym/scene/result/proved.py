"""How far the frames of a result are from a motion with proved digits: a bound, not an estimate."""

import math
from typing import TYPE_CHECKING

import numpy as np

from chapsym.dynamics import CertifiedMotion

from ..read.errors import SceneError

if TYPE_CHECKING:
    from xarray import Dataset

#: What is compared, and its unit.
UNITS = {"gamma": "", "omega": " rad/s", "attitude": "", "contact": " m"}


#: Of the differences: so that float64 is no part of them.
BITS = 128


def check_scene(dataset: "Dataset", scene: str) -> None:
    """Raises SceneError for a result of another scene, or with nothing to compare."""
    if not any(name in dataset for name in UNITS):
        raise SceneError(f"the result has none of {', '.join(UNITS)}: ask for one in its outputs")
    if dataset.attrs.get("scene") != scene:
        raise SceneError("the result is of another scene: run this one, and compare its result")


def proved_errors(dataset: "Dataset", found: CertifiedMotion) -> dict[str, float]:
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
    """A bound of the greatest difference of a component, of the nearer sign where either will do."""
    from flint import arb, ctx

    signs = (1, -1) if either else (1,)
    bounds = []
    for sign in signs:
        with ctx.workprec(BITS):
            away = [(sign * arb(float(x)) - y).abs_upper() for x, y in zip(given, true, strict=True)]
        bounds.append(max(math.nextafter(float(x), math.inf) if x.is_finite() else math.inf for x in away))
    return min(bounds)
