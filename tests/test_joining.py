"""What a contributor reads is true: its files and commands are there; the paper, the references, a release.

Each reference is cited where the documentation says how it relates, and the citation file agrees with them.
"""

import importlib.util
import re
import subprocess
import tomllib
from pathlib import Path

import commands
import pytest
import yaml

ROOT = Path(__file__).parents[1]
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
BIBLIOGRAPHY = (ROOT / "docs" / "bibliography.md").read_text(encoding="utf-8")
ENTRIES = re.findall(r"^@(\w+)\{(\w+),\n(.*?)^\}$", (ROOT / "docs" / "references.bib").read_text("utf-8"), re.M | re.S)
KEYS = [key for _, key, _ in ENTRIES]
TARGETS = re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)


def test_every_file_that_is_named_exists():
    named = re.findall(r"`([\w./-]+(?:/|\.\w+))`", CONTRIBUTING)
    named += re.findall(r"(?<=[ =])(?:tests|docs)/[\w/.]*[\w/]", CONTRIBUTING)
    assert len(named) >= 40
    assert not [name for name in named if not (ROOT / name).exists() and name not in ("docs/errata", "tests/FILE")]


def test_every_make_target_and_command_that_is_named_exists():
    assert set(re.findall(r"(?:^ {4,}|&& )make ([\w-]+)", CONTRIBUTING, re.MULTILINE)) <= set(TARGETS)
    for name in sorted(set(re.findall(r"\bchapsym ([a-z]+)", CONTRIBUTING))):
        assert commands.chapsym(name, "--help").returncode == 0, name


def test_the_paper_has_its_sections_and_its_references():
    text = (ROOT / "paper.md").read_text(encoding="utf-8")
    assert 250 <= len(text.split("---", 2)[2].split()) <= 1000
    headings = re.findall(r"^# (.*)$", text, re.MULTILINE)
    assert headings[:3] == ["Summary", "Statement of need", "State of the field"]
    assert headings[-1] == "References"
    references = (ROOT / yaml.safe_load(text.split("---")[1])["bibliography"]).read_text(encoding="utf-8")
    cited = set(re.findall(r"@(\w+)", text.split("---", 2)[2]))
    assert cited
    assert cited <= set(re.findall(r"^@\w+\{(\w+),$", references, re.MULTILINE))
    for figure in re.findall(r"\]\(([^)]*)\)", text):
        assert (ROOT / figure).is_file()


def test_every_reference_is_annotated_and_every_citation_is_a_reference():
    assert len(set(KEYS)) == len(KEYS) >= 30
    cited = re.findall(r"\{cite:[tp]\}`(\w+)`", BIBLIOGRAPHY)
    assert set(cited) == set(KEYS)


def test_the_paper_and_the_citation_file_speak_of_the_same_reference_and_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert citation["version"] == project["version"]
    assert citation["license"] == project["license"]
    assert citation["authors"] == project["authors"] == [{"name": "The chapsym developers"}]
    (paper,), body = citation["references"], next(body for _, key, body in ENTRIES if key == "fedorov2007")
    found = dict(re.findall(r"^  (\w+) *= \{(.*)\},?$", body, re.M))
    assert paper["title"] == found["title"].replace("{", "").replace("}", "")
    numbers = (str(paper["year"]), str(paper["volume"]), paper["number"])
    assert numbers == (found["year"], found["volume"], found["pages"])
    assert paper["journal"] == found["journal"]


def test_licences_are_files():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for name in project["license-files"]:
        assert "Permission is hereby granted" in (ROOT / name).read_text(encoding="utf-8")
    assert "the chapsym developers" in (ROOT / "LICENSE").read_text(encoding="utf-8")


# A release


@pytest.fixture(scope="module")
def release():
    spec = importlib.util.spec_from_file_location("release_check", ROOT / ".ci" / "release_check.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


FILES = {
    "pyproject.toml": '[project]\nversion = "1.2.0"\n',
    "chapsym/__init__.py": '__version__ = "1.2.0"\n',
    "CITATION.cff": "cff-version: 1.2.0\nversion: 1.2.0\ndate-released: 2030-01-02\n",
    "CHANGELOG.md": "## [Unreleased]\n\n## [1.2.0] - 2030-01-02\n\n## [1.1.0] - 2029-01-02\n",
}


@pytest.fixture
def checkout(tmp_path):
    """A checkout whose versions agree, and what writes one of its files."""
    (tmp_path / "chapsym").mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    return tmp_path


def test_one_version_and_one_date_are_ready(release, checkout):
    assert release.versions(checkout) == "version 1.2.0 of 2030-01-02, in all four files"


@pytest.mark.parametrize(
    ("name", "old", "new", "sentence"),
    [
        ("pyproject.toml", "1.2.0", "1.3.0", "chapsym/__init__.py has the version 1.2.0, pyproject.toml has 1.3.0"),
        ("CITATION.cff", "\nversion: 1.2.0", "\nversion: 1.1.0", "CITATION.cff has the version 1.1.0"),
        ("CHANGELOG.md", "[1.2.0]", "[1.2.1]", "CHANGELOG.md has the version 1.2.1"),
        ("CHANGELOG.md", "## [1.2.0] - 2030-01-02", "## [1.2.0]", "CHANGELOG.md has no date for 1.2.0"),
        ("CITATION.cff", "2030-01-02", "2030-01-03", "write date-released: 2030-01-02"),
    ],
)
def test_what_a_release_lacks_is_told_in_one_sentence(release, checkout, capsys, monkeypatch, name, old, new, sentence):
    (checkout / name).write_text(FILES[name].replace(old, new, 1), encoding="utf-8")
    monkeypatch.setattr(release, "CHECKS", (release.versions,))
    assert release.main(checkout) == 1
    said = capsys.readouterr().err
    assert sentence in said
    assert said.startswith("not ready: ")
    assert said.count("\n") == 1


def test_only_a_clean_tree_is_released(release, checkout):
    with pytest.raises(release.NotReady, match="is no git repository"):
        release.clean(checkout)
    subprocess.run(["git", "init", "--quiet"], cwd=checkout, check=True)
    with pytest.raises(release.NotReady, match=r"CHANGELOG\.md is not committed; commit it or take it away"):
        release.clean(checkout)
    who = ["-c", "user.name=x", "-c", "user.email=x", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", "add", "-A"], cwd=checkout, check=True)
    subprocess.run(["git", *who, "commit", "--quiet", "--no-verify", "-m", "x"], cwd=checkout, check=True)
    assert release.clean(checkout) == "the tree is clean"


def test_a_command_that_fails_says_its_last_line(release, tmp_path):
    with pytest.raises(release.NotReady, match=r"^it failed: the reason$"):
        release._run("it", tmp_path, "bash", "-c", "echo much >&2; echo the reason >&2; exit 3")
