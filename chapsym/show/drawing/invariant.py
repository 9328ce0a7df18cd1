"""The possible states of a ball on the spheres of γ and 𝒦/|𝒦|: its invariant curve, or the region by its integrals."""

from contextlib import suppress

import numpy as np
from xarray import Dataset

from chapsym.dynamics import BadInput, Ball, Curve, kernels
from chapsym.dynamics.ball import Floats

from . import reading

#: The relative tolerance of a vertical 𝒦, and the largest distance of an orbit from its drawn curve.
VERTICAL = 1e-9
NEAR = 1e-6
#: The number of points of a curve; on the separatrix u runs from -LONGEST to LONGEST.
POINTS, LONGEST = 721, 20.0
#: The number of positions of the other vector on its circle, for the range of the energy.
ANGLES = 48


def bodies_of(dataset: Dataset) -> list[Ball]:
    """The body of each ball of a result, in its axes; none if the result does not have J and D."""
    J, D, axes = (reading.per_ball(dataset, name) for name in ("mass_tensor", "D", "axes"))
    if J is None or D is None:
        return []
    with suppress(BadInput):
        return [Ball(J[i], D[i], axes=None if axes is None else axes[i]) for i in range(len(J))]
    return []


def unit(vectors: Floats) -> Floats:
    """Vectors (..., 3) divided by their lengths; zero stays zero."""
    largest = np.abs(vectors).max(axis=-1, keepdims=True)
    scaled = np.divide(vectors, largest, out=np.zeros_like(vectors), where=largest > 0.0)
    length = np.sqrt((scaled * scaled).sum(axis=-1, keepdims=True))
    return np.asarray(np.divide(scaled, length, out=scaled, where=length > 0.0))


def is_vertical(momentum: Floats, gamma: Floats) -> bool:
    """Whether 𝒦 = hγ, h ≠ 0, in every frame, (..., 3), but those that are NaN."""
    there = np.isfinite(gamma).all(axis=-1)
    momentum, gamma = momentum[there], gamma[there]
    return bool(momentum.any() and np.abs(np.cross(unit(momentum), gamma)).max() < VERTICAL)


def curve_through(body: Ball, orbit: Floats, D: float) -> Floats | None:
    """The curve ⟨x,Λ⁻¹x⟩ = l, Λ = I + D, on which an orbit (frames, 3) of unit vectors runs, (m, 3).

    For γ of a ball with vertical momentum D is that of the ball; for 𝒦/|𝒦| of a ball with D = 0 it is Poinsot's
    polhode.  None if the orbit is a fixed point, or is not on this curve: then J and D of the result are not those of
    the orbit.
    """
    principal = body.to_principal(orbit)
    try:
        curve = Curve.through(Ball(body.mass_tensor, np.float64(D)), principal[0])
        curve.argument(principal[-1])
    except BadInput:
        return None
    moments = curve.ball.inertia + D
    if np.abs((principal**2 / moments).sum(axis=-1) / curve.level - 1.0).max() > NEAR:
        return None
    end = min(curve.period / 2.0, LONGEST)
    return body.from_principal(curve.point(np.linspace(-end, end, POINTS)))


def energy_range(body: Ball, directions: Floats, cosine: float, of_gamma: bool) -> tuple[Floats, Floats]:
    """Least and largest ½⟨m,ω⟩/|𝒦|² for γ (if `of_gamma`) or m = 𝒦/|𝒦| at `directions`, (...), at a fixed angle.

    directions: unit vectors in principal axes, (..., 3).  The other vector is anywhere on the circle ⟨m,γ⟩ = `cosine`.
    """
    first = np.where(np.abs(directions[..., :1]) < 0.6, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    first = unit(np.cross(directions, first))
    second = np.cross(directions, first)
    turn = np.linspace(0.0, 2.0 * np.pi, ANGLES, endpoint=False)
    ring = np.multiply.outer(first, np.cos(turn)) + np.multiply.outer(second, np.sin(turn))
    here = np.broadcast_to(directions[..., np.newaxis, :], (*directions.shape[:-1], ANGLES, 3))
    others = cosine * here + np.sqrt(max(1.0 - cosine**2, 0.0)) * np.moveaxis(ring, -1, -2)
    m, gamma = (others, here) if of_gamma else (here, others)
    energy = kernels.energy(m, gamma, body.mass_tensor, body.D)
    return -_largest(-energy), _largest(energy)


def _largest(samples: Floats) -> Floats:
    """The maximum of a smooth periodic function from samples, (..., angles): a parabola through the three highest."""
    at = samples.argmax(axis=-1)[..., np.newaxis]
    before, top, after = (np.take_along_axis(samples, (at + d) % samples.shape[-1], -1)[..., 0] for d in (-1, 0, 1))
    bend = before - 2.0 * top + after
    return np.asarray(top - np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(top), where=bend < 0.0))
