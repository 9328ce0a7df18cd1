"""Every rotation with a given momentum, in float64, for one ball or a batch.

(5.2) are three quadrics in P³, 𝒦(q, γ) - 𝒦(q0² + |q|²), of which a rotation is a real point (q0, q1, q2, q3) up to a
factor.  Their coefficients are read off the momentum kernel, in the numbers that it is given: fmpq, arrays.  The eight
complex common points are found together, for many balls at once: Macaulay's matrix of degree 4 has an 8-dimensional
kernel, on which a linear form over another acts as multiplication, and its eigenvectors are the points (as in
`enclosed`).  They are then polished by Newton's iteration in C⁴.

A ball is settled if each of the eight is proved, up to roundings, to be an isolated root: the Newton-Kantorovich test
holds with room to spare, and they differ.  Then Bézout's theorem leaves no other, and a root is real if its conjugate
is not another one.  Complex roots far from all real points need no such proof.  A ball that is not settled in this way,
which is near a fold or has infinitely many complex solutions, is counted exactly (`precise_branches`): float64 numbers
are rational numbers.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import momentum as momentum_kernel

from ..ball import Ball, Floats, batch, largest_moment, numbers, unit_vertical
from ..errors import Status
from ..map import flag, step
from ..shown import Brief
from .continuation import Marchers, nonsingular

#: Most rotations that can have one momentum: the Bézout number of three quadrics.
MOST = 8
#: What error·bend may be; the theorem asks for at most 1/2, without room for what the two leave out.
CERTAIN = 1 / 16
#: Roots nearer than this, in units of 1/bend, are one root.
SAME = 1 / 3
#: A complex point of length 1 with an imaginary part above this is counted as complex.
FAR = 0.05
#: A q0 of a unit quaternion that is not above this is 0: the rotation is by π.
ROUNDING = 2.0**-51
#: Balls that are worked on together.
CHUNK = 1024
#: The rounding of a step is below this, even where D is large or a fold is near.
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
        Of the rotations, in [0, π], shape (..., 8), NaN beyond the count.
    multiplicity : numpy.ndarray
        Of the roots, shape (..., 8), 0 beyond the count; above 1 at a fold.
    count : numpy.ndarray
        The number of rotations, shape (...).
    small : numpy.ndarray
        The place of the rotation that `step` takes, or -1 if it takes none, shape (...).
    complete : numpy.ndarray
        Whether the rotations are known to be all, shape (...).

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


@np.errstate(over="ignore", under="ignore", invalid="ignore")  # a root that overflows is none
def branches(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, *, settle: bool = True) -> Branches:
    """Every rotation Ω with 𝒦(q, γ) = 𝒦 (5.2): all branches of the map.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...), in principal axes.
    momentum : array_like
        𝒦 in kg m², shape (..., 3).
    gamma : array_like
        Unit verticals upwards, shape (..., 3).  Both broadcast with the balls.
    settle : bool, optional
        Whether a ball that float64 does not settle is counted exactly, in some 0.1 s each; otherwise it is not
        complete, and its rotations are a guess.

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
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    n = len(D)
    found = Branches(
        np.full((n, MOST, 4), np.nan), np.full((n, MOST), np.nan), np.zeros((n, MOST), dtype=np.int64),
        np.zeros(n, dtype=np.int64), np.full(n, -1), np.zeros(n, dtype=bool),
    )  # fmt: skip
    for first in range(0, n, CHUNK):
        part = slice(first, first + CHUNK)
        _solve(found, part, K[part], g[part], J[part], D[part])
    if flag(settle, "settle"):
        for i in np.flatnonzero(~found.complete):
            _settle(found, i, K[i], g[i], J[i], D[i])
    _mark_small(found, K, g, J, D)
    return Branches(*(x.reshape((*shape, *x.shape[1:])) for x in vars(found).values()))


def _solve(found: Branches, part: slice, K: Floats, g: Floats, J: Floats, D: Floats) -> None:
    """The rotations of some balls, written into their rows."""
    K, J, D = _scaled(K, J, D)
    # Where D is large, half turns differ in q0 by J/D only: measured in a larger unit of q0 they are far apart.
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
    roots = _polished(q[real], K[where], g[where], J[where], D[where])
    q[real] = _signed(roots)
    q[~real] = np.nan
    angle = 2 * np.arctan2(np.linalg.norm(q[..., 1:], axis=-1), q[..., 0])
    order = np.lexsort((-q[..., 3], -q[..., 2], -q[..., 1], angle))  # NaN comes last
    found.rotation[part] = np.take_along_axis(q, order[..., np.newaxis], axis=1)
    found.angle[part] = np.take_along_axis(angle, order, axis=1)
    found.count[part] = real.sum(axis=1)
    found.multiplicity[part] = ~np.isnan(found.angle[part])


