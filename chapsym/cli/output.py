"""The output of every command: one sentence for an error, one JSON object, a progress bar."""

import json
import os
import re
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from chapsym import files

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

    from chapsym.scene.running.sweep import Progress
#: An object of JSON, and a row of a table: values by name.
Data = files.Data
Row = Mapping[str, object]

#: Seconds between two lines of progress where standard error is no terminal.
PAUSE, SELDOM = 5.0, 30.0
#: A word that is too long to read: a number of thousands of digits, a long path.
LONG = re.compile(r"(\S{150})\S{100,}(\S{150})")
#: The name of a result that is printed.
PRINTED = Path("-")


def fail(sentence: str, status: int) -> NoReturn:
    note(sentence)
    sys.exit(status)


def check_apart(path: Path | None, *others: Path | None) -> None:
    """Fails if an output would replace an input, or another output."""
    if path is not None and os.path.realpath(path) in {os.path.realpath(other) for other in others if other}:
        fail(f"{path} is named twice: choose another name", 2)


def check_printed(path: Path, as_json: bool) -> None:
    """Fails if a result and JSON would both be printed."""
    if as_json and path == PRINTED:
        fail("--json prints on standard output, where -o - writes the result: choose one", 2)


def apart(path: Path | None) -> AbstractContextManager[object]:
    """The stream for sentences on a result: standard error if the result is printed."""
    return redirect_stdout(sys.stderr) if path == PRINTED else nullcontext()


def note(sentence: str) -> None:
    """Prints a sentence on standard error, without failure; very long words are shortened."""
    _said("chapsym: " + files.visible(LONG.sub(r"\1...\2", sentence)) + "\n")


def put(*lines: object) -> None:
    """Prints lines, each one line: what names and titles of others have, a terminal would obey otherwise."""
    for line in lines:
        print(files.visible(str(line)), flush=True)  # so that a log shows it


def _said(text: str) -> None:
    """Prints on standard error; a full disk, a closed pipe or a closed terminal does not end the work."""
    try:
        print(text, end="", file=sys.stderr, flush=True)
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def counted(n: int, noun: str) -> str:
    """A number with its noun: 1 claim, 2 claims."""
    return f"{n} {noun}{'' if n == 1 else 's'}"


def now_and_then(pause: float) -> Callable[[str], None]:
    """A function of sentences that prints one of them every `pause` seconds."""
    last = time.monotonic()

    def tell(sentence: str) -> None:
        nonlocal last
        if time.monotonic() - last >= pause:
            last = time.monotonic()
            note(sentence)

    return tell


def print_json(value: object) -> None:
    print(json_text(value))


def json_text(value: object, indent: int | None = None) -> str:
    """JSON for standard output, with escapes for what a terminal would obey, or has no letter for."""
    whole = (sys.stdout.encoding or "").lower().startswith("utf")
    text = json.dumps(value, ensure_ascii=not whole, allow_nan=False, indent=indent)
    return re.sub(r"[^\n -~]", lambda x: x[0] if x[0].isprintable() else json.dumps(x[0])[1:-1], text)


def say(text: str) -> None:
    """Progress on standard error, on a terminal: a changing line, without a thread of Rich, which costs time."""
    if sys.stderr.isatty():
        _said(f"\r\033[K{files.visible(text)}")


def quiet() -> None:
    """Removes the line of progress."""
    say("")


def check_known(kind: str, names: Iterable[str], known: Iterable[str], more: str = "") -> None:
    """Fails for an unknown name."""
    for name in names:
        if name not in known:
            fail(f"there is no {kind} {name!r}; there are {', '.join(known)}{more}", 2)


@contextmanager
def telling(every: float = PAUSE) -> Iterator[Callable[[str], None]]:
    """Yields a function of a sentence: a line that changes on a terminal, elsewhere a line every some seconds."""
    try:
        yield say if sys.stderr.isatty() else now_and_then(every)
    finally:
        quiet()


@contextmanager
def progress_bar(label: str, total: int) -> Iterator[Callable[..., None]]:
    """Yields a function of the number done and the total, as `telling` does of a sentence, but seldom in a log."""
    left = _time_left()
    with telling(SELDOM) as tell:
        yield lambda done, of=total: tell(f"{label}: {done} of {of}{left(done, of)}")


@contextmanager
def following() -> Iterator[Callable[["Progress"], None]]:
    """Yields a function of the `Progress` of a run, as `telling` does of a sentence."""
    left = _time_left()

    def said(at: "Progress") -> str:
        balls = f"{at.balls} balls done" + (f", {at.failed} stopped early" if at.failed else "")
        return f"rolling: {at.steps / max(at.of, 1):.0%}, {balls}{left(at.steps, at.of)}"

    with telling() as tell:
        yield lambda at: tell(said(at))


def _time_left() -> Callable[[float, float], str]:
    """A function of the number done and the total: a clause on the remaining time, or nothing."""
    from chapsym.jobs import duration

    first: tuple[float, float] | None = None

    def left(done: float, of: float) -> str:
        nonlocal first
        now = time.monotonic()
        first = first or (now, done)  # a resumed run has some parts done
        started, before = first
        speed = (done - before) / (now - started) if now > started else 0.0
        return f", about {duration((of - done) / speed)} left" if speed > 0 and done < of else ""

    return left


def console_for(width: int) -> "Console":
    """The console for tables: as wide as the terminal, or elsewhere `width`."""
    from rich.console import Console

    return Console(width=None if sys.stdout.isatty() else width, markup=False, highlight=False)


def print_table(console: "Console", title: str, rows: Sequence[Row], shown: Callable[[Any], "str | Text"]) -> None:
    """Prints a table of rows with the same names, words to the left."""
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for name, value in rows[0].items() if rows else ():
        table.add_column(name, justify="left" if isinstance(value, str) else "right")
    for row in rows:
        table.add_row(*map(shown, row.values()))
    console.print(table)
