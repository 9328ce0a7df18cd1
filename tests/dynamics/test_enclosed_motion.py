"""Certified motions: the balls contain the motion found by another way, in ordinary and in extreme cases."""

import json
import random
from decimal import Decimal
from fractions import Fraction as F

import numpy as np
import pytest
import sympy as sp
from budget import slow
from certificate_changes import resealed
from commands import chapsym as command
from commands import refused
from contained import ORDINARY, VECTORS, random_case, started, worst
from flint import arb, ctx
from motion_truth import Truth, number

import chapsym
from chapsym import BadInput, ExactBall, certified_motion, checker
from chapsym.dynamics import enclosed_motion
from chapsym.dynamics.enclosed_motion import decimal, follow, written
from chapsym.dynamics.flow import start as exact


@pytest.mark.thorough
def test_random_motions_are_contained():
    """Without a rotor, and with one whose angular momentum is from a thousandth of the others to thirty times them."""
    rng = random.Random(21)
    for i in range(600):
        times, size = [F(rng.randint(1, 9), 7), F(2)], F(10) ** rng.choice((-3, -1, 0, 1)) * (i % 3 > 0)
        case = (*random_case(rng), [size * F(rng.randint(-99, 99), 33) for _ in range(3)])
        found = follow(started(*case), times, 15)
        assert found.stopped is None
        assert worst(found, case, times) < 1, case
        assert all(x.rad() <= arb("1e-15") for x in found.gamma.flat)


Q, W = (1, 2, -1, 3), ("1", "-1/2", "3/4")
#: A rotor of about the angular momentum of the ball.
A = ("-3", "2", "7/2")
EXTREMES = {
    "D is 0": ((1, 2, 4), 0, W, Q),
    "D is a million times J": ((1, 2, 4), 5 * 10**6, W, Q),
    "D is a millionth of J": ((1, 2, 4), "5e-6", W, Q),
    "equal moments": ((1, 1, 1), 3, W, Q),
    "two equal moments": ((1, 1, 4), 3, W, Q),
    "nearly equal moments": ((1, "1.0000000001", 1), 3, W, Q),
    "at rest": ((1, 2, 4), 3, (0, 0, 0), Q),
    "flat": ((1, 2, 0), 3, W, Q),
    "a rod": (("1e-6", "1e-6", 1), 3, W, Q),
    "a rod without thickness": ((0, 0, 1), 3, W, Q),
    "vertical momentum": ((1, 2, 4), 3, ("1/9", "1/5", "1/2"), (2, 0, 0, 0)),
    "near the separatrix": ((1, 2, 4), 3, ("1e-8", 1, 0), (1, 0, 0, 0)),
    "small units": (("1e-12", "2e-12", "4e-12"), "3e-12", W, Q),
    "a rotor": ((1, 2, 4), 3, W, Q, A),
    "a rotor, D is 0": ((1, 2, 4), 0, W, Q, A),
    "a rotor, D is a million times J": ((1, 2, 4), 5 * 10**6, W, Q, A),
    "a rotor, equal moments": ((1, 1, 1), 3, W, Q, A),
    "a rotor in a rod": (("1e-6", "1e-6", 1), 3, W, Q, A),
    "a heavy rotor": ((1, 2, 4), 3, W, Q, (100, 20, -30)),
    "a light rotor": ((1, 2, 4), 3, W, Q, ("1e-20", 0, "1e-30")),
    "a rotor, hardly moving": ((1, 2, 4), 3, ("1e-12", "-2e-12", "1e-15"), Q, A),
}


#: Of which the same without a rotor is among the others, or nearly.
SLOW = (
    "a rotor, D is 0", "a rotor, D is a million times J", "a rotor, equal moments", "D is a millionth of J",
    "a rod without thickness", "a heavy rotor", "near the separatrix",
)  # fmt: skip