def _scaled(K: Floats, J: Floats, D: Floats) -> tuple[Floats, Floats, Floats]:
    """The same in units in which Λmax is about 1; a momentum that no rotation has is made smaller, not attainable."""
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
        balls.turn(-np.linalg.solve(nonsingular(balls.tangent()), balls.gap(K)[..., np.newaxis])[..., 0])
    return balls.q


def _signed(q: Floats) -> Floats:
    """The one of q and -q whose first component that is not 0 is positive; a q0 that is rounding is 0."""
    q = np.where(np.abs(q) > [ROUNDING, 0.0, 0.0, 0.0], q, 0.0)
    leading = np.take_along_axis(q, (q != 0).argmax(axis=1)[:, np.newaxis], axis=1)
    return np.where(leading < 0, -q, q)


def _settle(found: Branches, i: np.intp, K: Floats, g: Floats, J: Floats, D: float) -> None:
    """The rotations of one ball, from exact arithmetic, which is loaded only when it is needed."""
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
    """Says which of the rotations is the one that `step` takes."""
    taken = step(Ball(J, D), K, g)
    distance = np.abs(found.rotation - taken.rotation[:, np.newaxis]).max(axis=-1)
    distance = np.where(np.isnan(distance), np.inf, distance)
    marked = (taken.status == Status.TAKEN) & (distance.min(axis=1) < ROUNDED)
    found.small[marked] = distance[marked].argmin(axis=1)


#: Newton's iterations on the eigenvectors; they converge quadratically from about 1e-10, or are not trusted.
ITERATIONS = 3
#: Roundings of a residual, in units of 2⁻⁵² and of the norm of the forms.
ROUNDINGS = 16.0
#: A quadratic form: the coefficient of x_a x_b under (a, b), a ≤ b.
Quadric = dict[tuple[int, ...], Any]

PAIRS = tuple(itertools.combinations_with_replacement(range(4), 2))


@dataclass(frozen=True)
class Candidates:
    """The eight points of each ball.

    points: (n, 8, 4), complex, of length 1, with the phase for which the imaginary part is least.
    error: how far the root may be, by Newton-Kantorovich with roundings, (n, 8).
    bend: |F'⁻¹F''|, (n, 8): no other root is nearer than about 1/bend, if error·bend is small.
    sound: whether the matrices of the ball were of full rank, (n,).
    """

    points: np.ndarray
    error: Floats
    bend: Floats
    sound: np.ndarray


def momentum_forms(gamma: Sequence[Any], mass_tensor: Sequence[Any], D: Any) -> list[Quadric]:
    """𝒦₁, 𝒦₂, 𝒦₃ as quadratic forms in (q0, q1, q2, q3), by polarisation."""

    def value(*indices: int) -> tuple[Any, ...]:
        return momentum_kernel(*(*(int(v in indices) for v in range(4)), *gamma, *mass_tensor, D))

    single = [value(a) for a in range(4)]
    forms: list[Quadric] = [{}, {}, {}]
    for a, b in PAIRS:
        both = value(a, b)
        for i, form in enumerate(forms):
            form[a, b] = single[a][i] if a == b else both[i] - single[a][i] - single[b][i]
    return forms


def quadrics(momentum: Sequence[Any], gamma: Sequence[Any], mass_tensor: Sequence[Any], D: Any) -> list[Quadric]:
    """𝒦(q, γ) - 𝒦(q0² + |q|²), whose real zeros are the rotations with the momentum 𝒦."""
    forms = zip(momentum_forms(gamma, mass_tensor, D), momentum, strict=True)
    return [{at: c - k if at[0] == at[1] else c for at, c in form.items()} for form, k in forms]


def candidates(forms: Floats) -> Candidates:
    """The common points of three quadrics xᵀSᵢx, symmetric matrices of shape (n, 3, 4, 4)."""
    basis, stretch = _orthonormal(forms)
    points, sound = _eigenvectors(basis)
    for _ in range(ITERATIONS):
        correction = _newton(basis, points)[0]
        points = points + correction
        points /= np.linalg.norm(points, axis=-1, keepdims=True)
    correction, inverse = _newton(basis, points)
    # |F'⁻¹F''| for orthonormal forms: its Frobenius norm is that of 2F'⁻¹.
    size = np.linalg.norm(inverse, axis=(-2, -1))
    bend, noise = 2 * size, ROUNDINGS * 2.0**-52 * stretch[:, np.newaxis] * size
    error = 2 * (np.linalg.norm(correction, axis=-1) + noise)
    square = (points * points).sum(axis=-1, keepdims=True)
    return Candidates(points * np.exp(-0.5j * np.angle(square)), error, bend, sound)


