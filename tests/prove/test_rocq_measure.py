"""The theorem `measure-iff` in Rocq: one page to read, no gap, and a change of the page is rejected."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

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


@needs_libraries
def test_rocq_accepts_the_theorem(tmp_path):
    found = judged(tmp_path)
    assert found.returncode == 0, found.stderr
    assert found.stdout.startswith("measure-iff is proved from the equation of a step")


@needs_libraries
def test_rocq_rejects_another_statement(tmp_path, thorough):
    for change in CHANGES if thorough else ("two equal moments are enough", "the inverse rotation"):
        found = judged(tmp_path / change.replace(" ", "-"), "Statement.v", *CHANGES[change])
        assert found.returncode != 0, found.stdout
        assert re.search(r'File "\./\w+\.v", line', found.stderr)


@needs_libraries
def test_rocq_rejects_a_gap(tmp_path):
    found = judged(tmp_path, "Circle.v", "rewrite cos_neg, cos_PI, !sq; intros F; apply N; lra.\nQed.", "Admitted.")
    assert found.returncode != 0
    assert "rests on other axioms" in found.stdout


@needs_libraries
def test_rocq_rejects_a_statement_that_is_not_the_pages(tmp_path):
    page = (FOLDER / "Statement.v").read_text(encoding="utf-8")
    own = page[page.index("Definition measure_iff") :]
    found = judged(tmp_path, "Statement.v", *CHANGES["two equal moments are enough"], {"MeasureIff.v": own})
    assert found.returncode != 0
    assert 'File "./Judged.v", line' in found.stderr


def judged(folder, name=None, old="", new="", before=()):
    """What Rocq says of a copy of the proof, after one change, with more text before the theorem of a file."""
    copy = shutil.copytree(FOLDER, folder / "rocq")
    for other in before:
        path = copy / other
        path.write_text(
            path.read_text(encoding="utf-8").replace("Theorem ", before[other] + "Theorem "), encoding="utf-8"
        )
    if name:
        path = copy / name
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1
        path.write_text(text.replace(old, new), encoding="utf-8")
    return subprocess.run(["make", "-s"], cwd=copy, capture_output=True, text=True)
