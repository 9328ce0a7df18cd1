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
    """Progress on standard error: one line that moves on a terminal; elsewhere only what is done once a machine."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
    elif ", once" in text:
        note(text)


def quiet() -> None:
    """Takes the line of progress away."""
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr, flush=True)


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
    """A bar on standard error, when that is a terminal; yields a function of what is done, and of a new total."""
    console = terminal()
    if console is None:
        yield lambda done, of=None: None
        return
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task(label, total=total)
        yield lambda done, of=None: bar.update(task, completed=done, total=of)


def console_for(width: int) -> Any:
    """Where tables go: as wide as the terminal, or elsewhere so wide."""
    from rich.console import Console

    return Console(width=None if sys.stdout.isatty() else width, markup=False, highlight=False)


def print_table(console: Any, title: str, rows: Sequence[Mapping[str, Any]], shown: Callable[[Any], str]) -> None:
    """A table of rows with the same names, words to the left."""
    from rich.table import Table

    table = Table(title=title, title_justify="left")
    for name, value in rows[0].items() if rows else ():
        table.add_column(name, justify="left" if isinstance(value, str) else "right")
    for row in rows:
        table.add_row(*map(shown, row.values()))
    console.print(table)
