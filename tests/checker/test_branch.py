"""A branch of the step over a circle, beyond the bound of lemma small-branch: proved once, all round, or refused."""

import random
from fractions import Fraction

import certificate_maker as maker
import mpmath as mp
import pytest
from budget import slow
from certificate_changes import at, committed, replaced, resealed

from chapsym.checker import Rejected, check, measure
from chapsym.checker.branch import Branch, _check_meant
from chapsym.checker.circle import Circle, direction
from chapsym.checker.interval import Interval
from chapsym.checker.measure import branch_of
from chapsym.checker.step import Ball


@pytest.fixture(scope="module")
def right():
    return committed("measure-even")


@pytest.fixture(scope="module")
def circle(right):
    return Circle(right)


@pytest.fixture(scope="module")
def branch(circle, right):
    return branch_of(circle, right)


def test_the_boxes_hold_the_roots_continued_from_height_0(right, circle, branch):
    """Roots by another Newton's iteration, in 40 steps of h, at random points of both halves of the circle."""
    rng, half = random.Random(5), len(branch.boxes) // 2
    J, D, h = [mp.mpf(x) for x in right["ball"]["J"]], mp.mpf(1), mp.mpf(10)
    for _ in range(2):
        t = Fraction(rng.randrange(-999, 1000), 1000)
        gamma = mp.matrix([mp.mpf(x.lo + x.hi) / 2 / 2**x.bits for x in circle.start(t)])
        u = mp.zeros(3, 1)
        for part in range(1, 41):
            u = maker.gibbs(J, D, h * part / 40 * gamma, gamma, u)
        box = branch.boxes[int((t + 1) * half)]
        assert all(x.lo <= y * 2**x.bits <= x.hi for x, y in zip(box, u, strict=True)), t
        turn = rng.choice([1, -1])  # the other half of the circle has the roots turned by R
        state = [Interval.enclosing(x, x, circle.level.bits) for x in map(Fraction, map(str, map(mp.nstr, u)))]
        there = circle.start(t) if turn == 1 else branch.half_turned(circle.start(t))
        wide = state if turn == 1 else branch.half_turned(state)
        branch.check_on(there, wide, "here")
        with pytest.raises(Rejected, match="here is not proved to be on the branch"):
            branch.check_on(there, [x + 1 for x in wide], "here")
        with pytest.raises(Rejected, match="here is not proved to be on the branch"):
            branch.check_on(branch.half_turned(there), wide, "here")


def test_the_directions_of_the_arcs_are_on_the_unit_circle_in_order():
    angles = [
        mp.atan2(*(mp.mpf(x.numerator) / x.denominator for x in reversed(direction(Fraction(i, 8)))))
        for i in range(-8, 9)
    ]
    assert angles == sorted(angles)
    assert mp.almosteq(angles[0], -mp.pi / 2)
    assert mp.almosteq(angles[-1], mp.pi / 2)
    assert all(sum(x * x for x in direction(Fraction(i, 7))) == 1 for i in range(-7, 8))


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        (("branch", "arcs"), 64, "one root at each point"),
        (("branch", "arcs"), 1, "from 2 to"),
        (("branch", "arcs"), 511, "even"),
        (("branch", "u", 0), "0.58530362128", "u of branch"),
        (("branch",), {"arcs": 512}, "exactly the names"),
        (("ball", "height"), "10.001", "u of branch"),
        (("radius",), "1e-9", "u of branch"),
        (("half_turns",), 3, "about 3 half turns"),
        (("orbits", 1, "start"), "147/1000", "u of step 1"),
        (("orbits", 1, "start"), "0", "not 0, which is b"),
        (("orbits",), None, "orbits must be a list of 2"),
        (("branch", "arcs"), 10**9, "from 2 to 8192"),
    ],
)  # fmt: skip
def test_what_is_changed_is_refused_by_mathematics_alone(right, branch, monkeypatch, path, value, sentence):
    assert at(right, path) != value
    if path[0] in ("half_turns", "orbits"):
        monkeypatch.setattr(measure, "branch_of", lambda *of: branch)
    with pytest.raises(Rejected, match=sentence):
        check(resealed(replaced(right, path, value)))


def test_the_u_of_the_file_is_that_of_one_root(circle, right):
    """At J = (1, 2, 4), D = 1, h = 3.7005 on this level two roots at γ_b = 0 round to (0.1, 0.5, 0.9)."""
    ball = {"J": ["1", "2", "4"], "D": "1", "height": "37005/10000", "level": "0.21166783"}
    there = Circle.__new__(Circle)
    there.level, there.height, there.ball = circle.level, circle.number(Fraction("3.7005")), None
    there.a, there.b, there.c = 1, 0, 2
    there.ball = Ball.within([Fraction(x) for x in ball["J"]], Fraction(1), Fraction(0), circle.level.bits)
    there.level, there.weights = circle.number(Fraction(ball["level"])), [1 / x for x in there.ball.contact]
    state = there.state(there.start(Fraction(0)))
    roots = [[Fraction(x) for x in text.split()] for text in ("0.1135 0.4671 0.8509", "0.1375 0.5076 0.9484")]
    for given in roots:
        _check_meant(there, state, given, 4)
        with pytest.raises(Rejected, match="may be that of two roots"):
            _check_meant(there, state, [round(10 * x) / Fraction(10) for x in given], 1)


def test_without_the_branch_the_file_is_beyond_the_bound(right):
    with pytest.raises(Rejected, match="less than the least moment"):
        check(resealed({name: value for name, value in right.items() if name != "branch"}))


@pytest.mark.parametrize(
    ("method", "sentence"),
    [("half_turned", "close after half a turn"), *slow(("reflected", "the step back is not proved"))],
)
def test_the_symmetries_are_those_of_the_step(right, monkeypatch, method, sentence):
    """With another reflection or rotation the branch does not close, or is not its own inverse."""
    monkeypatch.setattr(Branch, method, lambda self, v: list(v))
    with pytest.raises(Rejected, match=sentence):
        branch_of(Circle(right), right)


def test_a_direction_that_turns_round_is_refused(right, monkeypatch):
    sine = Circle.sine
    monkeypatch.setattr(Circle, "sine", lambda self, v, w: -sine(self, v, w))
    with pytest.raises(Rejected, match="in its direction"):
        branch_of(Circle(right), right)


def test_every_step_of_the_orbits_is_asked_to_be_on_the_branch(right, branch, monkeypatch):
    asked = []
    monkeypatch.setattr(measure, "branch_of", lambda *of: branch)
    monkeypatch.setattr(Branch, "check_on", lambda self, gamma, u, where: asked.append(where))
    check(right)
    assert asked == [f"step {i}" for i in range(1, 9)] * 2
