"""chapsym report, from outside."""

import json
import re

import commands
import pytest


@pytest.fixture
def report(tmp_path, monkeypatch, handmade):
    """Runs the command in an empty folder on records that are given, instead of proving everything."""
    import chapsym.prove
    from chapsym.prove import records as kept
    from chapsym.prove import runner

    monkeypatch.chdir(tmp_path)

    def run(*arguments, records=handmade):
        given = {record["id"]: record for record in records}
        monkeypatch.setattr(chapsym.prove, "load", lambda *_: dict.fromkeys(given))
        monkeypatch.setattr(kept, "read", lambda path: dict(given))
        monkeypatch.setattr(kept, "stale", lambda *_: [])
        monkeypatch.setattr(chapsym.prove, "prove_all", lambda ids, *_, **__: [given[i] for i in ids])
        monkeypatch.setattr(kept, "update", lambda *_: None)
        monkeypatch.setattr(runner, "downstream", lambda id, claims: given[id]["evidence"]["downstream"])
        return commands.chapsym("report", *arguments)

    return run


def test_the_page_has_a_default_name(report, tmp_path):
    done = report()
    assert done.returncode == 0, done.stderr
    assert done.stdout == (
        "wrote chapsym-report.html: 8 claims: 1 conditional, 1 corrected, 2 definition, 1 holds, 1 open, "
        "1 refuted, 1 settled\n"
    )
    assert [path.name for path in tmp_path.iterdir()] == ["chapsym-report.html"]
    text = (tmp_path / "chapsym-report.html").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert re.search(r"chapsym \d+\.\d+\.\d+, sympy 1\.14\.\d+, python-flint \d+\.\d+\.\d+", text)


@pytest.mark.parametrize(
    ("suffix", "start"),
    [("html", "<!DOCTYPE"), ("md", "# Errata"), ("tex", r"\documentclass"), ("json", '{\n "format": "chapsym err')],
)
def test_the_suffix_chooses_what_is_written(report, tmp_path, suffix, start):
    done = report("-o", f"x.{suffix}", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["file"] == f"x.{suffix}"
    assert found["claims"] == 8
    assert sum(found["counts"].values()) == 8
    assert (tmp_path / f"x.{suffix}").read_text(encoding="utf-8").startswith(start)


def test_an_open_claim_that_the_paper_states_exits_1_and_the_page_is_written(report, tmp_path, handmade, record):
    done = report("-o", "x.html", records=[*handmade, record("4.1", "open")])
    assert done.returncode == 1
    assert done.stderr == "chapsym: not proved: 4.1\n"
    assert "claim-4.1" in (tmp_path / "x.html").read_text(encoding="utf-8")


def test_a_list_of_errata_that_is_written_again_keeps_the_states_of_earlier_releases(report, tmp_path):
    assert report("-o", "x.json").returncode == 0
    kept = (tmp_path / "x.json").read_text(encoding="utf-8")
    (tmp_path / "x.json").write_text(kept.replace('"since": "', '"since": "0.0.'), encoding="utf-8")
    assert report("-o", "x.json").returncode == 0
    again = json.loads((tmp_path / "x.json").read_text(encoding="utf-8"))
    assert all(state["since"].startswith("0.0.") for entry in again["errata"] for state in entry["states"])


def test_neither_another_file_nor_a_folder_nor_the_records_are_overwritten(report, tmp_path):
    assert "x.json is named twice" in report("-o", "x.json", "--records", "x.json").stderr
    assert not list(tmp_path.iterdir())
    (tmp_path / "x.json").write_text('{"mine": 1}', encoding="utf-8")
    done = report("-o", "x.json")
    assert done.returncode == 2
    assert done.stderr.startswith("chapsym: x.json is there and cannot be gone on with: it is no list of errata; ")
    assert done.stderr.count("\n") == 1
    assert (tmp_path / "x.json").read_text(encoding="utf-8") == '{"mine": 1}'
    (tmp_path / "x.html").mkdir()
    done = report("-o", "x.html")
    assert done.returncode == 2
    assert "cannot be written" in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"x.html", "x.json"}
