"""Long steps: their weights, their order in both precisions, what they keep, their bits, and what they refuse."""

import math
import os
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from budget import slow
from plain import in_plain_python

import chapsym
from benchmarks.trade.frontiers import continuous
from chapsym.dynamics import extrapolation, kernels
from chapsym.dynamics.attitudes import initial_attitude
from chapsym.dynamics.levels import double_double
from chapsym.dynamics.loops import lanes
from chapsym.dynamics.loops.lanes import fitted, half_angle, turn_square
from chapsym.numbers import Pair

BALL = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.3)
#: D is 100 times the least moment of inertia.
LARGE = chapsym.Ball((0.1, 0.5, 1.6), 60.0)
K = np.array([1, -0.5, 0.75]) / np.sqrt(1 + 0.25 + 0.5625)
GAMMA = np.array([2, 3, 6]) / 7
UNIT_ROUNDOFF = 2.0**-53
PRECISIONS = ("double", "double-double")


@pytest.fixture(scope="module")
def at_two():
    """K, γ and the contact point after 2 s, by a Taylor series: nothing of the map in it."""
    return continuous(BALL, K, GAMMA, None, [Fraction(2)], 32)[0]


def exactly(found, name):
    """The numbers of a result as Fractions."""
    halves = [found] if found.low is None else [found, found.low]
    return sum(np.vectorize(Fraction, otypes=[object])(getattr(half, name)) for half in halves)


def error(reference, time_step, steps, precision="double", **options):
    end = chapsym.extrapolate(BALL, K, GAMMA, time_step, steps, contact=True, precision=precision, **options)
    parts = [exactly(end, name) for name in ("angular_momentum", "gamma", "contact")]
    return float(abs(np.concatenate(parts) - reference).max())


@pytest.mark.parametrize("columns", range(1, 7))
def test_weights_satisfy_the_order_conditions_exactly(columns):
    w = extrapolation.weights(columns)
    moments = [sum(x / Fraction(n) ** (2 * j) for n, x in enumerate(w, 8 - columns)) for j in range(columns + 1)]
    assert moments[:columns] == [1] + [0] * (columns - 1)
    assert moments[columns] != 0


def test_the_weights_in_pairs_are_those_of_the_columns_to_the_last_bit():
    whole, less = extrapolation.weights(12, 3), (*extrapolation.weights(11, 3), Fraction(0))
    for row, w, v in zip(extrapolation.weights_of_pairs(12), whole, less, strict=True):
        assert Pair(*row[:2]) == Pair.of(w)
        assert Pair(*row[2:]) == Pair.of(w - v)


@pytest.mark.parametrize(
    ("precision", "columns", "steps", "rounding", "apart"),
    [("double", columns, steps, 1e-12, 0.75) for columns, steps in ((2, 4), (3, 2), (4, 1))]
    + [("double-double", columns, steps, 1e-27, 1.5) for columns, steps in ((2, 8), (4, 4), (6, 4), (8, 4))],
)
def test_the_order_is_twice_the_columns(at_two, precision, columns, steps, rounding, apart):
    coarse, fine = (error(at_two, Fraction(2, n), n, precision, columns=columns) for n in (steps, 2 * steps))
    assert fine > rounding  # so that the ratio means something
    assert np.log2(coarse / fine) == pytest.approx(2 * columns, abs=apart)


def test_pairs_have_all_their_digits_and_the_doubt_is_the_error_of_a_column_less(at_two):
    assert error(at_two, Fraction(1, 4), 8, "double-double") < 1e-26
    fewer = error(at_two, 0.5, 4, "double-double", columns=7)
    doubt = chapsym.extrapolate(BALL, K, GAMMA, 0.5, 4, columns=8, precision="double-double").doubt
    assert fewer / 10 < doubt < 10 * fewer


@pytest.mark.usefixtures("way")
def test_a_steady_rotation_is_exact_in_one_step():
    """Lemma `steady`: equal moments, D > 0, any K and γ.  A step as long as it is, not fitted, would be off by 1e-3."""
    ball, time = chapsym.Ball((0.5, 0.5, 0.5), 0.7), 1.2
    omega = kernels.angular_velocity(K, GAMMA, ball.mass_tensor, ball.D)
    speed = np.linalg.norm(omega)
    turn = np.r_[np.cos(speed * time / 2), np.sin(speed * time / 2) * omega / speed]
    end = chapsym.extrapolate(ball, K, GAMMA, time, 1, columns=2)
    # Five turns' roundings times Σ|w| = 7, and the sine to an ulp.
    np.testing.assert_allclose(end.gamma, kernels.rotate(turn * [1, -1, -1, -1], GAMMA), rtol=0, atol=5 * 7 * 2**-52)


