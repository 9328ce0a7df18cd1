"""Taylor polynomials of the motion in floats, the longest that the machine has: nothing that is proved rests on them.

Time is τ, in units of a length h that the caller chooses; w = hω, and the momentum is hK, so that both are angles.  The
motion is y' = y × w for what is fixed in space, a' = ½ a∘w, and B(γ)w + hs = hK for the ball, s the angular momentum of
a rotor in it: bilinear in y and w.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from chapsym import generated

from ..loops.vectors import cross

Vector = Sequence[Any] | np.ndarray

#: Coefficients of a polynomial in float64: beyond them are 17 digits, at the length of a step.
TERMS = 44
#: Where it has more digits than float64 there is one correction less.
LONG = np.longdouble


class Series(NamedTuple):
    """a (4, n), γ and w (3, n): coefficients of the motion, long floats; B, A and Φ (n, 3, 3), floats.

    A is the matrix of the linear equation ξ' = Aξ of neighbouring motions (see `deviation`), Φ its solutions from 1.
    """

    a: np.ndarray
    gamma: np.ndarray
    w: np.ndarray
    B: np.ndarray
    A: np.ndarray
    Phi: np.ndarray

    def scaled(self, by: Any) -> "Series":
        """The same with `by` times the unit of time."""
        powers = by ** np.arange(self.a.shape[1])
        rows = powers.astype(float)[:, np.newaxis, np.newaxis]
        return Series(
            self.a * powers, self.gamma * powers, by * self.w * powers, self.B * rows, float(by) * self.A * rows,
            self.Phi * rows,
        )  # fmt: skip

    def sizes(self) -> np.ndarray:
        """The size of each coefficient, (n,): of w relative to its first."""
        turning = max(np.abs(self.w[:, 0]).max(), 1.0)
        return np.asarray(np.max([np.abs(x).max(axis=0) for x in (self.a, self.gamma, self.w / turning)], axis=0))

    def reach(self) -> float:
        """About the radius in which the series, that of A too, converge, in units of time; infinite of a polynomial."""
        near = np.abs(self.A).max(axis=(1, 2))
        last = np.maximum(self.sizes(), near / max(near[0], 1.0))[-8:]
        with np.errstate(divide="ignore"):
            return float((last ** (-1.0 / np.arange(self.a.shape[1])[-8:])).min())


def bend(J: Vector, w: Vector, x: Vector) -> tuple[Any, Any, Any]:
    """Iw × x - I(w × x), I = (J2 + J3, ...): how the angular momentum of w changes where the body is turned by x/2."""
    (J1, J2, J3), (w1, w2, w3), (x1, x2, x3) = J, w, x
    return (
        (J1 - J2) * (w2 * x3) - (J1 - J3) * (w3 * x2),
        (J2 - J3) * (w3 * x1) - (J2 - J1) * (w1 * x3),
        (J3 - J1) * (w1 * x2) - (J3 - J2) * (w2 * x1),
    )


def motion(a: Vector, k: Vector, J: Vector, D: float, rotor: Vector = (0.0, 0.0, 0.0), terms: int = TERMS) -> Series:
    """The series from the attitude a, with hK = k in space and hs = `rotor` in the body."""
    y, w, one = np.zeros((10, terms), LONG), np.zeros((3, terms), LONG), np.eye(3, dtype=LONG)
    R = np.reshape(generated.rotation(*a), (3, 3))
    y[:4, 0], y[4:7, 0], y[7:, 0] = a, R[2], np.asarray(k) @ R
    B = np.zeros((terms, 3, 3), LONG)
    B[0] = np.transpose([generated.contact_momentum(*(*e, *y[4:7, 0], *J, D)) for e in one])
    inverse = np.transpose([generated.angular_velocity(*(*e, *y[4:7, 0], *J, D)) for e in one])
    w[:, 0] = inverse @ (y[7:, 0] - rotor)
    for n in range(terms - 1):
        y[:, n + 1] = _BILINEAR @ (y[:, : n + 1] @ w[:, n::-1].T).ravel() / (n + 1)
        g = y[4:7, : n + 2]
        B[n + 1] = -D * (g @ g[:, ::-1].T)
        w[:, n + 1] = inverse @ (y[7:, n + 1] - np.einsum("mij,jm->i", B[1 : n + 2], w[:, n::-1]))
    B, J, turn = B.astype(float), [float(x) for x in J], w.astype(float)
    C = np.transpose([bend(J, turn, e[:, np.newaxis] * np.ones(terms)) for e in np.eye(3)], (2, 1, 0))
    C[0] += np.transpose([cross([float(x) for x in rotor], e) for e in np.eye(3)])
    A = quotient(B, C)
    return Series(y[:4], y[4:7], w, B, A, linear(A, np.zeros((terms - 1, 3, 3)), np.eye(3)))


def quotient(B: np.ndarray, right: np.ndarray) -> np.ndarray:
    """The series X with BX = right, (n, 3, ...)."""
    found = np.zeros_like(right)
    inverse = np.linalg.inv(B[0])
    for n in range(len(right)):
        m = min(n, len(B) - 1)
        known = np.einsum("mij,mj...->i...", B[1 : m + 1], found[n - m : n][::-1]) if m else 0.0
        found[n] = inverse @ (right[n] - known)
    return found


def linear(A: np.ndarray, rest: np.ndarray, start: np.ndarray) -> np.ndarray:
    """The solution of x' = Ax + rest from x(0) = start, (n + 1, 3, ...), rest (n, 3, ...)."""
    found = np.zeros((len(rest) + 1, *start.shape))
    found[0] = start
    for n in range(len(rest)):
        m = min(n, len(A) - 1)
        found[n + 1] = (np.einsum("mij,mj...->i...", A[: m + 1], found[n - m : n + 1][::-1]) + rest[n]) / (n + 1)
    return found


def long_float(x: Any) -> Any:
    """The middle of a ball."""
    high = float(x)
    with np.errstate(invalid="ignore"):  # beyond float64 it is no number
        return LONG(high) + LONG(float(x - high))


def _bilinear() -> np.ndarray:
    """(½ a∘w, γ × w, K × w) by the products of (a, γ, K), 10, and w, 3: (10, 30)."""
    found = np.zeros((10, 10, 3))
    for i, a in enumerate(np.eye(4)):
        for j, e in enumerate(np.eye(3)):
            found[:4, i, j] = np.array(generated.compose(*(*a, 0.0, *e))) / 2
    for i, v in enumerate(np.eye(3)):
        for j, e in enumerate(np.eye(3)):
            found[4:7, 4 + i, j] = found[7:, 7 + i, j] = np.cross(v, e)
    return found.reshape(10, 30)


_BILINEAR = _bilinear()
