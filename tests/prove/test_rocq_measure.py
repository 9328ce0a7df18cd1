"""The theorem `measure-iff` in Rocq: one page to read, no gap, and a change of the page is rejected."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from budget import slow

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "proofs" / "rocq"


def has(library):
    """Whether Rocq and a library of it are installed."""
    if not shutil.which("coqc"):
        return False
    where = subprocess.run(["coqc", "-where"], capture_output=True, text=True, check=True).stdout.strip()
    return (Path(where) / "user-contrib" / library).is_dir()


needs_libraries = pytest.mark.skipif(
    not (has("mathcomp/analysis") and has("Coquelicot")), reason="mathcomp-analysis or Coquelicot is not here"
)

#: Words with which a proof in Rocq leaves something out.
GAPS = r"\b(Admitted|admit|Axioms?|Parameters?|Conjecture|Unset|bypass_check)\b"
#: One place of the page each: what it says is another theorem, which the proof does not prove.
CHANGES = {
    "the inverse rotation": ("(scale (-2) (cross u v))", "(scale 2 (cross u v))"),
    "the other sign of D": ("(scale (- (D b * (dot g u / dot g g))) g)", "(scale (D b * (dot g u / dot g g)) g)"),
    "without u x I u": ("(cross u (inertia b u))", "(cross u u)"),
    "the square of u with a minus": ("(- ((1 + dot u u) / 2))", "(- ((1 - dot u u) / 2))"),
    "any root": ("residual b x u = V 0 0 0 /\\ dot u u < 1", "residual b x u = V 0 0 0 /\\ dot u u < 9"),
    "D may be 0": ("0 < I3 b /\\ 0 < D b", "0 < I3 b /\\ 0 <= D b"),
    "two equal moments are enough": ("<-> I1 b = I2 b /\\ I2 b = I3 b", "<-> I1 b = I2 b"),
    "without the determinant": ("rho (Phi x) * Rabs (\\det L)%R = rho x", "rho (Phi x) = rho x"),
}


def test_the_statement_fits_on_a_page():
    assert len((FOLDER / "Statement.v").read_text(encoding="utf-8").splitlines()) <= 60


def test_the_proof_has_no_gap():
    for path in FOLDER.glob("*.v"):
        text = re.sub(r"\(\*.*?\*\)", "", path.read_text(encoding="utf-8"), flags=re.S)
        assert not re.search(GAPS, text), path


@pytest.fixture(scope="session")
def accepted(tmp_path_factory):
    """A copy of the proof that Rocq has judged, and what it said: the changed copies go on from its files."""
    copy = shutil.copytree(FOLDER, tmp_path_factory.mktemp("measure") / "rocq")
    return copy, judged(copy)


@needs_libraries
def test_rocq_accepts_the_theorem(accepted):
    _, found = accepted
    assert found.returncode == 0, found.stderr
    assert found.stdout.startswith("measure-iff is proved from the equation of a step")


@needs_libraries
@pytest.mark.thorough
@pytest.mark.parametrize("change", CHANGES)
def test_rocq_rejects_another_statement(tmp_path, change):
    """That what is proved is the page is seen below, by a proof of another statement."""
    copy = shutil.copytree(FOLDER, tmp_path / "rocq")
    text = (copy / "Statement.v").read_text(encoding="utf-8")
    old, new = CHANGES[change]
    assert text.count(old) == 1
    (copy / "Statement.v").write_text(text.replace(old, new), encoding="utf-8")
    found = judged(copy)
    assert found.returncode != 0, found.stdout
    assert re.search(r'File "\./\w+\.v", line', found.stderr)


@needs_libraries
@pytest.mark.parametrize(
    ("last", "said"),
    [
        ("Theorem measure_iff_holds : measure_iff. Proof. Admitted.", "rests on other axioms"),
        ("Definition measure_iff := True. Theorem measure_iff_holds : measure_iff. exact I. Qed.", "./Judged.v"),
        *slow(("Lemma gap : False. Admitted. Theorem measure_iff_holds : measure_iff. case gap. Qed.", "axioms")),
    ],
)
def test_rocq_rejects_a_gap_and_a_statement_that_is_not_the_pages(accepted, tmp_path, last, said):
    """With another last file of the proof: what stands before it is as Rocq has compiled it."""
    copy = shutil.copytree(accepted[0], tmp_path / "rocq")
    (copy / "MeasureIff.v").write_text(f"Require Import Statement.\n{last}\n", encoding="utf-8")
    found = judged(copy, "FILES=MeasureIff Judged")
    assert found.returncode != 0
    assert said in found.stdout + found.stderr


def judged(folder, *options):
    """What Rocq says of a copy of the proof."""
    return subprocess.run(["make", "-s", *options], cwd=folder, capture_output=True, text=True)