@pytest.mark.parametrize("name", [*(name for name in EXTREMES if name not in SLOW), *slow(*SLOW)])
def test_extreme_motions_are_contained(name):
    case = EXTREMES[name]
    if name == "vertical momentum":  # ω with B(γ)ω = 5γ at γ = e₃
        case = (case[0], case[1], (0, 0, F(5, 3)), case[3])
    found = follow(started(*case), [F(0), F(1)], 15)
    assert found.stopped is None
    assert worst(found, case, [0, 1]) < 1


@pytest.mark.parametrize("J", [(1, 1, 4), (4, 1, 1), (0, 0, 1)])
def test_two_equal_moments_need_no_more_bits_than_others(J):
    """Turns about the third axis go nowhere in the equation of neighbours: its matrix has a column of zeros."""
    assert follow(started(J, 3, W, Q), [F(1)], 15).bits == follow(started((1, 2, 4), 3, W, Q), [F(1)], 15).bits


def test_a_steady_rotation_is_the_closed_form():
    """About the third axis, unstable: a turn by ωt, and nothing moves; the growth is met with more bits."""
    found = follow(started((1, 4, 2), 3, (0, 0, 1), (1, 0, 0, 0)), [F(30)], 20)
    with ctx.workprec(200):
        half = arb(15)
        for x, right in zip(found.attitude[0], (half.cos(), 0, 0, half.sin()), strict=True):
            assert (x + right).contains(0)  # cos 15 < 0: the other of the two quaternions
        assert all(x.rad() < arb("1e-20") for x in found.attitude[0])
        assert all(x.contains(0) for x in found.contact[0])


def test_numbers_that_python_does_not_write_are_shown_by_their_type():
    """It refuses whole numbers of more than 4300 digits."""
    assert repr(ExactBall((1, 2, 4), F(1, 10**5000))) == (
        "ExactBall(mass_tensor=(Fraction(1, 1), Fraction(2, 1), Fraction(4, 1)), "
        "D=an object of the type Fraction that has no short text)"
    )


def test_numpys_integers_are_integers():
    K = tuple(np.array([1, 2, 3]))
    plain = certified_motion(ExactBall((1, 2, 4), 3), (1, 2, 3), (0, 0, 1), 1)
    given = certified_motion(ExactBall(tuple(np.array([1, 2, 4])), np.int64(3)), K, (0, 0, 1), np.int32(1))
    assert given.write() == plain.write()


def test_many_digits_with_a_rotor_keep_its_integrals():
    """By the corrections that gain more bits each time; ⟨K,γ⟩, |K|² and ½⟨K - a, ω⟩ are those of the start."""
    start = (3, 1, 4), ("2/7", "3/7", "6/7"), ["0", "1/2"]
    found = certified_motion(ExactBall((1, 2, 4), 3), *start, 120, rotor=A)
    assert found.stopped is None
    with ctx.workprec(500):
        inside = exact.balls([F(x) for x in A])
        states = zip(found.angular_momentum, found.gamma, found.omega, strict=True)
        first, last = ([K @ g, K @ K, (K - inside) @ w] for K, g, w in states)
        assert all(x.overlaps(y) and y.rad() < arb("1e-115") for x, y in zip(first, last, strict=True))


def test_the_public_function_takes_numbers_as_they_are_written():
    ball = chapsym.ExactBall(("0.1", "1/2", Decimal("1.6")), "0.7", radius=F(1, 2))
    found = chapsym.certified_motion(ball, ("0.1", "-0.05", 0), ("2/7", "3/7", "6/7"), ["0", "0.1"], digits=30)
    with ctx.workprec(200):
        assert found.angular_momentum[0, 0].contains(number("1/10"))
        assert not found.angular_momentum[0, 0].contains(arb(0.1))
        assert found.gamma[0, 0].contains(number("2/7"))
    assert found.times == (0, F(1, 10))
    assert found.attitude[0, 0] > 0
    same = chapsym.certified_motion(
        ball, ("0.1", "-0.05", 0), ("2/7", "3/7", "6/7"), "0.1", attitude=("13/7", "3/7", "-2/7", 0)
    )
    assert all(x.overlaps(y) for x, y in zip(same.omega[0], found.omega[1], strict=True))


