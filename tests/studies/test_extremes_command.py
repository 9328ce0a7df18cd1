"""`chapsym extremes`, from outside: table, JSON, page, exit status."""

import json

import pytest
from commands import chapsym

from chapsym.cli import extremes as command
from chapsym.studies import extremes as study


def test_a_group_as_json_and_as_a_page(tmp_path):
    page = tmp_path / "page.html"
    done = chapsym("extremes", "--quick", "derived", "extrapolate", "-o", str(page), "--json")
    found = json.loads(done.stdout)
    assert [*found["groups"]] == ["extrapolate", "derived"]
    assert {cell["rung"] for cell in found["cells"]} == {"double"}
    assert sum(found["counts"].values()) == len(found["cells"])
    assert done.returncode == (1 if found["counts"]["failed"] else 0)
    text = page.read_text(encoding="utf-8")
    assert text.count("data-verdict=") == len(found["cells"])


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [(["nonsense"], "there is no group 'nonsense'"), (["-o", "page.txt"], "must end in .html"),
     (["-o", "/nowhere/page.html"], "does not exist")],
)  # fmt: skip
def test_what_is_wrong_is_said_before_anything_is_computed(arguments, sentence):
    done = chapsym("extremes", *arguments)
    assert done.returncode == 2
    assert done.stderr.startswith("chapsym: ")
    assert sentence in done.stderr
    assert done.stdout == ""


@pytest.mark.parametrize("verdict", ["within", "failed"])
def test_the_exit_status_is_1_if_a_cell_failed(monkeypatch, capsys, verdict):
    cell = study.Cell(
        "a condition", "fold", "double", verdict, 3.0, 4.0, 15.0, 1.0, "" if verdict == "within" else "off"
    )
    monkeypatch.setattr(study, "extremes", lambda *_, **__: [cell])
    if verdict == "failed":
        with pytest.raises(SystemExit) as stop:
            command.extremes(None, True, None, False)
        assert stop.value.code == 1
        assert "✗ a condition (double)" in " ".join(capsys.readouterr().out.split())
    else:
        command.extremes(None, True, None, False)
        assert "✓ 15.0" in capsys.readouterr().out
