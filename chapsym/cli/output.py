"""What every command does with its output: one sentence for an error, one JSON object, a bar."""

import json
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

#: What a measured figure may be written as.
FIGURES = (".svg", ".png", ".pdf")
#: Seconds between two lines of progress where standard error is no terminal.
PAUSE = 5.0


def fail(sentence: str, status: int) -> NoReturn:
    note(sentence)
    sys.exit(status)


def note(sentence: str) -> None:
    """One sentence on standard error, and no failure."""
    print(f"chapsym: {sentence}", file=sys.stderr)


def counted(n: int, noun: str) -> str:
    """So many of them: 1 claim, 2 claims."""
    return f"{n} {noun}{'' if n == 1 else 's'}"


def now_and_then() -> Callable[[str], None]:
    """Takes sentences, and notes one of them every few seconds."""
    last = time.monotonic()

    def tell(sentence: str) -> None:
        nonlocal last
        if time.monotonic() - last >= PAUSE:
            last = time.monotonic()
            note(sentence)

    return tell


def print_json(value: Any) -> None:
    print(json_text(value))


def json_text(value: Any, indent: int | None = None) -> str:
    """JSON for standard output: with escapes where that shows no more than some letters."""
    whole = (sys.stdout.encoding or "").lower().startswith("utf")
    return json.dumps(value, ensure_ascii=not whole, allow_nan=False, indent=indent)


def say(text: str) -> None:
    """Progress on standard error, on a terminal: a line that moves, without a thread of Rich's, which costs time."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def quiet() -> None:
    """Takes the line of progress away."""
    say("")


def check_known(kind: str, names: Iterable[str], known: Iterable[str], more: str = "") -> None:
    """Fails for a name that is none of those that there are."""
    for name in names:
        if name not in known:
            fail(f"there is no {kind} {name!r}; there are {', '.join(known)}{more}", 2)


def check_figure(output: Path, sections: Iterable[str], drawn: Iterable[str]) -> None:
    """Fails, before anything is measured, where a figure of these sections cannot be drawn or written."""
    from chapsym import extras, files

    extras.need("figures")
    if output.suffix not in FIGURES:
        fail(f"{str(output)!r}: a figure must end in {', '.join(FIGURES)}", 2)
    if not set(sections) & set(drawn):
        *some, last = drawn
        fail(f"only {', '.join(some)} and {last} have a figure", 2)
    files.check_destination(output)


def terminal() -> Any:
    """Rich's console on standard error, or None where that is no terminal: then Rich need not be loaded."""
    if not sys.stderr.isatty():
        return None
    from rich.console import Console

    console = Console(stderr=True, highlight=False, markup=False)
    return console if console.is_terminal else None


@contextmanager
def progress_bar(label: str, total: int) -> Iterator[Callable[..., None]]:
    """A bar on standard error, when that is a terminal; yields a function of what is done, a new total, and a word."""
    console = terminal()
    if console is None:
        yield lambda done, of=None, told="": None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    told = TextColumn("{task.fields[told]}")
    columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), told, TimeRemainingColumn()
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(label, total=total, told="")
        yield lambda done, of=None, told="": bar.update(task, completed=done, total=of, told=told)


@contextmanager
def following(as_json: bool) -> Iterator[Callable[[Any], None]]:
    """Yields a function of the `Progress` of a run: a bar on a terminal, elsewhere a line every few seconds."""
    if not as_json and terminal() is not None:
        with progress_bar("rolling", 0) as shown:
            yield lambda at: shown(at.steps, at.of, _balls(at))
        return
    from chapsym.scene.plan.plan import duration

    tell, first = now_and_then(), None

    def report(at: Any) -> None:
        nonlocal first
        now = time.monotonic()
        first = first or (now, at.steps)  # of a run that goes on, some are done already
        started, before = first
        speed = (at.steps - before) / (now - started) if now > started else 0.0
        left = f", about {duration((at.of - at.steps) / speed)} left" if speed > 0 else ""
        tell(f"{at.steps / max(at.of, 1):.0%}, {_balls(at)}{left}")

    yield report


def _balls(at: Any) -> str:
    return f"{at.balls} balls done" + (f", {at.failed} stopped early" if at.failed else "")


@contextmanager
def telling() -> Iterator[Callable[[str], None]]:
    """Yields a function of a sentence: a line that changes on a terminal, elsewhere a line every few seconds."""
    if not sys.stderr.isatty():
        yield now_and_then()
        return
    try:
        yield say
    finally:
        quiet()


def console_for(width: int) -> Any:
    """Where tables go: as wide as the terminal, or elsewhere so wide."""
    from rich.console import Console

    return Console(width=None if sys.stdout.isatty() else width, markup=False, highlight=False)


def print_table(console: Any, title: str, rows: Sequence[Mapping[str, Any]], shown: Callable[[Any], Any]) -> None:
    """A table of rows with the same names, words to the left."""
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for name, value in rows[0].items() if rows else ():
        table.add_column(name, justify="left" if isinstance(value, str) else "right")
    for row in rows:
        table.add_row(*map(shown, row.values()))
    console.print(table)
