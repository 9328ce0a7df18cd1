"""The data as a package of its own: NumPy alone, the figures of `chapsym judge`, a fixture of pytest."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from commands import answer

from benchmarks.rolling.wheel.__main__ import write

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "benchmarks/rolling/examples/mujoco-robot-1ms.csv"


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rolling") / "source"
    write(folder)
    return folder


def python(source, *words):
    """Another Python, where chapsym cannot be imported."""
    alone = source.parent / "alone"
    (alone / "chapsym").mkdir(parents=True, exist_ok=True)
    (alone / "chapsym" / "__init__.py").write_text("raise ImportError('of the package alone')\n", encoding="utf-8")
    path = os.pathsep.join(map(str, (source, alone)))
    return subprocess.run(
        [sys.executable, *map(str, words)], env={**os.environ, "PYTHONPATH": path}, cwd=alone, capture_output=True,
        text=True, check=False,
    )  # fmt: skip


def test_the_figures_are_those_of_the_command(source):
    code = f"import chapsym_rolling, json; print(json.dumps(chapsym_rolling.judge({str(EXAMPLE)!r}, 'robot')))"
    done = python(source, "-c", code)
    case = ROOT / "benchmarks/rolling/data/robot.json"
    assert json.loads(done.stdout) == answer("judge", EXAMPLE, "--against", case)["results"][0]["departure"]


def test_the_fixture_judges_the_truth_as_the_truth(source, tmp_path):
    test = tmp_path / "test_engine.py"
    test.write_text(
        "import numpy as np, pytest\n"
        "from chapsym_rolling import BadInput, judge, names\n\n"
        "def test_all(rolling_case):\n"
        "    centre = np.c_[rolling_case.path, np.full(len(rolling_case.time), rolling_case.radius)]\n"
        "    velocity = rolling_case.moving\n"
        "    run = dict(centre=centre, attitude=-rolling_case.attitude, velocity=velocity, omega=rolling_case.omega)\n"
        "    found = judge(run, rolling_case)\n"
        "    assert all(part['greatest'] < 1e-9 for part in found.values())\n"
        "    assert len(found) == (6 if rolling_case.radius else 4)\n"
        "    run['omega'] = 1.02 * rolling_case.omega\n"
        "    assert judge(run, rolling_case)['momentum']['greatest'] > 0.01\n\n"
        "@pytest.mark.parametrize('rolling_case', ['robot'], indirect=True)\n"
        "def test_one(rolling_case):\n"
        "    assert rolling_case.name == 'robot' and len(names()) == 35\n"
        "    with pytest.raises(BadInput, match='unit quaternions'):\n"
        "        judge(dict(centre=0 * rolling_case.omega, attitude=0 * rolling_case.attitude), 'robot')\n"
        "    with pytest.raises(BadInput, match='no case; those are'):\n"
        "        judge({}, 'cube')\n",
        encoding="utf-8",
    )
    done = python(source, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "chapsym_rolling.fixture", test)
    assert "36 passed" in done.stdout, done.stdout


def test_it_is_small(source):
    assert os.path.getsize(shutil.make_archive(str(source.parent / "package"), "zip", source)) < 1_000_000