BALL = chapsym.Ball((1, 2, 4), 3)
BAD = [
    ({"ball": 3}, "ball must be a chapsym.Ball, not int"),
    ({"ball": chapsym.Ball(((1, 2, 4), (1, 2, 5)), 3)}, "takes one ball, not a batch"),
    ({"gamma": (1, 1, 1)}, "gamma must be a unit vector"),
    ({"gamma": ("2/7", "3/7", "a")}, "'a' is not a number"),
    ({"times": ()}, "times must be one or more"),
    ({"times": (2, 1)}, "each later than the one before"),
    ({"times": -1}, "from 0 on"),
    ({"times": None}, "times must be a number"),
    ({"times": [[1], [2, 3]]}, "times 1 must be a number"),
    ({"rotor": (1, 2)}, "rotor must be 3 numbers"),
    ({"rotor": (1, 2, 3)}, "angular_momentum must differ from the rotor"),
    ({"digits": 0}, "digits must be a whole number from 1"),
    ({"limit": 0}, "limit must be a positive number"),
    ({"attitude": (1, 0, 0, 0)}, "attitude must turn gamma to"),
    ({"attitude": (0, 0, 0, 0)}, "attitude must not be 0"),
    ({"ball": ExactBall((0, 0, 1), 3), "gamma": (0, 0, 1)}, "does not resist a turn about the vertical"),
    ({"times": b"12"}, "times must be one or more numbers"),
    ({"times": ["1e-400"]}, "too far apart"),
    ({"gamma": [np.timedelta64(1, "s"), 0, 0]}, "gamma 1 must be a number"),
]


@pytest.mark.parametrize(("wrong", "sentence"), BAD, ids=[sentence for _, sentence in BAD])
def test_bad_input_is_told_in_a_sentence(wrong, sentence):
    good = {"ball": BALL, "angular_momentum": (1, 2, 3), "gamma": ("2/7", "3/7", "6/7"), "times": 1}
    with pytest.raises(chapsym.BadInput, match=sentence):
        chapsym.certified_motion(**(good | wrong))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("limit", [np.float16(600), F(600), Decimal(600), sp.Integer(600), 10**400, float("inf")])
def test_a_limit_may_be_a_number_of_any_kind(limit):
    assert chapsym.certified_motion(BALL, (1, 2, 3), ("2/7", "3/7", "6/7"), 1, limit=limit).stopped is None


@pytest.mark.parametrize("power", ["e400", "e-400"])
def test_moments_of_any_size_are_those_of_a_body_or_none(power):
    assert ExactBall(("1" + power, "2" + power, "4" + power), "3" + power).mass_tensor[2] == F("4" + power)
    odd = ("1" + power, "2" + power, "-4" + power)
    for wrong in ((odd, 3), ((-1, 2, 4), 3), ((0, 0, 0), 3), ((1, 2, 4), -3), ((1, 2, 4), 3, 0)):
        with pytest.raises(BadInput, match=r"mass_tensor|D = m ρ²|radius"):
            ExactBall(*wrong)


def test_each_of_many_frames_in_one_step_shows_progress_and_may_end_the_search():
    said = []
    found = follow(started(*ORDINARY), [F(i, 10**6) for i in range(60)], 10, progress=said.append)
    assert found.stopped is None
    assert len(said) >= 60 > found.steps


def test_a_correction_of_a_step_shows_progress_and_may_end_the_search():
    """Of many digits one takes seconds: it reports at each product of matrices, of which it has two."""
    said = []
    found = follow(started(*ORDINARY), [F(1, 100)], 300, progress=said.append)
    assert found.steps == 1
    assert len(said) > 30


