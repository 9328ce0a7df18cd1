"""Proved steps and runs: the bounds contain the error that an independent orbit sees, and are little more than it."""

import copy
from fractions import Fraction as F

import numpy as np
import pytest
from budget import slow
from crowds import NAMES, balls, beyond, floats_of, long_steps
from orbits import context, orbit

import chapsym
from chapsym import BadInput, Ball, Digits, Status, StepNotTaken
from chapsym import generated as kernels
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.dynamics.levels import double_double
from chapsym.dynamics.levels import proved as level
from chapsym.dynamics.levels.frames import Balls
from chapsym.dynamics.loops import proved
from chapsym.numbers.loose import Loose

BALL = Ball((0.1, 0.5, 1.6), 0.7, radius=0.5)
ROLLED = Ball.from_mass_tensor((0.003, 0.005, 0.009), mass=2.0, radius=0.1)
GAMMA = (2 / 7, 3 / 7, 6 / 7)


def momentum(size):
    """𝒦 with this length, of a ball with I_min = 0.6 and the bound of `small-branch` at 0.43."""
    return size * np.array([4, -2, 3]) / np.sqrt(29)


def off(found, exact):
    """|found - exact| of numbers of any kind, in 60 digits."""
    mp = context(60)
    return mp.sqrt(sum((mp.mpf(float(x)) - mp.mpf(y)) ** 2 for x, y in zip(found, exact, strict=True)))


def in_pairs(step, exact, name):
    """The error of a step in float64 by one in double-double."""
    high, low = getattr(exact, name), getattr(exact.low, name)
    return np.linalg.norm((getattr(step, name) - high) - low, axis=-1)


# -- steps


@pytest.mark.parametrize("made", [balls, long_steps, beyond])
def test_the_bounds_of_a_step_contain_the_error(made):
    """Balls of every kind, by a step in double-double; every small step is proved, and the bound is of a few ulps."""
    ball, K, g = made(300)
    found, exact = chapsym.step(ball, K, g, proved=True), chapsym.step(ball, K, g, precision="double-double")
    taken, sizes = found.status == Status.TAKEN, {"momentum": np.linalg.norm(K, axis=1), "gamma": 1.0, "rotation": 1.0}
    for name, size in sizes.items():
        bound = getattr(found.proved, name)
        assert (in_pairs(found, exact, name) <= bound)[taken].all()
        assert np.isnan(bound[~taken]).all()
        if made is not beyond:
            few = (bound < 64 * 2.0**-53 * np.maximum(size, 1e-290)) | ~taken
            # At rest or nearly, where the bound is that of what underflows; near a fold; D/I = 10¹⁴.
            assert set(np.flatnonzero(~few)) <= {1, 2, 4, 7}
    proof = np.isfinite(found.proved.momentum)
    assert proof.mean() > (0.8 if made is beyond else 0.98)
    assert np.array_equal(found.momentum, chapsym.step(ball, K, g).momentum, equal_nan=True)


@pytest.mark.parametrize("D", [0.0, 1e-6, 1.0, 1e6])
@pytest.mark.parametrize("J", [(1, 2, 4), (0, 1, 3), (1e-7, 1, 1), (1, 1, 1), (1e200, 2e200, 2.5e200)])
def test_bounds_of_one_step_of_odd_bodies(J, D):
    """Flat, slender and homogeneous bodies of any D, by a step of 50 digits: none is much above its error."""
    rng, D = np.random.default_rng(7), D * max(J)
    for size in (1e-12, 1e-3, 0.1, 0.4):
        g = rng.normal(size=3)
        g /= np.linalg.norm(g)
        K = rng.normal(size=3)
        K *= size / np.linalg.norm(K) * (sum(J) - max(J))
        step, exact = chapsym.step(Ball(J, D), K, g, proved=True), chapsym.step(Ball(J, D), K, g, precision=Digits(50))
        for name, unit in (("momentum", size * (sum(J) - max(J))), ("gamma", 1.0), ("rotation", 1.0)):
            seen, bound = off(getattr(step, name), getattr(exact, name)), getattr(step.proved, name)
            assert seen <= bound <= 2 * seen + 40 * 2.0**-53 * unit


