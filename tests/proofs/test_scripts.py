"""Each script prints its derivations and verdicts, and exits non-zero when a proof fails."""

import subprocess
import sys
from pathlib import Path

import pytest

import chapsym.proofs
from chapsym.derive import ball
from chapsym.prove import claims, load, main, runner

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
    monkeypatch.setattr(runner, "prove_one", lambda id, *_: {**records, **lemmas}[id])
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


@pytest.fixture
def forgotten(monkeypatch):
    """Claims that a test registers are those of the test only."""
    load(lemmas=True)
    monkeypatch.setattr(claims, "_REGISTER", claims.register())
    monkeypatch.setattr(sys, "modules", sys.modules.copy())


OWN = '''
import sympy as sp
from chapsym.derive.quotient import Quotient
from chapsym.prove import claim, equations, main

x, y = sp.symbols("x y")
equal = equations(Quotient((x, y)))

@claim("my-1", "x^2 - y^2 = (x - y)(x + y)", uses=("5.2",))
def squares(p):
    """A difference of squares."""
    p.printed(equal("x² - y² = (x - y)(x + y)", x**2 - y**2, (x - y) * (x + y)))
    p.control(equal("the same with x² + y²", x**2 + y**2, (x - y) * (x + y)))

if __name__ == "__main__":
    main(__file__)
'''


@pytest.mark.parametrize(("right", "status", "verdict"), [("(x - y)", 0, "HOLDS"), ("(x - 2*y)", 1, "OPEN")])
def test_a_script_of_ones_own_is_judged_anywhere(right, status, verdict, forgotten, tmp_path, capsys):
    script = tmp_path / "mine.py"
    script.write_text(OWN.replace("(x - y) *", f"{right} *"), encoding="utf-8")
    found, said = printed_by(script, capsys)
    assert (found, said.count("[my-1]")) == (status, 1)
    assert f"verdict: {verdict}" in said


def test_what_is_wrong_with_a_script_of_ones_own_is_a_sentence(forgotten, tmp_path):
    script = tmp_path / "mine.py"
    script.write_text(OWN.replace("@claim", "#"), encoding="utf-8")
    with pytest.raises(SystemExit, match=r"has no claim: write @claim"):
        main(str(script))


def test_a_copy_of_a_script_is_not_mistaken_for_the_installed_one(forgotten, tmp_path):
    copy = tmp_path / "s4_limits.py"
    copy.write_text(path_of("paper.s4_limits").read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(SystemExit, match=r"or install this checkout first"):
        main(str(copy))
