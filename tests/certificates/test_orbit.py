"""Certificates of periodic orbits of the whole map: found, proved, and refused."""

from fractions import Fraction
from unittest.mock import Mock

import numpy as np
import pytest
from budget import slow
from certificate_changes import committed
from flint import arb, arb_mat, ctx

from chapsym import checker
from chapsym.certificates import document, families, orbit
from chapsym.certificates.balls import NotProved, rounded, shortest
from chapsym.certificates.passage import Level, Map, Passage, identity
from chapsym.dynamics import BadInput
from chapsym.dynamics.errors import TooWide
from chapsym.dynamics.levels.balls import exact

COMMITTED = ("periodic-orbit-simplest", "periodic-orbit-attracting", "periodic-orbit-real-ball")
#: The resonance of the simplest certificate: 10 steps up to the rotation by π about e₃.
NEAR = Level((Fraction(1), Fraction(2), Fraction(4)), Fraction(2), Fraction(15, 2), Fraction(0))


@pytest.fixture(autouse=True)
def precision():
    with ctx.workprec(256):
        yield


def level_of(data):
    sizes = (data["integrals"][name] for name in ("momentum.momentum", "momentum.gamma"))
    return Level(tuple(map(Fraction, data["ball"]["J"])), Fraction(data["ball"]["D"]), *map(Fraction, sizes))


def member_of(data):
    momentum, gamma = ([exact(Fraction(x)) for x in data["start"][name]] for name in ("momentum", "gamma"))
    return families.Member(None, momentum, gamma)


@pytest.fixture(scope="module")
def family():
    """A family of 20 steps to all bits, of few members: the arc on which <momentum, gamma> grows by 1e-10."""
    with ctx.workprec(256), pytest.MonkeyPatch.context() as patch:
        patch.setattr(families, "MEMBERS", 4)
        return next(families.families(NEAR, 20, lambda what: None))


@pytest.fixture(scope="module")
def symmetric(family):
    """The symmetric orbit through which it leads."""
    return family[0]


@pytest.mark.parametrize("name", [*COMMITTED[:2], *slow(COMMITTED[2])])
def test_a_committed_certificate_is_proved_anew_and_accepted(name):
    data = committed(name)
    level, steps = level_of(data), data["steps"]
    ctx.prec = 512
    start = families.solved(level, steps, member_of(data), 4)
    passage = Map.of(level).passage(*start, steps)
    numbers = [*data["start"]["momentum"], *data["start"]["gamma"]]
    assert [rounded(x, data["digits"]) for v in start for x in v] == numbers
    det, unit = orbit.determinants(passage)
    assert det < 1
    assert [rounded(x, data["digits"]) for x in (det, unit)] == [data["determinant"], data["unit_eigenvalue"]]
    assert orbit.attracts(*orbit.multipliers(passage.derivative())) == ("trace" in data)
    assert checker.check(data).kind == orbit.KIND


@pytest.mark.parametrize("name", [COMMITTED[0], *slow(*COMMITTED[1:])])
def test_a_committed_certificate_has_the_largest_radius(name):
    data = committed(name)
    for factor, accepted in ((Fraction(1, 10), True), (10, False)):
        fields = {name: value for name, value in data.items() if name not in document.MADE}
        other = document.stated(orbit.KIND, **fields | {"radius": shortest(factor * Fraction(data["radius"]))})
        assert accepts(other) == accepted


def accepts(data):
    try:
        return checker.check(data).kind == orbit.KIND
    except checker.Rejected:
        return False


def test_a_level_off_the_family_is_refused():
    data = committed(COMMITTED[0])
    level, steps = level_of(data), data["steps"]
    off = Level(level.J, level.D, level.size, level.height + Fraction(1, 10**8))  # ten times the width of the family
    refused(off, families.solved(off, steps, member_of(data), 8), steps)


def refused(level, start, steps):
    """No certificate is written, or the checker refuses it."""
    with pytest.raises((NotProved, checker.Rejected)):
        checker.check(orbit._document(level, steps, start, Map.of(level).passage(*start, steps), 60, False))


def test_a_symmetric_orbit_keeps_the_volume_and_proves_nothing(symmetric):
    level = Level(NEAR.J, NEAR.D, NEAR.size, families.fraction(symmetric.height))
    passage = Map.of(level).passage(symmetric.momentum, symmetric.gamma, 20)
    # The start is symmetric to 1e-11; Newton's shortest corrections leave the square of that, times d det = 1e-8.
    assert abs(passage.derivative().det() - 1) < 1e-30
    assert abs((identity() - passage.derivative()).det()) < 1e-30
    refused(level, families.on_level(level, symmetric.momentum, symmetric.gamma), 20)


def test_the_mirror_image_has_the_inverse_derivative():
    data = committed(COMMITTED[0])
    level, steps = level_of(data), data["steps"]
    member = families.Member(None, *families.solved(level, steps, member_of(data), 4))
    here, there = (Map.of(level).passage(x.momentum, x.gamma, steps).derivative() for x in (member, member.mirrored()))
    product = here * there - identity()
    assert all(abs(product[i, j]) < 1e-50 for i in range(3) for j in range(3))


