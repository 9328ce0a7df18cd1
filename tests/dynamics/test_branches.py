"""All branches of the map: exact counts, enclosures, the fast version in float64, and the command."""

import json
from fractions import Fraction

import flint
import mpmath
import numpy as np
import pytest
import sympy as sp
from budget import examples, slow
from commands import chapsym as run
from commands import refused
from crowds import seeded
from hypothesis import given
from hypothesis import strategies as st

import chapsym
from chapsym import generated, testing
from chapsym.derive import solutions as derived
from chapsym.derive import three
from chapsym.derive.three import placed
from chapsym.dynamics import BadInput, Ball, branches
from chapsym.dynamics.loops.branch import inverse
from chapsym.dynamics.oracle import Oracle
from chapsym.dynamics.solutions import enclosed, multivalued
from chapsym.numbers import Digits, Double, Enclosure
from chapsym.prove import REAL, REAL_MULTIPLE, Count
from chapsym.prove.elimination import NotCounted

#: (J, D, 𝒦, γ): one state for each number of rotations; the odd numbers have a double root.
STATES = {
    0: ((1, 2, 4), 3, (9, 0, 0), ("2/7", "3/7", "6/7")),
    1: ((1, 2, 4), 0, (0, 0, 3), ("2/7", "3/7", "6/7")),
    2: ((3, 4, 2), 5, (5, 2, 1), (0, 0, 1)),
    3: ((1, 2, 4), 3, (0, 0, 1), (0, 0, 1)),
    4: ((1, 2, 4), 3, (1, "-1/2", "3/4"), ("2/7", "3/7", "6/7")),
    5: ((5, 1, 3), 10, (0, 0, -4), (0, 1, 0)),
    6: ((1, 2, 4), 100, (0, 1, 0), (0, 1, 0)),
    7: ((5, 3, 2), 302, ("7/43", "-18/43", "84/43"), ("-4/5", "-3/5", 0)),
    8: ((1, 2, 4), 1000, ("-1/4", "-3/2", "1/2"), ("6/7", "2/7", "3/7")),
}


def exact(state):
    """J, D, 𝒦 and γ as fractions."""
    J, D, K, g = state
    return tuple(map(Fraction, J)), Fraction(D), tuple(map(Fraction, K)), tuple(map(Fraction, g))


def solve(state, precision=Double()):  # noqa: B008
    return enclosed.precise_branches(*exact(state), precision)


def multiplicities(found):
    return [s.multiplicity for s in found.solutions]


def counted(state):
    """The number of real solutions, and with multiplicities, as certificates have it: by elimination."""
    J, D, K, g = (list(map(sp.Rational, x)) for x in (state[0], [state[1]], *state[2:]))
    point = placed((three.MASSES, J), ([three.D], D), (three.gamma, g), (three.K, K))
    found = Count("", derived.equations(), derived.POINT, point, (), three.RING).numbers()
    return found[REAL], found[REAL_MULTIPLE]


def in_float64(state):
    J, D, K, g = (np.array(x, dtype=float) for x in exact(state))
    return Ball(J, D), K, g


@pytest.mark.parametrize("count", STATES)
def test_every_number_of_rotations_occurs_in_order_of_their_angles(count):
    found = solve(STATES[count])
    assert (len(found.solutions), found.complete, found.reason) == (count, True, None)
    assert sum(multiplicities(found)) % 2 == 0
    assert sorted(multiplicities(found))[:-1] == [1] * (count - 1)
    assert counted(STATES[count]) == (count, sum(multiplicities(found)))
    written = found.write()["solutions"]
    angles = [s["angle"] for s in written]
    assert angles == sorted(angles)
    assert all(0 <= angle <= np.pi for angle in angles)
    assert all(next(x for x in (s["q0"], *s["q"]) if x) > 0 for s in written)


CONTEXT = mpmath.MPContext()
CONTEXT.dps = 80


@pytest.mark.parametrize("count", STATES)
def test_each_solves_the_matrix_equation(count):
    J, D, K, g = exact(STATES[count])
    J, D, K, g = ([CONTEXT.mpf(x.numerator) / x.denominator for x in v] for v in (J, [D], K, g))
    oracle = Oracle(J, D[0], g, digits=60)
    mp, target = oracle.mp, oracle.skew(K)
    for s in solve(STATES[count], Digits(50)).write()["solutions"]:
        q0, q1, q2, q3 = (mp.mpf(x) for x in (s["q0"], *s["q"]))
        skew = oracle.skew([q1, q2, q3])
        rotation = mp.eye(3) + 2 * q0 * skew + 2 * skew * skew
        assert mp.norm(oracle.momentum(rotation) - target) < 1e-47 * (1 + 20 * D[0])
        assert abs(mp.acos(min(1, (sum(rotation[i, i] for i in range(3)) - 1) / 2)) - mp.mpf(s["angle"])) < 1e-20


