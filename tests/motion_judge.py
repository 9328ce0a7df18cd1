"""The judge of what a scene gives without further words: how far every frame is from the motion of the ball.

python tests/motion_judge.py              # the shipped scenes and the random ones, as they are
python tests/motion_judge.py -a 1e-6      # to an accuracy that is asked for
python tests/motion_judge.py --best 3     # the cheapest order and steps of the map within 1e-6, by trying
"""

import argparse
import tempfile
import time
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import motion_reference
import numpy as np
import random_scenes

import chapsym
from chapsym.scene.members.members import expand
from chapsym.scene.plan.plan import plan_of
from chapsym.scene.read.scene import checked
from chapsym.scene.running.sweep import computed

#: Those with a motion in time; four.toml and vertical.toml begin with a momentum of one step of the map, and have none.
SHIPPED = ("bowling", "robot", "spread")
#: Of more balls so many are compared.
MOST = 64
#: No scene needs more stages of the map for the accuracies that are asked for here.
LONGEST = 2**24
#: |Δγ|, |Δω| by the ball's largest |ω|, the angle of the attitude in radians, the contact point by the radius.
PARTS = ("gamma", "omega", "attitude", "contact")


@dataclass(frozen=True)
class Row:
    """The largest distances of a scene from the motion, by part; `told` is the scene's own estimate, if it has one."""

    name: str
    model: str
    far: dict[str, float]
    told: float | None
    seconds: float

    @property
    def worst(self) -> float:
        return max(self.far.values())

    def line(self) -> str:
        far = "  ".join(f"{self.far[part]:8.1e}" if part in self.far else " " * 8 for part in PARTS)
        told = " " * 8 if self.told is None else f"{self.told:8.1e}"
        return f"{self.name:<10}  {far}  {told}  {self.seconds:8.4f}  {self.model}"


HEAD = f"{'scene':<10}  {'gamma':>8}  {'omega':>8}  {'attitude':>8}  {'contact':>8}  {'told':>8}  {'seconds':>8}  model"


def names():
    """All scenes."""
    return [*SHIPPED, "spread+", *map(str, range(random_scenes.COUNT))]


def scene_of(name):
    """The tables of a scene: a random one, or a shipped one, with a + all four parts of its motion."""
    if name.isdigit():
        return random_scenes.scene(int(name))
    scene = motion_reference.load(Path(chapsym.__file__).parent / "scene" / "examples" / f"{name.rstrip('+')}.toml")
    if name.endswith("+"):
        scene["run"]["outputs"] = list(PARTS)
    return scene


def to_accuracy(scene, accuracy):
    """The same scene, to an accuracy at the same times."""
    moments = motion_reference.times(scene["run"])
    frames, outputs = len(moments) - 1, scene["run"]["outputs"]
    return scene | {"run": {"accuracy": accuracy, "time": float(moments[-1]), "frames": frames, "outputs": outputs}}


def judged(name, scene, result, seconds):
    """The distances of a result, a Dataset, from the motion of the balls of its scene."""
    chosen = some(result.sizes["ball"])
    balls, true = truth(
        scene, {key: result[key].values for key in result.coords if "." in str(key)}, len(result["ball"])
    )
    np.testing.assert_allclose(result["time"].values, motion_reference.times(scene["run"]), rtol=1e-12, atol=1e-15)
    far = {part: apart(part, result[part].values[chosen], true, balls) for part in PARTS if part in result}
    told = float(result["error"].max()) if "error" in result else None
    return Row(name, result.attrs["model"], far, told, seconds)


def some(count):
    """The balls that are compared."""
    return np.unique(np.linspace(0, count - 1, min(count, MOST)).astype(int))


def truth(scene, values, count):
    """Those balls, and their motion."""
    balls = motion_reference.balls_of(scene, values, count, some(count))
    return balls, motion_reference.motion(balls, motion_reference.times(scene["run"]))


def apart(part, values, true, balls):
    """The largest distance at any frame of any ball; infinite where one of them was not reached."""
    if not np.isfinite(values).all():
        return np.inf
    off = np.linalg.norm(values - true[part], axis=-1)
    if part == "omega":
        off = off / np.linalg.norm(true[part], axis=-1).max(axis=-1, keepdims=True)
    if part == "contact":
        off = off / balls.radius[:, np.newaxis]
    if part == "attitude":  # q and -q are one attitude
        off = np.minimum(off, np.linalg.norm(values + true[part], axis=-1))
        off = 4 * np.arcsin(np.minimum(off / 2, 1.0))
    return float(off.max())


