"""Certified motions of a ball whose tensor is not diagonal: they are those in principal axes, turned."""

import json
import re
from fractions import Fraction as F
from pathlib import Path

import numpy as np
import pytest
from commands import chapsym as command
from commands import refused
from flint import arb, ctx, fmpq

import chapsym
from chapsym.dynamics.flow.start import principal, principal_exactly
from chapsym.dynamics.levels.proved_root import TooWide
from chapsym.generated import compose

BOWLING = Path(chapsym.__file__).parent / "scene" / "examples" / "bowling.toml"
#: A rational rotation from principal axes to those of the body.
TURN = F(2, 3), F(1, 3), F(2, 3), F(0)


def turned(q, v):
    """The vector v turned by the quaternion q."""
    back = (q[0], *(-x for x in q[1:]))
    return compose(*compose(*q, 0, *v), *back)[1:]


def tensor_of(moments):
    """The tensor in the axes of the body of principal moments."""
    columns = [turned(TURN, e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [[sum(m * c[i] * c[j] for m, c in zip(moments, columns, strict=True)) for j in range(3)] for i in range(3)]


@pytest.mark.parametrize("start", ["", "omega = [3, -2, 1]", 'omega = [3, -2, 1]\naxes = "space"'])
def test_the_bowling_ball_has_the_digits_of_its_block(tmp_path, start):
    """Its tensor has a root in it.  The run has its own axes, by floats: a proved bound says how near it is."""
    path = tmp_path / "bowling.toml"
    text = BOWLING.read_text().replace("time = 2.4 ", "time = 0.02 ").replace("frames = 480", "frames = 5")
    path.write_text(re.sub("velocity = .*\nspin = .*", start, text) if start else text)
    assert command("run", path, "-o", tmp_path / "run.npz").returncode == 0
    found = json.loads(
        command("certify", "motion", path, "--digits", "12", "--against", tmp_path / "run.npz", "--json").stdout
    )
    assert set(found["errors"]) == {"gamma", "omega", "attitude", "contact"}
    assert 0 < max(found["errors"].values()) < 1e-6
    said = refused("certify", "motion", path, "--certificate", tmp_path / "c.json")
    assert "a certificate is of principal axes" in said


def matrix(rows):
    return [[arb(x) for x in row] for row in rows]


def assert_are_of(found, tensor):
    """Each moment times its axis is the tensor times it, and the axes are near."""
    columns = [turned(found.turn, [int(i == j) for i in range(3)]) for j in range(3)]
    for moment, v in zip(found.moments, columns, strict=True):
        off = [sum(x * y for x, y in zip(row, v, strict=True)) - moment * w for row, w in zip(tensor, v, strict=True)]
        assert all(x.contains(0) and x.rad() < 1e-25 for x in off)


def test_axes_and_moments_are_those_of_the_tensor():
    assert principal(matrix([[2, 0, 0], [0, 1, 0], [0, 0, 1]])).turn == (1, 0, 0, 0)
    with pytest.raises(TooWide):
        principal(matrix([[3, 1, 1], [1, 3, 1], [1, 1, 3]]))
    rng = np.random.default_rng(5)
    for _ in range(20):
        A = rng.integers(-9, 9, (3, 3))
        tensor = (A + A.T) / 2
        with ctx.workprec(120):
            found = principal(matrix(tensor.tolist()))
            assert_are_of(found, tensor)
        assert np.allclose(sorted(float(x) for x in found.moments), np.linalg.eigvalsh(tensor), atol=1e-12)


@pytest.mark.parametrize("v", [(1, -3, 2), (3, 4, 0), (0, 1, -1)])
@pytest.mark.parametrize("s", [F(1, 3), F(-1, 40)])
def test_of_rational_numbers_two_moments_may_be_equal(v, s):
    tensor = [[F(7, 5) * (i == j) + s * v[i] * v[j] for j in range(3)] for i in range(3)]
    rows = [[fmpq(x.numerator, x.denominator) for x in row] for row in tensor]
    with ctx.workprec(120):
        found = principal_exactly(tensor)
        assert_are_of(found, rows)
        assert str(found.moments[0]) == str(found.moments[1]) != str(found.moments[2])
        near = [[x + F(1, 1000) * (i + j == 0) for j, x in enumerate(row)] for i, row in enumerate(tensor)]
        assert len({str(x) for x in principal_exactly(near).moments}) == 3
        assert principal_exactly([[F(i == j) for j in range(3)] for i in range(3)]).turn == (1, 0, 0, 0)


@pytest.mark.parametrize("J", [(F(1), F(2), F(4)), (F(2), F(2), F(4))])
def test_a_tensor_from_python_has_the_motion_of_its_principal_moments(J):
    """With a rotor and without: the vectors are those in principal axes, turned."""
    D, K, rotor = F(3), (F(1), F(-1, 2), F(3, 4)), (F(1, 5), F(0), F(-1, 7))
    up = (F(2, 7), F(3, 7), F(6, 7))
    for kind in ({}, {"rotor": rotor}):
        straight = chapsym.certified_motion(chapsym.ExactBall(J, D, 1), K, up, [1, 2], **kind)
        other = {name: turned(TURN, v) for name, v in kind.items()}
        given = turned(TURN, K), turned(TURN, up)
        askew = chapsym.certified_motion(chapsym.ExactBall(tensor_of(J), D, 1), *given, [1, 2], **other)
        assert askew.stopped is None
        for name in ("gamma", "angular_momentum", "omega"):
            for x, y in zip(getattr(straight, name), getattr(askew, name), strict=True):
                turn = turned([arb(fmpq(t.numerator, t.denominator)) for t in TURN], list(x))
                assert all(a.overlaps(b) for a, b in zip(turn, y, strict=True))


@pytest.mark.parametrize(
    ("tensor", "sentence"),
    [
        ([[1, 0, "1/3"], [0, 2, 0], [0, 0, 4]], "mass_tensor must be symmetric"),
        ([[1, 2, 0], [2, 2, 0], [0, 0, 4]], "no body has this mass_tensor"),
        ([[1, 0, 0], [0, -1, 0], [0, 0, 4]], "negative moment -1"),
        ([[1, 2], [2, 2]], "mass_tensor must be 3 numbers"),
        (np.ones((2, 2)), r"numbers, not array\(\[\[1., 1.\], \[1., 1.\]\]\)$"),
        ([1, [2], 4], "mass_tensor 2 must be a number"),
    ],
)
def test_tensors_of_no_body_are_refused(tensor, sentence):
    with pytest.raises(chapsym.BadInput, match=sentence):
        chapsym.ExactBall(tensor, 3)
