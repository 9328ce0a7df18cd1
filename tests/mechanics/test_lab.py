"""chapsym lab: JSON that is gone on with, and the page; the table is that of docs/how-to/mechanics.md."""

import json
import math
import os
import shutil
from itertools import pairwise
from pathlib import Path

import pytest
from commands import answer, chapsym, refused
from systems import SYSTEMS

import chapsym as chapsym_package
from chapsym import mechanics, sources

FILE = SYSTEMS / "particle.py"


@pytest.fixture
def spring(tmp_path):
    """A system of one coordinate, of which all verdicts are had at once."""
    file = tmp_path / "spring.py"
    head = "from sympy import symbols\nfrom chapsym.mechanics import System, dot\n(x,) = symbols('x,')\n"
    text = f"{head}SYSTEM = System('spring', [x], (dot(x) ** 2 - x**2) / 2, start={{x: 1}})\n"
    file.write_text(text, encoding="utf-8")
    return file


def test_exact_verdicts_are_in_json_and_on_the_page(tmp_path):
    out = tmp_path / "lab.html"
    done = chapsym("lab", SYSTEMS / "contact.py", "--method", "gni", "--steps", 20, "-o", out, "--json")
    (cell,) = json.loads(done.stdout)["cells"]
    assert cell["verdicts"]["order"] == {"verdict": "proved", "said": "2", "point": {}}
    wrong = cell["verdicts"]["reversible"]
    assert wrong["verdict"] == "false"
    assert set(wrong["point"]) == {"x", "y", "z", "x_dot", "y_dot", "z_dot"}
    page = out.read_text(encoding="utf-8")
    assert f"<li>gni: reversible: false {wrong['said']} from x = 4/3" in page
    assert "prefers-color-scheme: dark" in page


def test_json_is_gone_on_with(tmp_path, spring):
    out = tmp_path / "lab.json"
    options = ["--steps", 300, "-o", out, "--json", spring]
    first = answer("lab", "--method", "dla", *options)
    assert [cell["method"] for cell in first["cells"]] == ["dla"]
    data = json.loads(out.read_text(encoding="utf-8"))
    data["cells"][0]["drift"] = 12.5  # is not measured again
    out.write_text(json.dumps(data), encoding="utf-8")
    second = answer("lab", "--method", "dla", "--method", "gni", *options)
    assert [(cell["method"], cell["drift"] == 12.5) for cell in second["cells"]] == [("dla", True), ("gni", False)]
    changed = tmp_path / "changed.py"
    changed.write_text(spring.read_text(encoding="utf-8").replace("x: 1", "x: 2"), encoding="utf-8")
    third = answer("lab", "--method", "dla", *options[:-1], changed)
    assert third["cells"][-1]["drift"] != 12.5
    assert len(json.loads(out.read_text(encoding="utf-8"))["cells"]) == 3
    keys = {cell["key"] for cell in json.loads(out.read_text(encoding="utf-8"))["cells"]}
    system, code = mechanics.loaded(spring), sources.whole(Path(chapsym_package.__path__[0]))
    assert system.digest(None, False, code) in keys  # what other code measured is measured again
    cell = data["cells"][0]
    for odd in (
        {"key": "a", "method": "dla", "steps": 10}, cell | {"verdicts": []},
        cell | {"verdicts": {"order": {"verdict": "x"}}}, cell | {"drift": "x"}, cell | {"curve": [[0, 10**400]]},
    ):  # fmt: skip
        out.write_text(json.dumps({"cells": [odd]}), encoding="utf-8")
        assert "is not what chapsym lab has written" in refused("lab", "--method", "dla", *options)
    out.unlink()
    os.mkfifo(out)  # which would be waited for
    assert "it is a device or a pipe, not a file" in refused("lab", "--method", "dla", *options)


def test_two_commands_at_once_both_keep_their_cells(tmp_path, monkeypatch, spring):
    out, real = tmp_path / "lab.json", mechanics.measured
    words = "lab", spring, "--steps", 20, "--no-flags", "-o", out, "--method"

    def measured(*how):
        monkeypatch.undo()
        answer(*words, "gni")
        return real(*how)

    monkeypatch.setattr(mechanics, "measured", measured)
    assert [cell["method"] for cell in answer(*words, "dla")["cells"]] == ["dla"]
    assert [cell["method"] for cell in json.loads(out.read_text(encoding="utf-8"))["cells"]] == ["gni", "dla"]


def test_the_error_falls_with_work_by_the_order():
    """Each halving of the step costs twice as much and has a quarter of the error, or a sixteenth."""
    cells = answer("lab", FILE, "--method", "dla", "--method", "rk4", "--steps", 300, "--no-flags")["cells"]
    for cell, order in zip(cells, (2, 4), strict=True):
        for (work, error), (more, less) in pairwise(cell["work"]):
            assert more == pytest.approx(2 * work)
            assert order - 0.3 < math.log2(error / less) < order + 0.3


def test_no_drift_falls_to_none():
    done = chapsym("lab", FILE, "--method", "dla", "--steps", 1, "--halve", "--no-flags")
    assert done.stdout.endswith("with half the step: +0.0e+00\n")


def test_two_processes_say_the_same_and_what_a_file_prints_is_no_output(spring):
    """But for the time."""
    spring.write_text(f"{spring.read_text(encoding='utf-8')}print('of the file')\n", encoding="utf-8")
    words = "lab", spring, "--method", "dla", "--method", "gni", "--steps", 20, "--json", "--jobs"
    done = [chapsym(*words, jobs) for jobs in (1, 2)]
    assert all(set(each.stderr.splitlines()) == {"of the file"} for each in done)
    one, two = (json.loads(each.stdout) for each in done)
    for cell in (*one["cells"], *two["cells"]):
        cell["work"] = [error for _, error in cell["work"]]
        assert cell.pop("microseconds") > 0
    assert one == two


