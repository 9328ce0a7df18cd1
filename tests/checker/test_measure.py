"""Certificates of kind no-invariant-measure: a right one is accepted, a changed or a false one is not."""

import copy
import json
import math
import random
from fractions import Fraction

import certificate_maker as maker
import pytest
from certificate_changes import at, changed, leaves, refused, replaced, resealed

from chapsym import checker
from chapsym.checker import Rejected, check
from chapsym.checker.interval import Interval
from chapsym.checker.measure import Circle, half_turns

#: The level at which the two displacements of 9 steps are opposite, to 45 digits.
LEVEL = "0.243000952906382635505326722062055203819199224"
DIGITS = 45
#: One at which they have one sign.
OFF = "0.243000952906382635505326723"


@pytest.fixture(scope="module")
def right():
    return maker.measure(level=LEVEL, digits=DIGITS)


def test_a_right_certificate_is_accepted_and_says_what_it_proves_with_the_digest_of_the_format(right):
    verdict = check(right)
    assert verdict.kind == "no-invariant-measure"
    assert verdict.statement == right["statement"] == checker.statement(right)
    assert right["orbits"][0]["displacement"] in verdict.numbers["displacements"]
    assert {x["displacement"][0] for x in right["orbits"]} == {"0", "-"}
    assert checker.digest(right) == right["digest"]
    assert checker.digest(json.loads(json.dumps(right, indent=4))) == right["digest"]


@pytest.mark.parametrize(
    "options",
    [
        {"axes": (2, 1, 3), "level": LEVEL, "digits": 50},
        {"J": ("0", "1", "3"), "D": "1/2", "height": "7/10", "steps": 7, "digits": 50,
         "level": "0.6299712912791615185566315062403207442484"},
        {"J": ("0", "1", "3"), "D": "1/2", "height": "-7/10", "steps": 11, "digits": 45,
         "level": "0.4698400604780373216438265275474216963111"},
        {"level": LEVEL[:42], "digits": 40, "radius": "1e-50"},
    ],
)  # fmt: skip
def test_other_balls_axes_directions_and_a_box_of_parameters(options):
    check(maker.measure(**options))


def test_the_circle_is_that_of_the_whole_box(right):
    """What a certificate claims holds within the radius on both sides of each number."""
    ball, off = {"J": ["1", "2", "4"], "D": "1", "height": "12/5", "level": LEVEL}, Fraction(1, 10**9)
    circle = Circle(right | {"ball": ball, "radius": str(off)})
    around = [(circle.height, Fraction(12, 5), off), (circle.level, Fraction(LEVEL), off)]
    around += [(box, Fraction(x), 3 * off) for box, x in zip(circle.ball.contact, (7, 6, 4), strict=True)]  # I + D
    for box, x, radius in around:
        assert box.lo <= (x - radius) * 2**box.bits
        assert box.hi >= (x + radius) * 2**box.bits


def test_each_number_that_is_changed_is_refused_by_the_digest(right):
    """As every kind of certificate is: one place looks at the digests of all."""
    rng = random.Random(7)
    for path in [*leaves(right), ("digest",)]:
        assert refused(replaced(right, path, changed(at(right, path), rng))), path


def test_each_number_that_is_changed_is_refused_by_mathematics_alone(right, thorough):
    """With the sentence and the digest made anew: all of them, where the radius is 0; or every other of a step.

    Of those of a step the last decimal.
    """
    rng, numbers = random.Random(11), list(leaves(right))
    steps = [path for path in numbers if len(path) > 3]
    for path in [path for path in numbers if len(path) <= 3] + steps[:: 1 if thorough else 2]:
        for _ in range(1 if len(path) > 3 else 8 if thorough else 3):
            text = at(right, path)
            other = changed(text, rng) if len(path) <= 3 else text[:-1] + str((int(text[-1]) + 1) % 10)
            assert refused(resealed(replaced(right, path, other))), (path, other)