def test_a_wrong_rotation_has_a_bound_that_contains_it():
    """The bound is of the very numbers: of a rotation that is off, whoever found it, it is as large."""
    step = chapsym.step(BALL, momentum(0.2), GAMMA)
    one = [np.array([x], dtype=float) for x in (momentum(0.2), GAMMA, BALL.mass_tensor)]
    ball = Balls(*one, BALL.D.reshape(1), np.zeros(1))
    for wrong in (1e-12, 1e-8):
        q = step.rotation + wrong * np.array([0.0, 1.0, -1.0, 0.5])
        bound = level.of_step(ball, (q / np.linalg.norm(q))[None], step.momentum[None], step.gamma[None])[0]
        assert 1.4 * wrong < bound[2] < 10 * wrong
        assert 0.2 * wrong < bound[0] < 10 * wrong
    moved = level.of_step(ball, step.rotation[None], step.momentum[None] + [1e-9, 0, 0], step.gamma[None])[0]
    assert 1e-9 <= moved[0] < 1.001e-9


# -- runs


@pytest.mark.parametrize(("order", "size"), [(2, 0.03), (2, 0.55), (4, 0.2), *slow((2, 0.4), (8, 0.1))])
def test_the_bounds_of_a_run_are_the_errors_that_the_oracle_sees(order, size):
    """With attitude and contact, within the bound of `small-branch` and beyond it; the bound is the error itself."""
    steps = 15 if order == 2 else 4
    g, start = (0.0, 1.0, 0.0), (0.5, 0.5, 0.5, 0.5)  # R γ = e₃ exactly, as the oracle's contact point has it
    run = chapsym.trajectory(BALL, momentum(size), g, steps, order=order, attitude=start, contact=True, proved=True)
    exact = orbit(BALL, momentum(size), g, steps, COMPOSITIONS[order].exact, digits=40, attitude=start)
    assert run.proved.steps == steps
    for k in range(1, steps + 1):
        K, g, _, spot = exact[k]
        for name, truth, scale in (
            ("momentum", K, size),
            ("gamma", g, 1.0),
            ("contact", [x / 2 for x in spot[:2]], 0.5),
        ):
            seen, bound = off(getattr(run, name)[k], truth), getattr(run.proved, name)[k]
            assert seen <= bound <= 1.001 * seen + 1e-19 * scale


def test_the_bounds_are_those_of_a_certificate():
    """By Arb's balls, an enclosure of its own: 1100 steps, past a restoration, of float64 and of pairs."""
    for precision in ("double", "double-double"):
        run = chapsym.trajectory(BALL, momentum(0.1), GAMMA, 1100, every=550, contact=True, precision=precision,
                                 proved=True)  # fmt: skip
        wanted = chapsym.certify(run)
        for name in NAMES:
            bound, error = getattr(run.proved, name)[1:], getattr(wanted, f"{name}_error")[1:]
            assert (error <= bound * (1 + 1e-9)).all()
            assert (bound <= 1.001 * error + 1e-19).all()


def test_a_run_without_a_proof_is_the_same_run():
    ball, K, g = balls(12)
    ball = Ball(ball.mass_tensor, ball.D, radius=1.0)
    for options in ({}, {"contact": True}, {"precision": "double-double"}, {"order": 4}):
        plain, proof = (chapsym.trajectory(ball, K, g, 30, every=4, **options, proved=x) for x in (False, True))
        for x, y in zip(floats_of(plain), floats_of(proof), strict=True):
            assert np.array_equal(x, y, equal_nan=True)
        assert np.array_equal(plain.taken, proof.taken)
        assert np.array_equal(plain.status, proof.status)
        assert plain.proved is None
        assert proof.proved.momentum.shape == proof.momentum.shape[:-1]


def test_where_a_proof_ends():
    """Near a fold the lemmas do not reach: inf from there on, which `steps` names; a run that stops has its bounds."""
    with pytest.raises(StepNotTaken) as stopped:
        chapsym.trajectory(Ball((1, 2, 4), 3), (4.32, -2.16, 3.24), GAMMA, 10, proved=True)
    run = stopped.value.trajectory
    assert len(run.proved.momentum) == len(run.momentum) == 4
    finite = np.isfinite(run.proved.momentum)
    assert finite.tolist() == sorted(finite, reverse=True)
    assert run.proved.steps == finite.sum() - 1 < 3
    ball = chapsym.Stepper(Ball((1, 2, 4), 3), (4.32, -2.16, 3.24), GAMMA)
    with pytest.raises(StepNotTaken):
        ball.step(9)
    assert np.isinf(ball.proved.gamma)
    assert ball.proved.steps == 0


