"""Certificates of kind motion: the formulas, what is enclosed against another integrator, what is refused."""

import random
from contextlib import suppress
from fractions import Fraction

import certificate_maker as maker
import numpy as np
import pytest
from budget import slow
from certificate_changes import at, changed, leaves, replaced, resealed
from motion_truth import Truth, matrix_of

from chapsym.checker import Rejected, attitude, check, motion, rolling, statement
from chapsym.checker.interval import Interval
from chapsym.checker.taylor import derivatives

J, D, RADIUS = [Fraction(1), Fraction(2), Fraction(4)], Fraction(3), Fraction(1, 2)
INERTIA = [sum(J) - x for x in J]
QUATERNION = [Fraction(x) for x in ("1", "1/2", "-1/4", "1/8")]
OMEGA = [Fraction(x) for x in ("1/2", "2/5", "1")]
TIMES = [Fraction(x) for x in ("0", "1/3", "1")]
DIGITS = 8


def momentum(inertia, D, omega, quaternion):
    """K = Iω + D(ω - ⟨γ, ω⟩γ)."""
    gamma = matrix_of(quaternion)[2]
    along = sum(x * y for x, y in zip(gamma, omega, strict=True))
    return [i * w + D * (w - along * g) for i, w, g in zip(inertia, omega, gamma, strict=True)]


def quaternion_of(rows):
    """That of a rotation by less than 2 radians, with the first number positive."""
    first = (1 + rows[0][0] + rows[1][1] + rows[2][2]) ** 0.5 / 2
    turns = rows[2][1] - rows[1][2], rows[0][2] - rows[2][0], rows[1][0] - rows[0][1]
    return [first, *(x / (4 * first) for x in turns)]


def rounded(x, digits=DIGITS + 2):
    return str(Fraction(round(float(x) * 10**digits), 10**digits))


@pytest.fixture(scope="module")
def truth():
    """The frames by extrapolation, and K in arb numbers."""
    path = Truth(J, D, OMEGA, QUATERNION, RADIUS)
    return [found | {"attitude": quaternion_of(found["rows"])} for found in map(path.at, TIMES)]


@pytest.fixture(scope="module")
def right(truth):
    """Its numbers are those of the other integrator, in floats."""
    K = momentum(INERTIA, D, OMEGA, QUATERNION)
    frames = [
        {"time": str(t), **{name: [[rounded(x), "1e-8"] for x in found[name]] for name in motion.PARTS}}
        for t, found in zip(TIMES, truth, strict=True)
    ]
    for frame in frames:
        for name in ("omega", "contact"):  # which are below 1
            frame[name] = [[x, "4e-9"] for x, _ in frame[name]]
    return resealed({
        "format": "chapsym-certificate/1", "kind": "motion", "statement": "",
        "ball": {"J": ["1", "2", "4"], "D": "3", "radius": "1/2"},
        "start": {"attitude": [[str(x), "0"] for x in QUATERNION], "momentum": [[str(x), "0"] for x in K],
                  "position": ["0", "0"]},
        "digits": DIGITS, "bits": 80, "order": 40, "frames": frames,
    })  # fmt: skip


def holds(data, truth):
    """Whether each number of the frames is within its radius of the truth."""
    return all(
        abs(float(x) - float(Fraction(centre))) <= float(Fraction(radius)) * 1.0001
        for frame, found in zip(data["frames"], truth, strict=True)
        for name in motion.PARTS
        for x, (centre, radius) in zip(found[name], frame[name], strict=True)
    )


def test_a_certificate_is_accepted_with_what_it_proves(right, truth):
    verdict = check(right)
    assert verdict.statement == right["statement"] == statement(right)
    assert "at 3 times from 0 to 1" in verdict.statement
    assert "1e-8" in verdict.statement
    assert verdict.numbers["contact at 1"].startswith(right["frames"][2]["contact"][0][0])
    assert holds(right, truth)


def interval(x, bits=128):
    return Interval.about(Fraction(x), bits)


def middle(x):
    return (x.lo + x.hi) / 2 ** (x.bits + 1)


@pytest.mark.parametrize("with_rotor", [False, True])
def test_the_derivative_of_the_field_is_antisymmetric_but_for_the_matrix_that_is_stated(with_rotor):
    """⟨e, f′e⟩ = |a|²⟨ξ, B⁻¹Cξ⟩ for e = a∘(s, ξ), by duals, for quaternions of any length."""
    rng = random.Random(5)
    for _ in range(8):
        numbers = [interval(Fraction(rng.randrange(-99, 99), 50)) for _ in range(14)]
        a, e, k, rotor = numbers[:4], numbers[4:8], numbers[8:11], numbers[11:]
        one = attitude.Turning.of(INERTIA, D, interval, k, rotor if with_rotor else ())
        slopes = [x.slopes[0] for x in derivatives(one.field, a, [e])]
        found = sum(middle(x) * middle(y) for x, y in zip(e, slopes, strict=True))
        columns = np.array([[middle(x) for x in column] for column in one.stretch(a)])
        (q0, *q), v = [middle(x) for x in a], [middle(x) for x in e]
        xi = (q0 * np.array(v[1:]) - v[0] * np.array(q) - np.cross(q, v[1:])) / (q0**2 + np.dot(q, q))
        assert found == pytest.approx((q0**2 + np.dot(q, q)) * (xi @ columns.T @ xi), rel=1e-11, abs=1e-12)


