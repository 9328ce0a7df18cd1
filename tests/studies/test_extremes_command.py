"""`chapsym extremes`, from outside: table, JSON, page, exit status."""

import json

import pytest
from commands import chapsym, refused

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
    assert sentence in refused("extremes", *arguments)


@pytest.mark.parametrize(("verdict", "told"), [("within", "✓ 15.0"), ("failed", "✗ a condition (double)")])
def test_the_exit_status_is_1_if_a_cell_failed(monkeypatch, verdict, told):
    cell = study.Cell("a condition", "fold", "double", verdict, 3.0, 4.0, 15.0, 1.0, "off" * (verdict == "failed"))
    monkeypatch.setattr(study, "extremes", lambda *_, **__: [cell])
    done = chapsym("extremes", "--quick")
    assert bool(done.returncode) == (verdict == "failed")
    assert told in " ".join(done.stdout.split())
