"""A page of what a command measured, in Markdown: its tables, with the command, the date and the machine."""

import datetime
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .output import Row, print_table

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text


class Table(NamedTuple):
    """A table of rows with the same names, and the sentences under it."""

    title: str
    rows: Sequence[Row]
    sentences: Sequence[str] = ()


def is_page(output: Path | None) -> bool:
    """Whether the output is such a page; fails, before anything is measured, where it cannot be written."""
    from chapsym import files

    if output is None or output.suffix != ".md":
        return False
    files.check_destination(output)
    return True


def write(output: Path, title: str, about: str, tables: Sequence[Table], shown: Callable[[object], str] = str) -> None:
    """Writes the page, whole; `about` says in a sentence or two what was measured."""
    from chapsym import __version__, files
    from chapsym.report.notation import code
    from chapsym.studies.checkout import machine

    here = machine()
    command = code(" ".join(["chapsym", *map(files.pasted, sys.argv[1:])]))
    versions = ", ".join(f"{name} {version}" for name, version in here["versions"].items())
    lines = [
        f"# {title}", "", about, "",
        f"Written by {command}, of chapsym {__version__}, on {datetime.date.today()}. "
        f"Machine: {here['cpu']}; {here['cores']} cores; {here['system']}; {here['python']}; {versions}.",
    ]  # fmt: skip
    for table in tables:
        lines += ["", f"## {_text(table.title)}", "", *_rows(table.rows, shown)]
        lines += ["", *(f"- {_text(sentence)}" for sentence in table.sentences)] if table.sentences else []
    files.write_text(output, "\n".join(lines) + "\n")


def show(console: "Console", tables: Sequence[Table], shown: Callable[[Any], "str | Text"]) -> None:
    """Prints the tables, each with its sentences and an empty line after it."""
    for table in tables:
        print_table(console, table.title, table.rows, shown)
        for sentence in table.sentences:
            console.print(f"  {sentence}")
        console.print()


def _rows(rows: Sequence[Row], shown: Callable[[object], str]) -> list[str]:
    """The lines of a table, words to the left."""
    if not rows:
        return []
    marks = ["---" if isinstance(value, str) else "---:" for value in rows[0].values()]
    values = [map(shown, row.values()) for row in rows]
    return ["| " + " | ".join(map(_text, cells)) + " |" for cells in (rows[0].keys(), marks, *values)]


def _text(text: str) -> str:
    """A text in which nothing is a sign of Markdown."""
    for sign in "\\|*_<`$":
        text = text.replace(sign, "\\" + sign)
    return text
