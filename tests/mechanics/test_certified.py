"""Exact verdicts as certificates: what is written the checker accepts, and what is not so gets none."""

import copy
import json
import re
import subprocess
import sys

import pytest
import sympy as sp
from commands import answer, chapsym
from sympy import cos, sin, sqrt
from systems import FREE, SYSTEMS, a, example, particle, va, vx, vy, vz, x, y, z

from chapsym import checker
from chapsym.mechanics import METHODS, System, certified
from chapsym.prove.certificates import write

OWN = ["motion", "energy", "flag", "volume"]
SPRING = """from sympy import symbols
from chapsym.mechanics import System, dot
x, y = symbols("x y")
SYSTEM = System("spring", [x, y], (dot(x) ** 2 + dot(y) ** 2 - x**2) / 2, start={x: 1, dot(y): 1})
"""


def judged(*files):
    """What the checker says without chapsym, and its exit status."""
    command = [sys.executable, "-S", "-I", SYSTEMS.parents[2] / "checker", *files]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.fixture(scope="module")
def written(made_once, tmp_path_factory):
    """The certificates of the sleigh, of a spring, which keeps a momentum, and, by a tableau, of the particle."""

    def made():
        folder, spring = tmp_path_factory.mktemp("certificates"), tmp_path_factory.mktemp("systems") / "spring.py"
        spring.write_text(SPRING, encoding="utf-8")
        said = {}
        for file, method in ((SYSTEMS / "sleigh.py", "dla"), (spring, "dla"), (SYSTEMS / "particle.py", "rk4")):
            said |= answer("lab", file, "--method", method, "--steps", 20, "--certificates", folder)["certificates"]
        return folder, said

    return made_once("certificates", made)


def test_the_checker_accepts_what_the_command_wrote(written):
    folder, said = written
    claims = {claim for one in said.values() for claim in one["claims"]}
    assert claims == {path.stem for path in folder.iterdir()}
    assert {f"chaplygin-sleigh-{name}" for name in (*OWN, "dla-returns")} <= claims
    assert {"spring-dla-order", "spring-dla-keeps-2"} <= claims
    assert {"nonholonomic-particle-rk4-order", "nonholonomic-particle-rk4-returns"} <= claims
    status, text = judged(*folder.iterdir())
    assert (status, text.count("accepted")) == (0, len(claims))
    volume = json.loads((folder / "chaplygin-sleigh-volume.json").read_text(encoding="utf-8"))
    assert volume["uses"] == ["chaplygin-sleigh-flag", "chaplygin-sleigh-motion"]


def test_a_verdict_without_a_certificate_is_named_with_the_reason(written):
    none = written[1]["Chaplygin sleigh"]["none"]
    said = "it is one of the equations, so that nothing is to be decided"
    assert none.pop(said) == ["dla: keeps the constraints"]
    assert none == {"the derivatives of a step are not written down": ["dla: keeps a smooth volume"]}


@pytest.mark.parametrize(
    "name",
    [
        *(f"chaplygin-sleigh-{x}" for x in (*OWN, "dla-order", "dla-adjoint", "dla-returns", "dla-keeps-1")),
        "nonholonomic-particle-rk4-returns",
    ],
)
def test_what_is_tampered_with_is_refused(written, name, tmp_path):
    """With the sentence and the digest of what it says now."""
    folder, _ = written
    data = json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))
    tampered = 0
    for part in ("statements", "comparisons"):
        for i, one in enumerate(data[part]):
            if one["role"] != "printed":
                continue
            wrong = copy.deepcopy(data)
            if part == "statements":
                wrong[part][i]["right"][0] = ["+", one["right"][0], 1]
            else:
                wrong[part][i]["relations"][0][0] = {"=": "!=", "!=": "="}[one["relations"][0][0]]
            wrong["statement"] = checker.statement(wrong)
            wrong["digest"] = checker.digest(wrong)
            file = tmp_path / f"{part}-{i}.json"
            file.write_text(json.dumps(wrong), encoding="utf-8")
            used = [folder / f"{claim}.json" for claim in data["uses"]]
            status, text = judged(file, *used)
            assert status == 1
            assert "rejected" in text
            tampered += 1
    assert tampered


@pytest.mark.parametrize(("verdict", "part"), [("motion", "mass"), ("motion", "push"), ("energy", "energy")])
def test_what_is_not_so_has_no_certificate(verdict, part):
    """A wrong equation of the lab is no equation of the Lagrangian."""
    system = System("bead", (x, y), vx**2 + vy**2 - x**2, [vy - x * vx])
    assert all(one.certificate for one in certified(system))
    wrong = System("bead", (x, y), vx**2 + vy**2 - x**2, [vy - x * vx])
    wrong.__dict__[part] = getattr(system, part) + {"mass": sp.ones(2, 2), "push": sp.ones(2, 1)}.get(part, 1) * x
    found = {one.verdict: one for one in certified(wrong)}
    assert found[verdict].certificate is None
    assert "not proved" in found[verdict].why


