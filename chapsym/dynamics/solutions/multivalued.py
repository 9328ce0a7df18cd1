"""All rotations with a given momentum, in float64, for one ball or a batch.

The eight complex solutions of (5.2) are found together (`candidates`).  A ball is settled if each of them is proved, up
to roundings, to be an isolated root: the Newton-Kantorovich test holds with room to spare, and the eight differ.  Then
Bézout's theorem excludes others, and a root is real if its conjugate is not another root.  Complex roots far from all
real points need no such proof.  A ball that is not settled in this way, near a fold or with infinitely many complex
solutions, is counted exactly (`precise_branches`): float64 numbers are rational numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Ball, Floats, batch, callback, largest_moment, numbers, unit_vertical
from ..errors import Status
from ..map import flag, step
from ..shown import Brief
from .candidates import Candidates, candidates, quadrics
from .continuation import Marchers, nonsingular

#: The largest number of rotations with one momentum: the Bézout number of three quadrics.
MOST = 8
#: The largest error·bend: the theorem requires at most 1/2, and both are approximate.
CERTAIN = 1 / 16
#: Roots nearer than this, in units of 1/bend, are one root.
SAME = 1 / 3
#: A complex point of length 1 with an imaginary part above this is counted as complex.
FAR = 0.05
#: A q0 of a unit quaternion up to this is 0: a rotation by π.
ROUNDING = 2.0**-51
CHUNK = 1024
#: A bound of the rounding of a step, even for a large D or near a fold.
ROUNDED = 1e-3
POLISHINGS = 2


@dataclass(frozen=True, eq=False, repr=False)
class Branches(Brief):
    """All rotations with a momentum, by angle, for one ball or a batch with the leading axes (...).

    Attributes
    ----------
    rotation : numpy.ndarray
        Euler parameters (q0, q1, q2, q3), q0 ≥ 0, and at q0 = 0 the first of the others that is not 0 is positive;
        shape (..., 8, 4), NaN beyond the count.
    angle : numpy.ndarray
        The rotation angles in [0, π], shape (..., 8), NaN beyond the count.
    multiplicity : numpy.ndarray
        The multiplicities of the roots, shape (..., 8), 0 beyond the count; above 1 at a fold.
    count : numpy.ndarray
        The number of rotations, shape (...).
    small : numpy.ndarray
        The index of the rotation of `step`, or -1 if it takes none, shape (...).
    complete : numpy.ndarray
        Whether the rotations are known to be complete, shape (...).

    Examples
    --------
    >>> import chapsym
    >>> ball, K, gamma = chapsym.Ball((1, 2, 4), 3), (1, -0.5, 0.75), (2 / 7, 3 / 7, 6 / 7)
    >>> found = chapsym.branches(ball, K, gamma)
    >>> found.rotation[found.small].round(6).tolist()
    [0.991972, 0.065361, -0.017642, 0.106812]
    >>> found.multiplicity.tolist()
    [1, 1, 1, 1, 0, 0, 0, 0]
    """

    rotation: Floats
    angle: Floats
    multiplicity: np.ndarray
    count: np.ndarray
    small: np.ndarray
    complete: np.ndarray


@np.errstate(all="ignore")  # an overflow is no root
def branches(
    ball: Ball,
    momentum: ArrayLike,
    gamma: ArrayLike,
    *,
    settle: bool = True,
    progress: Callable[[int], None] = lambda balls_done: None,
) -> Branches:
    """All rotations Ω with 𝒦(q, γ) = 𝒦 (5.2): the branches of the map.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...), in principal axes.
    momentum : array_like
        𝒦 in kg m², shape (..., 3).
    gamma : array_like
        Unit verticals upwards, shape (..., 3).  Both broadcast with the balls.
    settle : bool, optional
        Whether a ball that float64 does not settle is counted exactly, in about 0.1 s, or about 10 s if components of
        its moments or momentum have ratios of 10¹⁰⁰; otherwise it is not complete, and its rotations are a guess.
    progress : callable, optional
        Called with the balls done so far: after each 1024, and after each that is counted exactly.

    Returns
    -------
    Branches

    Raises
    ------
    BadInput
        As `step` does.

    References
    ----------
    Equation (5.2) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> found = chapsym.branches(chapsym.Ball((1, 2, 4), 3), (1, -0.5, 0.75), (2 / 7, 3 / 7, 6 / 7))
    >>> int(found.count), bool(found.complete)
    (4, True)
    >>> found.angle[:4].round(6).tolist()
    [0.253599, 2.95257, 3.01505, 3.026705]
    """
    callback(progress)
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    n = len(D)
    found = Branches(
        np.full((n, MOST, 4), np.nan), np.full((n, MOST), np.nan), np.zeros((n, MOST), dtype=np.int64),
        np.zeros(n, dtype=np.int64), np.full(n, -1), np.zeros(n, dtype=bool),
    )  # fmt: skip
    for first in range(0, n, CHUNK):
        part = slice(first, first + CHUNK)
        _solve(found, part, K[part], g[part], J[part], D[part])
        progress(int(found.complete.sum()))
    if flag(settle, "settle"):
        left = np.flatnonzero(~found.complete)
        for done, i in enumerate(left, n - len(left) + 1):
            _settle(found, i, K[i], g[i], J[i], D[i])
            progress(done)
    _mark_small(found, K, g, J, D)
    return Branches(*(x.reshape((*shape, *x.shape[1:])) for x in vars(found).values()))


def _solve(found: Branches, part: slice, K: Floats, g: Floats, J: Floats, D: Floats) -> None:
    """The rotations of some balls, written into their rows."""
    K, J, D = _scaled(K, J, D)
    # For a large D, half turns differ in q0 only by J/D; in a larger unit of q0 they are far apart.
    with np.errstate(over="ignore", divide="ignore"):
        unit = np.minimum(1 + D / J.max(axis=1), 1e20) ** 0.75
    forms = _forms(K, g, J, D)
    forms[:, :, 0] /= unit[:, np.newaxis, np.newaxis]
    forms[:, :, :, 0] /= unit[:, np.newaxis, np.newaxis]
    eight = candidates(forms)
    real, found.complete[part] = _classified(eight)
    q = eight.points.real.copy()
    q[..., 0] /= unit[:, np.newaxis]
    where = np.nonzero(real)[0]
    q[real] = _signed(_polished(q[real], K[where], g[where], J[where], D[where]))
    q[~real] = np.nan
    angle = 2 * np.arctan2(np.linalg.norm(q[..., 1:], axis=-1), q[..., 0])
    order = np.lexsort((-q[..., 3], -q[..., 2], -q[..., 1], angle))  # NaN is last
    found.rotation[part] = np.take_along_axis(q, order[..., np.newaxis], axis=1)
    found.angle[part] = np.take_along_axis(angle, order, axis=1)
    found.count[part] = real.sum(axis=1)
    found.multiplicity[part] = ~np.isnan(found.angle[part])


def _scaled(K: Floats, J: Floats, D: Floats) -> tuple[Floats, Floats, Floats]:
    """The same in units in which Λmax is about 1; an unattainable momentum is reduced, but stays unattainable."""
    exponent = np.frexp(np.maximum(largest_moment(J, D), np.finfo(float).tiny))[1]
    K = np.clip(np.ldexp(K, -exponent[:, np.newaxis]), -16.0, 16.0)
    return K, np.ldexp(J, -exponent[:, np.newaxis]), np.ldexp(D, -exponent)


def _forms(K: Floats, g: Floats, J: Floats, D: Floats) -> Floats:
    """The quadrics as symmetric matrices, (n, 3, 4, 4)."""
    matrices = np.zeros((len(D), 3, 4, 4))
    for i, quadric in enumerate(quadrics(tuple(K.T), tuple(g.T), tuple(J.T), D)):
        for (a, b), coefficient in quadric.items():
            matrices[:, i, a, b] += coefficient / 2
            matrices[:, i, b, a] += coefficient / 2
    return matrices


def _classified(eight: Candidates) -> tuple[np.ndarray, np.ndarray]:
    """Which of the points are real, (n, 8), and for which balls that is certain, (n,)."""
    imaginary = np.linalg.norm(eight.points.imag, axis=-1)
    real = 2 * imaginary * eight.bend < SAME
    isolated = eight.error * eight.bend < CERTAIN
    far = (imaginary > FAR) & ~real
    along = np.einsum("npa,nqa->npq", eight.points.conj(), eight.points)
    apart = eight.points[:, np.newaxis] - along[..., np.newaxis] * eight.points[:, :, np.newaxis]
    distance = np.linalg.norm(apart, axis=-1)
    errors = eight.error[:, :, np.newaxis] + eight.error[:, np.newaxis]
    proved = isolated[:, :, np.newaxis] & isolated[:, np.newaxis] & ~np.eye(MOST, dtype=bool)
    different = ((distance > 2 * errors) | ~proved).all(axis=(1, 2))
    return real, (isolated | far).all(axis=1) & different & eight.sound


def _polished(q: Floats, K: Floats, g: Floats, J: Floats, D: Floats) -> Floats:
    """Newton's iteration with the kernels, on rotations (m, 4)."""
    balls = Marchers(q / np.linalg.norm(q, axis=1, keepdims=True), g, J, D, np.zeros(len(D), dtype=np.int64))
    for _ in range(POLISHINGS):
        w = -np.linalg.solve(nonsingular(balls.tangent()), balls.gap(K)[..., np.newaxis])[..., 0]
        balls.turn(w, np.full(len(w), True))
    return balls.q


