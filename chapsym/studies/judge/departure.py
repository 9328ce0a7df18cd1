"""How far one trajectory is from the truth, at each frame."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .case import Case, in_space
from .trajectory import Trajectory

#: When a trajectory is said to have departed: m, degrees, per cent.
LIMITS = {"path": 1e-3, "attitude": 1.0, "energy": 1.0, "momentum": 1.0}
UNITS = {"path": "m", "attitude": "degrees", "energy": "%", "momentum": "%", "height": "m", "slip": "m/s"}


def limit_of(name: str) -> str:
    """A limit in words: 1 degree."""
    return f"{LIMITS[name]:g} {'degree' if name == 'attitude' else UNITS[name]}"


@dataclass(frozen=True, eq=False)
class Departure:
    """At the frames, (frames,) each, or None where the file has no velocities.

    path: from the point of contact to that below the centre, m.  attitude: the angle between the two, degrees.
    energy, momentum: of the energy, and of the momentum about the contact point as a vector fixed in space, from those
    at the start, per cent.  height: of the centre above the radius, m.  slip: the speed of the ball's point at the
    floor, m/s.
    """

    path: np.ndarray
    attitude: np.ndarray
    height: np.ndarray
    energy: np.ndarray | None
    momentum: np.ndarray | None
    slip: np.ndarray | None

    def parts(self) -> dict[str, np.ndarray]:
        """Those that there are, by name."""
        return {name: part for name in UNITS if (part := getattr(self, name)) is not None}

    def summary(self, time: np.ndarray) -> dict[str, Any]:
        """The greatest, that at the end, and when the limits are passed: for JSON."""
        found: dict[str, Any] = {}
        for name, part in self.parts().items():
            found[name] = {"greatest": float(np.abs(part).max()), "end": float(part[-1]), "unit": UNITS[name]}
            if name in LIMITS:
                passed = np.flatnonzero(np.abs(part) > LIMITS[name])
                found[name] |= {"limit": LIMITS[name], "departs": float(time[passed[0]]) if passed.size else None}
        return found


def departure(case: Case, found: Trajectory) -> Departure:
    """Compares a trajectory with a case, frame by frame."""
    path = np.linalg.norm(found.centre[:, :2] - case.path, axis=-1)
    energy = momentum = slip = None
    if found.velocity is not None and found.omega is not None:
        known = _carried(case, case.attitude, _rolling(case), case.omega)
        own = _carried(case, found.attitude, found.velocity, found.omega)
        energy = 100 * (own[0] / known[0][0] - 1)
        momentum = 100 * np.linalg.norm(own[1] - known[1][0], axis=-1) / np.linalg.norm(known[1][0])
        slip = np.linalg.norm(found.velocity[:, :2] - _rolling(case, found.omega)[:, :2], axis=-1)
    return Departure(
        path, angle(case.attitude, found.attitude), found.centre[:, 2] - case.radius, energy, momentum, slip
    )


def angle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Between attitudes, in degrees: from the lengths of the sum and the difference, right for small angles, too."""
    apart, together = np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    near, far = np.minimum(apart, together), np.maximum(apart, together)
    return np.degrees(4 * np.arctan2(near, far))


def _rolling(case: Case, omega: np.ndarray | None = None) -> np.ndarray:
    """The velocity of the centre of a ball that rolls: ω × ρe₃."""
    w = case.omega if omega is None else omega
    return case.radius * np.stack([w[:, 1], -w[:, 0], np.zeros(len(w))], axis=-1)


def _carried(
    case: Case, attitude: np.ndarray, velocity: np.ndarray, omega: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The kinetic energy, J, and the momentum about the point of contact, kg m²/s in space."""
    back = attitude * np.array([1, -1, -1, -1])
    turning = case.inertia * in_space(back, omega)
    spin = in_space(attitude, turning)
    energy = (case.mass * (velocity**2).sum(axis=-1) + (omega * spin).sum(axis=-1)) / 2
    return energy, spin + case.mass * case.radius * np.cross([0, 0, 1], velocity)
