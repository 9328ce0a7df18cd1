"""What a step costs on this machine, by precision, order and length of step: measured once, kept in the user's cache.

A price is the seconds of a step at a few lengths θ = |ω|ε of the step (radians): long ones need more work, as the root
is farther from its guess and the lemma that proves it at once does not cover them.  And what a call costs besides.
"""

import contextlib
import hashlib
import json
import math
import os
import platform
import time
from collections.abc import Callable, Sized
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import platformdirs

import chapsym
from chapsym import dynamics, files, generated, numbers
from chapsym.dynamics import BadInput, Ball, StepNotTaken
from chapsym.dynamics.levels.double import SHORT_RUN
from chapsym.numbers import NAMED
from chapsym.renamed import in_words

from .methods import EXACT, Method, methods, take
from .request import Request

#: Changes when the file does.
VERSION = 1
#: Lengths of steps at which prices are taken, in radians.
LENGTHS = (0.02, 0.1, 0.25, 0.5, 1.0, 2.0)
#: What is priced, and chosen from.  One ball is no faster in float32 than in float64; mpmath, a thousand times slower
#: than double-double, has hardly more digits here, as its runs start from the same 106 bits.
PRECISIONS = (NAMED["double"], NAMED["double-double"])
#: Each price is the median of so many runs, each of about so many seconds.
RUNS, LEAST = 3, 1e-3
#: A price grows at most to so many steps a run.
MOST_STEPS = 1 << 14


@dataclass(frozen=True)
class Prices:
    """calls: seconds of a call, by "precision/body"; steps: [(θ, seconds a step), ...] by "precision/order/body"."""

    calls: dict[str, float]
    steps: dict[str, list[tuple[float, float]]]

    def of(self, method: Method, with_body: bool, length: float) -> float | None:
        """Seconds of a step of θ = `length`, on a log-log scale between those measured; None if none was."""
        found = self.steps.get(self._key(method, with_body))
        if not found:
            return None
        x, y = np.log(np.array(found)).T
        return float(np.exp(np.interp(np.log(length), x, y)))

    def call(self, method: Method, with_body: bool) -> float:
        """Seconds of a call besides its steps."""
        return self.calls.get(f"{method.label}/{_body(with_body)}", 0.0)

    @staticmethod
    def _key(method: Method, with_body: bool) -> str:
        return f"{method.label}/{method.order}/{_body(with_body)}"


def _body(with_body: bool) -> str:
    return "body" if with_body else "state"


def sample(of: str, time: float) -> Request:
    """The ball of docs/first.toml, by which prices are taken."""
    ball = Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    K, g = np.array([0.0446, -0.0346, 0.0313]), np.array([2.0, 3.0, 6.0]) / 7
    return Request(ball, K, g, time, 1e-6, of, rate=3.742, speed=3.742, rolling=2.0, condition=3.0)


def calibrate(progress: Callable[[str], None] = lambda text: None) -> Prices:
    """Takes all prices, in seconds; a method or a length of step that this ball cannot take has none."""
    calls: dict[str, float] = {}
    steps: dict[str, list[tuple[float, float]]] = {}
    wanted = [
        (request, method)
        for precision in PRECISIONS
        for request in (sample("state", 1.0), sample("contact", 1.0))
        for method in methods(request, precision)
        if method.order != EXACT
    ]
    started = time.monotonic()
    for done, (request, method) in enumerate(wanted):
        left = _forecast(time.monotonic() - started, done, wanted)
        progress(f"pricing {in_words(method.label)}, order {method.order}: {left}")
        with_body = request.of == "contact"
        if priced := _by_length(request, method):
            steps[Prices._key(method, with_body)] = priced
        if method.order == 2:
            calls[f"{method.label}/{_body(with_body)}"] = _seconds(request, method, 1, 1e-3) or 0.0
    for body in ("state", "body"):  # the exact top runs the map itself
        if f"double/2/{body}" in steps:
            steps[f"double/{EXACT}/{body}"] = steps[f"double/2/{body}"]
    return Prices(calls, steps)