SMALL = {
    "affine, a function of time": System("belt", (x, y), vx**2 + vy**2, [vy - x * vx - 1]),
    "integrable": System("pulled", (x, y), vx**2 + vy**2, [x * vx + y * vy]),
    "dependent constraints": System("twice", (x, y, z), FREE, [vz - y * vx, 2 * vz - 2 * y * vx]),
    "no constraint, a force": System("damped", (x,), vx**2 / 2, forces={x: -vx}),
    "a place on a circle": System("ring", (x, y), vx**2 + vy**2 - y, holonomic=[x**2 + y**2 - 1]),
    "a root": System("bent", (x, y, z), FREE, [vz - sqrt(1 + y**2) * vx]),
    "a turned edge": System("edge", (x, y, a), vx**2 + vy**2 + va**2 - cos(a), [sin(a) * vx - cos(a) * vy]),
}


@pytest.mark.parametrize("what", SMALL)
def test_systems_of_each_kind(what):
    found = {one.verdict: one for one in certified(SMALL[what])}
    for verdict in ("motion", "energy", "flag"):
        assert found[verdict].certificate, found[verdict].why
        checker.check(dict(found[verdict].certificate))


def test_an_integral_is_kept_or_changes_at_a_state():
    system = particle(integrals={"kept": (1 + y**2) * vx**2, "lost": vx})
    found = {one.verdict: one.certificate for one in certified(system)}
    assert [one["text"] for one in found["kept"]["statements"] if one["role"] == "printed"] == [
        "the rate of kept is what the equations set to 0"
    ]
    (lost,) = found["lost"]["comparisons"]
    assert lost["relations"][-1][0] == "!="
    assert found["kept"]["uses"] == found["lost"]["uses"] == ["particle-motion"]


@pytest.mark.parametrize(("name", "power"), [("chaplygin-sleigh-dla", 3), ("nonholonomic-particle-rk4", 5)])
def test_a_quantity_that_changes_is_shown_by_the_power_that_the_lab_says(written, name, power):
    found = json.loads((written[0] / f"{name}-keeps-1.json").read_text(encoding="utf-8"))
    (printed,) = [one for one in found["statements"] if one["role"] == "printed"]
    least = min(int(k) for k in re.findall(r"'step_length', (\d+)", str(printed["right"])))
    assert least == power


def test_two_systems_need_two_names(tmp_path):
    for name in ("one", "two"):
        text = f"x = symbols('x')\nSYSTEM = System('a name of many letters {name}', [x], dot(x) ** 2 / 2)\n"
        head = "from sympy import symbols\nfrom chapsym.mechanics import System, dot\n"
        (tmp_path / f"{name}.py").write_text(head + text, encoding="utf-8")
    done = chapsym("lab", tmp_path, "--method", "dla", "--steps", 5, "--certificates", tmp_path / "out")
    assert done.returncode == 2
    assert "certificates of one name" in done.stderr


#: Why exact verdicts of the documentation's systems have no certificate.
WITHOUT = {
    "it is one of the equations, so that nothing is to be decided",
    "the checker does not accept its certificate: the certificate has more than 1000000 letters",
    "the derivatives of a step are not written down",
    "the equations of a step divide by series",
    "it has more parts than a quantity whose factors are looked for",
}


#: How many certificates each system of the documentation has.
COUNTS = {
    "ball": 40, "contact": 32, "falling_disc": 29, "particle": 32, "rattleback": 20, "sleigh": 31, "snakeboard": 43,
    "suslov": 21, "transmission": 32, "veselova": 26, "vertical_disc": 36,
}  # fmt: skip


@pytest.mark.parametrize("name", COUNTS)
@pytest.mark.thorough  # what the command wrote of two systems is accepted above
def test_the_checker_accepts_all_of_each_system(name, tmp_path):
    """By every method, without chapsym; on the contact oscillator all but the midpoint rule end elsewhere."""
    assert sorted(COUNTS) == sorted(path.stem for path in SYSTEMS.glob("*.py"))
    system, elsewhere = example(name), set()
    methods = [method for method in METHODS if method != "own" or system.discrete]
    for one in certified(system, methods):
        if one.certificate is None:
            assert one.why in WITHOUT, one.verdict
            continue
        write(dict(one.certificate), tmp_path)
        if any("end elsewhere" in part["text"] for part in one.certificate["statements"]):
            elsewhere.add(one.verdict)
    status, text = judged(*tmp_path.iterdir())
    assert (status, text.count("accepted"), len([*tmp_path.iterdir()])) == (0, COUNTS[name], COUNTS[name])
    if name == "contact":
        assert {one for one in elsewhere if one.endswith("reversible")} == {
            f"{method}: reversible" for method in methods if method != "midpoint"
        }