def test_balls_with_one_moment_keep_the_distance_of_their_motions():
    one = attitude.Turning.of([Fraction(2)] * 3, D, interval, [interval(x) for x in (1, 2, 3)])
    box = [Interval.enclosing(x - Fraction(1, 9), x + Fraction(1, 9), 128) for x in QUATERNION]
    assert all(x.lo == x.hi == 0 for column in one.stretch(box) for x in column)


def test_no_step_of_a_ball_with_one_moment_makes_an_error_larger(right, monkeypatch):
    honest, found = rolling.Flow.growth, []
    monkeypatch.setattr(rolling.Flow, "growth", lambda *given: found.append(honest(*given)) or found[-1])
    ends(replaced(right, ("ball", "J"), ["2", "2", "2"]))
    assert set(found) == {1}


def random_start(rng):
    def number(most):
        return Fraction(rng.randrange(-100, 101), 100) * most

    tensor, D = [abs(number(3)) + Fraction(1, 10) for _ in range(3)], abs(number(5))
    return tensor, D, [number(4) for _ in range(3)], [1, *(number(1) for _ in range(3))]


@pytest.mark.parametrize("with_rotor", [False, True])
@pytest.mark.parametrize("seed", [0, 1, *slow(2, 3, 4, 5)])
def test_what_is_enclosed_contains_the_motion_found_by_another_way(right, seed, with_rotor):
    tensor, D, omega, quaternion = random_start(rng := random.Random(seed))
    rotor = [Fraction(rng.randrange(-300, 300), 100) * with_rotor for _ in range(3)]
    whole = sum(tensor)
    K = [x + y for x, y in zip(momentum([whole - x for x in tensor], D, omega, quaternion), rotor, strict=True)]
    inside = {"rotor": [str(x) for x in rotor]} if with_rotor else {}
    data = right | {
        "ball": {"J": [str(x) for x in tensor], "D": str(D), "radius": "1/2"} | inside, "bits": 160, "order": 80,
        "start": right["start"] | {"attitude": [[str(x), "0"] for x in quaternion],
                                   "momentum": [[str(x), "0"] for x in K]},
    }  # fmt: skip
    one, path = motion.Motion(data), Truth(tensor, D, omega, quaternion, RADIUS, rotor)
    times = [Fraction(1, 7), Fraction(1, 2)]
    for found, time in zip(one.frames(times), times, strict=True):
        true = path.at(time)
        for name in ("gamma", "angular_momentum", "omega", "contact"):
            unit = one.units.get(name, Fraction(1))
            for x, y in zip(found[name], true[name], strict=True):
                y, slack = Fraction(str(y.str(32, radius=False))) / unit, Fraction(1, 10**27)
                assert x.wider(int(slack * 2**160)).lo <= y * 2**160 <= x.wider(int(slack * 2**160)).hi
                assert x.width < 2 ** (160 - 85)
        rows = [[float(y) for y in row] for row in true["rows"]]
        np.testing.assert_allclose(matrix_of([middle(x) for x in found["attitude"]]), rows, atol=1e-13)


def ends(data, time=1):
    one = motion.Motion(data)
    (found,) = one.frames([Fraction(time)])
    return found["attitude"]


@pytest.mark.parametrize(("name", "time"), [("attitude", "1/1000"), ("momentum", "1"), *slow(("attitude", "1"))])
def test_all_starts_within_the_radii_are_enclosed(right, name, time):
    """Each number of the start as far off as it may be; soon after, when little else is."""
    off, right = Fraction(1, 10**9), right | {"bits": 128, "order": 60}
    whole = ends(replaced(right, ("start", name), [[x, "1e-9"] for x, _ in right["start"][name]]), time)
    for i, (x, _) in enumerate(right["start"][name]):
        for sign in (-1, 1):
            moved = ends(replaced(right, ("start", name, i, 0), str(Fraction(x) + sign * off)), time)
            assert all(x.lo < y.lo and y.hi < x.hi for x, y in zip(whole, moved, strict=True))


