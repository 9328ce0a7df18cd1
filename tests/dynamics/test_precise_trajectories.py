"""Trajectories and steps at any precision, against the independent oracle."""

import copy
import pickle
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from decimal import Decimal
from fractions import Fraction as F
from functools import partial

import flint
import mpmath
import numpy as np
import pytest
import sympy
from budget import examples, slow
from hypothesis import assume, given
from orbits import context, from_quaternion, orbit

import chapsym
from chapsym import BadInput, Status, StepNotTaken, generated, testing
from chapsym.dynamics import kernels
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.dynamics.levels import balls, dispatch
from chapsym.dynamics.loops.branch import small_rotation
from chapsym.dynamics.map import exact_step
from chapsym.numbers import Digits, Enclosure, precisions
from chapsym.numbers.precisions import flint_bits
from chapsym.rationals import exact_fraction

BALL = chapsym.Ball((0.1, 0.5, 1.6), 0.7, radius=0.5)
DIRECTION = np.array([4, -2, 3]) / np.sqrt(29)
GAMMA = (2 / 7, 3 / 7, 6 / 7)
#: An attitude for `orbit`: that which trajectories start from.
LEAST = "least"
FOLDING = chapsym.Ball((1, 2, 4), 3), (3.9, -1.95, 2.925)


def off(found, exact):
    """The largest difference of an array of mpf from a list of vectors, beside the length of the vector."""
    worst = 0
    for a, b in zip(found, exact, strict=True):
        size = max(abs(x) for x in b) or 1
        worst = max(worst, *(abs(y - x) / size for x, y in zip(a, b, strict=True)))
    return worst


def contains(balls, exact, digits):
    """Whether every ball of an array contains the oracle's value, which is right to `digits` digits."""
    with flint.ctx.workprec(int(digits * 3.33) + 60):
        for ball, value in zip(np.ravel(balls), exact, strict=True):
            truth = flint.arb(mpmath.nstr(value, digits + 15)) + flint.arb(0, f"1e-{digits}")
            if not ball.overlaps(truth):
                return False
    return True


@pytest.mark.parametrize("size", [0.05, 0.4])
def test_digits_are_the_oracles_step_by_step_and_balls_contain_it_and_are_small(size, thorough):
    steps, bits = 12, 200
    exact = orbit(BALL, size * DIRECTION, GAMMA, steps, digits=130, attitude=LEAST)
    for digits in (15, 30, 50, 100, 120) if thorough else (15, 100):
        run = chapsym.trajectory(BALL, size * DIRECTION, GAMMA, steps, contact=True, precision=Digits(digits))
        mp = context(digits + 20)
        assert off(run.momentum, [list(e[0]) for e in exact]) < mp.mpf(10) ** -digits
        assert off(run.gamma, [list(e[1]) for e in exact]) < mp.mpf(10) ** -digits
        for k, (_, _, R, r) in enumerate(exact):
            assert off(from_quaternion(mp, run.attitude[k]), R) < 4 * mp.mpf(10) ** -digits
            trace = [x / 2 for x in r[:2]]
            assert max(abs(x - y) for x, y in zip(run.contact[k], trace, strict=True)) < mp.mpf(10) ** -digits
    run = chapsym.trajectory(BALL, size * DIRECTION, GAMMA, steps, contact=True, precision=Enclosure(bits))
    for k, (K, g, R, r) in enumerate(exact):
        assert contains([*run.momentum[k], *run.gamma[k]], [*K, *g], 70)
        assert contains(run.contact[k], [x / 2 for x in r[:2]], 70)
        with flint.ctx.workprec(300):
            matrix = generated.rotation(*run.attitude[k])
        assert contains(matrix, [x for row in R for x in row], 70)
        for array in (run.momentum[k], run.gamma[k], run.attitude[k]):
            assert max(x.rad() for x in array) <= max(abs(x).mid() for x in array) * flint.arb(2) ** (2 - bits)


