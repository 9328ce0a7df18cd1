"""What is asked of a motion: balls, times and an accuracy; what answers it, and how far two runs are apart."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, kernels, native, trajectory
from chapsym.dynamics.ball import Asked, Floats, checked_before
from chapsym.dynamics.loops.expected import FIRST, FOUND, RATE, surveyed
from chapsym.dynamics.loops.lanes import MOST_COLUMNS

from .request import lengths

#: What an accuracy may be of.
PARTS = frozenset({"momentum", "gamma", "omega", "attitude", "contact"})
#: The order of long steps with all columns; lower ones are of the map and its compositions.
EXTRAPOLATED = 2 * MOST_COLUMNS
_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class Motion:
    """n balls at frames + 1 equal times.

    angular_momentum: K in kg m²/s, (n, frames + 1, 3).  gamma: (n, frames + 1, 3).  attitude: (n, frames + 1, 4), or
    None.  contact: in m, from (0, 0), (n, frames + 1, 2), or None.
    reached: the last frame of each ball, (n,); later ones are NaN.  status: why it stopped, a `Status`, (n,).
    error: an estimate of each ball's largest error at any frame, (n,), in the norm of `apart`.
    order, steps, total: of each ball, (n,), the steps between two frames, at most, and all; 0 of a steady rotation,
    which needs none.
    """

    angular_momentum: Floats
    gamma: Floats
    attitude: Asked
    contact: Asked
    reached: np.ndarray
    status: np.ndarray
    error: Floats
    order: np.ndarray
    steps: np.ndarray
    total: np.ndarray


@dataclass(eq=False)
class Problem:
    """What is asked for: n balls from K and γ, `frames` times `interval` seconds apart, to an accuracy.

    attitude: (n, 4) or None, where it is not followed.  contact: whether it is.
    parts: what the accuracy is of; with metres in metres, of relative errors and angles times the radius.
    """

    ball: Ball
    K: Floats
    gamma: Floats
    interval: float
    frames: int
    accuracy: float
    attitude: Asked
    contact: bool
    metres: bool = False
    parts: frozenset[str] = PARTS
    threads: int = 0

    def __post_init__(self) -> None:
        """Finds `units`, and what `loops.expected` finds of each ball at the start: `survey`, (FOUND, n)."""
        ball, n = self.ball, len(self.K)
        #: What a relative error of each ball comes to in the norm, (n,): 1, or the radius in m.
        self.units = ball.radius if self.metres and ball.radius is not None else np.full(n, 1.0)
        self.survey: Floats = np.empty((FOUND, n))
        survey = native.loop(surveyed)
        #: What rounding alone may leave of any ball, and whether one may rotate steadily.
        self.floor, self.single = survey(
            self.K, self.gamma, np.ascontiguousarray(ball.mass_tensor), ball.D, self.units, self.end, self.accuracy,
            self.survey,
        )  # fmt: skip

    def __len__(self) -> int:
        return len(self.K)

    def of(self, some: np.ndarray) -> "Problem":
        """Some of the balls."""
        ball = self.ball
        few = checked_before(ball.mass_tensor[some], ball.D[some], None if ball.radius is None else ball.radius[some])
        attitude = None if self.attitude is None else self.attitude[some]
        return replace(self, ball=few, K=self.K[some], gamma=self.gamma[some], attitude=attitude)

    @property
    def end(self) -> float:
        """The time of the last frame, in s."""
        return self.frames * self.interval

    @property
    def rate(self) -> Floats:
        """|ω| at the start in rad/s, (n,)."""
        return self.survey[RATE]

    @property
    def expected(self) -> float:
        """About how many long steps all balls take."""
        return float((self.end / self.survey[FIRST]).sum()) if self.frames else 0.0

    def take(self, order: int, steps: int, stride: int = 1) -> "Motion":
        """The balls at every `stride`-th frame, by `steps` steps of a composition from one to the next."""
        step, total = stride * self.interval / steps, steps * (self.frames // stride)
        run = trajectory(
            self.ball, step * self.K, self.gamma, total, order=order, every=steps, time_step=step,
            attitude=False if self.attitude is None else self.attitude, contact=self.contact, threads=self.threads,
        )  # fmt: skip
        how = (np.full(len(self), x) for x in (np.nan, order, steps, total))
        return Motion(
            run.angular_momentum(), run.gamma, run.attitude, run.contact, run.taken // steps, run.status, *how
        )


def nothing(problem: Problem) -> Motion:
    """Room for the motion, with the start as the first frame."""
    n, kept = len(problem), problem.frames + 1
    reached, status, order, steps, total = np.zeros((5, n), dtype=np.int64)
    try:
        found = Motion(
            np.empty((n, kept, 3)), np.empty((n, kept, 3)),
            None if problem.attitude is None else np.empty((n, kept, 4)),
            np.empty((n, kept, 2)) if problem.contact else None, reached, status, np.zeros(n), order, steps, total,
        )  # fmt: skip
    except (MemoryError, ValueError):
        raise BadInput(f"{kept} states of {n} balls do not fit into memory: keep fewer, by a larger `every`") from None
    found.angular_momentum[:, 0], found.gamma[:, 0] = problem.K, problem.gamma
    if found.attitude is not None:
        found.attitude[:, 0] = problem.attitude
    if found.contact is not None:
        found.contact[:, 0] = 0.0
    return found


def of(found: Motion, some: np.ndarray) -> Motion:
    """Some balls of a motion."""
    arrays: dict[str, Any] = {name: None if array is None else array[some] for name, array in vars(found).items()}
    return Motion(**arrays)


def put(found: Motion, where: np.ndarray, other: Motion) -> None:
    """Copies balls to their place among others."""
    for name, array in vars(other).items():
        if array is not None:
            getattr(found, name)[where] = array


def omega_of(problem: Problem, K: Floats, gamma: Floats) -> Floats:
    """ω of (n, 3) or (n, frames, 3); NaN where K is."""
    tensor, D = problem.ball.mass_tensor, problem.ball.D
    if K.ndim == 3:
        tensor, D = tensor[:, np.newaxis], D[:, np.newaxis]
    missing = np.isnan(K)
    if not missing.any():
        return kernels.angular_velocity(K, gamma, tensor, D)
    omega = kernels.angular_velocity(np.where(missing, 0.0, K), np.where(missing, _UP, gamma), tensor, D)
    return np.where(missing, np.nan, omega)


@np.errstate(all="ignore")  # frames that were not reached are NaN
def apart(problem: Problem, run: Motion, other: Motion, stride: int = 1) -> Floats:
    """How far two runs are apart at each common frame, (n, frames): other has every `stride`-th frame of run.

    The largest of the parts that are asked for: |ΔK|/|K|, |Δγ|, |Δω| over the largest |ω| of the ball, the angle
    between the attitudes in radians, and the distance of the contact points in radii; times the radius, if the accuracy
    is in metres.
    """
    radius = 1.0 if problem.ball.radius is None else problem.ball.radius[:, np.newaxis]
    K, L, gamma = run.angular_momentum[:, ::stride], other.angular_momentum, run.gamma[:, ::stride]
    found, parts = [np.zeros(gamma.shape[:2])], problem.parts
    if "gamma" in parts:
        found.append(lengths(gamma - other.gamma))
    if "momentum" in parts:
        found.append(_over(lengths(K - L), lengths(problem.K)[:, np.newaxis]))
    if "omega" in parts:
        omega = omega_of(problem, K, gamma)
        off = lengths(omega - omega_of(problem, L, other.gamma))
        found.append(_over(off, np.nanmax(lengths(omega), axis=-1, keepdims=True)))
    if "attitude" in parts and problem.attitude is not None:
        q, p = run.attitude[:, ::stride], other.attitude
        found.append(4 * np.arcsin(np.minimum(np.minimum(lengths(q - p), lengths(q + p)) / 2, 1.0)))
    if "contact" in parts and problem.contact:
        found.append(lengths(run.contact[:, ::stride] - other.contact) / radius)
    return np.asarray(np.max(found, axis=0) * (radius if problem.metres else 1.0))


def _over(a: Floats, size: Floats) -> Floats:
    """a / size; of a ball at rest a itself, which is 0."""
    return np.asarray(a / np.where(size > 0, size, 1.0))