@examples(8, 20)
@given(
    testing.rational_balls(), testing.rational_unit_vectors(), st.tuples(*[st.fractions(-3, 3, max_denominator=4)] * 3)
)
def test_the_count_is_the_one_by_elimination(ball, gamma, K):
    J, D = ball
    found = solve((J, D, K, gamma))
    try:
        other = counted((J, D, K, gamma))
    except NotCounted:
        assert len(set(J)) < 3
        return
    assert found.complete
    assert other == (len(found.solutions), sum(multiplicities(found)))


@examples(12, 40)
@given(testing.rational_balls(), testing.rational_unit_vectors(), testing.rational_rotations())
def test_a_rotation_is_among_those_of_its_momentum(ball, gamma, q):
    J, D = ball
    K = generated.momentum(*q, *gamma, *J, D)
    leading = next(x for x in q if x)
    upright = [float(x if leading > 0 else -x) for x in q]
    found = solve((J, D, K, gamma)).write()
    assert found["complete"] or not any(K)
    if found["complete"]:
        assert upright in [[s["q0"], *s["q"]] for s in found["solutions"]]


def test_without_momentum_there_are_the_identity_and_three_half_turns():
    found = solve(((1, 2, 4), 3, (0, 0, 0), ("2/7", "3/7", "6/7"))).write()
    assert [[s["q0"], *s["q"]] for s in found["solutions"]] == np.eye(4).tolist()
    assert [s["angle"] for s in found["solutions"]] == [0.0, np.pi, np.pi, np.pi]
    assert [s["small_rotation"] for s in found["solutions"]] == [True, False, False, False]


@pytest.mark.parametrize(
    ("J", "D", "K", "reason"),
    [
        ((1, 1, 4), 3, (0, 0, 0), "every rotation by pi about an axis in the plane of e1 and e2"),
        ((4, 1, 1), 0, (0, 0, 0), "every rotation by pi about an axis in the plane of e2 and e3"),
        ((2, 2, 2), 3, (0, 0, 0), "every rotation by pi has this momentum, which is 0"),
        ((1, 2, 4), 0, (0, 3, 0), "a curve of complex solutions in common"),
    ],
)
def test_infinitely_many_are_told(J, D, K, reason):
    found = solve((J, D, K, ("2/7", "3/7", "6/7")))
    assert not found.complete
    assert reason in found.reason
    assert [s.small_rotation for s in found.solutions] == [True]


@pytest.mark.parametrize(("size", "count"), [("6/5", 2), (2, 1), ("11/5", 0)])
def test_equal_moments_have_a_closed_form(size, count):
    """J = 1, D = 0: 𝒦 = 4q₀q, so that sin θ = |𝒦|/2, though the quadrics have a conic of complex points in common."""
    found = solve(((1, 1, 1), 0, (0, size, 0), (0, 0, 1))).write()
    assert (found["count"], found["complete"]) == (count, True)
    angle = np.arcsin(min(1.0, float(Fraction(size)) / 2))
    angles = [s["angle"] for s in found["solutions"]]
    assert angles == pytest.approx([angle, np.pi - angle][:count], rel=1e-15)
    assert [s["multiplicity"] for s in found["solutions"]] == {2: [1, 1], 1: [2], 0: []}[count]


def test_a_tiny_momentum_keeps_its_digits():
    tiny = Fraction(1, 10**300)
    found = solve(((1, 2, 4), 3, (tiny, 0, tiny), (0, "3/5", "4/5")), Digits(30)).write()["solutions"]
    step = chapsym.step(Ball((1, 2, 4), 3), (1e-300, 0, 1e-300), (0, 0.6, 0.8))
    assert found[0]["small_rotation"]
    assert [float(x) for x in found[0]["q"]] == pytest.approx(step.rotation[1:].tolist(), rel=1e-15)


