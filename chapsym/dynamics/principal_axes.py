"""The principal axes of a tensor, and vectors and attitudes in them; `axes`: unit quaternions to the given axes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from chapsym.generated import compose, rotate

from .errors import BadInput

Floats = NDArray[np.float64]

#: The largest relative difference of a tensor from its transpose that counts as rounding.
ASYMMETRY = 1e-12
#: The number of sweeps of Jacobi's rotations; each at least squares the off-diagonal entries.
SWEEPS = 7
#: Orders of the axes that differ by less than this are equally near, and the first is taken.
TIED = 1e-12


def asymmetry(tensor: Floats) -> Floats:
    """The largest difference between a tensor and its transpose, (...), in its largest component."""
    off, size = np.abs(tensor / 2 - tensor.mT / 2).max(axis=(-2, -1)), np.abs(tensor).max(axis=(-2, -1))
    return np.divide(2 * off, size, out=np.zeros_like(off), where=size > 0)


def is_tensor(array: Floats) -> bool:
    """Whether an array (..., 3, 3) consists of symmetric tensors, to rounding."""
    return array.shape[-2:] == (3, 3) and bool((asymmetry(array) <= ASYMMETRY).all())


def from_inertia_tensor(inertia: Floats) -> Floats:
    """∫xxᵀdm = ½ tr(I) - I, (..., 3, 3); raises BadInput if I is not symmetric to rounding."""
    if not is_tensor(inertia):
        off = np.abs(inertia - inertia.mT).max()
        raise BadInput(f"inertia must be symmetric, but it differs from its transpose by {off:.3g} kg m²")
    even = inertia / 2 + inertia.mT / 2
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        tensor = np.trace(even / 2, axis1=-2, axis2=-1)[..., np.newaxis, np.newaxis] * np.eye(3) - even
    if not np.isfinite(tensor).all():
        raise BadInput("inertia is beyond the range of float64, about 1.8e308")
    return tensor


@np.errstate(under="ignore")
def principal(tensor: Floats, least: float = 0.0) -> tuple[Floats, Floats | None]:
    """The principal moments of ∫xxᵀdm, (..., 3), and unit quaternions (..., 4) that turn principal to given axes.

    The axes are right-handed, in the order and with the signs nearest to the given axes; None if the tensor is
    diagonal.  Moments that are negative by rounding, or by at most `least`, are 0.  Raises BadInput if one is more
    negative.
    """
    diagonal = np.diagonal(tensor, axis1=-2, axis2=-1)
    off = np.abs(tensor - diagonal[..., np.newaxis] * np.eye(3)).max(axis=(-2, -1)) > 0
    if not off.any():
        return _of_a_body(diagonal, least), None
    moments, axes = _eigen(tensor)
    orders = np.array([[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]])
    nearness = np.abs(axes[..., np.arange(3), orders]).sum(axis=-1)  # for each order: Σ |Qᵢ,order(i)|
    order = orders[(nearness >= nearness.max(axis=-1, keepdims=True) - TIED).argmax(axis=-1)]
    moments, axes = np.take_along_axis(moments, order, -1), np.take_along_axis(axes, order[..., np.newaxis, :], -1)
    along = np.diagonal(axes, axis1=-2, axis2=-1)
    axes = axes * np.where(along < 0, -1.0, 1.0)[..., np.newaxis, :]
    weakest = np.arange(3) == np.abs(along).argmin(axis=-1)[..., np.newaxis]
    first, second, third = (axes[..., :, i] for i in range(3))
    mirrored = (np.cross(first, second) * third).sum(axis=-1, keepdims=True) < 0
    axes = axes * np.where(weakest & mirrored, -1.0, 1.0)[..., np.newaxis, :]
    moments = np.where(off[..., np.newaxis], moments, diagonal)
    axes = np.where(off[..., np.newaxis, np.newaxis], axes, np.eye(3))
    return _of_a_body(moments, least), quaternions(axes)


def _eigen(tensor: Floats) -> tuple[Floats, Floats]:
    """Ascending eigenvalues, and eigenvectors as columns, of symmetric tensors (..., 3, 3), by Jacobi's rotations.

    It uses sums, products, quotients and roots, which every processor rounds alike; LAPACK's results depend on it.
    """
    exponent = np.frexp(np.abs(tensor).max(axis=(-2, -1), keepdims=True))[1]
    a = np.ldexp(tensor, -exponent)
    axes = np.broadcast_to(np.eye(3), tensor.shape).copy()
    for p, q in ((0, 1), (0, 2), (1, 2)) * SWEEPS:
        off = a[..., p, q]
        with np.errstate(all="ignore"):  # a zero, or nearly: no rotation
            slope = (a[..., q, q] - a[..., p, p]) / (2 * off)
            tan = np.where(slope < 0, -1.0, 1.0) / (np.abs(slope) + np.sqrt(slope * slope + 1))
        tan = np.where(off == 0, 0.0, tan)[..., np.newaxis]
        cos = 1 / np.sqrt(tan * tan + 1)
        for columns in (a, a.swapaxes(-1, -2), axes):
            one, other = columns[..., p].copy(), columns[..., q].copy()
            columns[..., p], columns[..., q] = cos * (one - tan * other), cos * (other + tan * one)
    found = np.ldexp(np.diagonal(a, axis1=-2, axis2=-1), exponent[..., 0])
    order = np.argsort(found, axis=-1, stable=True)
    return np.take_along_axis(found, order, -1), np.take_along_axis(axes, order[..., np.newaxis, :], -1)


def _of_a_body(moments: Floats, least: float) -> Floats:
    """Principal moments of ∫xxᵀdm, with 0 for moments that are negative by rounding; raises BadInput beyond that."""
    largest = np.abs(moments).max(axis=-1, keepdims=True)
    rounding = np.maximum(16 * np.finfo(np.float64).eps * largest, least)
    bad = (moments <= -rounding).any(axis=-1) & (moments < 0).any(axis=-1)
    if bad.any():
        found = moments[bad][0].sum() - moments[bad][0]
        raise no_body(np.where(np.abs(found) <= rounding[bad][0], 0.0, found))
    return np.maximum(moments, 0.0)


def no_body(inertia: Floats) -> BadInput:
    """The error for principal moments of inertia, (3,), that no body has."""
    listed = ", ".join(f"{x:g}" for x in inertia)
    return BadInput(f"no body has the inertia ({listed}): each principal moment is at most the sum of the other two")


def quaternions(rotations: Floats) -> Floats:
    """Unit quaternions, scalar first, (..., 4), of rotation matrices (..., 3, 3).

    4qqᵀ is linear in the matrix; its row with the largest diagonal entry is a multiple of q.
    """
    r = np.moveaxis(rotations, (-2, -1), (0, 1))
    x, y, z = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    xy, xz, yz = r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1]
    rows = np.array(
        [
            [1 + r[0, 0] + r[1, 1] + r[2, 2], x, y, z],
            [x, 1 + r[0, 0] - r[1, 1] - r[2, 2], xy, xz],
            [y, xy, 1 - r[0, 0] + r[1, 1] - r[2, 2], yz],
            [z, xz, yz, 1 - r[0, 0] - r[1, 1] + r[2, 2]],
        ]
    )
    rows = np.moveaxis(rows, (0, 1), (-2, -1))
    best = np.diagonal(rows, axis1=-2, axis2=-1).argmax(axis=-1)
    chosen = np.take_along_axis(rows, best[..., np.newaxis, np.newaxis], -2)[..., 0, :]
    return chosen / np.sqrt((chosen * chosen).sum(axis=-1, keepdims=True))


def inverse(quaternion: Floats) -> Floats:
    """The inverse rotations of unit quaternions (..., 4)."""
    return quaternion * [1.0, -1.0, -1.0, -1.0]


def to_principal(axes: Floats, vectors: Floats) -> Floats:
    """Vectors, (..., 3), converted from the given axes to principal axes; NaN stays NaN."""
    return _on_arrays(rotate, inverse(axes), vectors)


def from_principal(axes: Floats, vectors: Floats) -> Floats:
    """Vectors, (..., 3), converted from principal axes to the given axes; NaN stays NaN."""
    return _on_arrays(rotate, axes, vectors)


def attitude_to_principal(axes: Floats, attitude: Floats) -> Floats:
    """Attitudes of the principal axes, (..., 4), from those of the given axes."""
    return _on_arrays(compose, attitude, axes)


def attitude_from_principal(axes: Floats, attitude: Floats) -> Floats:
    """Attitudes of the given axes, (..., 4), from those of the principal axes; NaN stays NaN."""
    return _on_arrays(compose, attitude, inverse(axes))


def _on_arrays(kernel: Callable[..., tuple[Floats, ...]], first: Floats, second: Floats) -> Floats:
    """A kernel of two groups on arrays (..., k) that broadcast, without the checks of `kernels`, for NaN frames."""
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        parts = kernel(*(array[..., i] for array in (first, second) for i in range(array.shape[-1])))
    return np.stack(parts, axis=-1)
