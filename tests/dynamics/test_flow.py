"""What the enclosure of a motion rests on: polynomials in balls, and the lemma of the deviation."""

import random
from fractions import Fraction as F

import numpy as np
import pytest
from flint import arb, arb_poly, ctx
from motion_truth import Truth, matrix_of, number

from chapsym import generated
from chapsym.dynamics.flow import deviation, series
from chapsym.dynamics.flow import path as paths
from chapsym.dynamics.flow.path import Path
from chapsym.dynamics.levels.proved_root import TooWide, upper
from chapsym.dynamics.levels.start import fraction

BITS = 120
J, D = (1, 2, 4), 3
ATTITUDE, K = (1, 2, -1, 3), (3, 1, 4)
NONE_INSIDE, ROTOR = (0, 0, 0), (-2, 5, 3)


def begun(attitude=ATTITUDE, radius=None, rotor=NONE_INSIDE):
    with ctx.workprec(BITS):
        given = (tuple(map(arb, x)) for x in (K, attitude))
        return Path(BITS, tuple(map(arb, J)), arb(D), *given, radius, tuple(map(arb, rotor)))


def test_a_polynomial_that_is_cut_contains_the_whole():
    rng = random.Random(1)
    for _ in range(20):
        x = [F(rng.randint(-9, 9), rng.randint(1, 9)) for _ in range(15)]
        (low,) = deviation.cut([arb_poly([number(c) for c in x])], 4)
        assert low.length() <= 5
        for time in (F(0), F(1, 3), F(1)):
            value = sum(c * time**i for i, c in enumerate(x))
            assert low(number(time)).contains(number(value))
            assert abs(low(number(time)) - number(value)).abs_lower() == 0


def polynomials(path, length=F(1, 2), corrected=True, spoilt=0.0):
    """The series of a step, its polynomials, what they leave, and hK."""
    with ctx.workprec(BITS):
        floats, length = path._series(length, 1.0)
        k = tuple(number(length) * x for x in path.k)
        body = path.body.during(number(length))
        if corrected:
            p, w, found = path._mended(floats, k, body)
        else:
            p = [deviation.exact(x) for x in poly(floats.a)]
            w = [deviation.exact(x) for x in poly(floats.w)]
            p = [deviation.exact(x - x(0) + y) for x, y in zip(p, path.p, strict=True)]
            p[1] = p[1] + arb_poly([0, 0, spoilt])
            w[2] = w[2] + arb_poly([0, 10 * spoilt])
            found = deviation.defects(p, w, k, body, 90)
        return floats, p, w, found, k, length


def poly(rows):
    return [arb_poly(row.astype(float).tolist()) for row in rows]


def true_gibbs(p, a):
    """ξ of the motion a = p∘(1, ξ) beside p."""
    q = generated.compose(p[0], -p[1], -p[2], -p[3], *a)
    return [x / q[0] for x in q[1:]]


def neighbour(start, inside=NONE_INSIDE):
    """The motion from an attitude, with the same K in space, by the other way."""
    with ctx.workprec(480):
        R0 = matrix_of([arb(x) for x in ATTITUDE])
        k = [sum(R0[i][j] * K[j] for j in range(3)) for i in range(3)]
        R = matrix_of(start)
        body = [sum(R[i][j] * k[i] for i in range(3)) for j in range(3)]
        own = [x - y for x, y in zip(body, inside, strict=True)]
        w = [fraction(x) for x in generated.angular_velocity(*own, *R[2], *J, D)]
        return Truth(J, D, w, [fraction(x) for x in start], rotor=inside)


def true_attitude(start, length, inside=NONE_INSIDE):
    """A quaternion of it after `length`."""
    with ctx.workprec(480):
        (a, b, c), (d, e, f), (g, h, i) = neighbour(start, inside).at(length)["rows"]
        q0 = (1 + a + e + i).sqrt() / 2
        return q0, (h - f) / (4 * q0), (c - g) / (4 * q0), (d - b) / (4 * q0)