def test_digits_are_those_of_the_enclosure():
    digits, boxes = (solve(STATES[8], precision).write()["solutions"] for precision in (Digits(40), Enclosure(200)))
    for s, box in zip(digits, boxes, strict=True):
        for x, y in zip((s["q0"], *s["q"], s["angle"]), (box["q0"], *box["q"], box["angle"]), strict=True):
            with flint.ctx.workprec(300):
                assert abs(flint.arb(x) - flint.arb(y)) < abs(flint.arb(y)) * flint.arb(10) ** -39
                assert flint.arb(y).rel_accuracy_bits() > 195


def test_the_counts_must_agree_and_the_interval_newton_test_must_find_the_same_root(monkeypatch):
    found = solve(STATES[8]).solutions
    monkeypatch.setattr(enclosed, "enclosed", lambda q, *state: found[0].rotation)
    with pytest.raises(ArithmeticError, match="another rotation"):
        solve(STATES[8])
    monkeypatch.setattr(enclosed._Algebra, "inertia", lambda self: (8, 2))
    with pytest.raises(ArithmeticError, match="differ"):
        solve(STATES[8])


@pytest.mark.parametrize("count", STATES)
def test_float64_agrees(count):
    found = branches(*in_float64(STATES[count]))
    known = solve(STATES[count]).write()["solutions"]
    assert (found.count, found.complete) == (count, True) or count == 7  # γ = (-4/5, -3/5, 0) is rounded
    if count != 7:
        for i, s in enumerate(known):
            assert found.rotation[i] == pytest.approx([s["q0"], *s["q"]], abs=1e-7 if s["multiplicity"] > 1 else 1e-12)
        assert np.isnan(found.rotation[count:]).all()
        assert (found.multiplicity[count:] == 0).all()
        assert found.small == next((i for i, s in enumerate(known) if s["small_rotation"]), -1)


@examples(2, 6)
@given(testing.states(fraction=(0.0, 1.3)))
def test_float64_counts_as_exact_arithmetic_does(state):
    """The rotations within the promise of `chapsym check`: 4κ ulps."""
    ball, K, gamma = state
    fast = branches(ball, K, gamma, settle=False)
    known = solve((ball.mass_tensor, float(ball.D), K, gamma)).write()
    if not fast.complete:
        return
    assert known["complete"]
    assert fast.count == known["count"]
    top = ball.inertia.max() + ball.D
    near = []
    for q in ([s["q0"], *s["q"]] for s in known["solutions"]):
        entries = np.abs(inverse(q, gamma, ball.mass_tensor, float(ball.D))[1]).max()
        budget = 4 * 2.0**-52 * entries * (np.abs(K).max() + 2 * top * np.abs(q[1:]).max()) + 2.0**-51
        # Near a half turn the sign is a matter of rounding, and so is the order of equal angles.
        away = [min(np.abs(p - q).max(), np.abs(p + q).max()) for p in fast.rotation[: fast.count]]
        assert min(away) <= budget
        near.append(np.argmin(away))
    assert sorted(near) == list(range(fast.count))
    assert (fast.multiplicity[: fast.count] == [s["multiplicity"] for s in known["solutions"]]).all()
    assert (np.diff(fast.angle[: fast.count]) >= 0).all()


@pytest.mark.parametrize("D", [0.0, 1.0, 1e2, 1e4, 1e6])
def test_float64_settles_generic_balls_alone(D):
    assert branches(*seeded(200, D, 7), settle=False).complete.all()


def test_what_float64_does_not_settle_is_counted_exactly():
    ball = Ball([[1, 1, 1], [1, 2, 4]], [5, 3])
    K, gamma = (0.5, -0.25, 0.75), (0.0, 0.0, 1.0)
    assert branches(ball, K, gamma, settle=False).complete.tolist() == [False, True]
    found = branches(ball, K, gamma)
    assert found.complete.all()
    assert found.count[0] == 2
    assert branches(Ball((1, 1, 1), 5), (0, 0, 0), gamma).complete == np.False_


def test_two_candidates_for_one_root_are_not_complete():
    rng = np.random.default_rng(3)
    points = np.linalg.qr(rng.normal(size=(8, 8)))[0][:, :4] + 1j * rng.normal(size=(8, 4))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    small, sound = np.full((1, 8), 1e-12), np.array([True])
    whole = multivalued.Candidates(points[np.newaxis], small, small + 1, sound)
    assert multivalued._classified(whole)[1] == [True]
    points[3] = 1j * points[5]
    whole = multivalued.Candidates(points[np.newaxis], small, small + 1, sound)
    assert multivalued._classified(whole)[1] == [False]


