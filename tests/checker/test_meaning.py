"""What is printed must be what was decided: the formulas of certificates are read, and forged meanings refused."""

import random
import re
from pathlib import Path

import pytest
from budget import slow
from meaning_changes import FOLDER, FORGED, certificate, changed

from chapsym.checker import Rejected, check, formulas, meaning, read
from chapsym.prove import load

#: Which take as long as many others.
LONG = "a part is dropped with a word left", "what is said in words, too"


@pytest.mark.parametrize("name", [*(name for name in FORGED if name not in LONG), *slow(*LONG)])
def test_a_certificate_with_another_meaning_is_refused(name):
    """As they are committed, all are accepted: what is proved now is what is committed, and it was judged."""
    id, change = FORGED[name]
    with pytest.raises(Rejected) as caught:
        check(changed(id, change))
    assert 10 < len(str(caught.value)) < 300


def test_the_formulas_of_most_equations_are_read():
    """A change here is progress, or a loss, and must be looked at."""
    files = [read(path) for path in Path(FOLDER).iterdir()]
    assert sum(bool(data["glossary"]) for data in files) == 82
    page = Path(__file__).parents[2] / "docs" / "explanation" / "verdicts.md"
    assert "82 claims are read so" in page.read_text(encoding="utf-8")
    assert [data["claim"] for data in files if data["verdict"] == "open"] == []
    decided = [one for data in files for part in meaning.DECIDED for one in data[part]]
    assert sum(one.get("words", False) for one in decided) == 17


def test_the_transpose_of_what_has_none_is_not_read():
    [part] = formulas.parts("F^T = A")
    with pytest.raises(formulas.NotRead, match="the transpose of F is not known"):
        formulas.relations(part, formulas.Reader([["F", "", "F"], ["A", "", "A"]], {"A": "A"}))


def test_no_sign_of_what_is_proved_can_be_turned(thorough):
    """In a formula that is refuted another sign may be as false, and is then as refuted."""
    turned = list(signs())
    for id, role, formula in turned if thorough else random.Random(37).sample(turned, 12):
        data = changed(id, lambda d, role=role, formula=formula: d.update({role: formula}))
        try:
            check(data)
        except Rejected:
            continue
        assert role == "printed"
        assert data["verdict"] == "corrected", formula
    assert len(turned) > 150


def signs():
    """The formulas that are read, with one sign turned, but for those in words, in indices and before O."""
    for path in sorted(Path(FOLDER).iterdir()):
        data = read(path)
        for role in ("printed", "corrected") if data["glossary"] else ():
            formula = data[role] or ""
            plain = re.sub(
                r"[_^]\{[^{}]*\}|[+-] O|[^,]*\\text\{[^{}]*\}[^,]*", lambda found: " " * len(found[0]), formula
            )
            for found in re.finditer("[+-]", plain):
                other = {"+": "-", "-": "+"}[found[0]]
                yield data["claim"], role, formula[: found.start()] + other + formula[found.end() :]


#: Formulas that are statements of the certificate and that the checker does not read.
COMPARED_BY_EYE = {"4.1"}


def test_each_claim_is_read_or_says_what_leads_to_its_formula():
    """A definition has nothing to decide; a question is answered by theorems."""
    left, inferred = set(), 0
    for id, claim in load().items():
        data = certificate(id)
        assert claim.printed == data["printed"]
        in_words = any(one["role"] == "inference" for one in data["sentences"])
        inferred += in_words
        if not data["glossary"] and not in_words and data["verdict"] not in ("definition", "settled"):
            left.add(id)
    assert left == COMPARED_BY_EYE
    page = Path(__file__).parents[2] / "docs" / "explanation" / "verdicts.md"
    assert f"In {inferred} claims the decided" in page.read_text(encoding="utf-8")