@pytest.mark.parametrize("order", [2, 4, 6, 8])
def test_orders_are_compositions_with_the_exact_coefficients(order):
    stages, steps = COMPOSITIONS[order].exact, 3 if order == 2 else 1
    exact = orbit(BALL, 0.2 * DIRECTION, GAMMA, steps, stages, digits=50)
    run = chapsym.trajectory(BALL, 0.2 * DIRECTION, GAMMA, steps, order=order, precision=Digits(45))
    assert off(run.momentum, [list(e[0]) for e in exact]) < 1e-45
    assert off(run.gamma, [list(e[1]) for e in exact]) < 1e-45
    balls = chapsym.trajectory(BALL, 0.2 * DIRECTION, GAMMA, steps, order=order, contact=True, precision=Enclosure(150))
    for k, (K, g, _, _) in enumerate(exact):
        assert contains([*balls.momentum[k], *balls.gamma[k]], [*K, *g], 48)
    rough = tuple(F(float(c)) for c in stages)  # the control: 40 digits are not those of float64
    if order > 2:
        other = orbit(BALL, 0.2 * DIRECTION, GAMMA, steps, rough, digits=50)
        assert off(run.gamma, [list(e[1]) for e in other]) > 1e-20
        assert not contains(balls.gamma[steps], list(other[steps][1]), 48)


@given(testing.states(fraction=(0.05, 0.95)))
@examples(4, 25)
def test_three_steps_of_any_state_are_enclosed(state):
    """Inside the bound of the lemma and beyond it, degenerate and stiff balls."""
    ball, momentum, gamma = state
    try:
        run = chapsym.trajectory(ball, momentum, gamma, 3, precision=Enclosure(120))
        digits = chapsym.trajectory(ball, momentum, gamma, 3, precision=Digits(30))
    except StepNotTaken as stop:
        assert stop.index > 0 or float(ball.D) > 1e3  # noqa: PT017 - the first step exists
        assume(False)
    exact = orbit(ball, momentum, gamma, 3, digits=60)
    assert off(digits.momentum, [list(e[0]) for e in exact]) < 1e-29
    assert off(digits.gamma, [list(e[1]) for e in exact]) < 1e-29
    scale = float(np.abs(momentum).max()) or 1.0
    for k, (K, g, _, _) in enumerate(exact):
        assert contains([x / scale for x in run.momentum[k]], [x / scale for x in K], 55)
        assert contains(run.gamma[k], list(g), 55)
        assert max(x.rad() for x in run.gamma[k]) < flint.arb(2) ** -117


@pytest.mark.parametrize("size", [0.4, *slow(0.05)])
def test_hundreds_of_steps_keep_all_their_bits(size):
    run = chapsym.trajectory(BALL, size * DIRECTION, GAMMA, 300, every=300, precision=Enclosure(200))
    more = chapsym.trajectory(BALL, size * DIRECTION, GAMMA, 300, every=300, precision=Digits(80))
    for enclosed, numbers in ((run.momentum[-1], more.momentum[-1]), (run.gamma[-1], more.gamma[-1])):
        assert contains(enclosed, list(numbers), 75)
        assert max(x.rad() for x in enclosed) <= max(abs(x).mid() for x in enclosed) * flint.arb(2) ** -198
    fewer = chapsym.trajectory(BALL, size * DIRECTION, GAMMA, 300, every=300, precision=Digits(30))
    assert off(fewer.momentum, [list(x) for x in more.momentum]) < 1e-30


@pytest.mark.parametrize("precision", ["single", "double-double", Digits(30), Enclosure(100)], ids=str)
def test_a_fold_on_the_way_stops_with_the_trajectory_before_it(precision):
    ball, K = FOLDING
    with pytest.raises(StepNotTaken) as plain:
        chapsym.trajectory(ball, K, GAMMA, 100)
    with pytest.raises(StepNotTaken) as caught:
        chapsym.trajectory(ball, K, GAMMA, 100, contact=False, precision=precision)
    assert (caught.value.index, caught.value.status) == (plain.value.index, Status.FOLDED)
    before = caught.value.trajectory
    assert before.momentum.shape == (plain.value.index + 1, 3)
    batch = chapsym.trajectory(ball, [np.array(K) / 10, K], GAMMA, plain.value.index + 2, precision=precision)
    assert batch.status.tolist() == [Status.TAKEN, Status.FOLDED]
    assert batch.taken.tolist() == [plain.value.index + 2, plain.value.index]
    assert all(x != x for x in batch.momentum[1, -1])


