"""Each script prints its derivations and verdicts, and exits non-zero when a proof fails."""

import subprocess
import sys
from pathlib import Path

import pytest

import chapsym.proofs
from chapsym.derive import ball
from chapsym.prove import main, runner

FOLDER = Path(chapsym.proofs.__file__).parent
LAST_LINES = 'if __name__ == "__main__":\n    main(__file__)\n'


def path_of(name):
    return FOLDER.joinpath(*name.split(".")).with_suffix(".py")


def printed_by(script, capsys):
    """The exit status of a script's claims, and what they print."""
    with pytest.raises(SystemExit) as ended:
        main(str(script))
    return ended.value.code, capsys.readouterr().out


def test_every_script_is_in_the_list_and_runs_its_claims():
    found = {
        f"{path.parent.name}.{path.stem}": path.read_text(encoding="utf-8")
        for folder in ("paper", "map", "open")
        for path in (FOLDER / folder).glob("[!_]*.py")
    }
    assert {name for name, text in found.items() if text.endswith(LAST_LINES)} == set(chapsym.proofs.SCRIPTS)
    assert {name for name, text in found.items() if "@claim(" in text} == set(chapsym.proofs.SCRIPTS)


@pytest.mark.parametrize("name", chapsym.proofs.SCRIPTS)
def test_a_script_prints_its_verdicts(name, records, lemmas, monkeypatch, capsys):
    """What `python proofs/...` does, with the records of this test run in the place of proving all again."""
    monkeypatch.setattr(runner, "prove_one", {**records, **lemmas}.__getitem__)
    status, said = printed_by(path_of(name), capsys)
    assert status == 0, said
    assert "verdict: " in said
    assert "control: " in said
    assert "PROBLEM" not in said


def test_a_script_runs_alone():
    script = path_of("paper.s4_limits")
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "verdict: HOLDS" in done.stdout
    assert "control: " in done.stdout


def test_a_script_whose_proof_fails_exits_1(monkeypatch, capsys):
    """The intertwining relations with a sign flipped."""
    honest = ball.momentum
    monkeypatch.setattr(ball, "momentum", lambda: honest() - 2 * ball.D * ball.Omega * ball.Gamma)
    status, said = printed_by(path_of("paper.s4_intertwining"), capsys)
    assert status == 1
    assert "verdict: OPEN" in said


def test_a_copy_of_a_script_is_not_mistaken_for_the_installed_one(tmp_path):
    copy = tmp_path / "s4_limits.py"
    copy.write_text(path_of("paper.s4_limits").read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(SystemExit, match=r"is not an installed proof of chapsym; install this checkout first"):
        main(str(copy))
