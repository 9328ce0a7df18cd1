"""An interval certificate as a theorem of Rocq: it says what the checker finds out, and a wrong number is rejected."""

import json
import re
import shutil
import subprocess
from fractions import Fraction
from pathlib import Path

import pytest

from chapsym import proofs
from chapsym.certificates.rocq import write
from chapsym.certificates.rocq.theorem import real

LARGE = Path(proofs.__path__[0]) / "certificates" / "measure-large.json"


def has_interval():
    """Whether Rocq is here, with coq-interval."""
    if not shutil.which("coqc"):
        return False
    found = subprocess.run(["coqc", "-where"], capture_output=True, text=True, check=True).stdout.strip()
    return (Path(found) / "user-contrib" / "Interval").is_dir()


needs_interval = pytest.mark.skipif(not has_interval(), reason="coq-interval is not here: no theorem is judged")


def one_step():
    """The certificate without all but the first step of its first orbit."""
    data = json.loads(LARGE.read_text(encoding="utf-8"))
    orbit = data["orbits"][0]
    [step] = orbit["steps"] = orbit["steps"][:1]
    return data | {"steps": 1, "orbits": [orbit | {"displacement": "-0.10046052746928570908"}]}, step


def written(folder, data):
    """The text for a certificate."""
    (folder / "one-step.json").write_text(json.dumps(data), encoding="utf-8")
    write([folder / "one-step.json"], folder)
    return (folder / "one_step.v").read_text(encoding="utf-8")


def test_a_real_number_is_written_as_it_is():
    numbers = [Fraction(x) for x in ("0", "7", "-7", "1/2", "-0.046", "1e-40", "-15e-29", "22/7", "-1/3", "1234.5")]
    texts = ["0", "7", "(-7)", "0.5", "(-0.046)", "1e-40", "(-15e-29)", "(22 / 7)", "(-1 / 3)", "1234.5"]
    assert list(map(real, numbers)) == texts


def test_the_theorem_has_every_number_of_the_certificate(tmp_path):
    write([LARGE], tmp_path)
    text = (tmp_path / "measure_large.v").read_text(encoding="utf-8")
    theorem = text.partition("Theorem measure_large")[2].partition("Proof.")[0]
    data = json.loads(LARGE.read_text(encoding="utf-8"))
    steps = [step for orbit in data["orbits"] for step in orbit["steps"]]
    given = [f"rounded 5e-21 (V {' '.join(real(Fraction(x)) for x in v)})" for s in steps for v in (s["u"], s["gamma"])]
    assert re.findall(r"rounded 5e-21 \(V .*?\)(?= \([ug] \d+%nat\))", theorem) == given
    assert re.findall(r"orbit (\d+) J D h", theorem) == ["7", "7"]
    last = "sine x1 x2 (g 0%nat) (g 7%nat)"
    assert theorem.count(f"0 < {last}") == theorem.count(f"{last} < 0") == 1
    assert re.findall(r"Rabs \(sine .*? - (.*?)\) < 5e-21\)", theorem) == ["415e-20", "(-365e-20)"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """In which Rocq judges the library once."""
    return tmp_path_factory.mktemp("intervals")


def rocq(folder):
    """What Rocq says of the files."""
    return subprocess.run(["make", "-C", folder], capture_output=True, text=True)


@needs_interval
def test_rocq_accepts_a_step_and_counts_its_axioms(folder):
    written(folder, one_step()[0])
    found = rocq(folder)
    assert found.returncode == 0, found.stderr
    assert re.search(r"^axioms      of one_step: [1-9]\d*: ", found.stdout, re.MULTILINE)


@needs_interval
def test_rocq_rejects_a_digit_and_a_bound_that_are_wrong(folder):
    data, step = one_step()
    step["u"][0] = step["u"][0][:-1] + "1"  # it is a 0
    written(folder, data)
    found = rocq(folder)
    assert "by_box" in found.stderr or "Numerical evaluation failed" in found.stderr
    text = written(folder, one_step()[0])
    [radius] = re.findall(r"near (\S+) \(V [^()]*\) u /", text)
    assert radius == "19e-29"
    (folder / "one_step.v").write_text(text.replace("19e-29", "9e-29"), encoding="utf-8")
    assert rocq(folder).returncode != 0