def test_what_is_proved_is_given_where_the_time_is_up(monkeypatch):
    clock = iter(range(100))
    monkeypatch.setattr(enclosed_motion.clock, "monotonic", lambda: next(clock))
    found = follow(started(*ORDINARY), [F(i) for i in range(101)], 10, limit=5)
    assert 1 <= len(found.times) < 101
    assert found.stopped == (
        f"5 s were not enough for 10 digits at 100 s: {len(found.times)} of 101 frames are proved, "
        f"until {found.times[-1]} s"
    )
    assert found.write()["stopped"] == found.stopped


def test_more_bits_are_taken_where_they_are_needed(monkeypatch):
    monkeypatch.setattr(enclosed_motion, "GUARD", -10)
    found = follow(started(*ORDINARY), [F(1)], 15)
    assert found.stopped is None
    assert worst(found, ORDINARY, [1]) < 1
    monkeypatch.setattr(enclosed_motion, "MOST_BITS", 60)
    assert follow(started(*ORDINARY), [F(1)], 15).stopped.startswith("more than 60 bits would be needed for 15 digits")


def test_decimals_contain_their_balls():
    rng = random.Random(3)
    with ctx.workprec(200):
        for _ in range(300):
            x = arb(rng.getrandbits(150)) / 2 ** rng.randint(0, 400) * rng.choice((1, -1))
            x = arb(x.mid(), abs(x.mid()) / 2 ** rng.randint(5, 140)) if rng.random() < 0.9 else x.mid()
            middle, radius = written(x, 28)
            outer = arb(number(Decimal(middle)), number(Decimal(radius)))
            assert outer.contains(x)
            assert len(Decimal(radius).as_tuple().digits) <= 3
            assert Decimal(radius) == 0 or outer.rad() <= 2 * x.rad() + abs(x.mid()) * arb("1e-29")


def test_a_radius_that_is_written_is_within_the_digits():
    """Where the ball has as many digits as are missed nowhere, and in a number that is exact and long."""
    with ctx.workprec(200):
        for i in range(200):
            x = arb(1 + i / 70, 1e-12 * 2**-enclosed_motion.ROUNDED)
            assert Decimal(written(x, 12)[1]) <= Decimal("1e-12")
        assert Decimal(written(arb(0.1), 50)[1]) <= Decimal("1e-51")
    many = certified_motion(
        ExactBall((1, 2, 4), 3), (0, 0, 0), ("2/7", "3/7", "6/7"), ["0"], enclosed_motion.MOST_DIGITS
    )
    assert len(many.write()["frames"][0]["gamma"][0][0]) > enclosed_motion.MOST_DIGITS


def test_times_are_written_as_decimals_where_they_are_such():
    assert [decimal(F(x)) for x in ("2", "0", "1/8", "1/3", "12.50")] == ["2", "0", "0.125", "1/3", "12.5"]


SCENE = """
[ball]
mass_tensor = [0.1, 0.2, "2/5"]
D = 0.3
radius = 0.1
[start]
omega = [0.1, "30 deg/s", {spin}]
{more}
[run]
time = 0.3
frames = 3
"""


def scene(tmp_path, more="", spin="-0.2", replaced=None):
    path = tmp_path / "scene.toml"
    text = SCENE.format(more=more, spin=spin)
    for old, new in (replaced or {}).items():
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    return path


def test_what_the_command_writes_is_a_case_for_judge(tmp_path):
    followed = {"frames = 3": 'frames = 3\noutputs = ["attitude", "omega", "contact"]'}
    path, case, run = scene(tmp_path, replaced=followed), tmp_path / "case.json", tmp_path / "run.csv"
    for words in (("certify", "motion", path, "--digits", "12", "-o", case), ("run", path, "-o", run)):
        assert command(*words).returncode == 0
    done = command("judge", run, "--against", case, "--json")
    assert done.returncode == 0, done.stderr
    assert max(part["greatest"] for part in json.loads(done.stdout)["results"][0]["departure"].values()) < 1e-4