def test_the_sine_is_that_of_the_standard_library_as_far_as_it_says():
    for x in np.linspace(0.01, 1.5, 150):
        off = abs(fitted(x * x) - math.sin(x) / x)
        assert off <= (2.0**-52 if x < 0.5 else 3e-10)
        assert abs(half_angle(x * x) - math.cos(x / 2) ** 2) < 1e-5
    assert abs(fitted(1.5**2) - math.sin(1.5) / 1.5) > 1e-10


def test_a_step_that_turns_too_far_is_not_fitted():
    assert turn_square(1.0, 2, (3.0, 0.0, 0.0)) == 9.0
    assert turn_square(1.001, 2, (3.0, 0.0, 0.0)) == 0.0
    assert turn_square(1.001, 3, (3.0, 0.0, 0.0)) > 9.0


@pytest.mark.parametrize(
    ("J", "D", "gamma"),
    [((1, 2, 4), 1e6, GAMMA), ((0, 1, 2), 3.0, GAMMA), ((1, 2, 4), 3.0, (0.0, 0.0, 1.0))],
    ids=["D = 1e6", "a flat body", "γ along an axis"],
)
def test_the_extremes_are_against_a_taylor_series_too(J, D, gamma):
    ball, momentum = chapsym.Ball(J, D), 0.5 * K
    exact = continuous(ball, momentum, gamma, None, [Fraction(1)], 25)[0, :6].astype(float)
    end = chapsym.extrapolate(ball, momentum, gamma, 0.25, 4)
    # 4 steps of 27 turns, weights with Σ|w| = 54.
    np.testing.assert_allclose([*end.angular_momentum, *end.gamma], exact, rtol=0, atol=4 * 54 * UNIT_ROUNDOFF)


def test_the_integrals_and_the_momentum_in_space_are_kept_at_a_low_order_too():
    start = initial_attitude(True, GAMMA)
    end = chapsym.extrapolate(BALL, K, GAMMA, 0.5, 400, columns=2, attitude=start)
    assert (end.attitude == chapsym.extrapolate(BALL, K, GAMMA, 0.5, 400, columns=2, attitude=True).attitude).all()
    # A turn rounds each of 6 components by a few units; in 400 steps, all of one sign, by 400 times that.
    budget = 400 * 8 * UNIT_ROUNDOFF
    k, g, a = end.angular_momentum, end.gamma, end.attitude
    assert np.abs(np.array([k @ g - K @ GAMMA, k @ k - K @ K, g @ g - GAMMA @ GAMMA])).max() < budget
    assert np.abs(kernels.rotate(a, g) - [0, 0, 1]).max() < budget
    assert np.abs(kernels.rotate(a, k) - kernels.rotate(start, K)).max() < budget
    assert abs(a @ a - 1) < 1e-15
    right = chapsym.extrapolate(BALL, K, GAMMA, 0.5, 400)
    assert np.abs(k - right.angular_momentum).max() > 1e6 * budget  # kept although the state is off
    assert right.attitude is None


def test_in_pairs_the_integrals_do_not_walk():
    kept = []
    for steps in (0, 400):
        end = chapsym.extrapolate(BALL, K, GAMMA, 0.5, steps, columns=2, precision="double-double")
        k, g = exactly(end, "angular_momentum"), exactly(end, "gamma")
        kept.append(np.array([k @ g, k @ k, g @ g]))
    # Two rotations of some dozen roundings each, at the beginning and at the end, and no more for 400 steps.
    assert abs(kept[0] - kept[1]).max() < 64 * 2.0**-104


@pytest.mark.parametrize(
    ("precision", "step", "steps", "off"), [("double", 0.5, 20, 1e-12), ("double-double", 0.25, 8, 1e-15)]
)
def test_back_in_time(precision, step, steps, off):
    """Not to rounding in float64: a step is self-adjoint to the order of its error only; 3e-14 was measured."""
    there = chapsym.extrapolate(BALL, K, GAMMA, step, steps, precision=precision)
    back = chapsym.extrapolate(BALL, there.angular_momentum, there.gamma, -step, steps, precision=precision)
    np.testing.assert_allclose(back.angular_momentum, K, rtol=0, atol=off)


