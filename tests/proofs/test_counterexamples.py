"""The counterexamples to what the checker does not read, once more, with `fractions` alone, in NumPy's arrays.

Where a printed formula has a glossary, the checker reads it, and decides both sides at the counterexample.
"""

import re
from fractions import Fraction as F

import numpy as np


def vector(*numbers):
    return np.array([F(x) for x in numbers])


ONE = np.eye(3, dtype=int) * F(1)
E1, _, E3 = ONE


def diagonal(*entries):
    return ONE * vector(*entries)


def written(x):
    """As the register writes it: the numbers of a vector, or a matrix as one text."""
    x = np.atleast_1d(x)
    return [str(x.astype(str).tolist()).replace("'", "")] if x.ndim == 2 else x.astype(str).tolist()


def agree(records, id, printed, corrected=None, example=0):
    """The sides of the register's counterexample are these, to the last digit: a pair, or a list of them."""
    shown = records[id]["evidence"]["counterexamples"][example]
    for kind, pairs in {"printed": printed, "corrected": corrected}.items():
        if pairs is not None:
            pairs = pairs if isinstance(pairs, list) else [pairs]
            assert [(s["left"], s["right"]) for s in shown[kind]] == [tuple(map(written, pair)) for pair in pairs]


def skew(a):
    return a - a.T


def wedge(a, b):
    return skew(np.outer(a, b))


def hat(v):
    return np.cross(v, ONE).T


def turn(axis, c=F(3, 5), s=F(4, 5)):
    """The right-handed turn about a unit vector."""
    return c * ONE + s * hat(axis) + (1 - c) * np.outer(axis, axis)


def test_4_1_by_hand(records):
    """R_{k-1} = R_k = 1: the printed principle says f∧γ = -½ m_k, (4.3) says f∧γ = m_k."""
    after = turn(E1)
    m_k = skew(after @ diagonal(1, 2, 3))
    rolled = -skew(after) / 2 @ E3  # (4.9) with ρ = 1
    assert rolled.tolist() == [0, F(4, 5), 0]
    force = F(5, 2) * rolled  # m(r_+ - 2r + r_-) with m = 5/2, r = r_- = 0
    printed_principle, skew_part = -m_k / 2 - wedge(force, E3), m_k - wedge(force, E3)
    assert not printed_principle.any()
    assert skew_part.any()
    agree(records, "4.1", (skew_part, printed_principle))


def test_5_16_integral(records):
    """sn = 4/5, cn = 3/5, dn = 4/5: p falls from ∞, dp/dδu = q = -2 cn dn/sn³, and the root is its positive half."""
    s, c, d = F(4, 5), F(3, 5), F(4, 5)
    q, half = -2 * c * d / s**3, c * d / s**3
    agree(records, "5.16-integral", (q, 2 * half), [(q * q, 4 * half**2), (q, q)])


def test_counts_and_single_numbers(records):
    before, first, second = 5, 0, 1  # 𝕃 = (y-x)²/2, q = 5, 0, 1, 3, 4, δq₀ = 1: the action has no q_{-1}
    agree(records, "3.4-principle", (-(second - first), -(second - first) + (first - before)))
    # n = 2, s = 1: N×N has the dimension 2(n-s), the distribution 2n-s.
    agree(records, "remark-1", (2 * (2 - 1), 2 * 2 - 1), example=1)
    # N×N is {x2 = y2 = 0}, and (q, q) has 1 and 1 there for q = (0, 1).
    agree(records, "remark-1", (vector(1, 1), vector(0, 0)))
    # diag(1,-1,-1) has 4q₀² = 1 + tr = 0, and is the rotation of (0, e1).
    assert (turn(E1, -1, 0) == diagonal(1, -1, -1)).all()
    assert records["5.1-angle"]["evidence"]["counterexamples"][0]["printed"][0]["left"] == ["0"]
    # 2(1 + u²) = u has the discriminant 1 - 16 < 0: a regular system without a successor.
    [sides] = records["remark-2"]["evidence"]["counterexamples"][0]["printed"]
    assert 1 - 4 * 2 * 2 < 0
    assert sides["left"] == ["0"]
    assert sides["statement"].startswith("Q = R, s = 0, 𝕃 = ½ln(1 + u²) + 2x, u = y - x, u_{k-1} = b: ")


#: Where a printed statement is no equation, the point must be the one that is recomputed above.
POINTS = {
    "3.4-principle": {"𝕃": "(y - x)²/2", "q_{-1}, ..., q_3": "5, 0, 1, 3, 4", "δq": "1, 0, 0, 0"},
    "remark-1": {"x1": "0", "x2": "1", "y1": "0", "y2": "1"},
    "remark-2": {"b": "0"},
    "5.1-angle": {"Omega11": "1", "Omega22": "-1", "Omega33": "-1"},
}


def test_points_in_words_are_those_that_are_recomputed(records):
    for id, point in POINTS.items():
        assert records[id]["evidence"]["counterexamples"][0]["point"] == point


def test_the_balls_of_the_counterexamples_are_of_matter(records):
    """J ≥ 0, and D = mρ² ≥ tr J: no matter lies outside the surface.  Of Λ alone: such J and D are possible."""
    balls = curves = 0
    for id, record in records.items():
        for example in record["evidence"]["counterexamples"]:
            point = {name: F(x) for name, x in example["point"].items() if re.fullmatch(r"-?\d+(/\d+)?", x)}
            if {"J1", "J2", "J3", "D"} <= point.keys():
                J = [point[f"J{i}"] for i in (1, 2, 3)]
                assert min(J) >= 0, id
                assert sum(J) <= point["D"], id
                balls += 1
            point |= {name.upper(): x for name, x in point.items()}
            if {"L1", "L2", "L3"} <= point.keys():
                first, second, third = (point[f"L{i}"] for i in (1, 2, 3))
                assert first > second > third, id
                assert first + second + third <= 5 * (second + third - first), id
                curves += 1
    assert (balls, curves) == (19, 4)
