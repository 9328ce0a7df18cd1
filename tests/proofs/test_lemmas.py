"""chapsym's own lemmas: their verdicts and evidence, and what a slip in a derivation does to those that rest on it."""

from dataclasses import replace
from fractions import Fraction

import pytest
import sympy as sp
from budget import slow

from chapsym.derive import ball, composition, continuous, elliptic, gibbs, gyrostat, modified, steady, three
from chapsym.proofs import LEMMAS
from chapsym.proofs.map import order
from chapsym.prove import load
from chapsym.prove.runner import judge

#: How many controls a lemma has, where it is another number than two or more.
CONTROLS = {"composition-order": 4, "steady": 3} | dict.fromkeys(
    ("gibbs-rotation", "top-precession", "steady-branch", "steady-axis", "steady-roll", "isotropic-spin", "straight",
     "periodic-orbits"), 1,
)  # fmt: skip


@pytest.mark.parametrize("id", LEMMAS)
def test_a_lemma_holds_with_its_evidence(lemmas, id):
    evidence = lemmas[id]["evidence"]
    assert lemmas[id]["verdict"] == "holds", evidence["problems"]
    assert evidence["problems"] == []
    assert evidence["witnesses"]
    assert len(evidence["controls"]) >= CONTROLS.get(id, 2)
    assert all(control["rejected"] for control in evidence["controls"])


def test_lemmas_are_no_claims_of_the_paper():
    assert set(LEMMAS) <= set(load(lemmas=True))
    assert not set(LEMMAS) & set(load())


def flipped(right):
    return sp.ImmutableMatrix(sp.Matrix(right).subs(gibbs.u[0], -gibbs.u[0]))


def doubled(right):
    return sp.Matrix(right).subs(three.D, 2 * three.D)


def lopsided(heavy):
    """Of the determinant of a heavy ball, Y = Mγ."""
    return [(names, gibbs.M * three.gamma if names is gibbs.Y else values) for names, values in heavy[0]], heavy[1]


#: A slip: in which functions, what it makes of what they give, and the lemmas that must see it.
SLIPS = {
    "the rotor's momentum": (gyrostat, ["added_momentum"], lambda right: -right, ["gyrostat-map"]),
    "half the load": (modified, ["load"], lambda right: right.subs(three.D, three.D / 2), ["modified-field"]),
    "the correction": (modified, ["correction"], lambda right: right + modified.omega, ["modified-field"]),
    "a factor of the energy": (modified, ["energy_rate"], lambda right: right * 4 / 3, ["modified-energy"]),
    "a vector product": (three, ["carried_steps"], lambda of: (of[0], of[1] + three.DRAG), ["stable-momentum"]),
    "the determinant": (gibbs, ["newton_heavy_steps"], lopsided, ["stable-determinant"]),
    "twice D": (continuous, ["angular_velocity"], doubled, ["stable-inverse", "isotropic-spin"]),
    "the residual": (
        gibbs, ["residual", "jacobian"], flipped,
        ["steady-branch", "steady", "steady-axis", "steady-roll", "measure-iff", "separatrix-map"],
    ),
    "the value of V": (elliptic, ["increment_parts"], lambda of: [of[0], 2 * of[1], *of[2:]], ["separatrix-map"]),
    "a factor in the kernel": (steady, ["spin_steps"], lambda right: (right[0], 2 * right[1]), ["isotropic-spin"]),
    "the contact point": (three, ["centre_step"], lambda right: sp.diag(1, 1, -1) * right, ["straight"]),
    "the contact term": (
        ball, ["momentum"], lambda right: right + ball.D * (ball.Omega * ball.Gamma - ball.Gamma * ball.OmegaT),
        ["self-adjoint", "reversible"],
    ),
}  # fmt: skip


def verdict(id):
    return judge(load(lemmas=True)[id]).verdict.value


@pytest.fixture
def _spin():
    steady.spin.cache_clear()
    yield
    steady.spin.cache_clear()


@pytest.mark.usefixtures("_spin", "uncertified")
@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_in_a_derivation_is_seen(monkeypatch, slip, thorough):
    place, names, wrong, ids = SLIPS[slip]
    for name in names:
        honest = getattr(place, name)
        monkeypatch.setattr(place, name, lambda *given, honest=honest: wrong(honest(*given)))
    for id in ids if thorough else ids[:1]:
        assert verdict(id) != "holds", id


@pytest.mark.usefixtures("uncertified")
@pytest.mark.parametrize(
    ("wanted", "place", "digit"), [(4, 2, 38), (8, 8, 38), *slow((4, 0, 39), (6, 1, 38), (8, 0, 30))]
)
def test_a_wrong_digit_is_seen(wanted, place, digit, monkeypatch):
    one = order.COMPOSITIONS[wanted]
    half = [*one.half]
    half[place] = half[place][: digit - 42] + str((int(half[place][digit - 42]) + 5) % 10) + half[place][digit - 41 :]
    monkeypatch.setitem(order.COMPOSITIONS, wanted, replace(one, half=tuple(half)))
    assert verdict("composition-order") != "holds"


def test_a_composition_of_too_low_an_order_is_seen(monkeypatch):
    """Kahan and Li's of order 6 in the place of that of order 8."""
    monkeypatch.setitem(order.COMPOSITIONS, 8, replace(order.COMPOSITIONS[6], order=8))
    assert verdict("composition-order") != "holds"


def test_a_condition_that_is_left_out_is_seen(monkeypatch):
    honest = composition.lyndon
    monkeypatch.setattr(composition, "lyndon", lambda order: honest(order)[:-1])
    assert verdict("composition-order") != "holds"


def test_the_brackets_are_lie_elements():
    """[1, 3] = 13 - 31, and [1, [1, 3]] = 113 - 2·131 + 311; their coefficients on a shuffle add up to 0."""
    assert {(1, 3): 1, (3, 1): -1} in composition.brackets(4)
    assert {(1, 1, 3): 1, (1, 3, 1): -2, (3, 1, 1): 1} in composition.brackets(5)


def test_an_interval_that_holds_no_solution_is_refused():
    half = order.COMPOSITIONS[6].exact[:5]
    with order.ctx.workprec(order.BITS):
        assert order.isolated(half, 6) is not None
        assert order.isolated([*half[:4], half[4] + 3 * order.OFF], 6) is None
        assert order.isolated([Fraction(1, 5)] * 5, 6) is None