def _signed(q: Floats) -> Floats:
    """q or -q, such that the first component that is not 0 is positive; a q0 that is rounding becomes 0."""
    q = np.where(np.abs(q) > [ROUNDING, 0.0, 0.0, 0.0], q, 0.0)
    leading = np.take_along_axis(q, (q != 0).argmax(axis=1)[:, np.newaxis], axis=1)
    return np.where(leading < 0, -q, q)


def _settle(found: Branches, i: np.intp, K: Floats, g: Floats, J: Floats, D: float) -> None:
    """The rotations of one ball by exact arithmetic, which is imported only when needed."""
    from chapsym.numbers import Double

    from .enclosed import precise_branches

    exact = [[Fraction(float(x)) for x in v] for v in (J, K, g)]
    known = precise_branches(exact[0], Fraction(float(D)), exact[1], exact[2], Double()).write()
    found.rotation[i], found.angle[i], found.multiplicity[i] = np.nan, np.nan, 0
    found.count[i], found.complete[i] = known["count"], known["complete"]
    for place, solution in enumerate(known["solutions"]):
        found.rotation[i, place] = [solution["q0"], *solution["q"]]
        found.angle[i, place], found.multiplicity[i, place] = solution["angle"], solution["multiplicity"]


def _mark_small(found: Branches, K: Floats, g: Floats, J: Floats, D: Floats) -> None:
    """Marks the rotation of `step`."""
    taken = step(Ball(J, D), K, g)
    distance = np.abs(found.rotation - taken.rotation[:, np.newaxis]).max(axis=-1)
    distance = np.where(np.isnan(distance), np.inf, distance)
    marked = (taken.status == Status.TAKEN) & (distance.min(axis=1) < ROUNDED)
    found.small[marked] = distance[marked].argmin(axis=1)
