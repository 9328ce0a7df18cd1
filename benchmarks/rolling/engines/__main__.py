"""Rolls a ball in an engine and judges it: python -m benchmarks.rolling.engines ENGINE BALL

BALL is a URDF or MJCF file, which the engine's own loader reads and `chapsym judge --body` judges; or the name of a
case, which starts as that case does and is judged against it.
"""

import argparse
import importlib
import math
import subprocess
import sys
from pathlib import Path

import numpy as np

from chapsym import files
from chapsym.dynamics.errors import BadInput
from chapsym.scene.read import robots
from chapsym.studies.judge import read_case, rolling

from .common import DATA, Start, check_centre, start_of, text

#: The modules of the engines.
ENGINES = {name: f"{name}_ball" for name in ("mujoco", "pybullet", "drake")} | {"penalty": "penalty"}


def seconds(text: str) -> float:
    """A positive time."""
    if not 0 < (found := float(text)) < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is no positive number of seconds")
    return found


def start_of_ball(body: Path, omega: list[float], time: float) -> Start:
    """A ball that rolls over the origin, its axes those of space, and 40 frames."""
    radius, spin = float(robots.table(body)["radius"]), np.array(omega)
    times = np.linspace(0, time, 41)
    return Start(np.array([0, 0, radius]), np.array([1.0, 0, 0, 0]), rolling(radius, spin), spin, times)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.rolling.engines", description=__doc__.splitlines()[0])
    parser.add_argument("engine", choices=ENGINES)
    parser.add_argument("ball", help="a URDF or MJCF file, or the name of a case")
    parser.add_argument("--step", type=seconds, default=0.001, help="in s")
    parser.add_argument("--omega", type=float, nargs=3, default=[4, -6, 3], help="of a file's ball, in space, rad/s")
    parser.add_argument("--time", type=seconds, default=10, help="of a file's ball, in s")
    parser.add_argument("--best", action="store_true", help="the settings that we found best, instead of the defaults")
    parser.add_argument("-o", "--output", type=Path, help="the trajectory: BALL-ENGINE.csv here")
    given = parser.parse_args()
    body, truth = Path(given.ball), ["--body", given.ball]
    if known := (DATA / f"{given.ball}.json").exists():
        body, truth = DATA / f"{given.ball}.urdf", ["--against", str(DATA / f"{given.ball}.json")]
    start = start_of(read_case(Path(truth[1]))) if known else start_of_ball(body, given.omega, given.time)
    check_centre(body)
    output = given.output or Path(f"{body.stem}-{given.engine}.csv")
    files.check_destination(output)
    try:
        run = importlib.import_module(f".{ENGINES[given.engine]}", __package__).run
        table = text(given.step, run(body, start, given.step, given.best))
    except ImportError as error:
        sys.exit(f"{given.engine} is not installed ({error}): pip install 'chapsym[engines]'")
    except Exception as error:  # of a loader of another program, each with its own kinds
        sys.exit(f"{given.engine} does not take {body}: {(str(error) or type(error).__name__).splitlines()[0]}")
    files.write_text(output, table)
    sys.exit(subprocess.run([sys.executable, "-m", "chapsym", "judge", output, *truth], check=False).returncode)


if __name__ == "__main__":
    try:
        main()
    except (BadInput, files.CannotWrite) as error:
        sys.exit(str(error))
