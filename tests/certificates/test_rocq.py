"""An interval certificate as a theorem of Rocq: it says what the checker finds out, and a wrong number is rejected."""

import re
import shutil
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from certificate_changes import FOLDER, committed

from chapsym.certificates.rocq import Theorem, write
from chapsym.certificates.rocq.theorem import real

ROOT = Path(__file__).resolve().parents[2]


def has_interval():
    """Whether Rocq is here, with coq-interval."""
    if not shutil.which("coqc"):
        return False
    found = subprocess.run(["coqc", "-where"], capture_output=True, text=True, check=True).stdout.strip()
    return (Path(found) / "user-contrib" / "Interval").is_dir()


needs_interval = pytest.mark.skipif(not has_interval(), reason="coq-interval is not here: no theorem is judged")


def one_step():
    """The certificate without all but the first step of its first orbit."""
    data = committed("measure-large")
    orbit = data["orbits"][0]
    one = orbit | {"steps": orbit["steps"][:1], "displacement": "-0.10046052746928570908"}
    return data | {"steps": 1, "orbits": [one]}


def written(folder, data):
    """The text for a certificate."""
    write({"one_step": str(Theorem("one_step", data))}, folder)
    return (folder / "one_step.v").read_text(encoding="utf-8")


def command(*arguments):
    """What the command says."""
    name = "chapsym.certificates.rocq"
    return subprocess.run([sys.executable, "-S", "-m", name, *arguments], cwd=ROOT, capture_output=True, text=True)


@pytest.mark.parametrize(
    ("kept", "sentence"),
    [
        ("periodic-orbit-simplest", "only certificates of kind no-invariant-measure are written"),
        ("none", "cannot be read"),
        ("measure-simplest", "the box of gamma of step 8 is too wide for Rocq to prove how it is rounded"),
    ],
)
def test_what_is_no_such_certificate_is_said_in_a_sentence(tmp_path, kept, sentence):
    said = command(FOLDER / f"{kept}.json", tmp_path / "made").stderr
    assert sentence in said
    assert said.count("\n") == 1
    assert not (tmp_path / "made").exists()


def test_what_is_not_named_or_cannot_be_written_is_said_in_a_sentence(tmp_path):
    assert command(tmp_path).stderr == "CERTIFICATE... DIR: name a certificate, and the folder for its theorem\n"
    (tmp_path / "file").touch()
    said = command(FOLDER / "measure-large.json", tmp_path / "file" / "made").stderr
    assert said == f"{tmp_path / 'file' / 'made'} cannot be written: Not a directory\n"


def test_a_real_number_is_written_as_it_is():
    numbers = [Fraction(x) for x in ("0", "7", "-7", "1/2", "-0.046", "1e-40", "-15e-29", "22/7", "-1/3", "1234.5")]
    texts = ["0", "7", "(-7)", "0.5", "(-0.046)", "1e-40", "(-15e-29)", "(22 / 7)", "(-1 / 3)", "1234.5"]
    assert list(map(real, numbers)) == texts


def test_the_theorem_has_every_number_of_the_certificate(tmp_path):
    assert command(FOLDER / "measure-large.json", tmp_path).returncode == 0
    text = (tmp_path / "measure_large.v").read_text(encoding="utf-8")
    theorem = text.partition("Theorem measure_large")[2].partition("Proof.")[0]
    data = committed("measure-large")
    steps = [step for orbit in data["orbits"] for step in orbit["steps"]]
    given = [f"rounded 5e-21 (V {' '.join(real(Fraction(x)) for x in v)})" for s in steps for v in (s["u"], s["gamma"])]
    assert re.findall(r"rounded 5e-21 \(V .*?\)(?= \([ug] \d+%nat\))", theorem) == given
    assert re.findall(r"orbit (\d+) J D h", theorem) == ["7", "7"]
    last = "sine x1 x2 (g 0%nat) (g 7%nat)"
    assert theorem.count(f"0 < {last}") == theorem.count(f"{last} < 0") == 1
    assert theorem.index(f"0 < {last}") < theorem.index(f"{last} < 0")  # as the displacements have their signs
    assert len(re.findall(r"sine x1 x2 \(g \d%nat\) \(g \d%nat\) < 0", theorem)) == 2 * 13 + 1
    assert re.findall(r"Rabs \(sine .*? - (.*?)\) < 5e-21\)", theorem) == ["415e-20", "(-365e-20)"]


def test_the_axioms_are_counted_by_their_libraries(tmp_path):
    written(tmp_path, one_step())
    said = "Axioms:\nUint63.b_spec\n  : forall x : A.b,\n    x\nPrimInt63.tail0 : x\nUint63.a : x\nZ.of : Z\n"
    (tmp_path / "said").write_text(f"#!/bin/sh\ncat << 'end'\n{said}end\n", encoding="utf-8")
    found = rocq(tmp_path, "COQC=sh said")
    assert re.search(r"^axioms      of one_step: 4: 1 PrimInt63 2 Uint63 1 Z$", found.stdout, re.MULTILINE)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """In which Rocq judges the library once."""
    return tmp_path_factory.mktemp("intervals")


def rocq(folder, *options):
    """What Rocq says of the files."""
    return subprocess.run(["make", "-C", folder, *options], capture_output=True, text=True)


def lines(text, start):
    """The numbers of the lines that begin so."""
    return [i for i, line in enumerate(text.splitlines(), 1) if line.strip().startswith(start)]


@needs_interval
@pytest.mark.thorough  # by `make rocq` what is committed is accepted, and the theorem has its numbers by a test above
def test_rocq_accepts_the_steps_and_rejects_a_digit_that_is_wrong(folder):
    text = written(folder, one_step())
    assert text.count("0.86047467164837169771)") == 1
    text = text.replace("0.86047467164837169771)", "0.86047467164837169770)")
    (folder / "one_step.v").write_text(text, encoding="utf-8")
    found = rocq(folder)
    assert found.returncode != 0
    [_, gamma] = lines(text, "+ by_box ")  # that u is right, was accepted
    assert f'"./one_step.v", line {gamma},' in found.stderr


@needs_interval
@pytest.mark.thorough
def test_rocq_rejects_a_bound_that_is_too_small(folder):
    text = written(folder, one_step())
    [radius] = re.findall(r"near (\S+) \(V [^()]*\) u /", text)
    assert radius == "19e-29"
    (folder / "one_step.v").write_text(text.replace(radius, "9e-29"), encoding="utf-8")
    found = rocq(folder)
    assert found.returncode != 0
    start, step = lines(text, "Qed.")[1:3]
    assert start < int(re.findall(r'"./one_step.v", line (\d+)', found.stderr)[0]) < step
