"""A scene with `accuracy` under [run]: the accuracy is given, and rung, order and step are chosen."""

from collections.abc import Callable

import numpy as np

from chapsym.accuracy import Accurate, accurate
from chapsym.dynamics import front

from .scene import Scene, SceneError


def run_accurately(scene: Scene, progress: Callable[[str], None] = lambda text: None) -> Accurate:
    """Runs a scene to its accuracy; the result says what was chosen, what it cost and how far off it may be.

    K = Λω - D⟨ω,γ⟩γ is rounded to float64 once, and is exact from there on, as J, D and γ/|γ| are.
    Raises BadInput where the accuracy cannot be had.
    """
    wanted, start, ball = scene.run, scene.start, scene.ball.ball()
    if wanted.accuracy is None or wanted.time is None or start.omega is None:
        raise SceneError("the scene asks for no accuracy: give run.accuracy, run.time and start.omega")
    with np.errstate(over="ignore", invalid="ignore"):
        K = front.contact_momentum(start.omega, start.gamma, ball.mass_tensor, ball.D)
    if not np.isfinite(K).all():
        raise SceneError("K = Λω - D⟨ω,γ⟩γ is beyond the range of float64, about 1.8e308; take other units")
    return accurate(
        ball, K, start.gamma, wanted.time, wanted.accuracy, of=wanted.of or ("contact" if wanted.contact else "state"),
        frames=wanted.frames or 1, attitude=wanted.attitude, limit=600.0 if wanted.limit is None else wanted.limit,
        progress=progress,
    )  # fmt: skip
