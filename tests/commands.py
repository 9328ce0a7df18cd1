"""The command `chapsym`, in this process where nothing else is asked for: a child starts for a second or two."""

import contextlib
import io
import json
import logging
import math
import os
import re
import subprocess
import sys
from pathlib import Path
from unittest import mock

from chapsym.cli import main, output

#: The register of two claims.
TWO = "--register", str(Path(__file__).with_name("two_claims.py"))


def chapsym(*arguments, cwd="."):
    """What the command writes and its exit status, as of a child that starts in the folder `cwd`."""
    said, words = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    handlers, level = list(logging.root.handlers), logging.getLogger("chapsym").level
    logging.root.handlers.clear()  # so that the command takes its own, as in a new process
    try:
        with (
            mock.patch.object(sys, "argv", ["chapsym", *map(str, arguments)]),
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(words),
            contextlib.chdir(cwd),
            mock.patch.object(sys, "unraisablehook", sys.unraisablehook),
            mock.patch.object(output, "PAUSE", math.inf),  # no line that a slow machine alone prints
        ):
            main()
    except SystemExit as ended:
        return subprocess.CompletedProcess(arguments, ended.code, _text(said), _text(words))
    finally:
        logging.root.handlers[:] = handlers
        logging.getLogger("chapsym").setLevel(level)


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
