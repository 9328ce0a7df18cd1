"""Certificates that the reduced map leaves no measure invariant: found, true in the whole box, and refused."""

import json
from fractions import Fraction

import pytest
from budget import slow
from certificate_changes import committed
from commands import answer, chapsym, refused
from flint import ctx

from chapsym import checker
from chapsym.certificates import document, measure, plateau, resonance
from chapsym.certificates.measure import no_invariant_measure
from chapsym.certificates.reduced import Reduced, Top
from chapsym.cli import certify
from chapsym.dynamics import BadInput

SIMPLEST = {"J": "1,2,4", "D": "1", "height": "12/5"}
LEVEL = Fraction("0.24300095290638263550532672206")

#: The certificates that are committed: the arguments that find them.
COMMITTED = {
    "measure-simplest": (SIMPLEST, {}),
    "measure-real-ball": ({"J": "1,2,8", "D": "12", "height": "12/5"}, {}),
    "measure-large": ({"J": "1,4,8", "D": "1/2", "height": "22/5"}, {}),
}
#: With a branch, at heights above the least moment: it takes longer to find their radii.
BEYOND = {
    "measure-beyond-bound": ({"J": "1,2,10", "D": "14", "height": "8"}, {}),
    "measure-even": ({"J": "1,2,10", "D": "1", "height": "10"}, {"steps": 8}),
}


def top(J="1,2,4", D="1", height="12/5"):
    return Top(tuple(map(Fraction, J.split(","))), Fraction(D), Fraction(height))


def displacements(found):
    return [Fraction(orbit["displacement"]) for orbit in found["orbits"]]


#: The command finds the simplest one.
@pytest.mark.parametrize("name", ["measure-real-ball", *slow("measure-large")])
def test_the_committed_certificates_are_what_is_found(name, capsys):
    ball, arguments = COMMITTED[name]
    found = no_invariant_measure(top(**ball), **arguments)
    assert found == committed(name)
    first, second = displacements(found)
    assert first * second < 0
    assert Fraction(found["radius"]) > 0
    certify._deliver(None, False, 600.0, lambda **known: found)
    assert capsys.readouterr().out.startswith(f"Proved: {found['statement']}\n  displacements: ")
    assert found["digest"] == checker.digest(found)


@pytest.mark.thorough
@pytest.mark.parametrize("name", BEYOND)
def test_the_committed_certificates_beyond_the_bound_are_what_is_found(name):
    ball, arguments = BEYOND[name]
    assert no_invariant_measure(top(**ball), **arguments) == committed(name)


def test_beyond_the_bound_a_branch_is_proved_too(monkeypatch):
    ball, arguments = BEYOND["measure-even"]
    right = committed("measure-even")
    known = {"level": Fraction(right["ball"]["level"]), "radius": Fraction(right["radius"])}
    with monkeypatch.context() as at_once:  # the checker proves it at the end
        at_once.setattr(measure, "FEWEST_ARCS", right["branch"]["arcs"])
        at_once.setattr(measure, "branch_of", lambda *of: None)
        assert no_invariant_measure(top(**ball), **arguments, **known) == right
    monkeypatch.setattr(measure, "MOST_ARCS", 64)
    with pytest.raises(
        BadInput, match="not proved over the whole circle with 64 arcs: the branch is not proved to have one root"
    ):
        no_invariant_measure(top(**ball), **arguments, **known)


@pytest.mark.parametrize("name", ["measure-real-ball", "measure-beyond-bound", "heteroclinic-real-ball"])
def test_the_real_ball_is_one(name):
    """J1 + J2 + J3 = ∫r² dm is at most mρ² = D, in the whole box."""
    found = committed(name)
    J, D, off = found["ball"]["J"], found["ball"]["D"], Fraction(found["radius"])
    assert sum(Fraction(x) + off for x in J) < Fraction(D) - off


def test_secants_find_the_end_of_a_plateau_and_stop_where_there_is_none():
    """Two levels whose displacements are the same to the last bit have no secant."""
    near = LEVEL - Fraction(1, 10**6), LEVEL + Fraction(1, 10**6)
    with ctx.workprec(128):
        found = plateau.end_of_plateau(Reduced(top()), near, (0, 1, 2), Fraction(1), 9, 128)
        assert abs(found - LEVEL) < Fraction(1, 10**28)  # the plateau is 4e-29 wide
        same = LEVEL, LEVEL + Fraction(1, 2**200)
        assert plateau.end_of_plateau(Reduced(top()), same, (0, 1, 2), Fraction(1), 9, 128) == same[1]


@pytest.mark.thorough  # the first axis is found by all others
def test_circles_around_the_axis_of_the_largest_moment():
    """Where those around the other axis have the larger displacement, only a level says that these are meant."""
    around = plateau.staircases(top(), 23, lambda what: None)[1]
    assert around.axes == (2, 1, 0)
    ends = plateau.refined(top(), around.between(23, 1), around.axes, 23, 1)
    level = resonance._middle(top(), ends, around.axes, 23, ("a", "b"), lambda what: None)
    found = no_invariant_measure(top(), level=level, steps=23)
    assert found["axes"] == [3, 2, 1]
    assert displacements(found)[0] * displacements(found)[1] < 0
    assert no_invariant_measure(top(), steps=23)["axes"] == [1, 2, 3]


def test_circles_next_to_the_separatrix_are_not_looked_at(monkeypatch):
    monkeypatch.setattr(plateau, "REACH", 0.1)
    with pytest.raises(BadInput, match="too near the separatrix"):
        no_invariant_measure(top(), steps=25)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_level_outside_of_the_plateau_is_refused(side):
    """The plateau is 4e-29 wide, and the level in its middle half."""
    with pytest.raises(BadInput, match=r"both displacements are (positive|negative): the level is outside"):
        no_invariant_measure(top(), level=LEVEL + side * Fraction(1, 10**26), steps=9)
    inside = no_invariant_measure(top(), level=LEVEL + side * Fraction(1, 10**31), steps=9)
    assert displacements(inside)[0] > 0 > displacements(inside)[1]


