"""Time reversal: with the momentum reversed, a ball rolls back through its states to its start.

The map is reversible (lemma `reversible`): with ϱ(𝒦, γ) = (-𝒦, γ), ϱΦϱ = Φ⁻¹, also for a symmetric composition, and
with the attitude and the contact point.  So no step needs an inverse: the way back is a run of the map.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from chapsym.numbers import Digits, DoubleDouble, Enclosure, is_a

from .ball import Ball, Floats
from .errors import BadInput
from .map import compose_step, step, trajectory
from .n.run_n import trajectory_n
from .results import Trajectory

#: The distance of the way back from the run at which its steps are checked for another branch.
FAR = 1e-6


class NotRetraced(ArithmeticError):
    """The way back differs: near a fold, the small rotation of a step back is not the inverse of the step.

    Attributes
    ----------
    index : int
        The step of the run (0 is the first) that is not reversed, for the first of the balls.
    balls : list of tuple of int
        The indices of the balls, `()` for one ball.
    trajectory : Trajectory
        The whole way back, as computed by the map.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.trajectory(chapsym.Ball((0.01, 0.5, 1.1), 2), (1.29, -0.85, 0.9), (2 / 7, 3 / 7, 6 / 7), 1)
    >>> try:
    ...     chapsym.reverse(run)
    ... except chapsym.NotRetraced as error:
    ...     error.index, error.balls
    (0, [()])
    """

    def __init__(self, index: int, balls: list[tuple[int, ...]], trajectory: Trajectory) -> None:
        self.index, self.balls, self.trajectory = index, balls, trajectory
        named = ", ".join(map(str, balls[:5])) + (", ..." if len(balls) > 5 else "")
        which = f" (of the first of the balls {named})" if balls[0] else ""
        super().__init__(
            f"the step back does not undo the step {index}{which}: it is so near a fold that the small rotation back "
            "is another one; take a shorter time step"
        )

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.index, self.balls, self.trajectory)


def reverse(run: Trajectory, *, progress: Callable[[int], None] = lambda steps_done: None) -> Trajectory:
    """The way back: the trajectory from the end of `run`, with the momentum reversed, to its start.

    `retrace_error` gives its distance from the run.  The largest measured one was 2⁻⁵³·√(2·stages)·(1 + growth), where
    growth is the factor by which the run amplifies a small change of its start: at most about the angle turned, in
    radians, but exponential near an unstable rotation.  To reverse a single state, change the sign of its momentum.

    Parameters
    ----------
    run : Trajectory
        A run of `trajectory` or `trajectory_n`, for one ball or a batch, in float32 or float64.
    progress : callable, optional
        As for `trajectory`.

    Returns
    -------
    Trajectory
        A trajectory of its own, forward in time.  Its frame j corresponds to frame -1-j of the run: up to rounding,
        `gamma`, `attitude` and `contact` are equal, and `momentum` is opposite (the ball turns the other way).  So
        `reverse(reverse(run))` is the run again.  It has the order, the frames and the time step of the run; its
        contact point starts where that of the run ended.

    Raises
    ------
    BadInput
        If a ball of the run stopped early, or if the run has no frame besides its first.
    NotRetraced
        If a step back takes another branch than the step of the run: never for |𝒦| below the bound of lemma
        `small-branch`, and otherwise observed only for D > 0, within 1% of a fold; checked only in three dimensions.
    StepNotTaken
        As `trajectory` and `trajectory_n` do.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1), 100)
    >>> back = chapsym.reverse(run)
    >>> back.momentum[-1].round(12).tolist()
    [-0.1, -0.2, -0.3]
    """
    steps, every = _frames(run)
    three = isinstance(run.ball, Ball)
    if run.order == 0:
        raise BadInput("the way back of a restored run is that of exact_top with the opposite momentum at its end")
    if np.isnan(run.momentum).any():
        raise BadInput("a ball of the batch stopped early; choose the frames up to `taken` first")
    last: Any = (*[slice(None)] * run.status.ndim, -1)
    attitude = False if run.attitude is None else run.attitude[last]
    traced, start = run.contact is not None, (-run.momentum[last], run.gamma[last])
    go: Any = partial(trajectory, time_step=run.time_step, precision=run.precision) if three else trajectory_n
    go = partial(go, order=run.order, every=every, attitude=attitude, contact=traced, progress=progress)
    back = go(run.ball, *start, steps)
    if traced:
        back.contact[...] += run.contact[..., -1:, :]
    strayed = _strayed(run, retrace_error(run, back)) if three else []
    if strayed:
        raise NotRetraced(strayed[0][1], [ball for ball, _ in strayed], back)
    return back


#: `reverse`, for a run in n dimensions.
reverse_n = reverse


def retrace_error(run: Trajectory, back: Trajectory) -> Floats:
    """The distance between the way back and the run at each frame of the run.

    Parameters
    ----------
    run : Trajectory
        The run.
    back : Trajectory
        The way back, `reverse(run)`.

    Returns
    -------
    numpy.ndarray
        The largest of the errors of 𝒦, relative to its largest component, of γ and, if followed, of the attitude, (...,
        frames).

    Raises
    ------
    BadInput
        For anything but two trajectories of equal shape.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1), 100)
    >>> bool(chapsym.retrace_error(run, chapsym.reverse(run)).max() < 1e-14)
    True
    """
    if not is_a(run, Trajectory) or not is_a(back, Trajectory) or run.gamma.shape != back.gamma.shape:
        raise BadInput("run and back must be a Trajectory and its way back, of equal shape: back = reverse(run)")

    def apart(there: Floats, here: Floats) -> Floats:
        """The largest difference in each frame, of vectors or matrices."""
        frames = run.status.ndim
        return np.asarray(np.abs(there - np.flip(here, frames)).max(axis=tuple(range(frames + 1, there.ndim))))

    size = apart(run.momentum, np.zeros_like(run.momentum)).max(axis=-1, keepdims=True)
    gap = apart(run.momentum, -back.momentum) / np.where(size > 0, size, 1.0)
    gap = np.maximum(gap, apart(run.gamma, back.gamma))
    if run.attitude is None or back.attitude is None:
        return gap
    return np.maximum(gap, apart(run.attitude, back.attitude))


def _frames(run: Trajectory) -> tuple[int, int]:
    """The number of steps from the first frame to the last, and from one frame to the next."""
    if not is_a(run, Trajectory):
        raise BadInput(f"run must be a Trajectory, not {type(run).__name__}; of a state, reverse the momentum")
    if isinstance(run.precision, DoubleDouble | Digits | Enclosure):
        raise BadInput("reverse goes back in float32 or float64 only: a run starts from floats, not from finer numbers")
    if len(run.index) < 2:
        raise BadInput("the run has no frame besides its first, so there is no way back")
    return int(run.index[-1] - run.index[0]), int(run.index[1] - run.index[0])


def _strayed(run: Trajectory, error: Floats) -> list[tuple[tuple[int, ...], int]]:
    """(ball, step) for each ball with a step that the small rotation back does not undo.

    Rounding may bring a way back as far off, by an unstable rotation: so the steps where it strays are looked at alone.
    """
    found = []
    for ball in map(tuple, np.argwhere((error > FAR).any(axis=-1)).tolist()):
        frame = int(np.flatnonzero(error[ball] > FAR).max())
        if (step := _last_not_undone(run, ball, frame)) is not None:
            found.append((ball, int(run.index[frame]) + step))
    return found


def _last_not_undone(run: Trajectory, which: tuple[int, ...], frame: int) -> int | None:
    """The last step between two frames that the step back does not reverse; None if all are reversed."""
    leading = run.momentum.shape[:-2]
    tensor = np.broadcast_to(run.ball.mass_tensor, (*leading, 3))[which]
    axes = None if run.ball.axes is None else np.broadcast_to(run.ball.axes, (*leading, 4))[which]
    ball = Ball(tensor, np.broadcast_to(run.ball.D, leading)[which], axes=axes)
    between = _frames(run)[1]
    there = trajectory(ball, run.momentum[which][frame], run.gamma[which][frame], between, order=run.order)
    ends = ball, -there.momentum[1:], there.gamma[1:]
    back = step(*ends) if run.order == 2 else compose_step(*ends, run.order)
    off = ~(np.abs(back.gamma - there.gamma[:-1]).max(axis=-1) <= FAR)
    return int(np.flatnonzero(off).max()) if off.any() else None
