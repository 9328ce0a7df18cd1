"""Old names work, and warn."""

import subprocess
import sys

import pytest
from commands import chapsym as command

import chapsym
import chapsym.numbers
from chapsym.renamed import Renamed

STEP = ["--mass-tensor", "1,2,4", "--D", "3", "--momentum", "1,-1/2,3/4", "--gamma", "2/7,3/7,6/7"]


def test_the_old_name_of_an_enclosure():
    with pytest.warns(Renamed, match=r"chapsym\.numbers\.Ball is now chapsym\.numbers\.Enclosure"):
        assert chapsym.numbers.Ball is chapsym.Enclosure
    with pytest.raises(AttributeError, match="no attribute 'Bell'"):
        _ = chapsym.numbers.Bell


OLD_SCENE = (
    "[ball]\nmass_tensor = [1, 2, 4]\nD = 3\n[start]\nmomentum = [1, -0.5, 0.75]\ngamma = [0, 0, 1]\n"
    '[run]\nsteps = 2\nprecision = "quad"\n'
)


USES = (
    'chapsym.step(BALL, (1, -0.5, 0.75), (0, 0, 1), precision="quad")',
    'chapsym.trajectory(BALL, (1, -0.5, 0.75), (0, 0, 1), 3, precision="quad")',
    'chapsym.roll(BALL, (1, 2, 3), 0.01, 3, precision="quad")',
    'chapsym.run_scene("old.toml")',
    "from chapsym.numbers import Ball",
    "chapsym.numbers.Ball",
)


def test_an_old_name_is_told_at_the_line_that_uses_it(tmp_path):
    (tmp_path / "old.toml").write_text(OLD_SCENE)
    script = tmp_path / "script.py"
    script.write_text("\n".join(["import chapsym, chapsym.numbers", "BALL = chapsym.Ball((1, 2, 4), 3)", *USES]))
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, cwd=tmp_path, check=True)
    told = [line for line in done.stderr.splitlines() if ": Renamed: " in line]
    assert [line.partition(": Renamed: ")[0] for line in told] == [f"{script}:{3 + i}" for i in range(len(USES))]
    assert all(line.endswith("the old name works until the next release") for line in told)


def test_old_options_are_told_in_a_line_and_answer_the_same():
    given = ["step", *STEP, "--json"]
    new = command(*given, "--precision", "single")
    assert (new.returncode, new.stderr) == (0, "")
    for old in (["--rung", "single"], ["--rung=single"]):
        done = command(*given, *old)
        assert (done.returncode, done.stdout) == (0, new.stdout)
        assert done.stderr == "chapsym: --rung is now --precision; the old name works until the next release\n"
    assert "--rung" not in command("step", "--help").stdout


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("no-invariant-measure", "--height", "--vertical-momentum"),
        ("periodic-orbit", "--momentum-gamma", "--vertical-momentum"),
        ("periodic-orbit", "--momentum-momentum", "--k-squared"),
    ],
)
def test_old_options_of_certificates(name, old, new):
    done = command("certify", name, old, "x")
    assert done.returncode == 2
    told, error = done.stderr.splitlines()
    assert told.startswith(f"chapsym: {old} is now {new};")
    assert error.startswith(f"chapsym: {new}: 'x' is not a number")


def test_quad_is_double_double():
    ball, K, gamma = chapsym.Ball((1, 2, 4), 3), (1, -0.5, 0.75), (0, 0, 1)
    with pytest.warns(Renamed, match='precision "quad" is now "double-double"') as told:
        old = chapsym.step(ball, K, gamma, precision="quad")
    new = chapsym.step(ball, K, gamma, precision="double-double")
    assert (old.write(), old.precision) == (new.write(), new.precision)
    assert len(told) == 1
    assert chapsym.step(ball, K, gamma, precision="double-double").precision == chapsym.numbers.DoubleDouble()


def test_quad_on_the_command_line():
    new = command("step", *STEP, "--json", "--precision", "double-double")
    old = command("step", *STEP, "--json", "--precision", "quad")
    assert (new.stderr, new.stdout) == ("", old.stdout)
    assert old.stderr == 'chapsym: precision "quad" is now "double-double"; the old name works until the next release\n'


def test_quad_in_a_scene(tmp_path):
    scene = tmp_path / "old.toml"
    scene.write_text(OLD_SCENE)
    done = command("run", scene, "-o", tmp_path / "old.npz", "--json")
    assert done.returncode == 0, done.stderr
    assert (
        'chapsym: precision "quad" is now "double-double"; the old name works until the next release\n' in done.stderr
    )
