"""chapsym report, from outside."""

import json
import os
import re
import subprocess
import sys

import pytest


def chapsym(*arguments, **kwargs):
    return subprocess.run(
        [sys.executable, "-m", "chapsym.cli", *arguments], capture_output=True, text=True, check=False, **kwargs
    )


#: Put into sitecustomize, so that the command finds the records of a file kept, instead of proving everything.
GIVEN = """
import json, chapsym.prove as prove, chapsym.prove.records as kept, chapsym.prove.runner as runner
records = {{record["id"]: record for record in json.load(open({path!r}, encoding="utf-8"))}}
prove.load = lambda lemmas=False: dict.fromkeys(records)
prove.prove_all = lambda ids, jobs=None, on_result=None: [records[id] for id in ids]
kept.read, kept.stale, kept.update = lambda path: dict(records), lambda *_: [], lambda *_: None
runner.downstream = lambda id, claims: records[id]["evidence"]["downstream"]
"""


@pytest.fixture
def report(tmp_path, handmade):
    """Runs the command in an empty folder on records that are given."""

    def run(*arguments, records=handmade):
        site, place = tmp_path / "site", tmp_path / "place"
        site.mkdir(exist_ok=True)
        place.mkdir(exist_ok=True)
        (site / "records.json").write_text(json.dumps(records), encoding="utf-8")
        (site / "sitecustomize.py").write_text(GIVEN.format(path=str(site / "records.json")), encoding="utf-8")
        done = chapsym("report", *arguments, cwd=place, env={**os.environ, "PYTHONPATH": str(site)})
        return done, place

    return run


def test_the_page_has_a_default_name(report):
    done, place = report()
    assert done.returncode == 0, done.stderr
    assert done.stdout == (
        "wrote chapsym-report.html: 8 claims: 1 cited, 1 conditional, 1 corrected, 1 definition, 1 holds, 1 open, "
        "1 refuted, 1 settled\n"
    )
    assert [path.name for path in place.iterdir()] == ["chapsym-report.html"]
    text = (place / "chapsym-report.html").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert re.search(r"chapsym \d+\.\d+\.\d+, sympy 1\.14\.\d+, python-flint \d+\.\d+\.\d+", text)


@pytest.mark.parametrize(("suffix", "start"), [("html", "<!DOCTYPE"), ("md", "# Errata"), ("tex", r"\documentclass")])
def test_the_suffix_chooses_what_is_written(report, suffix, start):
    done, place = report("-o", f"x.{suffix}", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["file"] == f"x.{suffix}"
    assert found["claims"] == 8
    assert sum(found["counts"].values()) == 8
    assert (place / f"x.{suffix}").read_text(encoding="utf-8").startswith(start)


def test_an_open_claim_that_the_paper_states_exits_1_and_the_page_is_written(report, handmade, record):
    done, place = report("-o", "x.html", records=[*handmade, record("4.1", "open")])
    assert done.returncode == 1
    assert done.stderr == "chapsym: not proved: 4.1\n"
    assert "claim-4.1" in (place / "x.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("x.pdf", "the output must end in .html or .md or .tex"),
        ("x", "the output must end in .html or .md or .tex"),
        ("nowhere/x.md", "the folder nowhere does not exist"),
    ],
)
def test_a_file_that_cannot_be_written_is_one_sentence_before_anything_is_proved(name, sentence, tmp_path):
    done = chapsym("report", "-o", name, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert sentence in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_folder_in_the_place_of_the_file_loses_nothing(report, tmp_path):
    (tmp_path / "place").mkdir()
    (tmp_path / "place" / "x.html").mkdir()
    done, place = report("-o", "x.html")
    assert done.returncode == 2
    assert "cannot be written" in done.stderr
    assert [path.name for path in place.iterdir()] == ["x.html"]
