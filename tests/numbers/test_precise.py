"""Steps at any precision: mpmath and Arb against the independent oracle."""

import os
import threading
from fractions import Fraction as F

import flint
import mpmath
import numpy as np
import pytest
from budget import examples
from hypothesis import given

from chapsym import BadInput, StepNotTaken, generated, testing
from chapsym.dynamics.levels import proved_root, start
from chapsym.dynamics.loops import branch
from chapsym.dynamics.map import exact_step
from chapsym.dynamics.oracle import Oracle
from chapsym.numbers import Digits, Double, DoubleDouble, Enclosure, precisions

J, D = (F(1), F(2), F(4)), F(3)
K, GAMMA = (F(1), F(-1, 2), F(3, 4)), (F(2, 7), F(3, 7), F(6, 7))


def truth(J, D, K, gamma, digits):
    """The oracle's step, from exact input."""
    context = mpmath.MPContext()
    context.dps = digits + 20
    mpf = lambda x: context.mpf(x.numerator) / x.denominator  # noqa: E731
    found = Oracle([mpf(x) for x in J], mpf(D), [mpf(x) for x in gamma], digits).step([mpf(x) for x in K])
    return [found.q0, *found.q, *found.momentum, *found.gamma]


def flat(written):
    return [written["q0"], *written["q"], *written["momentum"], *written["gamma"]]


def right(written, exact, digits):
    """Whether numbers are those of the oracle to so many digits.

    Those with a radius are within it, too, and have their digits beside the length of their vector, as is said of them.
    """
    lengths = [max(map(abs, exact[at])) for at in (slice(0, 4), slice(4, 7), slice(7, 10))]
    for i, (text, value) in enumerate(zip(flat(written), exact, strict=True)):
        mpf = value.context.mpf
        middle, _, radius = text.strip("[]").partition(" +/- ")
        size = lengths[(i >= 4) + (i >= 7)] if radius else abs(value)
        assert abs(mpf(middle) - value) <= min(size * mpf(10) ** (1 - digits), mpf(radius or "inf"))


@pytest.mark.parametrize("digits", [5, 30, 50, 200])
@pytest.mark.parametrize("scale", [F(1), F(1, 10**400)])
def test_digits_are_correct_to_the_last_one(digits, scale):
    """Those of a momentum below the range of float64, too."""
    momentum = [x * scale for x in K]
    written = exact_step(J, D, momentum, GAMMA, Digits(digits)).write()
    right(written, truth(J, D, momentum, GAMMA, digits + 10 + (400 if scale < 1 else 0)), digits)
    assert scale < 1 or all(len(text.lstrip("-0.").replace(".", "")) == digits for text in flat(written))


@pytest.mark.parametrize("exponent", [3, 11, 12, 25])
@pytest.mark.parametrize(("precision", "digits"), [(Digits(20), 20), (Enclosure(66), 19)])
@pytest.mark.parametrize("K", [(F(3, 20), F(-1, 10), F(0)), (F(0), F(3, 2), F(-1, 2))], ids=["across", "any"])
def test_a_stiff_ball_gets_all_its_digits(exponent, precision, digits, K):
    """D = 10^exponent costs digits in float64, which finds no start from 10^12 on; the precisions above carry more."""
    D = F(10**exponent)
    K = tuple(x * D for x in K) if K[2] == 0 else K  # along the vertical the ball bears only a momentum like J
    right(exact_step(J, D, K, GAMMA, precision).write(), truth(J, D, K, GAMMA, 2 * exponent + 60), digits)


@given(testing.rational_rotations(), testing.rational_unit_vectors(), testing.rational_balls())
@examples(15)
def test_the_slope_of_the_enclosure_is_the_derivative(q, gamma, ball):
    """F is quadratic, so a central difference is exact: on fractions `_slope` must equal it."""
    J, D = ball
    w, step = (F(1, 3), F(-2), F(5, 7)), F(1, 2)

    def value(point):
        scale = 1 + sum(x * x for x in point)
        moved = generated.momentum(*generated.compose(*q, F(1), *point), *gamma, *J, D)
        return [m - k * scale for m, k in zip(moved, K, strict=True)]

    tangent, hessian = (f(*q, *gamma, *J, D) for f in (generated.tangent_jacobian, generated.tangent_hessian))
    slope = proved_root._slope(tangent, hessian, K, w)
    for j in range(3):
        ahead, behind = ([x + s * step * (i == j) for i, x in enumerate(w)] for s in (1, -1))
        difference = [(a - b) / (2 * step) for a, b in zip(value(ahead), value(behind), strict=True)]
        assert [slope[3 * i + j] for i in range(3)] == difference


def test_the_interval_test_itself_finds_the_root(monkeypatch):
    """Without refinement the float64 root is off by 1e-16, and the one interval Newton step must put that right."""
    monkeypatch.setattr(proved_root, "refined", lambda q, *_: tuple(x.mid() for x in proved_root.unit(q)))
    precision, near = Enclosure(200), start.start(K, GAMMA, J, D)
    with flint.ctx.workprec(400):
        given = [tuple(map(precision.number, x)) for x in (near, K, GAMMA, J, (D,))]
        for enclosure, value in zip(proved_root.enclosed(*given), truth(J, D, K, GAMMA, 80)[:4], strict=True):
            assert enclosure.overlaps(flint.arb(str(value)) + flint.arb(0, "1e-70"))
            assert enclosure.rad() < flint.arb("1e-28")


@pytest.mark.parametrize("precision", [Double(), Digits(20), Enclosure(80)])
def test_precisions_make_and_write_numbers(precision):
    with precision.working():
        assert str(precision.write(precision.number(F(3, 2)))).startswith(("1.5", "[1.5"))


