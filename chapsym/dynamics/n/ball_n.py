"""The ball in n dimensions, its states, and the checks of both."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Floats, Parameters, common_shape, is_flag, keep, largest_moment, numbers, over_states
from ..errors import BadInput
from . import so_n

#: The largest accepted |𝒦 + 𝒦ᵀ|, relative to 𝒦.
SKEW_TOLERANCE = 1e-12
#: The largest accepted |R Rᵀ - 1| and |R γ - eₙ| of a given attitude.
AGREEMENT = 1e-9


@dataclass(frozen=True, eq=False, init=False, repr=False)
class BallN(Parameters):
    """A ball in n ≥ 3 dimensions, or an array of such balls, that rolls without slipping on a hyperplane.

    Parameters
    ----------
    mass_tensor : array_like
        The diagonal of J = ∫ x xᵀ dm about the centre, shape (..., n), in kg m².
    D : array_like
        m ρ² in kg m², shape (...); D = 0 is the Euler top on SO(n).
    radius : array_like, optional
        ρ in m, shape (...); needed only for the contact point.

    Raises
    ------
    BadInput
        For a moment below 0, a D below 0, a radius that is not positive, and if the momentum operator is singular at
        every γ: at most one moment may vanish, two if D > 0.

    References
    ----------
    Section 4 of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.BallN(mass_tensor=(1, 2, 0.5, 3), D=3, radius=0.1)
    >>> ball.n
    4
    """

    mass_tensor: Floats
    D: Floats
    radius: Floats | None

    def __init__(self, mass_tensor: ArrayLike, D: ArrayLike, radius: ArrayLike | None = None) -> None:
        tensor, contact = numbers(mass_tensor, "mass_tensor"), numbers(D, "D")
        rho = None if radius is None else numbers(radius, "radius")
        if not tensor.ndim or tensor.shape[-1] < 3:
            raise BadInput(f"mass_tensor must have n >= 3 moments along its last axis, not the shape {tensor.shape}")
        shapes = [tensor.shape[:-1], contact.shape, *([] if rho is None else [rho.shape])]
        common_shape(shapes, "mass_tensor, D and radius")
        for name, value in (("mass_tensor", tensor), ("D", contact)):
            if (value < 0).any():
                raise BadInput(f"{name} must not be negative, but it is {value.min():g}")
        if rho is not None and not (rho > 0).all():
            raise BadInput(f"radius must be positive, but it is {rho.min():g}")
        with np.errstate(over="ignore", under="ignore"):
            largest = largest_moment(tensor, contact)
        if not np.isfinite(largest).all():
            raise BadInput("the moments of inertia J1 + J2 + D, ... are beyond the range of float64")
        vanishing = (tensor == 0).sum(axis=-1)
        if (vanishing + np.where(contact > 0, 0, 1) > 2).any():
            raise BadInput(
                "the ball has no inertia about some plane: one moment of mass_tensor may vanish, two if D > 0"
            )
        keep(self, mass_tensor=tensor, D=contact, radius=rho)

    @property
    def n(self) -> int:
        """The dimension."""
        return int(self.mass_tensor.shape[-1])


def skew(vector: ArrayLike) -> Floats:
    """The skew matrix of a vector in three dimensions: skew(v) x = v × x.

    Parameters
    ----------
    vector : array_like
        v, (..., 3).

    Returns
    -------
    numpy.ndarray
        (..., 3, 3)

    Raises
    ------
    BadInput
        For anything but finite vectors of three real numbers.

    References
    ----------
    Section 5 of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> chapsym.skew((1, 2, 3)).tolist()
    [[0.0, -3.0, 2.0], [3.0, 0.0, -1.0], [-2.0, 1.0, 0.0]]
    """
    v = numbers(vector, "vector", 3)
    return so_n.from_coordinates(np.stack([v[..., 2], -v[..., 1], v[..., 0]], axis=-1), 3)


def axial(matrix: ArrayLike) -> Floats:
    """The vector (A₃₂, A₁₃, A₂₁) of a skew 3×3 matrix A: the inverse of `skew`.

    Parameters
    ----------
    matrix : array_like
        A, (..., 3, 3).

    Returns
    -------
    numpy.ndarray
        (..., 3)

    Raises
    ------
    BadInput
        For anything but finite matrices of this shape, skew to 1e-12 of their largest entry.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.axial([[0, -3, 2], [3, 0, -1], [-2, 1, 0]]).tolist()
    [1.0, 2.0, 3.0]
    """
    lower = so_n.coordinates(skew_matrices(matrix, 3, "matrix"))
    return np.stack([lower[..., 2], -lower[..., 1], lower[..., 0]], axis=-1)


@np.errstate(under="ignore")
def skew_matrices(value: ArrayLike, n: int, name: str = "momentum") -> Floats:
    """`value` as exactly skew matrices, (..., n, n); raises BadInput if it is not skew to 1e-12."""
    if (array := numbers(value, name)).shape[-2:] != (n, n):
        raise BadInput(f"{name} must be skew matrices of the shape (..., {n}, {n}), not {array.shape}")
    with np.errstate(over="ignore", under="ignore"):
        off, largest = np.abs(array / 2 + array.mT / 2), np.abs(array)
    if (off > SKEW_TOLERANCE / 2 * largest.max(axis=(-2, -1), keepdims=True, initial=0.0)).any():
        raise BadInput(f"{name} must be skew, but it differs from minus its transpose by {2 * float(off.max()):.2g}")
    return np.where(off == 0, array, array / 2 - array.mT / 2)


def invariants_n(momentum: ArrayLike, gamma: ArrayLike) -> Floats:
    """The integrals of the map on every branch (prop-2): functions of 𝒦 and γ that are invariant under rotations.

    Parameters
    ----------
    momentum : array_like
        𝒦, skew, (..., n, n).
    gamma : array_like
        γ, (..., n); both broadcast.

    Returns
    -------
    numpy.ndarray
        (..., m): tr 𝒦²ʲ for j = 1, ..., ⌊n/2⌋, then γᵀ𝒦²ʲγ for j = 1, ..., ⌊(n-1)/2⌋, then |γ|²: a complete set of
        independent ones.

    Raises
    ------
    BadInput
        As `step_n` does, except that γ need not be unit, and for invariants beyond the range of float64.

    References
    ----------
    Proposition 2 of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> chapsym.invariants_n(chapsym.skew((1, 2, 2)), (0, 0.6, 0.8)).round(12).tolist()
    [-18.0, -1.16, 1.0]
    """
    K = numbers(momentum, "momentum")
    K = skew_matrices(K, K.shape[-1] if K.ndim else 3)
    g = numbers(gamma, "gamma", K.shape[-1])
    try:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):  # which is refused
            found = so_n.invariants(K, g)
    except ValueError:
        raise BadInput(f"momentum and gamma do not broadcast: {K.shape}, {g.shape}") from None
    if not np.isfinite(found).all():
        raise BadInput("the invariants are beyond the range of float64, about 1.8e308; take other units")
    return found


@np.errstate(under="ignore")
def attitudes_with(gamma: Floats) -> Floats:
    """The attitudes of the least rotations with R γ = eₙ, (..., n, n), from the body to space.

    R = 1 - vvᵀ/(1 + γₙ) + 2 eₙγᵀ with v = γ + eₙ; for γ = -eₙ, a half turn of the last two axes.
    """
    n, last = gamma.shape[-1], gamma[..., -1]
    flat2 = (gamma[..., :-1] ** 2).sum(axis=-1)
    # 1 + γₙ cancels for a γ that points down; there use (1 - γₙ²)/(1 - γₙ).
    upper = np.where(last < 0, flat2 / (1 - np.minimum(last, 0)), 1 + last)
    down = upper == 0
    upper = np.where(down, 1.0, upper)
    v = np.concatenate([gamma[..., :-1], upper[..., np.newaxis]], axis=-1)
    R = np.eye(n) - v[..., :, np.newaxis] * v[..., np.newaxis, :] / upper[..., np.newaxis, np.newaxis]
    R[..., -1, :] += 2 * gamma
    R[down] = np.diag([*[1.0] * (n - 2), -1.0, -1.0])
    return so_n.polar(R)


def initial_attitudes(attitude: bool | ArrayLike, gamma: Floats, shape: tuple[int, ...]) -> Floats:
    """The first attitudes, (b, n, n): the given ones, checked against γ, or the least rotations."""
    n = gamma.shape[-1]
    if is_flag(attitude):
        return attitudes_with(gamma)
    if (R := numbers(attitude, "attitude")).shape[-2:] != (n, n):
        raise BadInput(f"attitude must be rotations of the shape (..., {n}, {n}), not {R.shape}")
    R = over_states(R, "attitude", shape, 2).reshape(-1, n, n)
    if (np.abs(R) > 2).any() or (np.abs(R @ R.mT - np.eye(n)) > AGREEMENT).any() or (np.linalg.det(R) < 0).any():
        raise BadInput("attitude must be rotations: R Rᵀ = 1 with determinant 1")
    if (np.abs((R @ gamma[..., np.newaxis])[..., 0] - np.eye(n)[-1]) > AGREEMENT).any():
        raise BadInput("attitude and gamma disagree: the attitude must turn gamma to (0, ..., 0, 1)")
    return R