def _forecast(passed: float, done: int, wanted: Sized) -> str:
    """How much of the work is left, and how long that takes if it goes on like this."""
    told = f"{len(wanted) - done} of {len(wanted)} left"
    return f"{told}, about {passed / done * (len(wanted) - done):.0f} s" if done else told


def _by_length(request: Request, method: Method) -> list[tuple[float, float]]:
    found = []
    for length in LENGTHS:
        steps, took = 1, _seconds(request, method, 1, length)
        while took is not None and steps < MOST_STEPS and (took < LEAST or _in_python(steps * method.stages, took)):
            steps *= 4
            took = _seconds(request, method, steps, length)
        if took is None:
            break
        found.append((length, took / steps))
    return found


def _in_python(work: int, took: float) -> bool:
    """Whether a run is so short that the loop may not be compiled yet, and yet affordable."""
    return work < 2 * SHORT_RUN and took < 0.1


def _seconds(request: Request, method: Method, steps: int, length: float) -> float | None:
    """The time of the processor that a run takes, or None if it cannot be."""
    taken = []
    try:
        take(request, method, steps, 1, steps * length / request.rate)
        for _ in range(RUNS):
            start = time.thread_time()
            take(request, method, steps, 1, steps * length / request.rate)
            taken.append(time.thread_time() - start)
    except (StepNotTaken, BadInput):
        return None
    return median(taken)


def path() -> Path:
    """Where the prices of this machine are kept: one file for each machine, set of libraries and code of the map."""
    libraries = f"{np.__version__} {chapsym.__version__} {platform.python_version()}"
    machine = f"{platform.machine()} {platform.processor()} {os.cpu_count()} {libraries} {VERSION} {_code()}"
    name = hashlib.sha256(machine.encode()).hexdigest()[:16]
    return Path(platformdirs.user_cache_path("chapsym")) / f"prices-{name}.json"


def _code() -> str:
    """The names and sizes of the files that run the map: other code has other prices."""
    folders = [Path(module.__file__).parent for module in (dynamics, generated, numbers) if module.__file__]
    return " ".join(f"{p.name}:{p.stat().st_size}" for folder in folders for p in sorted(folder.glob("*.py")))


def load_prices(progress: Callable[[str], None] = lambda text: None) -> Prices:
    """The prices that were kept, or else fresh ones, which are kept if the cache can be written.

    Where another process has kept prices meanwhile, they are those: what is chosen by them does not change later.
    """
    kept = path()
    if (found := _kept(kept)) is not None:
        return found
    progress("taking this machine's prices, once")
    fresh = calibrate(progress)
    if (found := _kept(kept)) is not None:
        return found
    save(fresh, kept)
    return fresh


def _kept(file: Path) -> Prices | None:
    try:
        found = json.loads(file.read_text(encoding="utf-8"))
        return _checked(found["calls"], found["steps"]) if found["version"] == VERSION else None
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError):
        return None


def _checked(calls: Any, steps: Any) -> Prices:
    """Prices from plain data; raises ValueError or TypeError for what `calibrate` cannot have written."""
    for name in ("double/2/state", "double/2/body", "quad/2/state", "quad/2/body"):
        if name not in steps or name.replace("/2", "") not in calls:
            raise ValueError(f"no price of {name}")
    priced = {name: [(_price(x), _price(y)) for x, y in points] for name, points in steps.items()}
    for points in priced.values():
        lengths = [x for x, _ in points]
        if not lengths or lengths != sorted(set(lengths)) or not all(y > 0 for _, y in points) or not lengths[0] > 0:
            raise ValueError("prices must be positive, of ascending lengths")
    return Prices({name: _price(x) for name, x in calls.items()}, priced)


def _price(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < math.inf:
        raise ValueError(f"{value!r} is no price")
    return float(value)


def save(prices: Prices, to: Path) -> None:
    """Writes the file whole; a cache that cannot be written is done without."""
    text = json.dumps({"version": VERSION, "calls": prices.calls, "steps": prices.steps})
    with contextlib.suppress(OSError, files.CannotWrite):
        to.parent.mkdir(parents=True, exist_ok=True)
        files.write_whole(to, lambda stream: stream.write(text.encode()))
