"""What the README and the page of verdicts count is on record; the project's files agree with the README.

Its commands and its Python are run with those of the other pages: `test_pages.py`.
"""

import re
import tomllib
from collections import Counter
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, metadata, version
from pathlib import Path

from packaging.specifiers import SpecifierSet

import chapsym

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
VERDICTS = (ROOT / "docs/explanation/verdicts.md").read_text(encoding="utf-8")


def test_the_pages_count_and_call_wrong_what_is_on_record(records):
    wrong = [id for id, record in records.items() if record["evidence"]["counterexamples"]]
    count = Counter(record["verdict"] for record in records.values())
    left_open, settled = count["open"], count["settled"]
    assert f"{len(wrong)} of its {len(records)} statements are not true as printed" in README
    assert f"Every one of the {len(records)} statements" in VERDICTS
    words = " ".join(VERDICTS.split())
    assert f"{len(wrong)} are not true as printed: {count['corrected']} are `corrected`" in words
    assert f"and {count['conditional']} are `conditional`" in words
    assert f"{left_open + settled} are open in the paper: {settled} are settled here, {left_open} left open" in words
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \| [^|]+ \|$", VERDICTS.partition("What matters most")[2], re.MULTILINE)
    named = [id for row in rows for id in row.strip().split(", ") if id in records]
    assert len(named) >= 9
    assert set(named) <= set(wrong)


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


def test_the_versions_that_make_installs_take_every_python_that_is_allowed():
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    words = []
    for name, _, pinned in (line.partition("==") for line in lines if "==" in line):
        with suppress(PackageNotFoundError):  # what is not installed, or in another version, is not judged
            needed = metadata(name).get("Requires-Python", "")
            if version(name) == pinned and "3.11.0" not in SpecifierSet(needed):
                words.append(f"{name} {pinned} needs Python {needed}")
    assert not words
