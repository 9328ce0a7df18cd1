"""The list of errata: every error, once, with its counterexample; LaTeX that stands alone.

Of the register it is what is published, to the byte; of records by hand it says what each kind of error must say.
"""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

import chapsym
from chapsym.report import WRITERS, errata, notation, records

ROOT = Path(__file__).parents[2]


@pytest.fixture(params=["register", "handmade"])
def found(request):
    return request.getfixturevalue(request.param)


def test_markdown_has_an_entry_for_each_error_in_the_order_of_the_paper(found):
    text = errata.markdown(found, "1.2.3")
    expected = [records.label(record["id"]) for record in records.errors(found)]
    assert re.findall(r"^## (.*)$", text, re.MULTILINE) == expected
    assert f"{len(expected)} of {len(found)} judged claims" in text
    assert "chapsym 1.2.3" in text


def test_every_kind_of_error_says_what_is_true(handmade):
    text = errata.markdown(handmade, "1")
    assert "- Printed: $a = \\tfrac12 b$\n- True: $a = \\tfrac14 b$\n" in text
    assert "- Condition: q is real\n" in text
    assert "- True: a is at most b\n" in text
    point = "J = (1, 2, 4), γ = (0, 0, 1), sn δu = 3/5, sn u = 4/5"
    assert f"- At `{point}`: `a_k = -b`; but `(1, 2/3) ≠ (1, -2/3)`" in text
    text = errata.latex(handmade, "1")
    assert r"\textit{Condition:} $q$ is real" in text
    assert r"\textit{True:} a is at most $b$" in text


@pytest.mark.parametrize(
    "formula",
    [
        "x % y",
        "x $ y",
        r"\input{x}",
        r"\text{\input x}",
        r"\def\x{1}",
        r"\text{a_b}",
        r"x \end{document}",
        "x\n\ny",
        "{x",
    ],
)
def test_what_is_no_formula_is_shown_as_it_is_typed(handmade, formula):
    wrong = next(record for record in handmade if record["verdict"] == "corrected")
    wrong["printed"] = formula
    assert f"- Printed: `{' '.join(formula.split())}`\n" in errata.markdown(handmade, "1")
    assert rf"\textit{{Printed:}} {notation.code_latex(formula)}" in errata.latex(handmade, "1")
    wrong["printed"] = "𝒦x = 1"
    assert r"$\displaystyle {\mathcal{K}}x = 1$" in errata.latex(handmade, "1")


def test_each_error_of_the_paper_has_a_kind_and_follows_from_errors(register):
    wrong = {record["id"] for record in records.errors(register)}
    kinds = {record["id"]: records.slip_of(record)[0] for record in records.errors(register)}
    assert all(kinds.values()), kinds
    assert {id for record in records.errors(register) for id in records.slip_of(record)[1]} <= wrong
    assert records.slips(register) == {"serious": (16, 8), "typo": (12, 12), "convention": (5, 4), "reading": (6, 6)}
    said = records.kinds(register)
    assert said in errata.markdown(register, "1")
    assert said in " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="no LaTeX on this machine; the source is checked without")
def test_latex_compiles(found, tmp_path):
    (tmp_path / "errata.tex").write_text(errata.latex(found, "1"), encoding="ascii")
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "errata.tex"], cwd=tmp_path, capture_output=True,
        text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:]
    assert "Overfull" not in done.stdout


def test_a_paper_without_errors_has_an_empty_list(record):
    sound = [record("2.1", "holds")]
    assert "0 of 1 judged claims" in errata.markdown(sound, "1")
    assert errata.latex(sound, "1").endswith("\\end{document}\n")


@pytest.mark.parametrize("suffix", [".md", ".tex"])
def test_the_published_list_is_what_the_records_give(register, suffix):
    """To mend: chapsym report -o docs/errata.md, and the same for errata.tex."""
    published = (ROOT / "docs" / f"errata{suffix}").read_text(encoding="utf-8")
    assert published == WRITERS[suffix](register, {"chapsym": chapsym.__version__}, {})
