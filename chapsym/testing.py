"""Hypothesis strategies for balls, rotations and states, for chapsym's tests and yours.

    from hypothesis import given
    from chapsym import testing

    @given(testing.states())
    def test_something(state):
        ball, momentum, gamma = state

Each has the strata to draw from as an argument, by default all; BadInput is raised for others:

    rotations: "generic", "near identity" (angles 1e-12 to 1e-3), "near pi" (q0 from 0 to 1e-3)
    inertias, mass tensors, balls, states: "generic", "degenerate" (equal, nearly equal, flat, D = 0, D large)

`of_ring` draws exact points at which the relations of any quotient ring hold.

All values are drawn through Hypothesis, so failures shrink and replay.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym import extras

extras.need("test")

from hypothesis import reject  # noqa: E402
from hypothesis import strategies as st  # noqa: E402

from chapsym.dynamics import BadInput, Ball  # noqa: E402
from chapsym.dynamics.ball import Floats, brief  # noqa: E402
from chapsym.dynamics.loops.branch import continued  # noqa: E402

ROTATIONS = ("generic", "near identity", "near pi")
BALLS = ("generic", "degenerate")

_component = st.floats(-1.0, 1.0, allow_subnormal=False)


def _normalised(v: Sequence[float]) -> Floats:
    array = np.array(v)
    array /= np.sqrt(array @ array)
    return array / np.sqrt(array @ array)


def _one(draw: st.DrawFn, strata: Sequence[str], known: Sequence[str]) -> str:
    if not isinstance(strata, list | tuple) or not strata or not all(x in known for x in strata):
        raise BadInput(f"strata must be some of {', '.join(known)}, not {brief(strata)}")
    return draw(st.sampled_from(strata))


@st.composite
def unit_vectors(draw: st.DrawFn, size: int = 3) -> Floats:
    """Unit vectors: in general position, and along an axis."""
    if not isinstance(size, int) or size < 1:
        raise BadInput(f"size must be a whole number from 1 on, not {brief(size)}")
    axis = draw(st.none() | st.integers(0, size - 1))
    if axis is not None:
        return np.eye(size)[axis] * draw(st.sampled_from([1.0, -1.0]))
    return _normalised(draw(st.tuples(*[_component] * size).filter(lambda v: sum(x * x for x in v) > 0.01)))


@st.composite
def rotations(draw: st.DrawFn, strata: Sequence[str] = ROTATIONS) -> Floats:
    """Unit Euler parameters (q0, q1, q2, q3) with q0 ≥ 0."""
    stratum = _one(draw, strata, ROTATIONS)
    axis = draw(unit_vectors())
    if stratum == "near identity":
        sine = 10 ** draw(st.floats(-12, -3))
        return np.array([np.sqrt(1 - sine * sine), *(sine * axis)])
    if stratum == "near pi":
        cosine = draw(st.just(0.0) | st.floats(-15, -3).map(lambda e: 10.0**e))
        return np.array([cosine, *(np.sqrt(1 - cosine * cosine) * axis)])
    half = draw(st.floats(0.01, 1.55))
    return np.array([np.cos(half), *(np.sin(half) * axis)])


@st.composite
def mass_tensors(draw: st.DrawFn, strata: Sequence[str] = BALLS) -> Floats:
    """J = (J1, J2, J3) of a body; degenerate: equal, nearly equal, two equal, flat."""
    moment = st.floats(0.05, 4.0)
    tensor = np.array(draw(st.tuples(moment, moment, moment)))
    if _one(draw, strata, BALLS) == "degenerate":
        kind = draw(st.sampled_from(["equal", "nearly equal", "symmetric", "flat"]))
        if kind == "equal":
            tensor[:] = tensor[0]
        elif kind == "nearly equal":
            tensor = tensor[0] * (1 + 1e-14 * np.array(draw(st.tuples(*[st.integers(-9, 9)] * 3))))
        elif kind == "symmetric":
            tensor[1] = tensor[0]
        else:
            tensor[draw(st.integers(0, 2))] = 0.0
    return tensor


def inertias(strata: Sequence[str] = BALLS) -> st.SearchStrategy[Floats]:
    """Principal moments (I1, I2, I3) that a body has: I1 = J2 + J3, ..."""
    return mass_tensors(strata).map(lambda tensor: tensor.sum() - tensor)


@st.composite
def balls(draw: st.DrawFn, strata: Sequence[str] = BALLS) -> Ball:
    """Balls whose momentum operator is regular for every γ; degenerate: also D = 0 and D large."""
    contact = draw(st.floats(0.0, 4.0))
    if _one(draw, strata, BALLS) == "degenerate":
        contact = draw(st.sampled_from([0.0, contact, 1e2, 1e5]))
    return Ball(draw(mass_tensors(strata)), contact)


@st.composite
def states(
    draw: st.DrawFn, strata: Sequence[str] = BALLS, fraction: tuple[float, float] = (0.0, 0.9)
) -> tuple[Ball, Floats, Floats]:
    """(ball, momentum, gamma) with a next step: the momentum is a fraction of that at which the branch folds."""
    ball, gamma, direction = draw(balls(strata)), draw(unit_vectors()), draw(unit_vectors())
    far = direction * 100 * (ball.mass_tensor.sum() + float(ball.D))
    # A few digits are enough, and fast.
    _, reach, _ = continued(far.tolist(), gamma.tolist(), ball.mass_tensor.tolist(), float(ball.D), 1e-5)
    return ball, far * reach * draw(st.floats(*fraction)), gamma


_small = st.integers(-6, 6)


@st.composite
def rational_rotations(draw: st.DrawFn) -> tuple[Fraction, ...]:
    """Exact rational unit Euler parameters: the square of an integer quaternion over its norm."""
    a, b, c, d = draw(st.tuples(_small, _small, _small, _small).filter(any))
    norm = a * a + b * b + c * c + d * d
    square = (a * a - b * b - c * c - d * d, 2 * a * b, 2 * a * c, 2 * a * d)
    return tuple(Fraction(x, norm) for x in square)


@st.composite
def rational_unit_vectors(draw: st.DrawFn) -> tuple[Fraction, ...]:
    """Exact rational unit vectors, by stereographic projection."""
    x, y, z = draw(st.tuples(_small, _small, st.integers(1, 6)))
    norm = x * x + y * y + z * z
    return Fraction(2 * x * z, norm), Fraction(2 * y * z, norm), Fraction(norm - 2 * z * z, norm)


@st.composite
def rational_balls(draw: st.DrawFn) -> tuple[tuple[Fraction, ...], Fraction]:
    """Exact (J, D)."""
    moment = st.fractions(Fraction(1, 8), 8, max_denominator=8)
    return draw(st.tuples(moment, moment, moment)), draw(st.fractions(0, 8, max_denominator=8))


@st.composite
def of_ring(draw: st.DrawFn, ring: Any, *assumed: Any) -> dict[str, Fraction]:
    """Exact values of the symbols of a ring, by name, at which its relations and the assumptions hold.

    ring: a `chapsym.derive.Quotient`; assumed: relations of SymPy, such as x > 0, for which positive numbers are drawn.
    Raises ArithmeticError if no rational point of the relations is known.
    """
    from chapsym.prove.points import drawn, first  # takes a second, with SymPy; not needed to roll balls
    from chapsym.prove.search import true

    small = st.fractions(-3, 3, max_denominator=6)
    positive = {one.gts for one in assumed if getattr(one, "lts", None) == 0}
    found = drawn(ring, lambda x: draw(small.map(abs) if x in positive else small), first(ring))
    if not all(true(one, found) for one in assumed):
        reject()
    return {x.name: Fraction(int(v.p), int(v.q)) for x, v in found.items()}
