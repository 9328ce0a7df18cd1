"""The pages of the repository: their blocks in order, and a folder in which these are run.

What stands in a block says what is done with it:

- `console`: commands after `$ `, run, each with what it prints; of one that fails, with its sentence;
- `python`: a session (`>>> `), run; all those of a page have the same names;
- `{code-block} LANGUAGE` with a caption: a file of that name, which the commands after it find;
- `sh`: commands that take minutes, or install: read, not run, as is code in a line that begins with `chapsym `;
- `text`: no command at all.

`...` in an output stands for whatever is there, and a number that is rounding is compared by its size.
"""

import contextlib
import doctest
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple
from unittest import mock

import commands
import typer
from typer.exceptions import TyperException

from chapsym.cli.app import app, plain

ROOT = Path(__file__).parents[1]
#: Written by commands, whose tests compare them.
WRITTEN = ("docs/errata.md", "docs/symbols.md", "docs/reference/measured/")
PAGES = {
    name: path
    for path in [*ROOT.glob("*.md"), *sorted((ROOT / "docs").rglob("*.md"))]
    if not (name := path.relative_to(ROOT).as_posix()).startswith(("docs/_build", *WRITTEN))
}
FENCED = re.compile(r"^(`{3,})([^\n`]*)\n(.*?)^\1$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`(chapsym [^`]+)`")


class Block(NamedTuple):
    """A fenced block: what is after the fence, what is inside, and where that begins and ends in the page."""

    kind: str
    text: str
    start: int
    end: int


class Command(NamedTuple):
    """A command of a `console` block, what is shown under it, and where that stands in the page."""

    line: str
    shown: str
    start: int
    end: int


def blocks(page):
    """The fenced blocks of a page, in order."""
    return [Block(one[2].strip(), one[3], *one.span(3)) for one in FENCED.finditer(page)]


def prose(page):
    """A page without its blocks."""
    return FENCED.sub("", page)


def console(block):
    """The commands of a block; one may go on after a backslash."""
    found = re.finditer(r"^\$ ((?:.*\\\n)*.*)\n((?:(?!\$ ).*\n)*)", block.text, re.MULTILINE)
    return [Command(one[1], one[2], block.start + one.start(2), block.start + one.end(2)) for one in found]


def comparable(text):
    """An output with what differs from one machine to another made equal."""
    text = re.sub(r"\(\d+\.\d\d s\)", "(0.00 s)", text)
    return re.sub(r"\d(\.\d+)?e-(1[4-7])\b", "1e-15", text)


def same(shown, printed):
    """Whether what is shown is what is printed."""
    check = doctest.OutputChecker().check_output
    return check(comparable(shown), comparable(printed), doctest.ELLIPSIS)


def workspace(folder):
    """A folder that looks like the root of the repository, and takes what the examples write."""
    for name in ("docs", "proofs", "checker", "chapsym", "generated", "benchmarks"):
        (folder / name).symlink_to(ROOT / name)
    return folder


def run(line, folder):
    """What a command prints in the folder; of one that fails, its sentence."""
    first, _, rest = line.partition(" | ")
    program, *words = shlex.split(first)
    script = program == "python" and words[0].endswith(".py")
    if (program == "chapsym" or script) and not {">", "&&"} & set(words):
        done = (commands.script if script else commands.chapsym)(*words, cwd=folder)
        if rest and done.returncode == 0:
            done = subprocess.run(["bash", "-c", rest], input=done.stdout, capture_output=True, text=True, cwd=folder)
    else:
        python = shlex.quote(sys.executable)
        ours = f'chapsym() {{ {python} -m chapsym "$@"; }}\npython() {{ {python} "$@"; }}\n'
        script = f"set -o pipefail\n{ours}{line}"
        # A pytest of a page loads no Zarr, which has a plugin, and its Hypothesis does not fail by the clock.
        env = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "CI": "1"}
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=folder, check=False, env=env)
    return done.stdout if done.returncode == 0 else done.stdout + done.stderr


def played(page, folder):
    """Runs a page: yields for each command or session what is wrong with it, "" for nothing, and what it printed."""
    names = {"__name__": "__main__"}
    for block in blocks(page):
        if block.kind == "console":
            for command in console(block):
                printed = run(command.line, folder)
                yield command, "" if same(command.shown, printed) else f"$ {command.line}\n{printed}", printed
        elif block.kind == "python":
            yield block, session(block.text, names, folder), ""
        elif block.kind.startswith("{code-block}") and (caption := re.search(r"^:caption: (.+)\n", block.text, re.M)):
            file = folder / caption[1]
            file.parent.mkdir(exist_ok=True)
            file.write_text(block.text[caption.end() :].lstrip("\n"), encoding="utf-8")


def session(text, names, folder):
    """Runs a session with these names, to which it adds; returns what doctest says of its failures."""
    said = []
    test = doctest.DocTestParser().get_doctest(text, names, "page", "page", 0)
    flags = doctest.ELLIPSIS
    with contextlib.chdir(folder), mock.patch.object(sys, "path", ["", *sys.path]):
        doctest.DocTestRunner(optionflags=flags).run(test, out=said.append, clear_globs=False)
    names.update(test.globs)
    return "".join(said)


def unknown(line, folder):
    """What the command line would not take of a line that is read and not run; "" if it is right."""
    words = shlex.split(line, comments=True)
    for end in ("|", ">", "&&"):
        if end in words:
            words = words[: words.index(end)]
    command, name = plain(typer.main.get_command(app)), "chapsym"
    rest = words[1:]
    try:
        with contextlib.chdir(folder), open(os.devnull, "w") as nothing, contextlib.redirect_stdout(nothing):
            context = command.make_context(name, list(rest), resilient_parsing=not rest)
            while hasattr(command, "commands") and context._protected_args:
                name, command, rest = command.resolve_command(context, [*context._protected_args, *context.args])
                context = command.make_context(name, list(rest), parent=context)
    except TyperException as error:
        said = error.format_message()
        named = said.startswith("Missing") or said.endswith("requires an argument.")  # a text may speak of it alone
        return "" if named else f"{line}: {said}"
    except (typer.Exit, SystemExit):
        return ""
    return ""