def test_a_momentum_that_is_tiny_is_not_proved_in_a_run():
    """It is taken larger there, as another ball is; a step says a bound of what underflows."""
    run = chapsym.trajectory(BALL, (1e-250, 0, 0), GAMMA, 3, proved=True)
    assert run.proved.steps == 0
    assert np.isinf(run.proved.gamma[1:]).all()
    assert np.isfinite(chapsym.step(BALL, (1e-250, 0, 0), GAMMA, proved=True).proved.gamma)


def in_numbers(v):
    """A vector as numbers of mpmath."""
    return [context(50).mpf(float(x)) for x in v]


def turned(v, q):
    """Ω v for a quaternion of any length."""
    q0, *x = q
    found = kernels.compose(*kernels.compose(*q, 0, *v), q0, *(-y for y in x))
    return [y / sum(z * z for z in q) for y in found[1:]]


def moved(u, g):
    """The way of the contact point in a step, in the body frame before it, in radii."""
    n = 1 + sum(x * x for x in u)
    return [2 * x / n for x in kernels.compose(0, *u, 0, *g)[1:]]


#: Bounds of three edges, the ball, and what k̃ and γ̃ are off by; D.
SETS = {
    "edges": ((3e-10, 1e-8, 1e-7), 0.0, 0.0, 0.7),
    "ball": ((0.0, 0.0, 0.0), 1e-8, 0.0, 0.7),
    "off": ((0.0, 0.0, 0.0), 1e-14, 1e-9, 0.7),
    "heavy": ((3e-17, 1e-15, 3e-16), 0.0, 0.0, 1e7),
}


@pytest.mark.parametrize("kind", SETS)
@pytest.mark.parametrize("size", [0.3, 0.55, *slow(0.05)])
def test_a_set_after_a_step_contains_what_its_corners_become(size, kind, thorough):
    """By steps of 45 digits from states that are turned by ξ; and one of edges is hardly larger."""
    mp, rng, (bounds, ball, away, D) = context(50), np.random.default_rng(2), SETS[kind]
    if size > 0.5:  # beyond the bound of `small-branch` smaller sets are followed
        bounds, ball, away = [1e-6 * x for x in bounds], 1e-6 * ball, 1e-6 * away
    for trial in range(3 if thorough else 1):
        K, g, J = momentum(size) * rng.choice([-1, 1], 3), np.eye(3)[trial], np.roll(BALL.mass_tensor, trial)
        I = [Loose(J[1] + J[2], 0.0), Loose(J[0] + J[2], 0.0), Loose(J[0] + J[1], 0.0)]
        shown = K * (1 + 0.9 * away), g + 0.9 * away * np.eye(3)[trial - 1]  # as the march has them
        q = exact_step_of(Ball(J, D), *shown)
        march = [Loose(float(x), float(x - mp.mpf(float(x)))) for x in (y / q[0] for y in q[1:])]
        u = [mp.mpf(x.high) + mp.mpf(x.low) for x in march]
        edges, box = rng.normal(size=(3, 3)), np.zeros(proved.ROWS)
        box[:9], box[9:12], box[12] = edges.reshape(-1), bounds, ball
        box[proved.K_OFF] = box[proved.G_OFF] = away
        slopes = proved.slope_of(K / 2, [x.high for x in I], D)
        assert (slopes[1] == proved.BEYOND) == (size > 0.5)
        with np.errstate(all="ignore"):
            proved.carried(box, march, *([Loose(x, 0.0) for x in v] for v in (shown[0] / 2, shown[1])), I, D, *slopes)
        if kind == "heavy" and size > 0.5:  # there `straight-path` is too near its end for D/I = 10⁷
            assert box[12] == np.inf
            continue
        Q, largest = np.linalg.inv(box[:9].reshape(3, 3).T), np.zeros(3)
        for signs in np.ndindex(2, 2, 2):
            side = rng.normal(size=3)
            xi = in_numbers((np.array(signs) * 2 - 1) * bounds @ edges + ball * side / np.linalg.norm(side))
            back = [mp.mpf(1), *(-x for x in xi)]
            k, vertical = (turned(in_numbers(v), back) for v in (K, g))
            found = exact_step_of(Ball(J, D), k, vertical)
            after = [x / found[0] for x in found[1:]]
            total = kernels.compose(*kernels.compose(1, *(-x for x in u), 1, *xi), 1, *after)
            z = np.abs(Q @ [float(x / total[0]) for x in total[1:]])
            assert np.all(z <= (box[9:12] + box[12] * np.linalg.norm(Q, axis=1)) * (1 + 1e-12))
            largest = np.maximum(largest, z)
            spot = turned(moved(after, vertical), [1, *xi])
            assert (
                off([0, 0, 0], [x - y for x, y in zip(spot, moved(u, in_numbers(g)), strict=True)]) <= box[proved.X_OFF]
            )
        if kind == "edges":
            assert np.all(largest > 0.9 * box[9:12] - 1e-12)
            row = np.zeros(4)
            proved.write_spread(row, box)
            most = proved.extent(box)
            assert 2 * most <= row[0] <= 2.001 * most + 1e-12
            assert 2 * most <= row[1] <= 2.001 * most + 1e-12
            assert most <= row[2] <= 1.001 * most + 1e-12


