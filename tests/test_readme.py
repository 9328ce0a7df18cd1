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
VERDICTS = "docs/explanation/verdicts.md"
#: What a page says of the numbers of verdicts.
COUNTED = [
    ("README.md", "{wrong} of its {claims} statements are not true as printed"),
    (VERDICTS, "Every one of the {claims} statements"),
    (VERDICTS, "{wrong} are not true as printed: {corrected} are `corrected`"),
    (VERDICTS, "and {conditional} are `conditional`"),
    (VERDICTS, "{asked} are open in the paper: {settled} are settled here, {open} left open"),
    ("paper.md", "each of {claims} claims"),
    ("paper.md", "{wrong} are not true as printed"),
    ("CHANGELOG.md", "Verdicts on {claims} claims"),
    ("CHANGELOG.md", "{wrong} are not true as printed"),
]


def test_the_pages_count_and_call_wrong_what_is_on_record(records):
    wrong = [id for id, record in records.items() if record["evidence"]["counterexamples"]]
    count = Counter(record["verdict"] for record in records.values())
    count.update(wrong=len(wrong), claims=len(records), asked=count["open"] + count["settled"], open=0)
    for name, said in COUNTED:
        assert said.format(**count) in " ".join((ROOT / name).read_text(encoding="utf-8").split()), (name, said)
    matters = (ROOT / VERDICTS).read_text(encoding="utf-8").partition("What matters most")[2]
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \| [^|]+ \|$", matters, re.MULTILINE)
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
