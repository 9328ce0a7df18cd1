"""How a long run is followed: a bar on a terminal, elsewhere a line now and then."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

#: Seconds between two lines.
PAUSE = 5.0


@contextmanager
def following(as_json: bool) -> Iterator[Callable[[Any], None]]:
    """Yields a function of a `Progress`; what it shows goes to standard error."""
    from rich.console import Console

    console = Console(stderr=True)
    if as_json or not console.is_terminal:
        yield Lines()
        return
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    balls = TextColumn("{task.fields[balls]}")
    columns = (TextColumn("rolling"), BarColumn(), TaskProgressColumn(), balls, TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("rolling", total=None, balls="")
        yield lambda at: bar.update(task, total=at.of, completed=at.steps, balls=_balls(at))


class Lines:
    """A line every few seconds, with the time that is left at the speed so far."""

    def __init__(self) -> None:
        self.first: tuple[float, int] | None = None
        self.last = time.monotonic()

    def __call__(self, at: Any) -> None:
        now = time.monotonic()
        if self.first is None:
            self.first = (now, at.steps)  # of a run that goes on, some are done already
        if now - self.last < PAUSE:
            return
        self.last = now
        started, before = self.first
        speed = (at.steps - before) / (now - started) if now > started else 0.0
        left = f", about {_seconds((at.of - at.steps) / speed)} left" if speed > 0 else ""
        print(f"chapsym: {at.steps / max(at.of, 1):.0%}, {_balls(at)}{left}", file=sys.stderr, flush=True)


def _balls(at: Any) -> str:
    return f"{at.balls} balls done" + (f", {at.failed} stopped early" if at.failed else "")


def _seconds(seconds: float) -> str:
    return (
        f"{seconds:.0f} s"
        if seconds < 100
        else f"{seconds / 60:.0f} min"
        if seconds < 6000
        else f"{seconds / 3600:.1f} h"
    )
