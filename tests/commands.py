"""The command `chapsym`, in this process where nothing else is asked for: a child starts for a second or two."""

import contextlib
import io
import json
import logging
import math
import os
import re
import runpy
import subprocess
import sys
from pathlib import Path
from unittest import mock

from chapsym.cli import main, output

#: The register of two claims.
TWO = "--register", str(Path(__file__).with_name("two_claims.py"))


def chapsym(*arguments, cwd="."):
    """What the command writes and its exit status, as of a child that starts in the folder `cwd`."""
    return _here(main, "chapsym", *arguments, cwd=cwd)


def script(file, *arguments, cwd="."):
    """The same of a Python script, which finds the modules in its folder."""

    def run():
        with mock.patch.object(sys, "path", [str(Path(file).parent), *sys.path]):
            runpy.run_path(file, run_name="__main__")

    return _here(run, file, *arguments, cwd=cwd)


def _here(run, *arguments, cwd):
    said, words = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    handlers, level = list(logging.root.handlers), logging.getLogger("chapsym").level
    logging.root.handlers.clear()  # so that the command takes its own, as in a new process
    try:
        with (
            mock.patch.object(sys, "argv", [*map(str, arguments)]),
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(words),
            contextlib.chdir(cwd),
            mock.patch.object(sys, "unraisablehook", sys.unraisablehook),
            mock.patch.object(output, "PAUSE", math.inf),  # no line that a slow machine alone prints
        ):
            run()
        status = 0
    except SystemExit as ended:
        status = ended.code or 0
        if isinstance(status, str):
            words.write(f"{status}\n")
            status = 1
    finally:
        logging.root.handlers[:] = handlers
        logging.getLogger("chapsym").setLevel(level)
    return subprocess.CompletedProcess(arguments[1:], status, _text(said), _text(words))


def _text(stream):
    stream.flush()
    return stream.buffer.getvalue().decode()


def child(*arguments, **options):
    """The same in a process of its own."""
    arguments = [sys.executable, "-m", "chapsym", *map(str, arguments)]
    return subprocess.run(arguments, capture_output=True, text=True, check=False, **options)


def answer(*arguments):
    """What the command answers in JSON, with nothing beside it."""
    done = chapsym(*arguments, "--json")
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return json.loads(done.stdout)


def refused(*arguments, run=chapsym, status=2, **options):
    """The one sentence of an error; before it a slow machine may have words how far a run was."""
    done = run(*arguments, **options)
    assert (done.returncode, done.stdout) == (status, ""), done.stdout + done.stderr
    said = re.sub(r"(?m)^chapsym: \d+%, .*\n", "", done.stderr)
    assert said.startswith("chapsym: ")
    assert said.count("\n") == 1, said
    return said.removeprefix("chapsym: ").rstrip()


def changed(folder, *lines):
    """The environment of a child that runs these lines before anything else, and has no records yet."""
    (folder / "sitecustomize.py").write_text("\n".join(lines))
    path = os.pathsep.join([str(folder), *filter(None, [os.environ.get("PYTHONPATH")])])
    return {**os.environ, "PYTHONPATH": path, "CHAPSYM_RECORDS": str(folder / "none.jsonl")}