def exact_step_of(ball, K, g):
    """The rotation of a step from numbers of mpmath."""
    return [context(50).mpf(x) for x in chapsym.step(ball, np.array(K, dtype=object), np.array(g, dtype=object),
                                                     precision=Digits(45)).rotation]  # fmt: skip


# -- a Stepper


@pytest.mark.parametrize("order", [2, 4])
def test_a_stepper_has_the_bounds_of_the_run(order):
    """Asked for now and then, after a copy, and anew after another momentum."""
    run = chapsym.trajectory(BALL, momentum(0.2), GAMMA, 60, order=order, contact=True, proved=True)
    ball = chapsym.Stepper(BALL, momentum(0.2), GAMMA, order=order, contact=True)
    assert ball.proved.steps == 0
    for steps in (1, 2, 0, 37, 20):
        ball.step(steps)
        for name in NAMES:
            assert getattr(ball.proved, name) == pytest.approx(getattr(run.proved, name)[ball.taken], rel=1e-9)
        assert ball.proved.steps == ball.taken
    other = copy.copy(ball)
    for one in (ball, other):
        one.momentum = momentum(0.1)
        one.step(5)
    assert ball.proved.momentum == other.proved.momentum
    again = chapsym.trajectory(BALL, momentum(0.1), run.gamma[-1], 5, order=order, proved=True)
    assert ball.proved.momentum == pytest.approx(again.proved.momentum[-1], rel=1e-9)


# -- what is refused


TURNED = Ball.from_inertia(np.array([[3, 0.1, 0], [0.1, 4, 0], [0, 0, 5.0]]), mass=1.0, radius=1.0)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        *((lambda p=p: chapsym.trajectory(BALL, (0, 0, 0.1), GAMMA, 2, precision=p, proved=True),
           "proved=True takes the precisions") for p in ("single", Digits(30))),
        *((lambda p=p: chapsym.step(BALL, (0, 0, 0.1), GAMMA, precision=p, proved=True),
           'a step is proved in "double"') for p in ("single", Digits(30))),
        (lambda: chapsym.step(TURNED, (0, 0, 0.1), GAMMA, proved=True), "what is proved is of principal axes"),
        (lambda: chapsym.trajectory(TURNED, (0, 0, 0.1), GAMMA, 3, proved=True), "what is proved is of principal axes"),
        (lambda: chapsym.step(BALL, (0, 0, 0.1), GAMMA, proved="yes"), "proved must be True or False"),
        (lambda: chapsym.roll(ROLLED, np.ones((2, 3)), 0.1, 3, proved=True), "takes one ball in principal axes"),
    ],
)  # fmt: skip
def test_what_is_not_proved_is_refused(call, said):
    with pytest.raises(BadInput, match=said):
        call()