def off_by(xi0, floats, p, w, found, k, path, length, inside=NONE_INSIDE):
    """How far the neighbour at ξ0 is from where the lemma puts it, the bound of that, and |ξ0|."""
    with ctx.workprec(480):
        start = generated.compose(*path.p, 1, *map(arb, xi0))
        a = true_attitude(start, length, inside)
        xi1 = true_gibbs([x(arb(1)) for x in p], a)
    with ctx.workprec(128):
        size = upper([arb(x) for x in xi0])
        step = deviation.deviation(floats, w, upper(k), found, path.body.during(number(length)), size)
        ends = [sum((step.M[i, j] * xi0[j] for j in range(3)), arb(0)) for i in range(3)]
        return upper([x - y for x, y in zip(xi1, ends, strict=True)]), step, upper(xi1), size


NEIGHBOURS = [(1e-3, -2e-3, 1e-3), (0.0, 0.0, 1e-3), (0.0, 1e-3, 0.0), (1e-3, 0.0, 0.0), (1e-6, 1e-6, -1e-6)]


@pytest.mark.parametrize("inside", [NONE_INSIDE, ROTOR])
@pytest.mark.parametrize("xi0", NEIGHBOURS)
def test_a_neighbour_is_where_the_lemma_says(xi0, inside):
    """Beside the motion itself: M to the first order, `more` for the second; neither more than a few hundred |ξ|²."""
    path = begun(rotor=inside)
    off, step, far, size = off_by(xi0, *(made := polynomials(path))[:5], path, made[5], inside)
    assert off <= step.more
    assert far <= step.within
    assert step.more < 2000 * size * size


@pytest.mark.parametrize("xi0", [(6e-4, -6e-4, 5e-4), (0.0, 0.0, -9e-4), (9e-4, 0.0, 0.0)])
def test_neighbours_are_in_the_frames(xi0):
    """Of a path that does not know its start to 1e-3: within the step and at its end, the contact point, too."""
    path = begun(radius=arb(1))
    truth = neighbour(generated.compose(*path.p, 1, *map(arb, xi0)))
    with ctx.workprec(BITS):
        path.spread.restart(arb("1e-3"))
        path.advance(F(1, 2))
        for time in (F(1, 5), F(1, 2)):
            assert path.time == F(1, 2)
            found, true = path.frame(time), truth.at(time)
            for name in ("gamma", "angular_momentum", "omega", "contact"):
                assert all(x.contains(y) for x, y in zip(found[name], true[name], strict=True)), name
                assert max(x.rad() for x in found[name]) < 0.3, name


def test_a_matrix_that_is_wrong_costs_width_and_not_truth():
    path = begun()
    made = polynomials(path)
    spoilt = made[0].Phi.copy()
    spoilt[1] += 0.01
    off, step, _, size = off_by(NEIGHBOURS[-1], made[0]._replace(Phi=spoilt), *made[1:5], path, made[5])
    assert 0.001 * size < off <= step.more
    assert step.more > 0.01 * size


@pytest.mark.parametrize("spoilt", [0.0, 1e-9, 1e-4])
def test_polynomials_that_are_wrong_are_off_by_what_is_said(spoilt):
    """Uncorrected and spoilt ones: the bound contains the error, and is not a thousand times as large."""
    path = begun()
    made = polynomials(path, corrected=False, spoilt=spoilt)
    off, step, _, _ = off_by((0.0, 0.0, 0.0), *made[:5], path, made[5])
    assert off <= step.more
    if spoilt:
        assert step.more < 1000 * off


def steady(path, length=F(1, 100)):
    """Of a rotation with the first ω: e is rounding, and κ all that is left."""
    with ctx.workprec(BITS):
        k = tuple(number(length) * x for x in path.k)
        R = generated.rotation(*path.p)
        body = [sum(R[3 * i + j] * k[i] for i in range(3)) for j in range(3)]
        w = [x.mid() for x in generated.angular_velocity(*body, *R[6:], *path.body.J, path.body.D)]
        rows = [list(path.p)]
        for n in range(1, 16):
            rows.append([x / (2 * n) for x in generated.compose(*rows[-1], 0, *w)])
        p, w = [deviation.exact(arb_poly(list(x))) for x in zip(*rows, strict=True)], [arb_poly([x]) for x in w]
        floats = series.motion(*long_start(path, k))
        return floats, p, w, deviation.defects(p, w, k, path.body, 90), k, length


def long_start(path, k):
    a, k, J = (np.array([series.long_float(x) for x in v]) for v in (path.p, k, path.body.J))
    return a, k, J, series.long_float(path.body.D)


