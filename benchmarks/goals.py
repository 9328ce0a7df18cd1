"""The goals of the project in one table: speed compared with the best known way, first calls, many balls."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import chapsym

from . import problems
from .batch import states
from .calls import repeated
from .continuous import LANES
from .harness import Contender, Say, cores, installed, interleaved
from .problems import Runs, States
from .results import Reached, Result

SEED = 20077
ACCURACIES = (1e-6, 1e-9)
#: The least seconds that a side is timed for in a round.
LEAST = 2e-3
#: The end time and the accuracy of the ensemble.
END, TOGETHER = 100.0, 1e-9
ROLL, OWN, HEYOKA, ACCURATE = "roll", "best own", "heyoka.py", "accurate"
#: A program: a ball in a state, and one call.
START = """
import numpy, chapsym
ball, K, g = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1), numpy.array((0.03, -0.01, 0.015)), (2 / 7, 3 / 7, 6 / 7)
"""
FIRST = {
    "step": "chapsym.step(ball, K, g)",
    "trajectory of 10⁵": "chapsym.trajectory(ball, K, g, 100_000)",
    "batch": "chapsym.trajectory(ball, numpy.tile(K, (1000, 1)), g, 100, every=100)",
    "extrapolate": "chapsym.extrapolate(ball, K, g, 0.5, 100)",
    "roll": "chapsym.roll(ball, (3.0, -2.0, 1.0), 0.01, 1000, gamma=g, contact=True)",
    "n = 4": "M = numpy.tri(4, k=-1) / 100\n"
    "chapsym.trajectory_n(chapsym.BallN((1.0, 2.0, 0.5, 3.0), 3.0), M - M.T, (0, 0, 0, 1.0), 1000)",
}
PROGRAM = "-m", "chapsym"
Fresh = tuple[tuple[str, ...], tuple[str, ...], float]


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Takes each figure once; `quick` is with 3 problems, an ensemble of 40 balls, and one start of each process."""
    missing = {HEYOKA: reason} if (reason := installed("heyoka")) else {}
    few = {"count": 3, "rounds": 3} if quick else {"count": 20, "rounds": 7}
    with cores(1):
        reach = [goal for accuracy in ACCURACIES for goal in to_an_accuracy(accuracy, on_round, **few)]
        reach += ensemble(40 if quick else 1000, 1 if quick else 5, on_round, missing)
    reach += first_calls(1 if quick else 5, on_round, missing)
    reach += single_steps((10_000, 100_000) if quick else (10_000, 100_000, 1_000_000), 3 if quick else 9, on_round)
    rows = [{"figure": r.what, "measured": r.value, "wanted": f"at most {r.wanted:g}", "reached": r.met} for r in reach]
    notes = ["best own: the fastest of extrapolate and trajectory of orders 2, 4, 6 and 8 that meets the accuracy"]
    return Result(f"the goals: {sum(r.met for r in reach)} of {len(reach)} are reached", rows, missing, notes=notes)


def to_an_accuracy(accuracy: float, on_round: Say, count: int, rounds: int) -> list[Reached]:
    """`roll` and `accurate` compared with the fastest of the other methods, and with heyoka.py, problem by problem."""
    ratios: dict[tuple[str, str], list[float]] = {}
    beyond = 0
    for i, problem in enumerate(problems.drawn(count, SEED)):
        on_round(f"accuracy {accuracy:g}: problem {i + 1} of {count}")
        truth = problems.truth_of(problem)
        beyond += problem.error(problems.rolled(problem, accuracy), truth) > accuracy
        sides: Runs = {ROLL: partial(problems.rolled, problem, accuracy)}
        if installed("heyoka") is None and (run := problems.loosest(problem, truth, accuracy)):
            sides[HEYOKA] = run
        _compare(ratios, ROLL, sides, problems.own_methods(problem, truth, accuracy), rounds)
        alone = truth[0], truth[1], None  # `accurate` promises the state
        whole: Runs = {ACCURATE: partial(problems.accurate, problem, accuracy)}
        _compare(ratios, ACCURATE, whole, problems.own_methods(problem, alone, accuracy, contact=False), min(rounds, 3))
    setting, loose = f"to {accuracy:g}", accuracy == ACCURACIES[0]
    found = [Reached(f"problems that {ROLL} takes {setting} with a larger error", beyond, 0, False)]
    for pair, most in (((ROLL, OWN), 1.5), ((ROLL, HEYOKA), 1.2 if loose else 1.0), ((ACCURATE, OWN), 3.0)):
        if values := ratios.get(pair):
            what, mean = f"{' / '.join(pair)}, {setting}", float(np.exp(np.mean(np.log(values))))
            found.append(Reached(f"{what}: geometric mean of {len(values)}", mean, most, False))
            if pair == (ROLL, OWN):
                found.append(Reached(f"{what}: worst", max(values), 3.0, False))
    return found


def _compare(ratios: dict[tuple[str, str], list[float]], name: str, sides: Runs, own: Runs, rounds: int) -> None:
    """Times all sides together, and notes the ratio of one to the others, and to the fastest of our own."""
    timings = interleaved([repeated(*side, LEAST) for side in (sides | own).items()], rounds)
    if own:
        best = min((timings[key] for key in own), key=lambda timing: timing.median)
        ratios.setdefault((name, OWN), []).append(timings[name].ratio_to(best)[0])
    if HEYOKA in sides:
        ratios.setdefault((name, HEYOKA), []).append(timings[name].ratio_to(timings[HEYOKA])[0])


