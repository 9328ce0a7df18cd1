"""Certified motions of a ball whose tensor is not diagonal: they are those in principal axes, turned."""

import json
from fractions import Fraction as F
from pathlib import Path

import numpy as np
import pytest
from commands import chapsym as command
from commands import refused
from flint import arb, ctx, fmpq

import chapsym
from chapsym.dynamics.enclosed_motion import follow
from chapsym.dynamics.flow.start import principal, principal_exactly
from chapsym.dynamics.levels.proved_root import TooWide
from chapsym.generated import compose
from chapsym.scene import load
from chapsym.scene.members.exactly import exact_motion

BOWLING = Path(chapsym.__file__).parent / "scene" / "examples" / "bowling.toml"
#: A rational rotation from principal axes to those of the body, and one from these to space.
TURN, UP = (F(2, 3), F(1, 3), F(2, 3), F(0)), (F(6, 7), F(2, 7), F(0), F(3, 7))
SCENE = """
[ball]
inertia = {inertia}
mass = 2
radius = "1/10"
rotor = {rotor}
[start]
omega = {omega}
attitude = {attitude}
{space}
[run]
time = 0.4
frames = 2
"""


def turned(q, v):
    """The vector v turned by the quaternion q."""
    back = (q[0], *(-x for x in q[1:]))
    return compose(*compose(*q, 0, *v), *back)[1:]


def tensor_of(moments):
    """The tensor in the axes of the body of principal moments."""
    columns = [turned(TURN, e) for e in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [[sum(m * c[i] * c[j] for m, c in zip(moments, columns, strict=True)) for j in range(3)] for i in range(3)]


def motion(tmp_path, **values):
    path = tmp_path / "scene.toml"
    words = {name: json.dumps(value, default=str) if name != "space" else value for name, value in values.items()}
    path.write_text(SCENE.format(**words), encoding="utf-8")
    start, times = exact_motion(load(path))
    return start, follow(start, times, 20)


@pytest.mark.parametrize("space", [False, True])
def test_it_is_the_motion_in_principal_axes_turned(tmp_path, space):
    moments, omega, rotor = (F(6, 1000), F(7, 1000), F(9, 1000)), (F(3), F(-2), F(1)), (F(0), F(1, 500), F(-1, 300))
    tensor = tensor_of(moments)
    assert all(tensor[i][j] for i in range(3) for j in range(3))
    how = 'axes = "space"' if space else ""
    one = motion(tmp_path, inertia=moments, rotor=rotor, omega=omega, attitude=compose(*UP, *TURN), space=how)[1]
    other = motion(
        tmp_path, inertia=tensor, rotor=turned(TURN, rotor), omega=omega if space else turned(TURN, omega), attitude=UP,
        space=how,
    )[1]  # fmt: skip
    with ctx.workprec(200):
        q = [arb(fmpq(x.numerator, x.denominator)) for x in TURN]
        back = [q[0], *(-x for x in q[1:])]
        for i in range(3):
            pairs = [
                (x, y)
                for name in ("gamma", "angular_momentum", "omega")
                for x, y in zip(turned(q, getattr(one, name)[i]), getattr(other, name)[i], strict=True)
            ]
            a = compose(*one.attitude[i], *back)
            sign = 1 if a[0] * other.attitude[i][0] > 0 else -1
            pairs += [(sign * x, y) for x, y in zip(a, other.attitude[i], strict=True)]
            pairs += list(zip(one.contact[i], other.contact[i], strict=True))
            assert all(x.overlaps(y) and float((x - y).abs_upper()) < 1e-19 for x, y in pairs)


def test_the_bowling_ball_has_the_digits_of_its_block(tmp_path):
    """Its tensor has a root in it.  The run has its own axes, by floats: a proved bound says how near it is."""
    path = tmp_path / "bowling.toml"
    path.write_text(BOWLING.read_text().replace("time = 2.4 ", "time = 0.1 ").replace("frames = 480", "frames = 5"))
    assert command("run", path, "-o", tmp_path / "run.npz").returncode == 0
    found = json.loads(
        command("certify", "motion", path, "--digits", "15", "--against", tmp_path / "run.npz", "--json").stdout
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