def _orthonormal(forms: Floats) -> tuple[Floats, Floats]:
    """Orthonormal forms that span the same, and the condition number of the given ones (very large if dependent)."""
    _, sizes, right = np.linalg.svd(forms.reshape(-1, 3, 16), full_matrices=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        stretch = sizes[:, 0] / sizes[:, 2]
    return right.reshape(-1, 3, 4, 4), np.where(np.isfinite(stretch), stretch, 1e100)


def _eigenvectors(basis: Floats) -> tuple[np.ndarray, np.ndarray]:
    """Points of length 1 from the eigenvectors of a multiplication, and whether the ranks are 27 and 8."""
    tables = _tables()
    macaulay = np.zeros((len(basis), 30, 35))
    coefficients = basis[:, :, tables.first, tables.second] * tables.weight
    for i in range(3):
        for place in range(10):
            macaulay[:, tables.block[i], tables.column[place]] += coefficients[:, i, place, np.newaxis]
    q, r = np.linalg.qr(np.swapaxes(tables.mixed @ macaulay, 1, 2), mode="complete")
    kernel = q[:, :, 27:]
    by_variable = kernel[:, tables.shifted]  # (n, 4, 20, 8)
    plane = np.einsum("v,nvmk->nmk", tables.plane, by_variable)
    separating = np.einsum("v,nvmk->nmk", tables.separating, by_variable)
    q_plane, r_plane = np.linalg.qr(plane)
    sound = (_smallest(r) > 1e-9) & (_smallest(r_plane) > 1e-9)
    r_plane[~sound] = np.eye(8)
    multiplication = np.linalg.solve(r_plane, np.swapaxes(q_plane, 1, 2) @ separating)
    vectors = np.linalg.eig(multiplication)[1]
    evaluated = by_variable @ vectors[:, np.newaxis]  # x_v m at each point, up to a factor
    reference = plane @ vectors
    points = np.einsum("nmp,nvmp->npv", reference.conj(), evaluated)
    length = np.linalg.norm(points, axis=-1, keepdims=True)
    return points / np.where(length > 0, length, 1.0), sound


def _newton(basis: Floats, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The Newton correction orthogonal to each point, (n, 8, 4), and the inverse of the derivative, (n, 8, 4, 3)."""
    gradient = np.einsum("nibc,npc->npib", basis, points)
    value = np.einsum("npib,npb->npi", gradient, points)
    matrix = np.concatenate([2 * gradient, points.conj()[:, :, np.newaxis]], axis=2)
    singular = ~(np.abs(np.linalg.det(matrix)) > 1e-100)
    matrix[singular] = np.eye(4)
    inverse = np.linalg.inv(matrix)[..., :3]
    inverse[singular] = 1e100  # nothing is proved with it
    return -np.einsum("npai,npi->npa", inverse, value), inverse


def _smallest(r: Floats) -> Floats:
    return np.abs(np.diagonal(r, axis1=1, axis2=2)).min(axis=1)


@cache
def _tables() -> SimpleNamespace:
    """Indices of Macaulay's matrix, by monomials of degree 4 and forms times those of degree 2; general constants."""

    def monomials(degree: int) -> list[tuple[int, ...]]:
        return list(itertools.combinations_with_replacement(range(4), degree))

    place = {m: i for i, m in enumerate(monomials(4))}
    pairs = monomials(2)
    rows = [(i, m) for i in range(3) for m in pairs]
    block = [[k for k, (j, _) in enumerate(rows) if j == i] for i in range(3)]
    column = [[place[tuple(sorted(p + m))] for m in pairs] for p in pairs]
    shifted = np.array([[place[tuple(sorted((v, *m)))] for m in monomials(3)] for v in range(4)])
    rng = np.random.default_rng(5)
    mixed = np.linalg.qr(rng.normal(size=(30, 27)))[0].T
    plane, separating = np.linalg.qr(rng.normal(size=(4, 2)))[0].T
    return SimpleNamespace(
        block=block, first=[a for a, _ in pairs], second=[b for _, b in pairs],
        weight=np.array([1.0 if a == b else 2.0 for a, b in pairs]),
        column=column, shifted=shifted, mixed=mixed, plane=plane, separating=separating,
    )  # fmt: skip
