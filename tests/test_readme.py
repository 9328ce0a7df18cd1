"""The README is true: its commands print what it shows, its Python runs, its tables match the register."""

import doctest
import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import chapsym

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def console_examples():
    for block in re.findall(r"```console\n(.*?)```", README, re.DOTALL):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, output = part.partition("\n")
            yield command, output


def without_times(text):
    return re.sub(r"\(\d+\.\d\d s\)", "(...)", text)


@pytest.mark.parametrize(("command", "output"), list(console_examples()), ids=lambda x: x[:40])
def test_a_command_prints_what_the_readme_shows(command, output, tmp_path, verdicts):
    binary = Path(sys.executable).parent
    script = command.replace("chapsym ", f"{shlex.quote(sys.executable)} -m chapsym.cli ", 1)
    script = script.replace("python proofs", f"{shlex.quote(sys.executable)} proofs", 1)
    for name in ("first.npz", "page.html"):
        script = script.replace(name, str(tmp_path / name))
    records = tmp_path / "verdicts.jsonl"  # those of this run, which the report takes as it would the user's own
    records.write_text("".join(json.dumps(record) + "\n" for record in verdicts.values()), encoding="utf-8")
    env = {**os.environ, "CHAPSYM_RECORDS": str(records)}
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=ROOT, env=env, check=False)
    assert done.returncode == 0, done.stderr + str(binary)
    shown = done.stdout.replace(f"{tmp_path}{os.sep}", "")
    # The drift is rounding: its digits may differ on another processor, its size may not.
    rounded = [re.sub(r"\d\.\de-(15|16|14)", "~1e-15", without_times(t)) for t in (shown, output)]
    assert rounded[0] == rounded[1]


def test_the_python_examples_run():
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner()
    for block in re.findall(r"```python\n(.*?)```", README, re.DOTALL):
        runner.run(parser.get_doctest(block, {}, "README", "README.md", 0))
    results = runner.summarize()
    assert results.attempted >= 8
    assert results.failed == 0


def test_the_readme_counts_and_calls_wrong_what_is_on_record(records):
    wrong = sum(bool(record["evidence"]["counterexamples"]) for record in records.values())
    left_open, settled = (sum(r["verdict"] == verdict for r in records.values()) for verdict in ("open", "settled"))
    assert f"Every one of the {len(records)} statements" in README
    assert f"{wrong} are not true as printed" in README
    assert f"{left_open + settled} are open in the\npaper: {settled} are settled here, {left_open} left open" in README
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \| [^|]+ \|$", README, re.MULTILINE)
    named = [id for row in rows for id in row.strip().split(", ") if id in records]
    assert len(named) >= 9
    assert all(records[id]["evidence"]["counterexamples"] for id in named)


def test_versions_and_limits_agree():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["version"] == chapsym.__version__
    assert project["requires-python"] == ">=3.11"
    assert "Python 3.11 or newer" in README
    pinned = (ROOT / "constraints.txt").read_text(encoding="utf-8")
    assert "://" not in pinned
    for requirement in project["dependencies"]:
        name = re.match(r"[\w-]+", requirement).group()
        assert re.search(rf"^{name}==", pinned, re.MULTILINE), name


def test_ci_calls_the_readmes_test_command():
    ci = (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    assert "make test" in ci
    assert "make test" in README
    assert "make verify" in README