@pytest.mark.thorough
def test_without_contact_both_displacements_are_one_number():
    """The control: D = 0 is refused; towards it the displacement goes to 0 as D²."""
    with pytest.raises(BadInput, match="for D = 0 there is nothing to find"):
        no_invariant_measure(top(D="0"))
    wide, narrow = (no_invariant_measure(top(D=x), radius=Fraction(0)) for x in ("1e-10", "1e-20"))
    spread = [abs(x - y) for x, y in map(displacements, (wide, narrow))]
    assert abs(spread[0] / spread[1] / 10**20 - 1) < 0.01  # k' is nearly 1: δ_a/k' - δ_b is the same all over a plateau


@pytest.mark.parametrize(
    ("ball", "arguments", "sentence"),
    [
        ({"J": "1,1,4"}, {}, "must differ"),
        ({"J": "1,1.5,1e300"}, {}, "the moments of inertia are too far apart for the search"),
        ({"J": "-1,2,4"}, {}, "entries J ≥ 0"),
        ({"J": "0,0,4"}, {}, "at most one is 0"),
        ({"D": "-1"}, {}, "must not be negative"),
        ({"height": "0"}, {}, "moves nothing"),
        ({"height": "300"}, {}, "beyond the bound of lemma small-branch"),
        ({"height": "300"}, {"level": LEVEL, "steps": 9}, "beyond the bound of lemma small-branch"),
        ({"height": "1/100"}, {}, "at most about"),
        ({}, {"steps": 5}, "no circle has 1 half turn in 5 steps"),
        ({}, {"steps": 1001}, "from 3 to 1000"),
        ({}, {"steps": 2}, "from 3 to 1000"),
        ({}, {"steps": 9, "half_turns": 3}, "common factor"),
        ({}, {"half_turns": 0}, "at least 1"),
        ({}, {"digits": 20}, "take 31 or more"),
        ({}, {"digits": 3000}, "from 1 to 2000"),
        ({}, {"radius": Fraction(-1)}, "must not be negative"),
        ({}, {"radius": Fraction(1, 10**30)}, "take a smaller radius"),
        ({"J": "0,1,3"}, {"radius": Fraction(1, 10**60)}, "may be negative"),
        ({}, {"level": Fraction(1, 2), "steps": 9}, "the levels of circles are between"),
        ({}, {"level": Fraction(1, 6), "steps": 9}, "the levels of circles are between"),
        ({}, {"level": LEVEL}, "--steps"),
        ({}, {"level": LEVEL, "steps": 13}, "half turns, not by a whole number"),
        ({}, {"level": LEVEL, "steps": 9, "half_turns": 2}, "not by 2"),
    ],
)
def test_what_has_no_certificate_is_one_sentence(ball, arguments, sentence):
    with pytest.raises(BadInput, match=sentence) as refused:
        no_invariant_measure(top(**ball), **arguments)
    assert "\n" not in str(refused.value)


def test_a_displacement_that_is_too_small_is_not_looked_for_forever(monkeypatch):
    monkeypatch.setattr(resonance, "MOST_DIGITS", 100)
    with pytest.raises(BadInput, match="100 digits do not distinguish the displacement"):
        no_invariant_measure(top(D="1e-90"), steps=9)


def test_the_command_writes_what_it_prints_or_refuses_with_one_sentence(tmp_path):
    file = tmp_path / "found.json"
    found = answer("certify", "no-invariant-measure", "-o", file)
    assert found == json.loads(file.read_text(encoding="utf-8")) == committed("measure-simplest")
    assert file.read_text(encoding="utf-8") == document.text(committed("measure-simplest"))
    assert refused("certify", "no-invariant-measure", "--mass-tensor", "1,2,4", "--D", "0").startswith("for D = 0")


def test_the_command_has_the_checker_judge(tmp_path, capfd):
    file = tmp_path / "changed.json"
    found = committed("measure-large")
    good = tmp_path / "good.json"
    document.write(good, found)
    assert chapsym("certify", "check", good).returncode == 0
    assert capfd.readouterr().err == ""
    found["orbits"][0]["displacement"] = found["orbits"][0]["displacement"].replace("415", "416")
    document.write(file, {**found, "digest": checker.digest(found)})
    assert chapsym("certify", "check", good, file).returncode == 1
    assert "rejected" in capfd.readouterr().err
    assert chapsym("certify", "check", str(tmp_path / "nowhere.json")).returncode == 2
    for given in (["./-dash"], ["--manifest", "./-dash"]):
        chapsym("certify", "check", *given)
        assert "-dash: unreadable: -dash cannot be read: No such file" in capfd.readouterr().err


def test_a_certificate_needs_opposite_signs(monkeypatch):
    real = measure._orbits
    assert no_invariant_measure(top(), level=LEVEL, steps=9, radius=Fraction(0))
    monkeypatch.setattr(measure, "_orbits", lambda top, at: [real(top, at)[0]] * 2)
    with pytest.raises(BadInput, match="both displacements are positive"):
        no_invariant_measure(top(), level=LEVEL, steps=9, radius=Fraction(0))
    monkeypatch.setattr(measure, "_least_digits", lambda top, at: 31)
    with pytest.raises(BadInput, match="take a smaller radius"):
        no_invariant_measure(top(), level=LEVEL, steps=9, radius=Fraction(0))
