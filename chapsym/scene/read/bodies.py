"""The mass tensors ∫xxᵀdm of bodies, and the principal axes of a tensor.

A body is a batch: masses and lengths are arrays (...), vectors (..., 3), and its tensor is (..., 3) if it is diagonal
in the axes of the user, else (..., 3, 3).  Every centre of mass is the centre of the ball.
"""

from collections.abc import Callable
from inspect import signature

import numpy as np

from chapsym.dynamics import BadInput
from chapsym.dynamics.ball import Floats, last_digit

#: The tolerance for mass outside of the ball by rounding, as that of a shell is at the radius.
ROUNDING = 1e-12
#: The least accepted moments, relative to a homogeneous ball: smaller ones mean mass within a fiftieth of the radius.
LEAST = 1e-3


def homogeneous(mass: Floats, radius: Floats) -> Floats:
    """m ρ²/5 along each axis: ∫x²dm = ⅓ ∫r²dm with ∫r²dm = 3m/ρ³ ∫₀^ρ r⁴dr = 3mρ²/5."""
    return _isotropic(mass * radius**2 / 5)


def shell(mass: Floats, radius: Floats, thickness: Floats | int = 0) -> Floats:
    """m/5 (ρ⁵ - r⁵)/(ρ³ - r³) along each axis, between r = ρ - thickness and ρ; m ρ²/3 as the thickness goes to 0.

    Both differences have the factor ρ - r, which is divided out.
    """
    inner = radius - thickness
    _check((inner >= 0) & (inner <= radius), "thickness must be from 0 to the radius")
    fourth = radius**4 + radius**3 * inner + (radius * inner) ** 2 + radius * inner**3 + inner**4
    return _isotropic(mass / 5 * fourth / (radius**2 + radius * inner + inner**2))


def dumbbell(
    mass: Floats, radius: Floats, point_mass: Floats, separation: Floats, thickness: Floats | int = 0
) -> Floats:
    """A shell, and two equal point masses on the third axis, at ± separation/2; the shell has the rest of the mass.

    The points add 2 point_mass (separation/2)² along the third axis.
    """
    left = mass - 2 * point_mass
    _check(point_mass >= 0, "point_mass must not be negative")
    _check(left >= 0, "the two point masses are more than the mass, which is that of the whole ball")
    inside = (separation >= 0) & (separation <= 2 * (radius - thickness))
    _check(inside, "separation must be from 0 to the inside of the shell")
    points = point_mass * separation**2 / 2
    return shell(left, radius, thickness) + np.stack([0 * points, 0 * points, points], axis=-1)


def bowling(mass: Floats, radius: Floats, block_mass: Floats, block_size: Floats, block_offset: Floats) -> Floats:
    """A homogeneous ball; in it a cuboid block with its middle at block_offset, and a counterweight.

    block_mass is the mass of the block beyond that of the displaced core; its edges block_size are along the axes.  The
    counterweight is a point on the surface, opposite to the block, of the mass block_mass |offset|/ρ, which brings the
    centre of mass to the centre.  The rest of the mass is the homogeneous ball.  ∫xxᵀdm = m₀ρ²/5 + block_mass
    (diag(size²)/12 + oo ᵀ) + block_mass |o| ρ ôôᵀ for the offset o = |o| ô.
    """
    distance = np.sqrt((block_offset * block_offset).sum(axis=-1))
    core = mass - block_mass - block_mass * distance / radius
    corner = np.sqrt(((np.abs(block_offset) + block_size / 2) ** 2).sum(axis=-1))
    _check(block_mass >= 0, "block_mass must not be negative")
    _check((block_size >= 0).all(axis=-1), "block_size must not be negative")
    _check(corner <= radius * (1 + ROUNDING), "the block reaches beyond the radius of the ball")
    _check(core >= 0, "the block and its counterweight are more than the mass, which is that of the whole ball")
    along = np.divide(radius, distance, out=np.zeros_like(distance * radius), where=distance > 0)
    weight = (block_mass * (1 + along))[..., np.newaxis, np.newaxis]
    points = weight * block_offset[..., :, np.newaxis] * block_offset[..., np.newaxis, :]
    even = _isotropic(core * radius**2 / 5) + block_mass[..., np.newaxis] * block_size**2 / 12
    return points + even[..., np.newaxis] * np.eye(3)