def test_steps_come_in_batches_and_refuse_what_trajectories_refuse():
    ball = chapsym.Ball([(1, 2, 4), (0.1, 0.5, 1.6)], 3)
    found = chapsym.step(ball, [(1, -0.5, 0.75), (40, 0, 0)], GAMMA, precision=Digits(20))
    assert found.status.tolist() == [Status.TAKEN, Status.UNREACHABLE]
    assert found.rotation.shape == (2, 4)
    assert all(x != x for x in found.rotation[1])
    with pytest.raises(StepNotTaken, match="no rotation of this ball"):
        chapsym.step(BALL, (40, 0, 0), GAMMA, precision=Enclosure(60))


@pytest.mark.parametrize("precision", [Digits(30), Enclosure(100)])
def test_integrals_and_energies_are_in_the_numbers_of_the_precision(precision):
    run = chapsym.roll(BALL, (1, 2, 3), 0.01, 30, precision=precision)
    drift = run.invariants()[-1] - run.invariants()[0]
    assert all(abs(x) < 1e-28 for x in drift)
    assert abs(run.kinetic_energy()[0] - chapsym.roll(BALL, (1, 2, 3), 0.01, 30).kinetic_energy()[0]) < 1e-12


def test_the_precision_of_others_is_left_alone():
    before = mpmath.mp.prec, flint.ctx.prec
    chapsym.trajectory(BALL, 0.3 * DIRECTION, GAMMA, 5, precision=Digits(60))
    chapsym.trajectory(BALL, 0.3 * DIRECTION, GAMMA, 5, precision=Enclosure(300))
    assert (mpmath.mp.prec, flint.ctx.prec) == before


def test_threads_do_not_change_the_digits_of_each_other():
    """flint has one precision for all threads."""
    run = partial(chapsym.trajectory, BALL, 0.3 * DIRECTION, GAMMA, 150, every=150)
    precisions = [Digits(300), Digits(15), Enclosure(700), Digits(60), Enclosure(60)]
    alone = [run(precision=p).momentum[-1].tolist() for p in precisions]
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        with ThreadPoolExecutor(len(precisions)) as pool:
            together = list(pool.map(lambda p: run(precision=p).momentum[-1].tolist(), precisions))
    finally:
        sys.setswitchinterval(before)
    for one, other in zip(alone, together, strict=True):
        assert list(map(str, one)) == list(map(str, other))


def test_a_point_that_is_no_root_costs_digits_and_no_truth(monkeypatch):
    """The enclosure does not depend on the point: with two thirds of its bits the truth is still inside."""
    root = balls.root

    def less_precise(*given):
        point, start = root(*given)
        return tuple((x * (1 + flint.arb(2) ** -60)).mid() for x in point), start

    monkeypatch.setattr(balls, "root", less_precise)
    run = chapsym.trajectory(BALL, 0.4 * DIRECTION, GAMMA, 2, precision=Enclosure(90))
    exact = orbit(BALL, 0.4 * DIRECTION, GAMMA, 2, digits=80)
    assert contains([*run.momentum[-1], *run.gamma[-1]], [*exact[-1][0], *exact[-1][1]], 70)


@pytest.mark.parametrize("bits", [60, 100, 319, 321, 700, 3000])
@pytest.mark.parametrize("size", [0.4, 1e-200])
def test_roots_are_roots_at_any_precision(bits, size):
    state = (list(map(F, v)) for v in (size * DIRECTION, np.array(GAMMA), BALL.mass_tensor))
    ball = balls.DigitsBall(Digits(int(bits * 0.3)), (*state, F(0.7), (F(1),), None, 0.0))
    with flint.ctx.workprec(ball.precision):
        u, _ = ball._root(ball.k, [])
        left = generated.gibbs_residual(*u, *ball.k, *ball.g, *ball.I, ball.D)
        unit = size * flint.arb(2) ** -ball.root_bits
        assert all(abs(x.mid()) < 64 * unit for x in left)
        assert any(abs(x.mid()) > unit / 64 for x in left)  # the control: the numbers have no more bits than they say


