"""What is printed must be what was decided: the formulas of certificates are read, and forged meanings refused."""

from pathlib import Path

import pytest
from meaning_changes import FOLDER, FORGED, certificate, changed

from chapsym.checker import Rejected, check, formulas, read


@pytest.mark.parametrize("name", FORGED)
def test_a_certificate_with_another_meaning_is_refused(name):
    id, change = FORGED[name]
    check(certificate(id))
    with pytest.raises(Rejected) as caught:
        check(changed(id, change))
    assert 10 < len(str(caught.value)) < 300


def test_the_formulas_of_most_equations_are_read():
    """A change here is progress, or a loss, and must be looked at."""
    files = [read(path) for path in Path(FOLDER).iterdir()]
    assert sum(bool(data["glossary"]) for data in files) == 46
    assert [data["claim"] for data in files if data["verdict"] == "open"] == []


def test_the_transpose_of_what_has_none_is_not_read():
    [part] = formulas.parts("F^T = A")
    with pytest.raises(formulas.NotRead, match="the transpose of F is not known"):
        formulas.equations(part, formulas.Reader([["F", "", "F"], ["A", "", "A"]], {"A": "A"}))
