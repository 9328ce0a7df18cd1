"""The step of the checker against Newton's iteration in mpmath."""

from fractions import Fraction

import mpmath as mp
import pytest
from certificate_maker import travelled

from chapsym.checker.interval import Interval, Rejected
from chapsym.checker.linear import cross
from chapsym.checker.step import Ball, check_small_branch, gibbs_vector, moved, tangents

BITS = 240
J, D = (1, 2, 4), Fraction(7, 2)
BALL = Ball.within([Fraction(x) for x in J], D, Fraction(0), BITS)
MOMENTUM, GAMMA = (Fraction(1), Fraction(-1, 2), Fraction(3, 4)), (Fraction(2, 7), Fraction(3, 7), Fraction(6, 7))
VECTORS = [[1, 0, 0, 0, 0, 0], [0, 0, 0, 0, 1, 0], [1, 2, -1, 3, -2, 1]]


def enclosed(numbers):
    return [Interval.enclosing(Fraction(x), Fraction(x), BITS) for x in numbers]


def value(x):
    assert x.hi - x.lo < 2**20, "an enclosure much wider than the last bits"
    return mp.mpf(x.lo + x.hi) / mp.mpf(2) ** (BITS + 1)


def of(fraction):
    return mp.mpf(fraction.numerator) / fraction.denominator


def stepped(x):
    """(Ωᵀ𝒦, Ωᵀγ) and the Gibbs vector of a state of six numbers of mpmath."""
    after, [u] = travelled(J, of(D), (mp.matrix(x[:3]), mp.matrix(x[3:])), 1)
    return [*after[0], *after[1]], u


@pytest.fixture(scope="module")
def step():
    with mp.workdps(70):
        start = [of(x) for x in (*MOMENTUM, *GAMMA)]
        _, true = stepped(start)
        near = [Fraction(int(mp.nint(x * 10**40)), 10**40) for x in true]
        state = enclosed(MOMENTUM), enclosed(GAMMA)
        yield start, state, gibbs_vector(BALL, state, [x.point() for x in enclosed(near)]), true


def test_the_gibbs_vector_and_the_state_after_it_are_those_of_mpmath(step):
    start, state, u, true = step
    assert [x.lo >> BITS for x in cross(enclosed((1, 2, 3)), enclosed((4, 5, 6)))] == [-3, 6, -3]
    assert all(abs(value(x) - t) < mp.mpf(10) ** -65 for x, t in zip(u, true, strict=True))
    after = [value(x) for v in moved(u, state) for x in v]
    assert max(abs(a - b) for a, b in zip(after, stepped(start)[0], strict=True)) < mp.mpf(10) ** -65


def test_the_derivative_is_that_of_the_step(step):
    """Central differences with h = 1e-20: an error of h² = 1e-40, times third derivatives of size 10."""
    start, state, u, _ = step
    h = mp.mpf(10) ** -20
    found = tangents(BALL, state, u, [(enclosed(v[:3]), enclosed(v[3:])) for v in VECTORS])
    for v, pair in zip(VECTORS, found, strict=True):
        there, back = (stepped([x + s * h * y for x, y in zip(start, v, strict=True)])[0] for s in (1, -1))
        for x, a, b in zip([*pair[0], *pair[1]], there, back, strict=True):
            assert abs(value(x) - (a - b) / (2 * h)) < mp.mpf(10) ** -37


def test_a_momentum_as_large_as_the_least_moment_is_named():
    for size in ("3", "7"):
        with pytest.raises(Rejected, match="least moment of inertia"):
            check_small_branch(BALL, enclosed([size])[0])


def test_the_root_beyond_a_right_angle_is_refused():
    """𝒦 = γ = e3, I3 = 3: 3u = ½(1 + u²) has the roots 3 ± √8."""
    state, near = (enclosed((0, 0, 1)), enclosed((0, 0, 1))), [Fraction(0), Fraction(0)]
    for root in ("0.171573", "5.828427"):
        u = [x.point() for x in enclosed([*near, root])]
        if root < "1":
            gibbs_vector(BALL, state, u)
        else:
            with pytest.raises(Rejected, match=r"\|u\| < 1"):
                gibbs_vector(BALL, state, u)


def test_the_bound_of_the_small_branch_is_where_it_should_be():
    """I = (6, 5, 3): ϱ(3/2 + |𝒦|) < 3 with ϱ = tan ½ arcsin(|𝒦|/3) holds up to |𝒦| = 2.8126…."""
    with mp.workdps(30):
        bound = mp.findroot(lambda k: mp.tan(mp.asin(k / 3) / 2) * (1.5 + k) - 3, (2.6, 2.9), solver="anderson")
        least = Fraction(mp.nstr(bound - mp.mpf(10) ** -15, 25))
    for size in (Fraction(1, 10), least):
        check_small_branch(BALL, enclosed([size])[0])
    with pytest.raises(Rejected, match="beyond the bound"):
        check_small_branch(BALL, enclosed([least + Fraction(2, 10**15)])[0])


@pytest.mark.parametrize(
    ("J", "D", "radius"),
    [((-1, 2, 4), 1, 0), ((0, 1, 2), 1, "1/10"), ((0, 0, 1), 1, 0), ((1, 2, 4), 0, 0), ((1, 2, 4), -1, 0),
     ((1, 2, 4), "1/10", "1/10")],
)  # fmt: skip
def test_what_is_no_ball_is_refused(J, D, radius):
    with pytest.raises(Rejected):
        Ball.within([Fraction(x) for x in J], Fraction(D), Fraction(radius), BITS)