def test_verdicts_that_were_not_asked_for_are_added_and_other_lengths_of_a_step_are_not_mixed(tmp_path, spring):
    out = tmp_path / "lab.json"
    words = "lab", spring, "--method", "dla", "--steps", 20, "-o", out
    assert answer(*words, "--no-flags")["cells"][0]["verdicts"] == {}
    assert answer(*words)["cells"][0]["verdicts"]["self-adjoint"]["verdict"] == "proved"
    assert len(json.loads(out.read_text(encoding="utf-8"))["cells"]) == 1
    assert answer(*words, "--no-flags")["cells"][0]["verdicts"] != {}
    assert [cell["length"] for cell in answer(*words, "--length", 0.05)["cells"]] == [0.05]
    assert len(json.loads(out.read_text(encoding="utf-8"))["cells"]) == 2


def test_a_quantity_that_is_not_defined_is_one_sentence(tmp_path):
    text = FILE.read_text(encoding="utf-8").replace("coordinates=", "integrals={'r': sqrt(x - 100)}, coordinates=")
    (tmp_path / "root.py").write_text(text.replace("import sym", "import sqrt, sym"), encoding="utf-8")
    few = "--method", "dla", "--steps", 20, "--no-flags"
    done = chapsym("lab", tmp_path / "root.py", *few, "-o", tmp_path / "x.json")
    assert "dla: a quantity is not defined on the motion" in done.stdout
    assert json.loads((tmp_path / "x.json").read_text(encoding="utf-8"))["cells"][0]["energy"] is None


def test_a_page_with_a_curve_for_each_method(tmp_path, spring):
    folder, out = tmp_path / "systems", tmp_path / "lab.html"
    folder.mkdir()
    shutil.copy(SYSTEMS / "particle.py", folder)
    rest = spring.read_text(encoding="utf-8").replace(" - x**2", "").replace("x: 1", "x: 0")
    (folder / "rest.py").write_text(rest, encoding="utf-8")
    methods = [word for name in ("dla", "gni") for word in ("--method", name)]
    done = chapsym("lab", folder, "--steps", 200, "-o", out, *methods)
    assert (done.returncode, done.stderr) == (0, f"chapsym: wrote {out}\n")  # no warning of what does not change
    text = out.read_text(encoding="utf-8")
    assert text.count("<svg") == 2
    assert text.count("<tr>") == 2 * 3
    assert "geometric nonholonomic integrator" in text
    assert "completely nonholonomic" in text
    assert "http" not in text.replace("http://www.w3.org", "").replace("http://purl.org", "").replace(
        "http://creativecommons.org", ""
    )


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("x = 1", [], "has no SYSTEM = System(...)"),
        ("x = 1/0", [], "cannot be run: ZeroDivisionError: division by zero"),
        ("from chapsym.mechanics import System\nSYSTEM = System('s', (), 0)", [], "s: coordinates must be symbols"),
        ("x = 1", ["--method", "euler"], "'euler' is no method; those are dla, own, dla-left, gni, leapfrog"),
        ("x = 1", ["-o", "lab.txt"], "lab.txt must end in .json or .html"),
        (FILE.read_text(encoding="utf-8"), ["--length", "0"], "the length of a step must be positive, not 0.0"),
        ("x = 1", ["-o", "none/lab.html"], "the folder none does not exist"),  # before anything is measured
    ],
)
def test_what_is_no_system_is_one_sentence(tmp_path, text, options, said):
    file = tmp_path / "system.py"
    file.write_text(text, encoding="utf-8")
    assert said in refused("lab", file, *options, "--certificates", tmp_path / "made")
    assert not (tmp_path / "made").exists()


def test_what_is_no_file_is_one_sentence(tmp_path):
    assert "has no file of a system" in refused("lab", tmp_path)
    for name in ("none.py", "none.txt"):
        assert "is no file of a system" in refused("lab", tmp_path / name)


def test_two_systems_of_one_name_and_a_start_off_the_constraints_are_one_sentence(tmp_path):
    text = FILE.read_text(encoding="utf-8")
    (tmp_path / "other.py").write_text(text, encoding="utf-8")
    off = text.replace("vy:", "vz: 3, vy:").replace("holonomic par", "par")
    (tmp_path / "off.py").write_text(off, encoding="utf-8")
    done = chapsym("lab", tmp_path / "off.py", FILE, "--method", "dla", "--steps", 10, "--no-flags")
    assert "off the constraints; leave out those" in done.stderr
    assert (done.returncode, done.stderr.count("\n"), done.stdout.count("\n")) == (2, 1, 3)  # the other is measured
    done = chapsym("lab", FILE, tmp_path / "other.py", "--method", "dla", "--steps", 10, "--no-flags")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "two systems are called nonholonomic particle" in done.stderr


def test_what_is_not_decided_is_said_and_the_rest_measured(tmp_path):
    text = FILE.read_text(encoding="utf-8").replace("vz - y * vx", "vz - y * vx * cos(1)")
    (tmp_path / "odd.py").write_text(text.replace("import sym", "import cos, sym"), encoding="utf-8")
    done = chapsym("lab", tmp_path / "odd.py", "--method", "dla", "--steps", 10)
    assert "not decided (exact verdicts need sin and cos of coordinates, which 1 is not: make it one)" in done.stdout
    assert "proved 0" in done.stdout