def test_a_centre_that_is_moved_out_does_not_allow_a_wider_radius():
    """K = -901 text as -1001 up to 100: a tenth of what is text, more than a tenth of K."""
    text = [(Fraction(0), Fraction(0)), (Fraction(-1001), Fraction(100))]
    for name in ("angular_momentum", "omega"):
        with pytest.raises(Rejected, match="greater than the digits say"):
            motion._check_claim(name, text, Fraction(1, 10), Fraction(1))
        motion._check_claim(name, [text[0], (Fraction(-990), Fraction(90))], Fraction(1, 10), Fraction(1))


FRAME = ("frames", 2)


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [((*FRAME, "gamma", 0, 0), "0.83", "gamma at 1 is not proved"), ((*FRAME, "gamma", 1, 1), "1e-14", "gamma at 1"),
     (("frames", 1, "angular_momentum", 2, 0), "0", "angular_momentum at 1/3"),
     ((*FRAME, "omega", 1, 0), "0.19", "omega at 1"), ((*FRAME, "contact", 0, 0), "0.1", "contact at 1"),
     ((*FRAME, "attitude", 3, 0), "-0.58", "attitude at 1"), ((*FRAME, "attitude", 0, 0), "-0.6", "must be positive"),
     ((*FRAME, "time"), "1.001", "at 1.001 is not proved"), ((*FRAME, "time"), "1/3", "each later"),
     (("frames", 0, "time"), "-1", "from 0 on"), (("frames", 0, "gamma", 0, 0), "0.4", "gamma at 0 is not"),
     ((*FRAME, "gamma", 0, 1), "2e-8", "greater than the digits say"), ((*FRAME, "gamma", 0, 1), "1", "greater than"),
     ((*FRAME, "omega", 0, 1), "9e-8", "greater than"), ((*FRAME, "contact", 0, 1), "6e-9", "greater than"),
     ((*FRAME, "gamma", 0, 1), "-1e-8", "negative radius"), (("digits",), 9, "greater than the digits say"),
     (("digits",), 0, "digits must be"), (("bits",), 63, "bits must"), (("order",), 8, "not proved|not enclosed"),
     (("ball", "J", 0), "1.0001", "not proved"), (("ball", "J", 1), "-2", "negative"), (("ball", "D"), "3.1", "proved"),
     (("ball", "D"), "-1", "negative"), (("ball", "radius"), "0.6", "contact at"),
     (("ball", "radius"), "0", "positive"), (("ball", "J"), ["0", "0", "0"], "does not follow"),
     (("start", "attitude", 1, 0), "0.51", "not proved"),
     (("start", "attitude", 1, 1), "1e-3", "not proved|not enclosed"), (("start", "momentum", 0, 0), "3", "proved"),
     (("start", "momentum", 0, 1), "1e-6", "not proved|not enclosed"), (("start", "position", 0), "1e-7", "contact"),
     (("start", "momentum"), [["0", "0"]] * 3, "at rest"), (("start", "attitude"), [["0", "0"]] * 4, "not follow"),
     (("start", "attitude"), [["1", "2"]] * 4, "positive|not proved"), (("frames",), [], "frames must")],
)  # fmt: skip
def test_what_is_changed_and_sealed_anew_is_refused_by_mathematics(right, path, value, words):
    with pytest.raises(Rejected, match=words):
        check(resealed(replaced(right, path, value)))


def test_a_step_without_a_length_is_refused(right, monkeypatch):
    monkeypatch.setattr(rolling.Flow, "length", lambda self, terms: 0)
    with pytest.raises(Rejected, match="a step has no length"):
        check(right)


def test_nothing_is_changed_without_a_new_seal(right):
    with pytest.raises(Rejected, match="digest"):
        check(replaced(right, (*FRAME, "gamma", 0, 0), "0.8"))
    with pytest.raises(Rejected, match="statement"):
        check(maker.sealed(right | {"frames": right["frames"][:2]}))


def test_less_is_still_true(right):
    """Fewer frames, fewer digits, more bits; and without the point of contact."""
    assert "at 2 times from 1/3 to 1" in check(resealed(right | {"frames": right["frames"][1:]})).statement
    assert check(resealed(right | {"bits": 96, "digits": 7}))
    bare = [{name: x for name, x in frame.items() if name != "contact"} for frame in right["frames"]]
    start = {name: right["start"][name] for name in ("attitude", "momentum")}
    without = right | {"ball": {"J": right["ball"]["J"], "D": "3"}, "start": start, "frames": bare}
    assert "radius =" not in check(resealed(without)).statement
    with pytest.raises(Rejected, match="exactly the names"):
        check(resealed(right | {"frames": bare}))


def test_a_digit_of_a_frame_is_refused_or_true(right, truth):
    rng, places = random.Random(3), [x for x in leaves(right) if x[0] == "frames" and x[-1] == 0]
    accepted = 0
    for path in rng.sample(places, 15):
        one = resealed(replaced(right, path, changed(at(right, path), rng)))
        with suppress(Rejected):
            check(one)
            accepted += 1
            assert holds(one, truth)
    assert accepted < 5
