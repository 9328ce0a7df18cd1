"""Each script runs alone, prints its derivation and verdict, and exits non-zero when its proof fails."""

import subprocess
import sys
from pathlib import Path

import pytest

import chapsym.proofs

FOLDER = Path(chapsym.proofs.__file__).parent


def test_every_script_is_in_the_list():
    found = {path.stem for path in (*FOLDER.glob("s[2-6]_*.py"), *FOLDER.glob("open_*.py"), *FOLDER.glob("map_*.py"))}
    assert found == set(chapsym.proofs.SCRIPTS)


@pytest.mark.parametrize("name", chapsym.proofs.SCRIPTS)
def test_a_script_runs_alone(name):
    done = subprocess.run([sys.executable, FOLDER / f"{name}.py"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "verdict: " in done.stdout
    assert "control: " in done.stdout
    assert "PROBLEM" not in done.stdout


def test_a_script_whose_proof_fails_exits_1(tmp_path):
    """The intertwining relations with a sign flipped, run in a copy of the package's proofs."""
    program = (
        "import sys; from chapsym.derive import ball; honest = ball.momentum\n"
        "ball.momentum = lambda: honest() - 2 * ball.D * ball.Omega * ball.Gamma\n"
        "from chapsym.prove import main; main(sys.argv[1])"
    )
    script = FOLDER / "s4_intertwining.py"
    done = subprocess.run([sys.executable, "-c", program, script], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "verdict: OPEN" in done.stdout


def test_a_copy_of_a_script_is_not_mistaken_for_the_installed_one(tmp_path):
    copy = tmp_path / "s4_limits.py"
    copy.write_text((FOLDER / "s4_limits.py").read_text(encoding="utf-8"), encoding="utf-8")
    done = subprocess.run([sys.executable, copy], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "is not the installed chapsym.proofs.paper.s4_limits" in done.stderr