def ensemble(balls: int, rounds: int, on_round: Say, missing: dict[str, str]) -> list[Reached]:
    """Different balls to the same worst error at the end: `roll`, `extrapolate` and heyoka.py, 8 at once."""
    setting = f"{balls} different balls, t = {END:g}"
    many, truths = problems.drawn(balls, SEED, END), []
    for i, problem in enumerate(many):
        on_round(f"{setting}: what is true, {i + 1} of {balls}")
        truths.append(problems.truth_of(problem))
    truth = [np.stack([x[i][-1] for x in truths]) for i in range(3)]  # type: ignore[index]
    J, D, radius = (np.stack([getattr(p.ball, name) for p in many]) for name in ("mass_tensor", "D", "radius"))
    omega, gamma, K = (np.stack([getattr(p, name) for p in many]) for name in ("omega", "gamma", "momentum"))
    ball, sizes = chapsym.Ball(J, D, radius), (np.linalg.norm(K, axis=-1), 1.0, radius)

    def roll(accuracy: float) -> States:
        run = chapsym.roll(ball, omega, END, 1, gamma=gamma, contact=True, accuracy=accuracy, threads=1)
        return (run.momentum / END)[:, -1], run.gamma[:, -1], run.contact[:, -1]

    def extrapolate(step: float) -> States:
        steps = round(END / step)
        run = chapsym.extrapolate(ball, K, gamma, END / steps, steps, contact=True, threads=1)
        return run.angular_momentum, run.gamma, run.contact

    runs: dict[str, Iterable[Callable[[], States]]] = {
        ROLL: (partial(roll, accuracy) for accuracy in 10.0 ** -np.arange(8, 12, 0.5)),
        "extrapolate": (partial(extrapolate, step) for step in 0.5 * 0.85 ** np.arange(20)),
    }
    if installed("heyoka") is None:
        runs[HEYOKA] = (problems.taylor_batch(many, tolerance) for tolerance in problems.TOLERANCES)
    sides, lost = {}, {}
    for name, tried in runs.items():
        on_round(f"{setting}: {name}")
        for run in tried:
            ends = run()
            off = np.array([np.linalg.norm(x - y, axis=-1) / s for x, y, s in zip(ends, truth, sizes, strict=True)])
            lost[name] = int(np.isnan(off).any(axis=0).sum())
            if off.max() <= TOGETHER:
                sides[name] = run
                break
        else:
            missing[f"{setting}: {name}"] = f"nothing that was tried meets {TOGETHER:g}"
    timings = interleaved([Contender(name, run, balls) for name, run in sides.items()], rounds)
    found = [Reached(f"{setting}: NaN of {name}", lost[name], 0, False) for name in runs if name != HEYOKA]
    for name in [name for name in sides if name != HEYOKA and HEYOKA in sides]:
        ratio, *_ = timings[name].ratio_to(timings[HEYOKA])
        found.append(Reached(f"{setting}, to {TOGETHER:g}: {name} / {HEYOKA}, {LANES} at once", ratio, 0.9, False))
    return found


def timed(arguments: tuple[str, ...], program: tuple[str, ...] = PROGRAM) -> float:
    """Runs a command, or a program, in a process of its own; the seconds of the processor."""
    before = os.times()
    done = subprocess.run([sys.executable, *program, *arguments], capture_output=True, text=True, check=False)
    after = os.times()
    if done.returncode:
        raise RuntimeError(f"{' '.join(('chapsym', *arguments[:1]))} fails: {done.stderr.strip()}")
    return after.children_user - before.children_user + after.children_system - before.children_system


def first_calls(rounds: int, on_round: Say, missing: dict[str, str]) -> list[Reached]:
    """Fresh processes, with the start of Python and the imports: median seconds of the processor."""
    runs: dict[str, Fresh] = {f"first call, {name}": ((), ("-c", START + call), 0.4) for name, call in FIRST.items()}
    found = []
    with TemporaryDirectory() as folder:
        scene = str(Path(__file__).parents[1] / "docs" / "first.toml")
        runs["chapsym run docs/first.toml"] = ("run", scene, "-o", f"{folder}/out.npz"), PROGRAM, 0.6
        if rounds > 1:
            runs["chapsym prove --jobs 1"] = ("prove", "--jobs", "1", "--records", f"{folder}/records"), PROGRAM, 20.0
        for name, (arguments, program, most) in runs.items():
            on_round(f"a fresh process: {name}")
            try:
                seconds = [timed(arguments, program) for _ in range(rounds if most < 1 else 1)]
                found.append(Reached(f"{name}: s of the processor", float(np.median(seconds)), most, False))
            except RuntimeError as error:
                missing[name] = str(error)
    return found


def single_steps(counts: Iterable[int], rounds: int, on_round: Say) -> list[Reached]:
    """One step of many balls: nanoseconds of the processor a ball."""
    found = []
    for balls in counts:
        on_round(f"one step of {balls} balls")
        K, g, J, D = states(balls)
        ball = chapsym.Ball(J, D)
        sides: dict[str, Callable[..., object]] = {
            "step": chapsym.step,
            "trajectory of 1": partial(chapsym.trajectory, steps=1),
        }
        contenders = [Contender(name, partial(run, ball, K, g), balls) for name, run in sides.items()]
        for name, timing in interleaved(contenders, rounds).items():
            found.append(Reached(f"{name}, {balls} balls: ns of the processor a ball", timing.median * 1e9, 200, False))
    return found