def judge(name, accuracy=None, **run):
    """The row of a scene as it is, or to an accuracy, or with other keys under [run]."""
    scene = scene_of(name)
    if accuracy is not None:
        scene = to_accuracy(scene, accuracy)
    scene["run"] |= run
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        path.write_text(random_scenes.toml(scene), encoding="utf-8")
        started = time.process_time()
        result = chapsym.run_scene(path).dataset
        seconds = time.process_time() - started
    return judged(name, scene, result, seconds)


@dataclass(frozen=True)
class Best:
    """The cheapest of the map's orders: its steps, its distance from the motion, and its seconds."""

    order: int
    steps: int
    far: float
    seconds: float


def best(name, accuracy):
    """The cheapest order and steps within an accuracy of a scene, by trying, and the seconds of the scene as it is."""
    whole = scene_of(name)
    scene = fewer(whole)
    moments = motion_reference.times(scene["run"])
    members = expand(checked(scene))
    values = {key: one.values for key, one in members.parameters.items()}
    balls, true = truth(scene, values, len(members))

    def mapped(order, every, scene=scene):
        steps = every * (len(moments) - 1)
        told = {"order": order, "time_step": float(moments[-1]) / steps, "steps": steps, "every": every}
        return scene | {"run": told | {"outputs": scene["run"]["outputs"]}}

    @cache
    def far(order, every):
        columns = rolled(mapped(order, every))
        chosen = some(len(members))
        return max(apart(part, columns[part][chosen], true, balls) for part in PARTS if part in columns)

    found, least = [], LONGEST
    for order in (8, 6, 4, 2):
        every, stages = 1, len(chapsym.substeps(order)) * (len(moments) - 1)
        while far(order, every) > accuracy and every * stages < least:
            every *= 2
        low = every // 2
        while every - low > max(1, every // 50):
            middle = (low + every) // 2
            low, every = (low, middle) if far(order, middle) <= accuracy else (middle, every)
        if far(order, every) <= accuracy:
            least = min(least, 2 * every * stages)
            seconds = timed(lambda order=order, every=every: rolled(mapped(order, every, whole)))
            found.append(Best(order, every * (len(moments) - 1), far(order, every), seconds))
    return min(found, key=lambda one: one.seconds), timed(lambda: rolled(whole))


def fewer(scene):
    """The same scene with no more draws than are compared, the first of them."""
    samples = scene.get("sweep", {}).get("samples", 0)
    return scene | {"sweep": scene["sweep"] | {"samples": MOST}} if samples > MOST else scene


def rolled(scene):
    """The columns of a run, (balls, frames, ...), unit by unit; planned each time, as a choice is part of the run."""
    plan = plan_of(checked(scene))
    parts = []
    for chunk in range(len(plan.chunks)):
        state, frames = None, []
        for segment in range(len(plan.segments)):
            columns, state = computed(plan, chunk, segment, state)
            frames.append(columns)
        parts.append({key: np.concatenate([one[key] for one in frames], axis=1) for key in frames[0]})
    return {key: np.concatenate([one[key] for one in parts]) for key in parts[0]}


def timed(work):
    """Seconds of the processor, the least of five, or of as many as one second holds."""
    taken = []
    while not taken or (len(taken) < 5 and sum(taken) < 1):
        started = time.process_time()
        work()
        taken.append(time.process_time() - started)
    return min(taken)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "scene", nargs="*", help=f"of {', '.join(SHIPPED)}, 0 to {random_scenes.COUNT - 1}; default all"
    )
    parser.add_argument("-a", "--accuracy", type=float, help="run to this accuracy; without, the scene as it is")
    parser.add_argument("--order", type=int, help="the map with this order")
    parser.add_argument("--best", action="store_true", help="the cheapest order and steps of the map, by trying")
    given = parser.parse_args()
    if given.best:
        print(f"{'scene':<10}  order     steps  {'off':>8}  {'seconds':>9}  {'as it is':>9}  times")
    else:
        print(HEAD)
    for name in given.scene or names():
        if given.best:
            one, own = best(name, given.accuracy or 1e-6)
            told = f"{one.far:8.1e}  {one.seconds:9.5f}  {own:9.5f}  {own / one.seconds:5.2f}"
            print(f"{name:<10}  {one.order:5}  {one.steps:8}  {told}", flush=True)
        else:
            print(judge(name, given.accuracy, **({"order": given.order} if given.order else {})).line(), flush=True)


if __name__ == "__main__":
    main()