def test_progress_counts_the_steps_of_all_balls():
    seen = []
    chapsym.trajectory(BALL, [0.1 * DIRECTION] * 2, GAMMA, 450, every=450, precision=Digits(15), progress=seen.append)
    assert seen == [200, 400, 450, 650, 850, 900]


def test_more_bits_than_can_be_carried_are_refused_in_one_sentence(monkeypatch):
    monkeypatch.setattr("chapsym.dynamics.levels.balls.MOST_GUARD", 10)
    with pytest.raises(BadInput, match=r"after step \d+ of 1000, 70 bits leave less than 60"):
        chapsym.trajectory(BALL, 0.4 * DIRECTION, GAMMA, 1000, precision=Enclosure(60, guard=10))


@given(testing.states(fraction=(0.05, 1.0)), testing.unit_vectors())
@examples(40)
def test_what_is_certified_is_monotone_and_contains_the_root(state, direction):
    """Lemma small-branch in balls, on numbers: in the ball ∂G/∂u has at least the slope m, and the root is in it."""
    ball, momentum, gamma = state
    ratio = (ball.mass_tensor.sum() + float(ball.D)) / np.sort(ball.inertia)[0]
    assume(ratio < 1e4)
    with flint.ctx.workprec(150):
        given = (list(map(F, v)) for v in (momentum, gamma, ball.mass_tensor))
        under_way = balls.ArbBall(150, (*given, F(float(ball.D)), (F(1),), None, 0.0))
        bound = under_way.bounds[0]
        inertia, contact = np.array(list(map(float, under_way.I))), float(under_way.D)
        k = np.array(list(map(float, under_way.k)))
    assume(bound is not None)
    radius, slope = map(float, bound)
    status, _, q0, *q = small_rotation(*momentum, *gamma, *ball.mass_tensor, float(ball.D))
    assert status == 0
    assert np.linalg.norm(q) / q0 <= radius * (1 + 1e-12)
    u = radius * direction
    ahead, behind = (
        kernels.kernel("gibbs_residual")(u + s * np.eye(3), k, gamma, inertia, contact) for s in (0.5, -0.5)
    )
    matrix = (ahead - behind).T  # G is quadratic: the central difference is exact
    assert np.linalg.eigvalsh((matrix + matrix.T) / 2)[0] >= slope - 1e-12 * (inertia.max() + contact)


@pytest.mark.parametrize("precision", ["double-double", Digits(20), Enclosure(80)], ids=str)
def test_reverse_refuses_what_it_would_round(precision):
    run = chapsym.trajectory(BALL, 0.1 * DIRECTION, GAMMA, 3, precision=precision)
    with pytest.raises(BadInput, match="reverse goes back in"):
        chapsym.reverse(run)


@pytest.mark.parametrize("momentum", [(100, 0, 0), (0.1, 0.05, 0.2)])
def test_the_fewest_bits_without_a_guard_have_an_end(momentum):
    """As no bits are left at the first step, there is no cost of a step, and no guard could be doubled."""
    ball = chapsym.Ball((1, 2, 4), 3, 1.0)
    with nullcontext() if momentum[0] < 1 else pytest.raises(StepNotTaken, match="no rotation"):
        run = chapsym.trajectory(ball, momentum, (0.6, 0, 0.8), 2, contact=True, precision=Enclosure(2, guard=0))
        fine = chapsym.trajectory(ball, momentum, (0.6, 0, 0.8), 2, contact=True)
        assert all(x.contains(float(y)) for x, y in zip(run.gamma[-1], fine.gamma[-1], strict=True))