#: The ∫xxᵀdm of bodies from mass, radius and other keys, some of them optional.
PRESETS: dict[str, Callable[..., Floats]] = {one.__name__: one for one in (homogeneous, shell, dumbbell, bowling)}


def keys_of(preset: str, required: bool = False) -> tuple[str, ...]:
    """The keys of a preset other than mass and radius, all or only the required ones."""
    _, _, *own = signature(PRESETS[preset]).parameters.values()
    return tuple(one.name for one in own if not required or one.default is one.empty)


#: The keys of all presets.
KEYS = tuple(key for preset in PRESETS for key in keys_of(preset))


def _isotropic(moment: Floats) -> Floats:
    return np.stack([moment, moment, moment], axis=-1)


def _check(holds: np.ndarray | np.bool_, sentence: str) -> None:
    if not np.all(holds):
        raise BadInput(sentence)


def size_rounded_by(mass: object, radius: object) -> float:
    """The relative rounding of mass radius² by the digits of both, ½ δm/m + δρ/ρ; 0 for integers."""
    parts = [(last_digit(x) / x if isinstance(x, float) and 0 < x != round(x) else 0.0) for x in (mass, radius)]
    return min(parts[0] / 2 + parts[1], 0.01)


def unbalanced(what: str, offset: float | None, radius: float | None) -> str:
    """Why a centre of mass off the centre is refused: the model would omit at least the torque m g a of the weight."""
    cost = "" if not (offset and radius) else f", by up to g offset/radius = {9.81 * offset / radius:.2g} m/s²"
    size = "not 0" if offset is None else f"{1e3 * offset:.3g} mm off the centre of the ball"
    return (
        f"{what} is {size}, and the ball of chapsym is balanced: with such an offset the weight speeds the ball up and "
        f"slows it down{cost}, which no result here would have; leave it out to roll the balanced ball"
    )


def check_inside(mass_tensor: Floats, mass: Floats, radius: Floats, rounded: float = 0.0) -> None:
    """Raises BadInput if mass is outside of the ball, or all of it near the centre, by ∫r²dm = tr J and m ρ².

    For a homogeneous ball in n dimensions tr J is n/(n+2) m ρ².  rounded: the excess of tr J that the digits of all
    allow.
    """
    trace, most, m, rho = np.broadcast_arrays(mass_tensor.sum(axis=-1), mass * radius**2, mass, radius)
    n = mass_tensor.shape[-1]
    even = n * most / (n + 2)
    if (low := trace < LEAST * even).any():
        found, wanted = ((n - 1) / n * part[low].flat[0] for part in (trace, even))
        clause = f"{wanted:.3g} kg m² of a homogeneous ball"
        clause = f"1/{wanted / found:.0f} of the {clause}" if found else f"0, not the {clause}"
        lengths = f"{1e3 * np.sqrt(found / m[low].flat[0]):.2g} mm, and its radius is {1e3 * rho[low].flat[0]:.4g} mm"
        mended = "did you mean other units? (for such a body give D = mass radius² instead of mass)"
        raise BadInput(f"its moments of inertia are {clause}: its radius of gyration is {lengths}; {mended}")
    outside = trace > most * (1 + ROUNDING) + rounded
    if outside.any():
        raise BadInput(
            f"some of its mass is outside of the ball: J1 + J2 + J3 = {trace[outside].flat[0]:.4g} kg m² is more than "
            f"mass radius² = {most[outside].flat[0]:.4g}; did you mean other units? (for a body that reaches beyond "
            "its rolling radius, give D = mass radius² instead of mass)"
        )