@pytest.mark.parametrize("left_out", [False, True])
@pytest.mark.parametrize(("name", "least"), [("kappa", 1e-6), ("e", 1e-3)])
def test_what_is_left_of_the_momentum_and_of_the_turning_counts(name, least, left_out):
    """Where p does not move at all, and w is that of the start, e is all that is left."""
    path = begun()
    floats, p, w, found, k, length = steady(path)
    if name == "e":
        with ctx.workprec(BITS):
            p = [arb_poly([x[0]]) for x in p]
            found = deviation.defects(p, w, k, path.body, 90)
    other = found.kappa if name == "e" else found.e
    assert deviation.bound(other) < 1e-30 < least < deviation.bound(getattr(found, name))
    if left_out:
        found = found._replace(**{name: NONE})
    off, step, _, _ = off_by((0.0, 0.0, 0.0), floats, p, w, found, k, path, length)
    assert (off > step.more) == left_out


def test_the_bound_of_a_rotor_is_that_of_the_lemma():
    """`slip` is at least 2αX + θ, with α, β and W as they are found, and θ and δ as the lemma has them."""
    path = begun(rotor=ROTOR)
    floats, _, w, found, k, length = polynomials(path)
    with ctx.workprec(128):
        body = path.body.during(number(length))
        step = deviation.deviation(floats, w, upper(k), found, body, arb(1e-3))
        degree = floats.a.shape[1] - 1
        omega, gamma = (deviation.cut(x, degree) for x in (w, [x * found.unit for x in found.R[6:]]))
        beta, _, alpha, W = deviation._sizes(omega, gamma, body, deviation._weights(floats))
        X, size, I = step.within, upper(body.rotor), sorted(map(float, body.inertia))
        sigma = arb((I[2] - I[0]) / 2)
        s = 5 * beta * sigma * X
        delta = (s * W + 2 * beta * X * size) / (1 - s)
        theta = beta * (8 * sigma * X * X * W + 2 * X * X * size + 5 * sigma * X * delta)
        assert step.slip > (2 * alpha * X + theta) * arb(1 - 1e-9)


NONE = [arb_poly([0])] * 3


def test_what_is_far_off_is_refused():
    path = begun()
    floats, _, w, found, k, _ = polynomials(path)
    with ctx.workprec(128), pytest.raises(TooWide):
        deviation.deviation(floats, w, upper(k), found, path.body, arb(0.3))


def test_corrections_gain_more_bits_each_time(monkeypatch):
    """48 bits each would take 31 of them; and where the start is not moved."""
    seen = []

    def counted(*arguments):
        seen.append(ctx.prec)
        return deviation.defects(*arguments)

    monkeypatch.setattr(paths, "defects", counted)
    with ctx.workprec(900):
        path = Path(900, tuple(map(arb, J)), arb(D), tuple(map(arb, K)), tuple(map(arb, ATTITUDE)), None)
        start = list(path.p)
        path.advance(F(1, 4))
        assert [p(arb(0)) == x for p, x in zip(path.last.p, start, strict=True)] == [True] * 4
        assert path.spread.size < arb(2) ** -880
    assert len(seen) <= 14


def test_the_solutions_of_neighbours_have_twice_as_many_bits_once_they_are_mended():
    with ctx.workprec(400):
        path = Path(400, tuple(map(arb, J)), arb(D), tuple(map(arb, K)), tuple(map(arb, ATTITUDE)), None)
        floats, length = path._series(F(1, 4), 1.0)
        p, w, _ = path._mended(floats, tuple(number(length) * x for x in path.k), path.body)
        one, left = paths.Neighbours(floats, path.body, path.tick), []
        for _ in range(3):
            left.append(unlike_inverse(one))
            one.mend(p, w, 200)
        assert left[0] < arb(2) ** -48
        assert left[1] < arb(2) ** -94
        assert left[2] < arb(2) ** -186
        # Φ' = AΦ, as BΦ' = CΦ.
        unit = 1 / sum((x * x for x in p), arb_poly([0]))(arb(0))
        gamma = [x * unit for x in generated.rotation(*p)[6:]]
        assert deviation._slip(one.phi, w, gamma, path.body) < arb(2) ** -300


def unlike_inverse(one):
    """How far ΦΨ is from 1 on [0, 1]."""
    rows = one._product(one.phi, one.psi)
    return upper([(x - (i == j))(deviation.UNIT) for i, row in enumerate(rows) for j, x in enumerate(row)])