def test_few_bits_of_a_heavy_ball_get_as_many_guards_as_they_need():
    """Twice the guard does not prove the second step; four times does."""
    ball = chapsym.Ball((1.779423646749144, 0.7875892554488442, 1.325351855087655), 9949625772.676554)
    K = (0.028855133210578584, -0.04534716690488444, -0.09916930020971375)
    gamma = (0.8775927590707405, -0.34737600149091397, 0.33039501027526086)
    few = chapsym.trajectory(ball, K, gamma, 2, order=8, precision=Enclosure(40))
    many = chapsym.trajectory(ball, K, gamma, 2, order=8, precision=Enclosure(300))
    for one, other in zip(few.momentum[-1], many.momentum[-1], strict=True):
        assert one.contains(other)


MADE = {
    "Fraction": lambda x: x,
    "Decimal": lambda x: Decimal(x.numerator) / Decimal(x.denominator),
    "mpf": lambda x: mpmath.mpf(x.numerator) / x.denominator,
    "sympy": lambda x: sympy.Rational(x.numerator, x.denominator),
}


@pytest.mark.parametrize("kind", MADE)
def test_exact_numbers_reach_digits_and_enclosures_as_they_are(kind):
    texts = "1/3 2/7 5/3", "3/7", "1/3 -1/7 3/11", "2/7 3/7 6/7"
    with mpmath.workdps(70):
        J, D, K, g = ([MADE[kind](F(x)) for x in some.split()] for some in texts)
    exact = [[exact_fraction(x) for x in some] for some in (J, K, g)]
    assert exact[0][0] != F(1 / 3)
    digits = Digits(25 if kind == "Decimal" else 60)
    wanted = exact_step(exact[0], exact_fraction(D[0]), exact[1], exact[2], digits).momentum
    ball = chapsym.Ball(J, D[0])
    first = chapsym.step(ball, K, g, precision=digits).momentum
    last = chapsym.trajectory(ball, K, g, 1, precision=digits).momentum[1]
    assert first.tolist() == last.tolist() == wanted.tolist()
    orbit = chapsym.certify(chapsym.trajectory(ball, K, g, 1, precision=digits), bits=128)
    assert max(orbit.momentum_error) < max(10.0 ** (2 - digits.count), 1e-38)
    enclosed = chapsym.step(ball, K, g, precision=Enclosure(60)).momentum
    with flint.ctx.workprec(400):
        for x, y in zip(enclosed, wanted, strict=True):
            assert x.overlaps(flint.arb(flint.fmpq(*exact_fraction(y).as_integer_ratio())))
            assert x.rad() < 1e-15
    moments = [MADE[kind](F(x)) for x in ("1/2", "2/3", "3/4")]
    half = sum(map(exact_fraction, moments)) / 2
    assert chapsym.Ball.from_inertia(moments, D=1).exact[0].tolist() == [half - exact_fraction(x) for x in moments]


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))])
@pytest.mark.parametrize("precision", [Digits(20), Enclosure(80)])
def test_results_can_be_copied_and_go_to_other_processes(copied, precision):
    run = chapsym.trajectory(BALL, 0.1 * DIRECTION, GAMMA, 3, precision=precision, time_step=0.1)
    proved = chapsym.certify(run)
    again = copied(proved)
    assert again.trajectory.precision == precision
    assert again.write() == proved.write()
    assert repr(again.trajectory.omega) == repr(run.omega)
    assert repr(again.gamma) == repr(proved.gamma)
    assert again.trajectory.gamma.dtype == object


@pytest.mark.parametrize("radius", [0, 1e-30, 0.75, float("inf")])
def test_a_copy_of_a_ball_is_the_same_to_the_bit(radius):
    with flint_bits(300):
        for ball in (
            flint.arb(1) / 3 + flint.arb(0, radius),
            flint.arb(2) ** -5000 + flint.arb(0, radius),
            flint.arb("nan"),
        ):
            again = copy.deepcopy(ball)
            assert repr(again) == repr(ball)
            if ball.is_finite():
                assert again.mid().man_exp() == ball.mid().man_exp()
                assert again.rad().man_exp() == ball.rad().man_exp()


def test_a_step_of_the_most_bits_takes_no_more(monkeypatch):
    for module in (precisions, dispatch):
        monkeypatch.setattr(module, "MOST_BITS", 10_000)
    assert chapsym.step(BALL, 1e-60 * DIRECTION, GAMMA, precision=Enclosure(10_000)).status == Status.TAKEN
