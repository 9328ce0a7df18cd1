"""A scene with `accuracy` under [run]: the accuracy is given, and rung, order and step are chosen."""

from collections.abc import Callable

from chapsym.accuracy import Accurate, accurate

from ..members.expand import expand
from ..read.scene import Scene, SceneError, single


def run_accurately(scene: Scene, progress: Callable[[str], None] = lambda text: None) -> Accurate:
    """Runs a scene to its accuracy; the result says what was chosen, what it cost and how far off it may be.

    K = Λω - D⟨ω,γ⟩γ is rounded to float64 once, and is exact from there on, as J, D and γ/|γ| are.
    Raises BadInput where the accuracy cannot be had.
    """
    wanted = scene.run
    if wanted.accuracy is None or wanted.time is None:
        raise SceneError("the scene asks for no accuracy: give run.accuracy, run.time and start.omega")
    members, task = expand(scene), scene.task()
    return accurate(
        single(members), members.momentum[0], members.gamma[0], wanted.time, wanted.accuracy, of=task.of,
        frames=task.steps, attitude=wanted.attitude if members.attitude is None else members.attitude[0],
        limit=task.limit, progress=progress,
    )  # fmt: skip