def test_in_a_box_of_parameters_only_the_radius_can_be_changed_to_another_true_one(thorough):
    """A smaller box proves less, and a somewhat larger one proves more, with the same digits."""
    rng = random.Random(17)
    right = maker.measure(level=LEVEL[:42], digits=40, radius="1e-50")
    for path in [path for path in leaves(right) if len(path) < 4]:
        for _ in range(8 if thorough else 4):
            data = resealed(replaced(right, path, changed(at(right, path), rng)))
            assert refused(data) or (path == ("radius",) and Fraction(data["radius"]) < Fraction("1e-45"))


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [(("ball", "height"), "0", "height is not proved"), (("ball", "height"), "29/10", "beyond the bound"),
     (("ball", "height"), "-3", "least moment"), (("radius",), "-1e-60", "radius must not be negative"),
     (("radius",), "10", "mass tensor"), (("axes",), [3, 2, 1], "circle around"),
     (("axes",), [1, 3, 2], "circle around"), (("axes",), [1, 2, 2], "in some order"),
     (("ball", "level"), "1/5", "u of step 1"), (("ball", "level"), LEVEL + "0", "more decimals"),
     (("ball", "J"), ["1", "2"], "list of 3"), (("orbits", 1, "start"), "a", "u of step 1"),
     (("orbits", 1, "start"), "c", "must be a or b"),
     # By their parity only half turns enter the displacement: 3 in place of 1 must fail by the count.
     (("half_turns",), 3, "about 3 half turns"),
     # The bits are chosen from the size of the parameters: all are 0.
     (("ball",), {"J": ["0"] * 3, "D": "0", "height": "0", "level": "0"}, "D and the moments")],
)  # fmt: skip
def test_each_hypothesis_is_proved_from_the_numbers(right, path, value, sentence):
    with pytest.raises(Rejected, match=sentence):
        check(resealed(replaced(right, path, value)))


def points(*degrees):
    """γ in the plane (a, b) at these angles."""
    turns = [[Fraction(f(math.radians(d))).limit_denominator(10**9) for f in (math.cos, math.sin)] for d in degrees]
    return [[Interval.enclosing(x, x, 60) for x in (*turn, Fraction(0))] for turn in turns]


def test_half_turns_are_counted_and_steps_in_both_directions_or_opposite_orbits_are_refused(right, monkeypatch):
    circle = Circle(right)
    assert circle.direction(points(0, 100, 200, 370)) == 1
    assert circle.direction(points(0, -100, -200, -370)) == -1
    for degrees in ((0, 100, 50), (0, 180), (0, 0), (0, 100, 300)):
        with pytest.raises(Rejected, match="one direction"):
            circle.direction(points(*degrees))
    for count, degrees in ((0, (10, 100, 179)), (1, (100, 181)), (2, (100, 200, 350, 400)), (3, (170, 340, 500, 600))):
        start, *others = points(0, *degrees)
        assert half_turns([circle.sine(start, v) for v in others]) == count
    with pytest.raises(Rejected, match="line of the start"):
        half_turns([Interval(1, 2, 60), Interval(-1, 1, 60)])
    directions = iter((1, -1))
    monkeypatch.setattr(Circle, "direction", lambda self, gammas: next(directions))
    assert refused(right)


def test_another_sentence_and_an_orbit_or_a_step_more_or_less_are_refused(right):
    for data in (right | {"statement": right["statement"].replace("9 steps", "8 steps")},
                 right | {"orbits": right["orbits"][:1]}, right | {"orbits": right["orbits"] * 2},
                 right | {"orbits": [right["orbits"][0]] * 2}, right | {"extra": 1},
                 {k: v for k, v in right.items() if k != "radius"}):  # fmt: skip
        assert refused(maker.sealed(data))
    shorter = copy.deepcopy(right)
    del shorter["orbits"][0]["steps"][-1]
    assert refused(maker.sealed(shorter))
    shorter["steps"] = 8
    del shorter["orbits"][1]["steps"][-1]
    assert refused(resealed(shorter))


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"level": LEVEL, "digits": DIGITS, "radius": "1e-40"}, "rounded correctly"),
        ({"level": OFF, "digits": DIGITS}, "opposite signs"),
        ({"D": "0", "level": "0.243", "digits": 30}, "D and the moments"),
        ({"J": ("2", "2", "4"), "level": "1/5", "digits": 30}, "three moments"),
    ],
)
def test_what_has_no_certificate_is_refused(options, sentence):
    """Too large a box, off the resonance, and integrable: the displacements of a top, and of equal moments."""
    with pytest.raises(Rejected, match=sentence):
        check(maker.measure(**options))


def test_an_integrable_map_cannot_be_faked():
    """A top with D = 0 taken for a ball has other orbits."""
    top = maker.measure(D="0", level="0.3", digits=30)
    for D in ("1/1000000", "1e-20", "1"):
        fake = resealed(replaced(top, ("ball", "D"), D))
        with pytest.raises(Rejected):
            check(fake)


@pytest.mark.parametrize("bad", ["nan", "1_0", " 1", "1e99999", "1/0", "", "0x1", "１", "1" * 5000, 1])
def test_a_number_in_another_form_is_refused_with_a_sentence(right, bad):
    for path in (("ball", "D"), ("ball", "J", 0), ("radius",), ("steps",), ("digits",), ("axes", 0),
                 ("orbits", 0, "start"), ("orbits", 0, "displacement"), ("orbits", 1, "steps", 3, "u", 0)):  # fmt: skip
        if bad == 1 and path[0] in ("axes",):
            continue
        assert refused(resealed(replaced(right, path, bad))), path