# -- the constants


class Rounded:
    """What an operation of pairs errs by at most, on the text of a kernel, in powers of u = 2⁻⁵³.

    terms: a bound of the sum of the absolute values of what makes the number; the low half is at most `low` u terms,
    and the pair off by at most `error` u² terms.  A loose sum rounds low halves twice, a product four times and leaves
    out one (`numbers.pairs`); a part more covers what is of higher order.
    """

    def __init__(self, terms, low=F(0), error=F(0)):
        self.terms, self.low, self.error = F(terms), F(low), F(error)

    @staticmethod
    def of(x):
        return x if isinstance(x, Rounded) else Rounded(abs(x))

    def __add__(self, other):
        other = self.of(other)
        low = max(self.low, other.low)
        return Rounded(self.terms + other.terms, 1 + low + F(1, 2**20), max(self.error, other.error) + 2 * low + 2)

    def __neg__(self):
        return self

    def __mul__(self, other):
        other, exact = self.of(other), isinstance(other, int) and other in (1, 2)
        if exact:  # a power of two
            return Rounded(self.terms * other.terms, self.low, self.error)
        low = self.low + other.low
        error = self.error + other.error + self.low * other.low + 3 * low + 2
        return Rounded(self.terms * other.terms, 1 + low + F(1, 2**20), error)

    def __rtruediv__(self, other):
        """By a sum of squares: what divides is its terms.  The quotient of pairs errs by 15 u² ([JMP] algorithm 17)."""
        return Rounded(self.of(other).terms / self.terms, 1, self.error + 16)

    __radd__ = __sub__ = __rsub__ = __add__
    __rmul__ = __mul__


def of(name, *groups):
    """What a kernel errs by on pairs, its numbers at most as large as is said; floats where `low` is 0."""
    arguments = [Rounded(size, low) if size != 1 or low else 1 for size, low, count in groups for _ in range(count)]
    return getattr(kernels, name)(*arguments)


def test_what_kernels_in_pairs_err_by():
    """160 u² of the terms, and the terms of unit vectors: 8(most |u| + |k|) and what `EVALUATED` has room for."""
    u, unit, I = (1, 1, 3), (1, 1, 3), (1, 1, 3)
    residual = of("gibbs_residual", u, unit, unit, I, (1, 1, 1))
    turned = of("turn", (1, 0, 1), u, unit)
    assert max(x.error for x in (*residual, *turned)) <= 160
    rng = np.random.default_rng(3)
    for _ in range(60):
        u, k, g, I, D = (
            rng.normal(size=3),
            rng.normal(size=3),
            rng.normal(size=3),
            rng.uniform(0.01, 1, 3),
            10 * rng.random(),
        )
        u, g = u * rng.random() / np.linalg.norm(u), g / np.linalg.norm(g)
        size = np.linalg.norm(u)
        terms = [float(x.terms) for x in kernels.gibbs_residual(*(Rounded(abs(F(x))) for x in (*u, *k, *g, *I, D)))]
        assert np.linalg.norm(terms) <= 8 * (1 + size) * ((max(I) + D) * size + np.linalg.norm(k))
        turned = [float(x.terms) for x in kernels.turn(1, *(Rounded(abs(F(x))) for x in (*u, *g)))]
        assert np.linalg.norm(turned) <= 8 * size
        a = rng.normal(size=4)
        a /= np.linalg.norm(a)
        q = [Rounded(abs(F(x)), 2, 30) for x in (1.0, *u)]
        spot = kernels.rotate(
            *(Rounded(abs(F(x)), 1) for x in a), *kernels.centre_step(*q, *(Rounded(abs(F(x)), 1) for x in g))
        )
        assert float(max(x.error for x in spot)) * np.linalg.norm([float(x.terms) for x in spot]) <= 2**13 * size
    assert proved.EVALUATED >= 8 * 160 * 2.0**-106
    assert proved.PAIR >= 4 * 2.0**-106