def test_the_command_takes_the_numbers_of_a_scene_as_they_are_written(tmp_path):
    spin = "-0.200000000000000000000000000000000000000000001"
    path = scene(tmp_path, 'rpy = ["90 deg", 0.0, "-60 deg"]\nposition = [0.5, -1]', spin)
    done = command("certify", "motion", path, "--digits", "60", "--json", "-o", tmp_path / "out.json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    kept = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert found.items() <= kept.items()
    assert kept.keys() - found.keys() == {"case", "title", "ball"}
    assert found.keys() == {"frames", "digits", "steps", "bits"}
    assert [frame["time"] for frame in found["frames"]] == ["0", "0.1", "0.2", "0.3"]
    first = found["frames"][0]
    balls = {name: [(Decimal(x), Decimal(r)) for x, r in v] for name, v in first.items() if name != "time"}
    (x, r), (y, s), (z, t) = (tuple(map(F, x)) for x in balls["omega"])
    assert abs(x - F("0.1")) <= r < F("1e-60")
    assert abs(z - F(spin)) <= t
    with ctx.workprec(300):
        assert abs(number(y) - arb.pi() / 6) < number(s)
    assert [[float(x) for x, _ in balls[name]] for name in ("contact", "gamma")] == [[0.5, -1.0], [0, 1, 0]]
    half = Decimal(3).sqrt() / 2  # to the 28 digits of decimals
    for (x, r), right in zip(balls["attitude"], (half, half, Decimal("-0.5"), Decimal("-0.5")), strict=True):
        assert abs(x - right * Decimal("0.5").sqrt()) <= r + Decimal("1e-27")


OF_THE_MAP = {"omega = [0.1,": "momentum = [0.1,", "30 deg/s": "1", "time = 0.3": "steps = 3", "frames = 3": ""}
ROTOR = {"radius = 0.1": 'radius = 0.1\nrotor = [0.01, "1/30", "-2e-3 kg m^2 rpm"]'}


def test_the_command_takes_a_rotor_as_it_is_written(tmp_path):
    """K is Bω + a, and the motion that of `certified_motion`; in units of turns a is a multiple of π."""
    path = scene(tmp_path, replaced=ROTOR)
    done = command("certify", "motion", path, "--digits", "12", "--json")
    assert done.returncode == 0, done.stderr
    expected = json.loads(done.stdout)["frames"]
    plain = json.loads(command("certify", "motion", scene(tmp_path), "--digits", "12", "--json").stdout)["frames"]
    with ctx.workprec(200):
        inside = [number("1/100"), number("1/30"), -arb.pi() * number("2e-3") / 30]
        for (x, r), (y, s), a in zip(*(f[0]["angular_momentum"] for f in (expected, plain)), inside, strict=True):
            assert abs(number(x) - number(y) - a) <= number(r) + number(s)
        w, q = ([F(x) for x, _ in expected[0][name]] for name in ("omega", "attitude"))
        truth = Truth((F("0.1"), F("0.2"), F("0.4")), F("0.3"), w, q, F("0.1"), [F(str(float(x))) for x in inside])
        true = truth.at(F("0.3"))
        for name in VECTORS:
            for (x, _), right in zip(expected[-1][name], true[name], strict=True):
                assert abs(number(x) - right) < 1e-11


@pytest.mark.parametrize("words", [("run", "-o", "out.npz"), ("scene", "check")])
def test_what_has_no_rotor_refuses_one_in_a_sentence(tmp_path, words):
    assert "ball.rotor goes with chapsym certify motion alone" in refused(*words, scene(tmp_path, replaced=ROTOR))


def test_a_certificate_of_a_ball_with_a_rotor_is_accepted_and_another_rotor_is_not(tmp_path):
    file = tmp_path / "c.json"
    path = scene(tmp_path, replaced={"radius = 0.1": 'radius = 0.1\nrotor = [0.01, "1/30", -0.002]'})
    made = command("certify", "motion", path, "--digits", "9", "--certificate", file)
    assert made.returncode == 0, made.stderr
    assert "a rotor with (1e-2, 1/30, -0.002) in K" in checker.check(json.loads(file.read_text())).statement
    for other in (["0.01", "1/30", "-0.0021"], ["0", "0", "0"]):
        data = json.loads(file.read_text())
        data["ball"]["rotor"] = other
        with pytest.raises(checker.Rejected, match="is not proved to be"):
            checker.check(resealed(data))


def test_no_certificate_is_written_of_a_rotor_in_turns(tmp_path):
    said = refused("certify", "motion", scene(tmp_path, replaced=ROTOR), "--certificate", tmp_path / "c.json")
    assert "a certificate has the rotor's angular momentum as rational numbers" in said
    assert not (tmp_path / "c.json").exists()


REFUSED = [
    (
        ROTOR | {"omega = [0.1,": "omega = [0,", "30 deg/s": "0 rpm", "-0.2]": "0.0]"},
        "without angular velocity the ball stays at rest",
    ),
    ({"radius = 0.1": "radius = 0.1\nrotor = [1, 2]"}, "rotor"),
    ({"radius = 0.1": 'radius = 0.1\nrotor = [1, 2, "3 kg"]'}, "angular momentum"),
    ({"radius = 0.1": "radius = 0.1\nrotor = [1, 2, { linspace = [1, 2, 3] }]"}, "rotor"),
    (OF_THE_MAP, "is of the map"),
    ({"D = 0.3": "D = { linspace = [1, 2, 3] }"}, "are of one ball"),
    (
        {'mass_tensor = [0.1, 0.2, "2/5"]': f'inertia = [[5, 1, 1], [1, 5, 1], [1, 1, "5.{400 * "0"}1"]]'},
        "two principal moments are nearly equal",
    ),
]


def test_a_scene_may_have_a_tensor_of_two_equal_moments(tmp_path):
    changed = {'mass_tensor = [0.1, 0.2, "2/5"]': "inertia = [[5, 1, 1], [1, 5, 1], [1, 1, 5]]"}
    assert command("certify", "motion", scene(tmp_path, replaced=changed)).returncode == 0


@pytest.mark.parametrize(("changed", "sentence"), REFUSED, ids=[sentence for _, sentence in REFUSED])
def test_a_scene_that_is_not_for_it_is_refused(tmp_path, changed, sentence):
    assert sentence in refused("certify", "motion", scene(tmp_path, replaced=changed))


def test_a_motion_that_takes_too_long_fails_with_what_is_proved(tmp_path):
    done = command("certify", "motion", scene(tmp_path), "--digits", "8", "--limit", "1e-9", "--json")
    assert done.returncode == 1
    assert json.loads(done.stdout)["stopped"].startswith("1e-09 s were not enough for 8 digits at 0.3 s: 1 of 4")
    assert "1e-09 s were not enough" in done.stderr


@pytest.mark.parametrize(
    ("body", "scale"),
    [('preset = "homogeneous"', F(2, 5)), ('preset = "shell"', F(2, 3)), ("inertia = [0.01, 0.01, 0.01]", None)],
)
def test_bodies_are_exact(tmp_path, body, scale):
    """Of a sphere K = (I + D)ω - D⟨ω,γ⟩γ with I a part of D = mρ²."""
    changed = {'mass_tensor = [0.1, 0.2, "2/5"]': f"mass = 3\n{body}", "D = 0.3": ""}
    found = json.loads(command("certify", "motion", scene(tmp_path, replaced=changed), "--json").stdout)
    D = F(3, 100)
    I = F(1, 100) if scale is None else scale * D
    middle, radius = found["frames"][0]["angular_momentum"][0]
    assert abs(F(middle) - (I + D) * F(1, 10)) <= F(radius) < F(1, 10**20)