@pytest.mark.parametrize(("eigenvalues", "inside"), [((0.9, 0.5, -0.3), True), ((0.9, 1.1, 0.2), False),
                                                 ((-1.01, 0.5, 0.5), False), ((1, 0.5, 0.5), False)])  # fmt: skip
def test_attraction(eigenvalues, inside):
    diagonal = arb_mat([[x if i == j else 0 for j in range(3)] for i, x in enumerate(eigenvalues)])
    assert orbit.attracts(*orbit.multipliers(diagonal)) == inside
    spiral = arb_mat([[0.6, -0.7, 0], [0.7, 0.6, 0], [0, 0, eigenvalues[0]]])  # of modulus 0.92
    assert orbit.attracts(*orbit.multipliers(spiral)) == (abs(eigenvalues[0]) < 1)


@pytest.mark.parametrize(("eigenvalues", "proves"), [((0.5, 2, 3), True), ((0.5, 2, -1), True), ((0.25, 2, 2), False),
                                                     ((0.5, 2, 1), False), ((0.5, 3, 1), False)])  # fmt: skip
def test_a_determinant_of_1_and_an_eigenvalue_1_prove_nothing(eigenvalues, proves):
    diagonal = arb_mat([[x if i == j else 0 for j in range(3)] for i, x in enumerate(eigenvalues)])
    passage = Passage((arb(1), arb(0), arb(0), arb(0)), diagonal, arb_mat(3, 4), [])
    if proves:
        assert orbit.determinants(passage)[0] == np.prod(eigenvalues)
        return
    with pytest.raises(NotProved):
        orbit.determinants(passage)


def test_an_orbit_is_found(monkeypatch, family):
    monkeypatch.setattr(families, "families", lambda *_: iter([family]))
    data = orbit.periodic_orbit(NEAR.J, NEAR.D, NEAR.size, 20, digits=45, radius=Fraction(1, 10**95))
    assert data["radius"] == "1e-95"
    assert checker.check(data).numbers["determinant"] == data["determinant"] < "1"
    assert data["integrals"]["momentum.gamma"].startswith("2.51")
    with pytest.raises(BadInput, match="does not accept the radius 1e-40"):
        orbit._with_radius(data, Fraction(1, 10**40), 20, lambda what: None)
    with pytest.raises(BadInput, match="too few to show"):
        orbit.periodic_orbit(NEAR.J, NEAR.D, NEAR.size, 20, digits=8)
    monkeypatch.setattr(checker, "check", Mock(side_effect=checker.Rejected("no")))
    with pytest.raises(BadInput, match="does not accept"):
        orbit.periodic_orbit(NEAR.J, NEAR.D, NEAR.size, 20)


def test_families_that_cannot_be_followed_are_left_out(monkeypatch, family):
    errors = iter([NotProved(), TooWide(), ZeroDivisionError()])
    starts = [np.array([1.0, 0, 0, x, 0, 0]) for x in (0.1, 0.2, 0.3, 0.4)]
    monkeypatch.setattr(families, "_symmetric", lambda level, steps: starts)
    monkeypatch.setattr(families, "_followed", Mock(side_effect=[*errors, family]))
    assert list(families.families(NEAR, 20, lambda what: None)) == [family]
    monkeypatch.setattr(families, "families", lambda *_: iter([family]))
    monkeypatch.setattr(families, "solved", Mock(side_effect=ZeroDivisionError))
    with pytest.raises(BadInput, match="no orbit of 20 steps is proved there"):
        orbit.periodic_orbit(NEAR.J, NEAR.D, NEAR.size, 20)
    monkeypatch.setattr(families, "near", Mock(side_effect=ZeroDivisionError))
    with pytest.raises(BadInput, match="no orbits of 20 steps that are not symmetric were found"):
        orbit.periodic_orbit(NEAR.J, NEAR.D, NEAR.size, 20)


@pytest.mark.parametrize(("change", "sentence"), [
    ({"D": 10**400}, "the search begins in float64"),
    ({"J": (1, 1, 4)}, "must differ"), ({"D": 0}, "D must be positive"), ({"size": 9}, "beyond the bound"),
    ({"size": 0}, "must be positive"), ({"height": 3}, "parallel"), ({"steps": 1}, "number of steps"),
    ({"digits": 0}, "number of decimals"), ({"digits": 2001}, "number of decimals"),
])  # fmt: skip
def test_what_has_no_certificate_is_refused(change, sentence):
    given = {"J": (1, 2, 4), "D": 2, "size": Fraction(15, 2), "steps": 20, **change}
    given |= {"J": tuple(map(Fraction, given["J"])), "D": Fraction(given["D"]), "size": Fraction(given["size"])}
    with pytest.raises(BadInput, match=sentence):
        orbit.periodic_orbit(**given)
