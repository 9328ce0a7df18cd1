"""The pages of what was measured are written by the commands, and show the tables that they print."""

import re
from pathlib import Path

import pytest
from commands import chapsym

import benchmarks
from benchmarks import command
from chapsym.studies import check

PAGES = Path(__file__).parents[2] / "docs" / "reference" / "measured"
ROW = re.compile(r"^\| (.+) \|$", re.MULTILINE)


def table(page):
    """The first table of a page: lists of what is in its cells."""
    return [[cell.replace("\\", "") for cell in re.split(r"(?<!\\) \| ", row)] for row in ROW.findall(page)]


def test_a_page_of_the_check_has_the_table_that_is_printed(tmp_path, monkeypatch):
    monkeypatch.setattr(check, "STRATA", dict(list(check.STRATA.items())[:2]))
    page = tmp_path / "the check.md"
    done = chapsym("check", "--states", 1, "--steps", 1000, "-o", page)
    assert done.returncode == 0, done.stderr
    text = page.read_text(encoding="utf-8")
    assert f"`chapsym check --states 1 --steps 1000 -o '{page}'`" in text
    assert re.search(r"on \d{4}-\d\d-\d\d\. Machine: .*\d cores", text)
    header, _, *rows = table(text)
    assert header[0] == "stratum"
    for row in rows:
        assert re.search(r" +│ +".join(map(re.escape, row)), done.stdout), row
    assert len(rows) == 2


def test_a_page_of_a_benchmark_has_its_rows_its_peers_and_what_was_to_be_reached(tmp_path, monkeypatch):
    reach = [benchmarks.Reached("speed", 2.0, 1.0, True)]
    one = benchmarks.Result("A_title", [{"name": "x|y", "value": 1.23456}], {"peer": "not installed"}, reach)
    monkeypatch.setattr(benchmarks, "SECTIONS", {"one": "one"})
    monkeypatch.setattr(benchmarks, "run", lambda *arguments: one)
    page = tmp_path / "bench.md"
    command.measure(["one"], True, page, False)
    text = page.read_text(encoding="utf-8")
    goals, rows = (table(part) for part in text.split("## A"))
    assert goals[2:] == [["one", "speed", "2", "at least 1", "yes"]]
    assert rows == [["name", "value"], ["---", "---:"], ["x|y", "1.23"]]
    assert "## A\\_title" in text
    assert "- peer: not installed\n" in text


@pytest.mark.parametrize("name", ["bench", "check", "extremes", "trade"])
def test_the_pages_of_the_documentation_are_written_by_commands(name):
    text = (PAGES / f"{name}.md").read_text(encoding="utf-8")
    command = rf"`chapsym {name}( [^`]*)? -o docs/reference/measured/{name}\.md`, of chapsym \S+, on \d{{4}}-"
    assert re.search(command, text)
