"""(5.2) as three quadrics in P³, 𝒦(q, γ) - 𝒦(q0² + |q|²), and their eight complex common points in float64.

A rotation is a real point (q0, q1, q2, q3) up to a factor.  The coefficients are computed with the momentum kernel, in
the numbers of its arguments: fmpq, arrays.  The points are found for many balls at once.

Macaulay's matrix of degree 4 has an 8-dimensional kernel, on which a linear form over another acts as multiplication:
its eigenvectors are the points (as in `enclosed`).  They are then polished by Newton's iteration in C⁴, where the
Newton-Kantorovich test says what each is: an isolated root, or not proved to be one.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np

from chapsym.generated import momentum

from ..ball import Floats

EPSILON = 2.0**-52
#: The number of Newton iterations on the eigenvectors; they converge quadratically from about 1e-10, or are rejected.
POLISHINGS = 3
#: A bound of the rounding of a residual, in units of EPSILON and of the norm of the forms.
ROUNDINGS = 16.0
#: A quadratic form: the coefficient of x_a x_b under (a, b), a ≤ b.
Quadric = dict[tuple[int, ...], Any]

PAIRS = tuple(itertools.combinations_with_replacement(range(4), 2))


@dataclass(frozen=True)
class Candidates:
    """The eight points of each ball.

    points: (n, 8, 4), complex, of length 1, with the phase that makes the imaginary part least.
    error: a bound of the distance of the root, by Newton-Kantorovich with roundings, (n, 8).
    bend: |F'⁻¹F''|, (n, 8): no other root is nearer than about 1/bend, if error·bend is small.
    sound: whether the matrices of the ball had full rank, (n,).
    """

    points: np.ndarray
    error: Floats
    bend: Floats
    sound: np.ndarray


def momentum_forms(gamma: Sequence[Any], mass_tensor: Sequence[Any], D: Any) -> list[Quadric]:
    """𝒦₁, 𝒦₂, 𝒦₃ as quadratic forms in (q0, q1, q2, q3), by polarisation."""

    def value(*indices: int) -> tuple[Any, ...]:
        return momentum(*(*(int(v in indices) for v in range(4)), *gamma, *mass_tensor, D))

    single = [value(a) for a in range(4)]
    forms: list[Quadric] = [{}, {}, {}]
    for a, b in PAIRS:
        both = value(a, b)
        for i, form in enumerate(forms):
            form[a, b] = single[a][i] if a == b else both[i] - single[a][i] - single[b][i]
    return forms


def quadrics(momentum: Sequence[Any], gamma: Sequence[Any], mass_tensor: Sequence[Any], D: Any) -> list[Quadric]:
    """The quadrics 𝒦(q, γ) - 𝒦(q0² + |q|²); their real zeros are the rotations with the momentum 𝒦."""
    forms = zip(momentum_forms(gamma, mass_tensor, D), momentum, strict=True)
    return [{at: c - k if at[0] == at[1] else c for at, c in form.items()} for form, k in forms]


def candidates(forms: Floats) -> Candidates:
    """The common points of three quadrics xᵀSᵢx, symmetric matrices of shape (n, 3, 4, 4)."""
    basis, stretch = _orthonormal(forms)
    points, sound = _eigenvectors(basis)
    for _ in range(POLISHINGS):
        correction = _newton(basis, points)[0]
        points = points + correction
        points /= np.linalg.norm(points, axis=-1, keepdims=True)
    correction, inverse = _newton(basis, points)
    # For orthonormal forms |F'⁻¹F''| has the Frobenius norm of 2F'⁻¹.
    size = np.linalg.norm(inverse, axis=(-2, -1))
    bend, noise = 2 * size, ROUNDINGS * EPSILON * stretch[:, np.newaxis] * size
    error = 2 * (np.linalg.norm(correction, axis=-1) + noise)
    square = (points * points).sum(axis=-1, keepdims=True)
    return Candidates(points * np.exp(-0.5j * np.angle(square)), error, bend, sound)


def _orthonormal(forms: Floats) -> tuple[Floats, Floats]:
    """Orthonormal forms with the same span, and the condition number of the given forms (very large if dependent)."""
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
    inverse[singular] = 1e100  # not used in a proof
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
