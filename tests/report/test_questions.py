"""The page of the open questions: answers, certificates as the checker judges them, and what the studies found."""

import copy
import re
from importlib import import_module
from pathlib import Path

import pytest

from chapsym import checker
from chapsym.cli import report as command
from chapsym.proofs.open import certified
from chapsym.report import questions

VERSIONS = {"chapsym": "0.1.0"}
SIMPLEST = certified.FOLDER / "measure-simplest.json"


@pytest.fixture
def asked(record):
    """The two questions and a lemma that one of them uses."""
    return [
        record("5.9-open", "settled", answer="No, <b>never</b>.", uses=["locked-circle", "prop-3"], open_in_paper=True),
        record("6-open", "open", tried=["an ansatz"], open_in_paper=True),
        record("locked-circle", "holds", derivation=["a circle"]),
    ]


def test_answers_and_lemmas_are_there_and_escaped_and_links_lead_to_them(asked):
    text = questions.html(asked, [], [], VERSIONS)
    assert "No, &lt;b&gt;never&lt;/b&gt;." in text
    assert all(text.count(f'id="claim-{record["id"]}"') == 1 for record in asked)
    assert "No certificate was given" in text
    assert set(re.findall(r'href="#([^"]+)"', text)) <= set(re.findall(r'id="([^"]+)"', text))
    assert text == questions.html(copy.deepcopy(asked), [], [], VERSIONS)


def test_the_words_of_the_paper_and_the_readings_are_shown_with_what_carries_them(record):
    row = {"asked": "real <i>s</i>", "answer": "no", "by": ["locked-circle"], "text": "No. Where h = 1: no."}
    left = {"asked": "complex s", "answer": "open", "by": [], "theorem": None, "text": None}
    rows = [row | {"theorem": {"conclusions": []}}, left]
    given = record(
        "5.9-open", "settled", answer="No.", readings=rows, settled={"text": "by hand: 2 sentences"},
        question={"words": "“is there a (multi-valued) reparameterization”", "where": "Section 5"},
    )  # fmt: skip
    text = questions.html([given], [], [], VERSIONS)
    shown = re.sub(r"<[^>]+>", "", text)
    for said in (
        "“is there a (multi-valued) reparameterization”", "Section 5", "Settled by hand: 2 sentences.", "complex s",
        "real &lt;i&gt;s&lt;/i&gt;", "No. Where h = 1: no.", "locked-circle",
    ):  # fmt: skip
        assert said in shown, said
    assert re.findall(r"<td><b>(.*?)</b></td><td>(.*?)</td>", text) == [("no", "locked-circle"), ("open", "open")]


def test_a_certificate_is_shown_as_it_is_judged(asked):
    data = checker.read(SIMPLEST)
    good = questions.Checked("good.json", data, checker.check(data).numbers)
    bad = questions.Checked("bad.json", data, {}, "the digest is not that of the file")
    text = questions.html(asked, [good, bad], [], VERSIONS)
    assert data["ball"]["level"] in text
    assert text.count("✗</span> bad.json") == text.count("✓</span> good.json") == 1
    assert "Rejected: the digest is not that of the file" in text


def test_figures_are_inside_the_page(asked):
    evidence = questions.Evidence("rotation", "Rotation", ["it locks"], [("A staircase", "<svg/>")])
    text = questions.html(asked, [], [evidence], VERSIONS)
    assert 'src="data:image/svg+xml;base64,PHN2Zy8+" alt="A staircase"' in text
    assert "it locks" in text


@pytest.mark.parametrize("name", command.STUDIES)
def test_what_a_full_study_left_is_read(name):
    folder = Path(__file__).parents[2] / "docs" / "open"
    found = command._evidence(name, folder)
    assert found.sentences
    assert len(found.figures) == len(import_module(f"research.{name}").CAPTIONS) > 0
    assert all(caption and svg.lstrip().startswith("<?xml") for caption, svg in found.figures)


@pytest.mark.parametrize("text", ['{"quick": true}', "[" * 10**5])
def test_other_data_than_a_study_writes_are_refused(tmp_path, capsys, text):
    (tmp_path / "rotation.json").write_text(text)
    with pytest.raises(SystemExit) as stop:
        command._evidence("rotation", tmp_path)
    assert stop.value.code == 2
    assert "cannot be read as what chapsym study rotation -o writes" in capsys.readouterr().err