def at_random(n, seed=5):
    """n balls with states at random, |K| from 0.1 to 2."""
    rng = np.random.default_rng(seed)
    K, g = rng.normal(size=(n, 3)), rng.normal(size=(n, 3))
    K *= rng.uniform(0.1, 2.0, (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    for _ in range(2):
        g /= np.linalg.norm(g, axis=1, keepdims=True)
    return chapsym.Ball(rng.uniform(0.1, 2.0, (n, 3)), rng.uniform(0.0, 2.0, n)), K, g


@pytest.mark.parametrize("columns", [2, 4, 6, *slow(3, 5)])
@pytest.mark.parametrize("time_step", [0.05, 0.5])
@pytest.mark.parametrize("heavy", [1.0, 100.0])
def test_lanes_take_the_rotations_of_the_branch(monkeypatch, columns, time_step, heavy):
    """The safe way proves each rotation to be that of the small-rotation branch, or continues it from no rotation.

    The roots agree to roundings; 27 steps of the map, weights with Σ|w| < 60, and 4 long steps: 1e-12 is ample.
    A rounding of K counts D/I times in ω, of heavy balls as many times more.
    """
    ball, K, g = at_random(10)
    ball = chapsym.Ball(ball.mass_tensor, heavy * ball.D, 0.7)
    fast = chapsym.extrapolate(ball, K, g, time_step, 4, columns=columns, contact=True)
    monkeypatch.setattr(lanes, "side_by_side", lambda S, *args: S[lanes.LOST].fill(1.0) or True)
    with in_plain_python():
        safe = chapsym.extrapolate(ball, K, g, time_step, 4, columns=columns, contact=True)
    assert (safe.status == 0).sum() >= 8
    assert (safe.status == fast.status).all()
    for name in ("angular_momentum", "gamma", "attitude", "contact", "doubt"):
        np.testing.assert_allclose(getattr(fast, name), getattr(safe, name), rtol=0, atol=1e-12 * heavy)
        assert (getattr(fast, name) != getattr(safe, name)).any()  # two ways indeed


def everything(found):
    parts = [found.angular_momentum, found.gamma, found.attitude, found.contact, found.doubt]
    if found.low is not None:
        parts += [found.low.angular_momentum, found.low.gamma, found.low.attitude, found.low.contact]
    return [np.asarray(x) for x in parts if x is not None]


@pytest.mark.parametrize(("time_step", "columns"), [(0.3, 6), (2.0, 6), (4.0, 6), (0.7, 2), (0.7, 4)])
def test_a_ball_has_the_same_bits_alone_in_a_batch_and_in_plain_python(time_step, columns):
    """A long time_step takes the safe way for some balls, and stops others; neither touches those beside them."""
    ball, K, g = at_random(11)
    radius, D = np.linspace(0.1, 0.9, 11), ball.D.copy()
    D[5] *= 1e3  # heavy, among those that are not
    ball = chapsym.Ball(ball.mass_tensor, D, radius)
    more = {"columns": columns, "contact": True, "every": 2}
    whole = chapsym.extrapolate(ball, K, g, time_step, 5, **more)
    for n in (2, 8):  # one after another, and a full block
        few = chapsym.Ball(ball.mass_tensor[:n], ball.D[:n], radius[:n])
        found = chapsym.extrapolate(few, K[:n], g[:n], time_step, 5, threads=1, **more)
        for a, b in zip(everything(found), everything(whole), strict=True):
            np.testing.assert_array_equal(a, b[:n])
    for i in range(11):
        one = chapsym.Ball(ball.mass_tensor[i], ball.D[i], radius[i])
        if whole.status[i]:
            with pytest.raises(chapsym.StepNotTaken):
                chapsym.extrapolate(one, K[i], g[i], time_step, 5, **more)
            continue
        found = chapsym.extrapolate(one, K[i], g[i], time_step, 5, **more)
        for a, b in zip(everything(found), everything(whole), strict=True):
            np.testing.assert_array_equal(a, b[i])
    with in_plain_python():
        plain = chapsym.extrapolate(ball, K, g, time_step, 5, **more)
    for a, b in zip(everything(plain), everything(whole), strict=True):
        np.testing.assert_array_equal(a, b)
    assert time_step != 4.0 or 0 < np.isnan(whole.doubt).sum() < 11


def test_a_batch_of_many_has_the_same_bits_on_any_number_of_cores(monkeypatch):
    monkeypatch.setattr(extrapolation, "SHORT_RUN", 1)
    ball, K, g = at_random(45)
    one = chapsym.extrapolate(ball, K, g, 0.4, 60, attitude=True, threads=1)
    two = chapsym.extrapolate(ball, K, g, 0.4, 60, attitude=True, threads=2)
    for a, b in zip(everything(one), everything(two), strict=True):
        np.testing.assert_array_equal(a, b)


def test_in_pairs_a_ball_has_the_same_bits_in_a_batch_and_in_parts(monkeypatch):
    momenta, options = np.array([K, 0.3 * K, -K]), {"contact": True, "precision": "double-double"}
    batch = chapsym.extrapolate(BALL, momenta, GAMMA, 0.4, 5, threads=2, **options)
    monkeypatch.setattr(double_double, "CHUNK", 300)  # two long steps
    for i in range(3):
        alone = chapsym.extrapolate(BALL, momenta[i], GAMMA, 0.4, 5, **options)
        for a, b in zip(everything(alone), everything(batch), strict=True):
            np.testing.assert_array_equal(a, b[i])


@pytest.mark.parametrize("precision", PRECISIONS)
def test_every_state_is_that_of_a_run_which_ends_there(precision):
    given, options = (BALL, K, (-0.768, 0.576, -0.28), 0.4), {"contact": True, "precision": precision}
    options["attitude"] = (0.6, 0.48, 0.64, 0.0)
    run = chapsym.extrapolate(*given, 7, every=3, **options)
    assert run.index.tolist() == [0, 3, 6]
    assert run.contact.shape == (3, 2)
    for frame, steps in enumerate(run.index.tolist()):
        end = chapsym.extrapolate(*given, steps, **options)
        assert end.index is None
        for half, one in [(run, end), (run.low, end.low)][: 1 + (precision != "double")]:
            for name in ("angular_momentum", "gamma", "attitude", "contact"):
                np.testing.assert_array_equal(getattr(half, name)[frame], getattr(one, name))
    assert (run.contact[0] == 0).all()
    batch = chapsym.extrapolate(BALL, [K, 100 * K], GAMMA, 0.5, 7, every=3, precision=precision)
    assert batch.angular_momentum.shape == (2, 3, 3)
    assert np.isnan(batch.gamma[1, 1:]).all()
    assert (batch.gamma[1, 0] == GAMMA).all()
    assert batch.contact is None


def test_the_contact_point_in_axes_of_the_ball_is_that_in_principal_axes():
    turn = np.array([0.8, 0.0, 0.6, 0.0])
    there = chapsym.Ball(BALL.mass_tensor, BALL.D, 0.3, turn)
    k, g = there.from_principal(K), there.from_principal(GAMMA)
    end = chapsym.extrapolate(there, k, g, 0.5, 4, contact=True, every=2)
    space = kernels.rotate(end.attitude, end.angular_momentum)
    np.testing.assert_allclose(space, np.broadcast_to(space[0], space.shape), rtol=0, atol=1e-14)
    start = kernels.compose(initial_attitude(True, g), turn)
    same = chapsym.extrapolate(there.principal, K, GAMMA, 0.5, 4, contact=True, every=2, attitude=start)
    np.testing.assert_allclose(end.contact, same.contact, rtol=0, atol=1e-14)


@pytest.mark.usefixtures("plain")
@pytest.mark.parametrize(("ball", "time_step", "rounds"), [(BALL, 2.1, 3), (BALL, 0.25, 0), (LARGE, 2.1, 3)])
def test_lanes_do_not_need_the_safe_way(monkeypatch, ball, time_step, rounds):
    """Otherwise they would be right, and slow; so they would with poor guesses, which need more rounds.

    At 2.1 three columns are beyond the lemma's bound.
    """
    calls = []
    monkeypatch.setattr(lanes, "long_step", lambda *args: calls.append(1) or (0, 1.0))
    monkeypatch.setattr(lanes, "MOST_ROUNDS", rounds)
    chapsym.extrapolate(ball, K, GAMMA, time_step, 40)
    assert not calls


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("thin", [1.0, 1e-12])
def test_a_top_that_turns_about_its_axis(thin):
    """D = 0 and K along the axis: γ turns about it with ω = K3/I3, as thin as the body may be.

    50 steps with a few roundings each, times Σ|w| = 54.
    """
    top = chapsym.Ball((thin, thin, 1.0), 0.0)
    end = chapsym.extrapolate(top, (0, 0, thin), GAMMA, 0.5, 50)
    angle = -0.5 * 0.5 * 50
    x, y, z = GAMMA
    turned = (x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle), z)
    np.testing.assert_allclose(end.gamma, turned, rtol=0, atol=50 * 4 * 54 * UNIT_ROUNDOFF)
    assert (end.angular_momentum == (0, 0, thin)).all()


@pytest.mark.usefixtures("way")
def test_a_body_too_thin_for_float64_is_refused():
    with pytest.raises(chapsym.StepNotTaken) as caught:
        chapsym.extrapolate(chapsym.Ball((1e-200, 1e-200, 1.0), 0.0), (0, 0, 1e-200), GAMMA, 0.5, 50)
    assert caught.value.status is chapsym.Status.NO_INERTIA


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize(("mass", "time"), [(2.0**-200, 1.0), (2.0**300, 2.0**200), (1.0, 2.0**-400)])
def test_units_do_not_matter(precision, mass, time):
    options = {"contact": True, "precision": precision}
    known = chapsym.extrapolate(chapsym.Ball(BALL.mass_tensor, BALL.D, 0.5), K, GAMMA, 0.5, 2, **options)
    ball = chapsym.Ball(BALL.mass_tensor * mass, BALL.D * mass, 0.5)
    end = chapsym.extrapolate(ball, K * (mass / time), GAMMA, 0.5 * time, 2, **options)
    for found, one in [(end, known), (end.low, known.low)][: 1 + (precision != "double")]:
        assert (found.angular_momentum * (time / mass) == one.angular_momentum).all()
        assert (found.gamma == one.gamma).all()
        assert (found.contact == one.contact).all()


@pytest.mark.usefixtures("way")
def test_in_pairs_what_is_beyond_the_range_is_a_fold_or_stays():
    """A momentum times a time may be beyond float64, where `ldexp` of plain Python raises OverflowError."""
    options = {"steps": 1, "columns": 2, "precision": "double-double"}
    for size, step in ((1e200, 1e300), (1e300, 1e-200)):
        with pytest.raises(chapsym.StepNotTaken):
            chapsym.extrapolate(BALL, size * K, GAMMA, step, **options)
    assert chapsym.extrapolate(BALL, 1e-300 * K, GAMMA, 1e-5, **options).status == chapsym.Status.TAKEN


def test_in_pairs_a_step_may_be_longer_than_one_of_the_map():
    """Columns from n = 1 on would have no rotation where those from 3 on have."""
    assert chapsym.extrapolate(BALL, K, GAMMA, 2.0, 1, precision="double-double").status == chapsym.Status.TAKEN
    with pytest.raises(chapsym.StepNotTaken):
        chapsym.trajectory(BALL, 2.0 * K, GAMMA, 1, precision="double-double")


@pytest.mark.usefixtures("way")
def test_where_nothing_moves():
    for momentum, time_step, steps in ((0 * K, 0.5, 9), (K, 0.0, 9), (K, 0.5, 0), (1e-310 * K, 0.5, 9)):
        end = chapsym.extrapolate(BALL, momentum, GAMMA, time_step, steps)
        assert (end.angular_momentum == momentum).all()
        assert (end.gamma == GAMMA).all()
        # The weights in float64 do not add up to exactly 1 and 0: Σ|w| is 54 and 25.
        assert 0 <= end.doubt <= steps * 2 * (54 + 25) * 2 * UNIT_ROUNDOFF


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_step_beyond_the_fold_raises_for_one_and_is_told_for_a_batch(precision):
    with pytest.raises(chapsym.StepNotTaken) as caught:
        chapsym.extrapolate(BALL, 100 * K, GAMMA, 1.0, 2, precision=precision)
    assert caught.value.index == 0
    assert caught.value.status is chapsym.Status.FOLDED
    batch = chapsym.extrapolate(BALL, [100 * K, K, 1e300 * K], GAMMA, 0.5, 2, precision=precision)
    assert batch.status.tolist() == [chapsym.Status.FOLDED, chapsym.Status.TAKEN, chapsym.Status.FOLDED]
    assert batch.taken.tolist() == [0, 2, 0]
    alone = chapsym.extrapolate(BALL, K, GAMMA, 0.5, 2, precision=precision)
    for a, b in zip(everything(batch), everything(alone), strict=True):
        assert np.isnan(a[[0, 2]]).all()
        assert (a[1] == b).all()


@pytest.mark.parametrize(
    ("args", "kwargs", "words"),
    [
        ((0.5, 1), {"contact": True, "ball": LARGE}, "radius"),
        ((0.1, -1), {}, "steps must be a whole number from 0 on"),
        ((0.1, 1), {"columns": 7}, "columns must be a whole number from 2 to 6"),
        ((0.1, 1), {"columns": 13, "precision": "double-double"}, "columns must be a whole number from 2 to 12"),
        ((0.1, 1), {"precision": "single"}, 'long steps have the precisions "double" and "double-double"'),
        ((0.1, 1), {"precision": "half"}, "precision must be"),
        ((Fraction(10) ** 400, 1), {"precision": "double-double"}, "time_step is beyond the range of float64"),
        ((0.1, 10**13), {"precision": "double-double", "every": 1}, "do not fit into memory"),
        (([0.1, 0.2], 1), {}, "time_step must be one number"),
    ],
)
def test_bad_input_gets_one_sentence(args, kwargs, words):
    with pytest.raises(chapsym.BadInput, match=words):
        chapsym.extrapolate(kwargs.pop("ball", BALL), K, GAMMA, *args, **kwargs)


BITS = """
import hashlib, numpy as np, chapsym
ball = chapsym.Ball.from_inertia([[3, 0.1, 0.2], [0.1, 3.3, 0.05], [0.2, 0.05, 4]], D=2.0)
K = np.random.default_rng(1).normal(size=(20, 3))
found = [ball.axes, chapsym.roll(ball, K[0], 0.01, 60).momentum, chapsym.roll(ball, K, 0.01, 10).gamma]
print(hashlib.sha256(b"".join(np.ascontiguousarray(x).tobytes() for x in found)).hexdigest())
"""


def test_the_bits_of_a_motion_do_not_depend_on_what_blas_the_processor_gets():
    """OpenBLAS has other kernels for other processors; where NumPy has another BLAS, the names change nothing."""
    found = {
        subprocess.run(
            [sys.executable, "-c", BITS], env=os.environ | {"OPENBLAS_CORETYPE": name}, capture_output=True, text=True,
            check=True,
        ).stdout
        for name in ("Haswell", "Prescott")
    }  # fmt: skip
    assert len(found) == 1


@pytest.mark.parametrize("balls", [(), (9,)])
def test_a_long_run_goes_in_parts_to_the_bit_so_that_it_can_be_interrupted(balls, monkeypatch):
    momenta, steps, seen = np.tile(0.1 * K, (*balls, 1)), 100, []

    def rolled(steps, progress=seen.append):
        return chapsym.extrapolate(BALL, momenta, GAMMA, 0.5, steps, columns=6, threads=1, progress=progress)

    whole = rolled(steps)
    monkeypatch.setattr(extrapolation, "CHUNK", 7 * extrapolation.stages_of(6))
    del seen[:]
    parts = rolled(steps)
    assert len(seen) > 2
    assert seen[-1] == steps * (balls or (1,))[0]
    for name in ("angular_momentum", "gamma", "doubt", "taken", "status"):
        np.testing.assert_array_equal(getattr(parts, name), getattr(whole, name))

    def stop(_):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rolled(10**15, stop)


def test_balls_that_stop_end_a_long_run():
    steps = 10**13  # which would take years
    assert (chapsym.extrapolate(BALL, np.tile(1e3 * K, (9, 1)), GAMMA, 0.5, steps).taken == 0).all()
    with pytest.raises(chapsym.StepNotTaken):
        chapsym.extrapolate(BALL, 1e3 * K, GAMMA, 0.5, steps)
