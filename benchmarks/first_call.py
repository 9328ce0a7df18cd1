"""The first call: commands in fresh processes, with a fresh cache of compiled code and with a warm one."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from .results import Reached, Result

STEP = ("step", "--mass-tensor", "1,2,4", "--D", "3", "--momentum", "1,-1/2,3/4", "--gamma", "2/7,3/7,6/7")
SCENE = """
[ball]
mass_tensor = [1.0, 2.0, 4.0]
D = 3.0
[start]
omega = [0.3, -0.2, 0.1]
gamma = ["2/7", "3/7", "6/7"]
[run]
time_step = 0.05
steps = 100000
every = 1000
"""


#: What runs the arguments of a command.
COMMAND = ("-m", "chapsym.cli")


def timed(arguments: tuple[str, ...], cache: Path, program: tuple[str, ...] = COMMAND) -> tuple[float, float, str]:
    """Runs a command in a process of its own; returns (seconds, those of the processor, what it says on stderr)."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache)}
    start, busy = time.perf_counter(), _busy()
    done = subprocess.run(
        [sys.executable, *program, *arguments], capture_output=True, text=True, check=False, env=environment
    )
    seconds, busy = time.perf_counter() - start, _busy() - busy
    if done.returncode:
        raise RuntimeError(f"{' '.join(('chapsym', *arguments[:1]))} fails: {done.stderr.strip()}")
    return seconds, busy, done.stderr


def _busy() -> float:
    """The seconds that the processor spent on processes that have ended; other programs do not lengthen them."""
    times = os.times()
    return times.children_user + times.children_system


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times `chapsym step` and `chapsym run` with a cache that is empty, and again with the one that it leaves."""
    rounds = 1 if quick else 5
    seconds: dict[tuple[str, str], list[tuple[float, float]]] = {}
    said: dict[str, bool] = {}
    with tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.toml"
        scene.write_text(SCENE, encoding="utf-8")
        commands = {"step": STEP, "run": ("run", str(scene), "-o", str(Path(folder) / "out.npz"))}
        for i in range(rounds):
            for name, arguments in commands.items():
                on_round(f"chapsym {name}: round {i + 1} of {rounds}")
                for state in ("cold", "warm"):
                    took, busy, told = timed(arguments, Path(folder) / f"cache{i}{name}")
                    seconds.setdefault((name, state), []).append((took, busy))
                    said[f"{name}, {state}"] = "compil" in told
    medians = {key: np.median(found, axis=0) for key, found in seconds.items()}
    rows = [
        {
            "name": f"chapsym {name}", "cache": state, "seconds": float(took), "of the processor": float(busy),
            "says that it compiles": said[f"{name}, {state}"],
        }
        for (name, state), (took, busy) in medians.items()
    ]  # fmt: skip
    reach = [Reached("seconds of a warm chapsym step", float(medians["step", "warm"][0]), 0.7, False)]
    notes = [] if said["run, cold"] else ["a cold chapsym run does not say that it compiles"]
    return Result("the first call", rows, {}, reach, notes=notes)
