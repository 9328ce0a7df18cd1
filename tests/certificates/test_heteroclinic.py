"""Certificates of the ends of orbits between the unstable rotations: found, as the lemma says, and refused."""

import json
import math
import re
from decimal import Decimal
from fractions import Fraction

import pytest
from certificate_changes import committed
from commands import answer, chapsym, refused
from flint import ctx

from chapsym import checker
from chapsym.certificates import heteroclinic as search
from chapsym.certificates.heteroclinic import Orbits, heteroclinic
from chapsym.certificates.reduced import Top
from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.start import fraction

COMMITTED = {"heteroclinic-light": ("1,4,8", "1/2", "22/5"), "heteroclinic-real-ball": ("1,8,12", "22", "8")}


def top(J="1,4,8", D="1/2", height="22/5"):
    return Top(tuple(map(Fraction, J.split(","))), Fraction(D), Fraction(height))


@pytest.mark.thorough  # the other one is what the command finds
def test_a_committed_certificate_is_what_is_found():
    found = heteroclinic(top(*COMMITTED["heteroclinic-real-ball"]))
    assert found == committed("heteroclinic-real-ball")
    assert found["digest"] == checker.digest(found)


def test_for_small_D_the_difference_is_that_of_the_lemma():
    """I = (9, 6, 5), h = 9/2, D = 1/1000: E(D) is 0.998726 of its second order, as lemma separatrix has it."""
    with ctx.workprec(400):
        orbits = Orbits(top("1,4,5", "1/1000", "9/2"))
        half = fraction(orbits.growth).limit_denominator(10**12)
        ends = [orbits.end(x, 80)[0] for x in (Fraction(1), half)]
        difference = float((ends[0] / ends[1]).log())
        last, growth = float(orbits.last), float(orbits.growth)
        kappa, c, h, I2 = float(orbits.kappa), math.log(growth), 4.5, 6.0
    slope = 2 * math.sqrt(I2**2 - h**2)
    second = 2 * last / ((last**2 - 1) ** 2 * slope**2) + 2 * h * kappa / ((last**2 - 1) * slope**3)
    law = -16 * math.pi**2 / c**2 * second * 1e-6 / math.sinh(math.pi**2 / c)
    assert difference / law == pytest.approx(0.998726, abs=2e-6)


@pytest.mark.parametrize(
    ("ball", "arguments", "sentence"),
    [
        ({"J": "4,1,8"}, {}, "J1 < J2 < J3"),
        ({"J": "1,1,8"}, {}, "J1 < J2 < J3"),
        ({"D": "0"}, {}, "D = 0 there is nothing"),
        ({"height": "0"}, {}, "must be positive"),
        ({"height": "-1"}, {}, "must be positive"),
        ({"height": "5"}, {}, "less than 5"),
        ({"height": "49/10"}, {}, "beyond the bound"),
        ({"height": "1/1000"}, {}, "a larger height"),
        ({}, {"starts": (Fraction(1), Fraction(1))}, "two different positive"),
        ({}, {"starts": (Fraction(-1), Fraction(1))}, "two different positive"),
        ({}, {"digits": 10}, "take 24 or more"),
        ({}, {"digits": 0}, "from 1 to 2000"),
        ({}, {"radius": Fraction(-1)}, "must not be negative"),
        ({}, {"radius": Fraction(1, 10**20)}, "does not accept"),
    ],
)
def test_what_has_no_certificate_is_one_sentence(ball, arguments, sentence):
    with pytest.raises(BadInput, match=sentence) as error:
        heteroclinic(top(**ball), **arguments)
    assert "\n" not in str(error.value)


def test_ends_that_are_one_are_not_told_apart_forever(monkeypatch):
    """Δ(-u) = Δ(u)."""
    monkeypatch.setattr(search, "MOST_DIGITS", 40)
    with pytest.raises(BadInput, match="40 digits do not distinguish the difference"):
        heteroclinic(top(), starts=(Fraction(2), Fraction(1, 2)))


@pytest.mark.thorough
def test_other_starts_and_more_digits():
    found = heteroclinic(top(), starts=(Fraction(3, 2), Fraction(1, 5)), digits=30, radius=Fraction(0))
    assert [one["start"] for one in found["orbits"]] == ["3/2", "1/5"]
    assert found["digits"] == 30


def test_the_command_writes_what_it_prints_or_refuses_with_one_sentence(tmp_path):
    file = tmp_path / "ends.json"
    found = answer("certify", "heteroclinic", "-o", file)
    assert found == json.loads(file.read_text(encoding="utf-8")) == committed("heteroclinic-light")
    assert refused("certify", "heteroclinic", "--mass-tensor", "3,2,1", "--D", "1").startswith(
        "the entries of J must grow"
    )
    assert "takes 2 numbers" in refused("certify", "heteroclinic", "--starts", "1")
    done = chapsym("certify", "heteroclinic", "--radius", 0)
    first, other = re.search(r"^  exp .*: ([\d.]+) and ([\d.]+)$", done.stdout, re.MULTILINE).groups()
    assert f"{Decimal(other) - Decimal(first):.2e}" == "7.22e-22"
