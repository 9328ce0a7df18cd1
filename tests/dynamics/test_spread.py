"""The mean-value form of Arb's balls: all states that there may be stay inside, and what they span does not swell."""

import itertools
from fractions import Fraction as F

import flint
import numpy as np
import pytest

import chapsym
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.dynamics.levels import balls
from chapsym.dynamics.loops.branch import small_rotation
from chapsym.generated import compose

BITS, WIDE = 150, 20
GAMMA = (2 / 7, 3 / 7, 6 / 7)
DIRECTION = np.array((6, -2, 3)) / 7
STATES = {
    "small": ((0.1, 0.5, 1.6), 0.7, 0.05 * DIRECTION, GAMMA),
    "large": ((0.1, 0.5, 1.6), 0.7, 0.4 * DIRECTION, GAMMA),
    "beyond small-branch": ((0.1, 0.5, 1.6), 0.7, 0.6 * DIRECTION, GAMMA),
    "light": ((0.1, 0.5, 1.6), 1e-9, 0.3 * DIRECTION, GAMMA),
    "no contact term": ((1, 2, 4), 0.0, DIRECTION, GAMMA),
    "heavy": ((0.1, 0.5, 1.6), 1e5, 0.4 * DIRECTION, GAMMA),
    "vertical": ((0.1, 0.5, 1.6), 0.7, 0.4 * np.array(GAMMA), GAMMA),
    "at rest": ((0.1, 0.5, 1.6), 0.7, np.zeros(3), GAMMA),
    "an axis": ((1, 2, 4), 3.0, (0.0, 0.0, 1.0), (0.0, 0.0, 1.0)),
    "equal moments": ((1, 1, 1), 3.0, DIRECTION, GAMMA),
    "tiny": ((0.1, 0.5, 1.6), 0.7, 1e-200 * DIRECTION, GAMMA),
}


def under_way(state, order=2, attitude=()):
    J, D, K, g = state
    exact = [[F(x) for x in v] for v in (K, g, J)]
    return balls.ArbBall(BITS, (*exact, F(D), COMPOSITIONS[order].exact, attitude, 1.0))


def turned_back(xi, v):
    """Ωᵀv of the Gibbs vector ξ, exactly."""
    once = [xi[i - 2] * v[i - 1] - xi[i - 1] * v[i - 2] for i in range(3)]
    twice = [xi[i - 2] * once[i - 1] - xi[i - 1] * once[i - 2] for i in range(3)]
    return [x + 2 * (z - y) / (1 + sum(c * c for c in xi)) for x, y, z in zip(v, once, twice, strict=True)]


def contained(state, steps=6, order=2, bits=WIDE):
    """Whether the states at the corners of a box of 2^-bits, each followed alone, stay inside; and the bits left."""
    edge = F(1, 2**bits)
    J, D, K, g = state
    with flint.ctx.workprec(BITS):
        wide = under_way(state, order)
        wide.spread.restart(flint.arb(float(2 * edge)))
        wide.spread.box = flint.arb_mat(3, 1, [flint.arb(0, float(edge))] * 3)
        singles = []
        for signs in itertools.product((1, -1), repeat=3):
            xi = [s * edge * (1 - F(1, 2**60)) for s in signs]
            turned = (turned_back(xi, [F(x) for x in v]) for v in (K, g))
            singles.append((under_way((J, D, *turned), order, None), list(map(balls.exact, xi))))
        for _ in range(steps):
            wide.step()
            back = (wide.p[0], *(-x for x in wide.p[1:]))
            for one, xi in singles:
                one.step()
                e0, *e = compose(*back, *compose(1, *xi, *one.p))
                r = wide.spread.axes.inv() * flint.arb_mat(3, 1, [x / e0 for x in e])
                if not all(x.contains(y) for x, y in zip(wide.spread.box.entries(), r.entries(), strict=True)):
                    return False, wide.bits()
                if not all(x.contains(y) for v, w in zip(wide.frame(BITS)[:2], one.frame(BITS)[:2], strict=True)
                           for x, y in zip(v, w, strict=True)):  # fmt: skip
                    return False, wide.bits()
        return True, wide.bits()


@pytest.mark.parametrize("name", STATES)
def test_every_state_that_there_may_be_stays_inside(name):
    """And what they span grows by a few bits, and of a heavy ball as D/I: that has to be narrow."""
    given, cost = (60, 30) if name == "heavy" else (WIDE, 7)
    stays, left = contained(STATES[name], bits=given)
    assert stays
    assert left > given - cost


def test_it_is_so_for_stages_and_random_states():
    draw, count = np.random.default_rng(4), 0
    while count < 6:
        J, D = draw.uniform(0.2, 3, 3), draw.choice([0.0, 3.0, 300.0])
        K, g = draw.normal(size=(2, 3))
        g /= np.linalg.norm(g)
        K *= draw.uniform(0.05, 0.6) * sum(sorted(J)[:2]) / np.linalg.norm(K)
        if small_rotation(*K, *g, *J, D)[0]:
            continue
        count += 1
        assert contained((J, D, K, g), steps=3, order=2 if count % 3 else 4)[0]


def test_near_a_fold_the_selected_root_is_followed_in_the_same_way(monkeypatch):
    J, D, K, g = STATES["large"]
    reach = chapsym.fold(chapsym.Ball(J, D), K, g).reach
    state = J, D, 0.999 * reach * K, g
    with flint.ctx.workprec(BITS):
        assert contained(state, steps=1)[0]
        ball = under_way(state)
        ball.step()
        assert ball.selected == 1
        monkeypatch.setattr(balls, "LEAST_SCALAR", 2)  # no rotation has a Gibbs vector that is short enough
        assert contained(state, steps=1)[0]
