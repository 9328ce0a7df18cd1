"""Whole commands in fresh processes, all that they compile in the cache: what a user waits for, start to end."""

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .first_call import timed
from .results import Reached, Result

#: {} balls for {} steps, each kept at its end.
SWEEP = """
[ball]
mass_tensor = [1.0, 2.0, 4.0]
D = 3.0
[start]
omega = [{{ normal = [0.3, 0.02] }}, -0.2, 0.1]
gamma = ["2/7", "3/7", "6/7"]
[sweep]
samples = {}
seed = 7
[run]
time_step = 0.05
steps = {}
every = {}
"""
#: What all the proofs are to cost, in seconds of one core; and 200 short calls, which took 3.6 s in plain Python.
PROOFS, SHORT = 20.0, 0.5
#: Runs of so many steps, so often, in a process that does nothing else: the seconds of the first, and of all.
CALLS = """
import sys, time, chapsym
state, steps, calls = (chapsym.Ball((1, 2, 4), 3), (0.1, -0.05, 0.075), (2 / 7, 3 / 7, 6 / 7)), *map(int, sys.argv[1:])
start = time.perf_counter()
chapsym.trajectory(*state, steps)
first = time.perf_counter() - start
for _ in range(calls - 1):
    chapsym.trajectory(*state, steps)
print(first, time.perf_counter() - start, file=sys.stderr)
"""


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times a sweep to a .zarr beside its overhead, 200 calls of 1000 steps, and all proofs."""
    rounds, balls, steps = (1, 100, 100) if quick else (5, 20_000, 1000)
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder, cache = Path(name), Path(name) / "cache"
        for balls_of_one, steps_of_one in ((balls, steps), (2, 10)):
            scene, told = folder / f"{balls_of_one}.toml", f"{balls_of_one} balls, {steps_of_one} steps, to .zarr"
            scene.write_text(SWEEP.format(balls_of_one, steps_of_one, steps_of_one), encoding="utf-8")
            found = []
            for i in range(rounds + 1):  # the first run fills the cache
                on_round(f"{told}: round {i} of {rounds}")
                found.append(timed(("run", str(scene), "-o", str(folder / f"{balls_of_one}-{i}.zarr")), cache)[:2])
            rows.append(_row(f"chapsym run: {told}", np.median(found[1:], axis=0)))
        on_round("200 calls of 1000 steps")
        timed(("1000000", "1"), cache, ("-c", CALLS))  # which is compiled
        *took, said = timed(("1000", "200"), cache, ("-c", CALLS))
        first, every = (float(x) for x in said.split())
        rows.append(_row("a process with 200 calls of 1000 steps", took))
        on_round("all proofs, a minute")
        records = "prove", "--jobs", "1", "--records", str(folder / "records")
        proved = timed((*records, "4.3") if quick else records, cache)[:2]
        rows.append(_row("chapsym prove --jobs 1" + (" 4.3" if quick else ""), proved))
    note = f"200 calls of 1000 steps take {every:.3g} s, the first of them {first * 1e3:.3g} ms"
    reach = [
        Reached("seconds of 200 calls of 1000 steps in a fresh process", every, SHORT, False),
        Reached("seconds of the processor of chapsym prove", float(proved[1]), PROOFS, False),
    ]
    return Result("whole commands, with what they compile in the cache", rows, {}, reach, notes=[note])


def _row(name: str, seconds: Sequence[float] | np.ndarray) -> dict[str, Any]:
    return {"name": name, "seconds": float(seconds[0]), "of the processor": float(seconds[1])}