def test_a_step_above_the_fold_marks_no_rotation(monkeypatch):
    """Where D is large float64 may step where exact arithmetic finds no small rotation."""
    taken = chapsym.step(Ball((1, 2, 4), 3), (1, -0.5, 0.75), np.array([2, 3, 6]) / 7)
    monkeypatch.setattr(enclosed, "step", lambda *state: taken)
    assert not any(s.small_rotation for s in solve(STATES[8]).solutions)


def test_a_rounded_vertical_is_taken_as_it_is():
    gamma = (0.0, 0.7071067811865476, 0.7071067811865476)
    assert branches(Ball((1, 1, 1), 0), (0, 0, 0), gamma).count == 1


def test_a_batch_is_its_balls():
    ball, K, gamma = seeded(6, 30.0, 7)
    whole = branches(ball, K, gamma)
    for i in range(6):
        one = branches(Ball(ball.mass_tensor[i], ball.D[i]), K[i], gamma[i])
        assert one.count.shape == ()
        assert (one.count, one.small) == (whole.count[i], whole.small[i])
        assert np.allclose(one.rotation, whole.rotation[i], rtol=0, atol=1e-14, equal_nan=True)
    many = branches(Ball((1, 2, 4), 3), np.ones((2, 1, 3)), np.broadcast_to([0.0, 0.0, 1.0], (5, 3)))
    assert many.rotation.shape == (2, 5, 8, 4)
    assert branches(Ball((1, 2, 4), 3), np.ones((0, 3)), (0, 0, 1)).count.shape == (0,)


@pytest.mark.parametrize("large", [1e100, *slow(1e300)])
def test_extremes_of_float64(large):
    found = branches(Ball((1, 2, 4), large), (1 / large, 0, 1 / large), (0.0, 0.6, 0.8))
    assert (found.complete, found.count) == (True, 4)


def test_bad_input_is_refused():
    with pytest.raises(BadInput, match="settle must be True or False"):
        branches(Ball((1, 2, 4), 3), (1, 0, 0), (0, 0, 1), settle=np.ones(2))
    with pytest.raises(BadInput, match="gamma must be a unit vector"):
        branches(Ball((1, 2, 4), 3), (1, 0, 0), (0, 0, 2))
    with pytest.raises(BadInput, match="beyond the range of float64"):
        solve(((1, 2, 4), 3, ("1e400", 0, 0), (0, 0, 1)))


COMMAND = ["branches", "--mass-tensor", "1,2,4", "--D", "1000", "--momentum=-1/4,-3/2,1/2", "--gamma", "6/7,2/7,3/7"]


def test_the_command_gives_the_contracts_fields():
    found = json.loads(run(*COMMAND, "--json").stdout)
    assert list(found) == ["count", "complete", "solutions"]
    assert (found["count"], found["complete"], len(found["solutions"])) == (8, True, 8)
    assert list(found["solutions"][0]) == ["q0", "q", "angle", "multiplicity", "small_rotation"]
    assert [s["small_rotation"] for s in found["solutions"]] == [True] + [False] * 7
    step = json.loads(run("step", *COMMAND[1:], "--json").stdout)
    assert found["solutions"][0]["q0"] == pytest.approx(step["q0"], rel=1e-15)
    strings = json.loads(run(*COMMAND, "--json", "--digits", "30").stdout)["solutions"]
    assert float(strings[0]["angle"]) == found["solutions"][0]["angle"]
    assert len(strings[0]["angle"]) > 30


def test_the_command_prints_a_table():
    lines = run(*COMMAND).stdout.splitlines()
    assert lines[0] == "8 rotations, complete"
    assert lines[1].split() == ["angle", "q0", "q1", "q2", "q3", "multiplicity"]
    assert lines[2].endswith("1, the small rotation")
    assert len(lines) == 10
    none = run(*COMMAND[:-3], "--momentum", "9999,0,0", "--gamma", "0,0,1")
    assert (none.returncode, none.stdout) == (0, "0 rotations, complete\n")
    words = run("branches", "--mass-tensor", "1,1,4", "--D", "3", "--momentum", "0,0,0", "--gamma", "0,0,1", "--json")
    assert words.returncode == 0
    assert "infinitely many" in json.loads(words.stdout)["reason"]


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        (["--gamma", "0,0,1.1"], "gamma must be a unit vector"),
        (["--momentum", "1,2"], "--momentum takes 3 numbers"),
        (["--momentum", "1e400,0,0"], "beyond the range of float64"),
    ],
)
def test_the_command_refuses_bad_input_in_one_sentence(more, sentence):
    assert sentence in refused(*COMMAND, *more)