def test_edges_that_are_made_orthogonal_contain_the_set():
    """Of flat sets and points, too."""
    rng = np.random.default_rng(4)
    for kind in range(60):
        box = np.zeros(proved.ROWS)
        edges = rng.normal(size=(3, 3)) * 10.0 ** rng.uniform(-6, 3, (3, 1))
        if kind % 4 == 1:
            edges[1] = edges[0] * 1.5
        if kind % 4 == 2:
            edges[1:] = 0.0
        box[:9], box[9:12], box[12] = edges.reshape(-1), 10.0 ** rng.uniform(-9, 0, 3), 10.0 ** rng.uniform(-12, -6)
        before = box.copy()
        proved.squared(box)
        Q, b = box[:9].reshape(3, 3), box[9:12]
        assert np.abs(Q @ Q.T - np.eye(3)).max() < 1e-13
        assert box[12] == 0.0
        for _ in range(20):
            z, e = rng.choice([-1, 1], 3) * before[9:12], rng.normal(size=3)
            point = z @ edges + before[12] * e / np.linalg.norm(e)
            assert np.all(np.abs(Q @ point) <= b * (1 + 1e-12))


# -- the motion of the ball


def test_bounds_of_a_rolled_ball_are_of_its_motion():
    """By a certified motion of more digits; they are below the estimate, and little more than the error."""
    run = chapsym.roll(ROLLED, (1.0, 2.0, 3.0), 0.25, 8, accuracy=1e-7, contact=True, every=2, proved=True)
    K = [F(float(x)) / F(0.25) for x in run.momentum[0]]
    exact = chapsym.certified_motion(
        ROLLED, K, run.gamma[0], [F(1, 2) * i for i in range(5)], 24, attitude=run.attitude[0]
    )
    size = np.linalg.norm(run.momentum[0])
    for name, truth, unit in (
        ("momentum", exact.angular_momentum, size), ("gamma", exact.gamma, 1.0), ("attitude", exact.attitude, 1.0),
        ("contact", exact.contact, 0.1),
    ):  # fmt: skip
        for k in range(1, 5):
            middle = [context(60).mpf(str(x.mid().str(40, radius=False))) for x in truth[k]]
            middle = [x / 4 for x in middle] if name == "momentum" else middle
            seen, bound = off(getattr(run, name)[k], middle), getattr(run.proved, name)[k]
            if name == "attitude":
                seen = min(seen, off(-run.attitude[k], middle))
            assert seen <= bound * (1 + 1e-12) <= seen * 1.01 + 1e-9 * unit
            assert bound <= run.error * unit
    assert run.proved.steps == 8


def test_a_map_that_is_rolled_is_proved_as_a_run():
    run = chapsym.roll(ROLLED, (1.0, 2.0, 3.0), 0.1, 9, map=True, proved=True)
    again = chapsym.trajectory(ROLLED, run.momentum[0], run.gamma[0], 9, proved=True)
    assert np.array_equal(run.proved.gamma, again.proved.gamma)


# -- what an independent reader found


def test_a_stepper_with_another_momentum_has_a_contact_point_that_is_not_0():
    """Its rounding in the sum is counted: without, 9 of 80 legs were outside."""
    rng, ball = np.random.default_rng(11), Ball((0.1, 0.5, 1.6), 0.7, radius=1.0)
    stepper = chapsym.Stepper(ball, (0.1, 0.02, 0.05), (0, 0, 1), contact=True)
    for _ in range(20):
        stepper.step(int(rng.integers(1, 9)))
        start, g, a, K = stepper.contact, stepper.gamma, stepper.attitude, rng.uniform(-0.1, 0.1, 3)
        stepper.momentum = K
        stepper.step(7)
        exact = chapsym.trajectory(ball, K, g, 7, attitude=a, contact=True, precision="double-double")
        truth = [F(x) + F(y) + F(z) for x, y, z in zip(start, exact.contact[-1], exact.low.contact[-1], strict=True)]
        away = [float(F(x) - y) for x, y in zip(stepper.contact, truth, strict=True)]
        assert np.hypot(*away) <= stepper.proved.contact <= np.hypot(*away) * 1.01 + 1e-25