@pytest.mark.parametrize("digits", range(12, 24, 3))
def test_no_number_of_digits_is_float64_in_disguise(digits):
    """The float64 start is unit to 1e-16 only, and its first correction is as small."""
    J = (F(232, 97), F(166, 97), F(290, 97))
    K = (F(1050671085365083, 2361183241434822606848), F(2450623061553463, 2251799813685248), F(1, 10**6))
    right(exact_step(J, F(0), K, GAMMA, Digits(digits)).write(), truth(J, F(0), K, GAMMA, 50), digits)


@pytest.mark.parametrize(
    ("precision", "exponent", "digits"),
    [(precision, n, 18) for precision in (Digits(20), Enclosure(66)) for n in (-900, -400, 400, 900)]
    + [(DoubleDouble(), n, 30.5) for n in (-240, -120, 100, 300)],
)
def test_units_are_no_matter(precision, exponent, digits):
    """J, D and 𝒦 in other units: the same rotation, and the momenta by as much; also beyond the range of float64.

    Products of pairs underflow long before their halves do: the step is taken in units of the ball.
    """
    unit = F(10) ** exponent
    plain = exact_step(J, D, K, GAMMA, Digits(40)).write()
    found = exact_step([unit * x for x in J], unit * D, [unit * x for x in K], GAMMA, precision).write()
    mp = mpmath.MPContext()
    mp.dps = 50
    for name, scale in (("q", 1), ("gamma", 1), ("momentum", mp.mpf(10) ** exponent)):
        for text, exact in zip(found[name], plain[name], strict=True):
            middle = text.strip("[]").split(" +/- ")[0]
            assert abs(mp.mpf(middle) / scale / mp.mpf(exact) - 1) < mp.mpf(10) ** -digits


@pytest.mark.parametrize("precision", [Digits(20), Enclosure(66)])
def test_momenta_beyond_the_range_of_float64_are_unreachable_or_folded(precision):
    with pytest.raises(StepNotTaken, match="no rotation of this ball"):
        exact_step(J, D, [x * 10**400 for x in K], GAMMA, precision)


def test_the_continuation_is_the_same_on_other_numbers():
    """`branch.small_rotation` with mpmath's numbers agrees with float64, in what it attains too."""
    context = mpmath.MPContext()
    context.dps = 30
    for factor in (0.1, 1.0, 1.15, 5.0):
        state = [factor * float(x) for x in K], [2 / 7, 3 / 7, 6 / 7], [1.0, 2.0, 4.0]
        status, reach, *q = branch.small_rotation(*state[0], *state[1], *state[2], 3.0)
        found = start.on(context)(*([context.mpf(x) for x in v] for v in state), context.mpf(3))
        assert found[0] == status
        assert abs(found[1] - reach) < 1e-9
        if status == 0:
            assert all(abs(a - b) < 1e-12 for a, b in zip(found[2], q, strict=True))


def test_a_body_and_a_state_are_checked_at_any_size():
    tiny, unit, rest = F(1, 10**400), F(10) ** 310, (F(0),) * 3
    nearly = (F(3, 5), F(4, 5) + F(1, 10**20), F(0))  # unit to 20 digits
    for state, precision, said in (
        (((tiny, tiny, -tiny), tiny, rest, GAMMA), Digits(20), "negative moment"),
        ((J, -tiny, K, GAMMA), Digits(20), "must not be negative"),
        (((F(0), F(0), tiny), F(0), rest, GAMMA), Digits(20), "no inertia about one of its axes"),
        (([x * unit for x in J], D * unit, [unit / 10] * 3, GAMMA), DoubleDouble(), "beyond the range of float64"),
        ((J, D, (F(1), F(0), 1 / unit**2), GAMMA), DoubleDouble(), "below the range of float64"),
        ((J, D, K, nearly), Digits(30), "give it exactly"),
        ((J, D, K, nearly), Enclosure(100), "give it exactly"),
    ):
        with pytest.raises(BadInput, match=said):
            exact_step(*state, precision)
    for precision in (Double(), Digits(15)):
        exact_step(J, D, K, nearly, precision)


@pytest.mark.parametrize(("make", "field", "least"), [(Digits, "count", 1), (Enclosure, "bits", 2)])
@pytest.mark.parametrize("value", [0, 10**9, -3, 2.5, True, "x", None], ids=repr)
def test_a_precision_takes_a_whole_number_of_digits_that_memory_holds(make, field, least, value):
    with pytest.raises(ValueError, match=rf"{field} of {make.__name__} must be a whole number from {least} to"):
        make(value)
    if value not in (0, 10**9):
        with pytest.raises(ValueError, match=f"guard of {make.__name__} must be a whole number from 0"):
            make(30, guard=value)
    assert make(np.int64(30), np.int8(5)) == make(30, 5)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks here")
def test_a_process_that_is_forked_while_another_thread_counts_counts_too():
    counting, done = threading.Event(), threading.Event()

    def count():
        with Enclosure(60).working():
            counting.set()
            done.wait()

    thread = threading.Thread(target=count)
    thread.start()
    counting.wait()
    child = os.fork()
    if child == 0:
        os._exit(0 if precisions.FLINT.acquire(blocking=False) else 1)
    done.set()
    thread.join()
    assert os.waitpid(child, 0)[1] == 0


def test_bits_are_those_of_before_where_an_interrupt_delays_the_end_of_a_block():
    """The inner block ends when its generator is freed, after the outer one."""
    before = flint.ctx.prec
    outer, inner = precisions.flint_bits(100), precisions.flint_bits(90)
    outer.__enter__()
    inner.__enter__()
    outer.__exit__(None, None, None)
    inner.gen.close()
    assert flint.ctx.prec == before
    alone = precisions.flint_bits(90)
    alone.__enter__()
    alone.gen.close()
    assert flint.ctx.prec == before
