"""How a long run is followed: a bar on a terminal, elsewhere a line now and then."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from .output import now_and_then, terminal


@contextmanager
def following(as_json: bool) -> Iterator[Callable[[Any], None]]:
    """Yields a function of a `Progress`; what it shows goes to standard error."""
    console = None if as_json else terminal()
    if console is None:
        yield _lines()
        return
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    balls = TextColumn("{task.fields[balls]}")
    columns = (TextColumn("rolling"), BarColumn(), TaskProgressColumn(), balls, TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("rolling", total=None, balls="")
        yield lambda at: bar.update(task, total=at.of, completed=at.steps, balls=_balls(at))


def _lines() -> Callable[[Any], None]:
    """A line every few seconds, with the time that is left at the speed so far."""
    tell, first = now_and_then(), None

    def report(at: Any) -> None:
        nonlocal first
        now = time.monotonic()
        first = first or (now, at.steps)  # of a run that goes on, some are done already
        started, before = first
        speed = (at.steps - before) / (now - started) if now > started else 0.0
        left = f", about {_seconds((at.of - at.steps) / speed)} left" if speed > 0 else ""
        tell(f"{at.steps / max(at.of, 1):.0%}, {_balls(at)}{left}")

    return report


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
