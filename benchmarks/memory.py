"""Memory: a trajectory allocates the states that it keeps; a batch of 10⁶ balls runs in under 1 GB."""

import subprocess
import sys
import tracemalloc
from contextlib import suppress

import numpy as np

import chapsym

from .harness import Say
from .results import Reached, Result
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D

#: A state that is kept: 𝒦 and γ, the number of its step, and one number more while that is made.
BYTES_KEPT = 8 * 8
#: The memory that a run may take besides: less than a thousand states.
BESIDES = 1000 * BYTES_KEPT
GIGABYTE = 2**30

#: Runs in a process of its own, so that the peak is that of the batch; prints it in bytes.
CHILD = """
import sys
import chapsym
from benchmarks.batch import states
from benchmarks.memory import peak_of_this_process
balls, steps = int(sys.argv[1]), int(sys.argv[2])
K, g, J, D = states(balls)
end = chapsym.trajectory(chapsym.Ball(J, D), K, g, steps, every=steps)
assert (end.taken == steps).all()
print(peak_of_this_process())
"""


def peak_of_this_process() -> int:
    """The largest resident size so far, in bytes; raises ImportError where the system does not tell."""
    # The process' own; getrusage begins with what its parent had.
    with suppress(OSError, StopIteration), open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith("VmHWM"))
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def peak_of_a_trajectory(steps: int, every: int) -> int:
    """The peak of what a trajectory of one ball allocates, in bytes."""
    ball = chapsym.Ball(MASS_TENSOR, D)
    momentum = 0.05 * np.asarray(MOMENTUM)
    chapsym.trajectory(ball, momentum, GAMMA, 10_000, every=1000)  # compiles, which allocates too
    tracemalloc.start()
    try:
        kept = chapsym.trajectory(ball, momentum, GAMMA, steps, every=every)
        assert len(kept.index) == steps // every + 1
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def peak_of_a_batch(balls: int, steps: int) -> int:
    """The largest resident size of a fresh process that runs a batch, in bytes."""
    return int(subprocess.check_output([sys.executable, "-c", CHILD, str(balls), str(steps)], text=True))


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """The peaks of a long trajectory that keeps few states, and of 10⁶ balls (quick: 10⁵) in a fresh process."""
    steps, balls = (1_000_000, 100_000) if quick else (10_000_000, 1_000_000)
    reach = []
    for every in (1000, 100):
        on_round(f"one ball, {steps} steps, every {every}")
        frames = steps // every + 1
        allowed = frames * BYTES_KEPT + BESIDES
        peak = peak_of_a_trajectory(steps, every)
        reach.append(Reached(f"MB of {frames} states kept of {steps} steps", peak / 1e6, allowed / 1e6, False))
    on_round(f"{balls} balls in a fresh process")
    whole = peak_of_a_batch(balls, 10)
    reach.append(Reached(f"MB of a process with {balls} balls, 10 steps", whole / 1e6, GIGABYTE / 1e6, False))
    return Result("memory", [{"name": r.what, "MB": r.value, "allowed": r.wanted} for r in reach], {}, reach)
