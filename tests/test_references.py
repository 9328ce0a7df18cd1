"""The references: each is cited where the documentation says how it relates, and the citation file agrees with them."""

import re
import tomllib
from pathlib import Path

import yaml

ROOT = Path(__file__).parents[1]
BIBLIOGRAPHY = (ROOT / "docs" / "bibliography.md").read_text(encoding="utf-8")
ENTRIES = re.findall(r"^@(\w+)\{(\w+),\n(.*?)^\}$", (ROOT / "docs" / "references.bib").read_text("utf-8"), re.M | re.S)
KEYS = [key for _, key, _ in ENTRIES]


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