@pytest.mark.parametrize("K", [(2e-311, -1e-311, 3e-311), (2e-308, -1e-308, 1e-307)])
def test_bounds_of_subnormal_momenta_are_not_rounded_to_less(K):
    ball = Ball((1e-303, 2e-303, 4e-303), 3e-303)
    step, exact = chapsym.step(ball, K, GAMMA, proved=True), chapsym.step(ball, K, GAMMA, precision=Digits(60))
    assert off(step.momentum, exact.momentum) <= context(60).mpf(float(step.proved.momentum))


def test_a_path_of_a_tiny_ball_is_a_sum_of_rounded_parts():
    run = chapsym.trajectory(Ball((0.1, 0.5, 1.6), 0.7, 1e-310), (0.03, 0.01, -0.02), (0, 0, 1), 400, every=40,
                             contact=True, proved=True)  # fmt: skip
    assert (chapsym.certify(run).contact_error <= run.proved.contact).all()


def test_bounds_that_do_not_fit_into_memory(monkeypatch):
    def full(*arguments, **options):
        raise MemoryError

    monkeypatch.setattr(level, "errors", full)
    with pytest.raises(BadInput, match="4 frames of 1 balls do not fit into memory"):
        chapsym.trajectory(BALL, momentum(0.1), GAMMA, 3, proved=True)


def test_squares_that_underflow_are_not_lost():
    """Of a rotation that is none, for a momentum whose squares underflow."""
    one = [np.array([x], dtype=float) for x in ((2e-170, 0, 0), (0, 1, 0), (1, 1e-160, 1e-160))]
    bound = level.of_step(Balls(*one, np.zeros(1), np.zeros(1)), np.array([[1.0, 0, 0, 0]]), *one[:2])[0]
    assert bound[2] > 4e-11


def test_a_heavy_ball_is_followed():
    """D/I = 10⁸, where 1/m is far more than most residuals take."""
    ball = Ball((1, 1.5, 1.2), 1e8)
    run = chapsym.trajectory(ball, (0.3, 0.2, 0.15), (0, 0.6, 0.8), 40, every=8, proved=True)
    assert run.proved.steps == 40
    assert (chapsym.certify(run).gamma_error <= run.proved.gamma * (1 + 1e-9)).all()


@pytest.mark.parametrize("options", [{}, {"map": True}, {"map": True, "precision": "double-double"}])
def test_a_position_at_the_start_is_in_the_bounds_of_a_rolled_ball(options):
    """What the sum with it rounds; in double-double it keeps 31 digits."""
    place = np.array([1000.3, -7.1])
    runs = [
        chapsym.roll(ROLLED, (1.0, 2.0, 3.0), 0.1, 6, contact=True, proved=True, **options, **more)
        for more in ({}, {"position": place})
    ]
    spots = [[F(float(x)) for x in run.contact.flat] for run in runs]
    if runs[0].low is not None:
        spots = [[x + F(float(y)) for x, y in zip(one, run.low.contact.flat, strict=True)]
                 for one, run in zip(spots, runs, strict=True)]  # fmt: skip
    moved = np.array([float(y - x - F(float(place[i % 2]))) for i, (x, y) in enumerate(zip(*spots, strict=True))])
    rounded = np.linalg.norm(moved.reshape(-1, 2), axis=1)
    here, there = (run.proved.contact for run in runs)
    assert (rounded <= there - here).all()
    assert (there - here < 1e-12 if runs[0].low is None else there < 1e-26).all()


@pytest.mark.parametrize("after", [False, True])
def test_the_proof_of_a_stepper_can_be_interrupted_and_goes_on(after, monkeypatch):
    """Python raises it before a compiled call, or right after the one in which it arrives."""
    whole, parts = (chapsym.Stepper(BALL, momentum(0.03), GAMMA) for _ in range(2))
    for one in (whole, parts):
        one.step(100)
    bound = whole.proved.momentum
    monkeypatch.setattr(double_double, "CHUNK", 30)
    take, calls = double_double.OneBall.take, []

    def interrupted(*given):
        calls.append(given)
        if len(calls) == 3 and not after:
            raise KeyboardInterrupt
        found = take(*given)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return found

    monkeypatch.setattr(double_double.OneBall, "take", interrupted)
    with pytest.raises(KeyboardInterrupt):
        _ = parts.proved
    assert parts.proved.momentum == bound
    assert parts.proved.steps == 100
