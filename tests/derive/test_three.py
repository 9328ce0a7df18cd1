"""n = 3: the derived expressions at exact points, against matrices of fractions."""

from fractions import Fraction

import sympy as sp
from budget import examples
from hypothesis import given
from reference import axial, dot, matmul, momentum, rotation, times, transposed

from chapsym import generated, testing
from chapsym.derive import three, vertical

UNITS = testing.rational_rotations()
VECTORS = testing.rational_unit_vectors()


@given(UNITS, testing.rational_unit_vectors(), testing.rational_balls())
def test_momentum_is_that_of_the_matrix_equation(q, g, ball):
    J, D = ball
    expected = axial(momentum(rotation(*q), g, J, D))
    assert list(generated.momentum(*q, *g, *J, D)) == expected


@given(UNITS)
def test_rotation_is_rodrigues(q):
    assert list(generated.rotation(*q)) == [x for row in rotation(*q) for x in row]


@given(UNITS, VECTORS)
def test_transport_and_rotate_are_inverse(q, v):
    assert list(generated.transport(*q, *v)) == times(transposed(rotation(*q)), v)
    assert list(generated.rotate(*q, *generated.transport(*q, *v))) == list(v)


@given(UNITS, testing.rational_unit_vectors(), testing.rational_balls())
@examples(25)
def test_the_expansion_around_a_rotation_is_exact(q, g, ball):
    """𝒦(q ∘ (1, w)) = 𝒦(q) + T w + ½ Σ H w w, with no further terms."""
    J, D = ball
    w = (Fraction(1, 3), Fraction(-2), Fraction(5, 7))
    moved = generated.momentum(*generated.compose(*q, Fraction(1), *w), *g, *J, D)
    tangent = generated.tangent_jacobian(*q, *g, *J, D)
    h = generated.tangent_hessian(*q, *g, *J, D)
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    for i, base in enumerate(generated.momentum(*q, *g, *J, D)):
        linear = sum(tangent[3 * i + j] * w[j] for j in range(3))
        square = sum(h[3 * n + i] * w[a] * w[b] * (1 if a == b else 2) for n, (a, b) in enumerate(pairs)) / 2
        assert moved[i] == base + linear + square


@given(UNITS.filter(lambda q: q[0] != 0), testing.rational_unit_vectors(), testing.rational_balls())
@examples(25)
def test_the_two_jacobians_differ_by_the_chart(q, g, ball):
    """T = (∂𝒦/∂q)(q0 + q×): in the chart q moves by q0 w + q × w."""
    J, D = ball
    flat = generated.momentum_jacobian(*q, *g, *J, D)
    chart = [list(flat[3 * i : 3 * i + 3]) for i in range(3)]
    q0, q1, q2, q3 = q
    moves = [[q0, -q3, q2], [q3, q0, -q1], [-q2, q1, q0]]
    assert [x for row in matmul(chart, moves) for x in row] == list(generated.tangent_jacobian(*q, *g, *J, D))


@given(UNITS, testing.rational_unit_vectors(), testing.rational_balls())
def test_the_step_conserves_what_it_should_exactly(q, g, ball):
    """Any rotation at all carries 𝒦(q, γ), γ to a state with the same invariants and the intertwined momentum."""
    J, D = ball
    K = generated.momentum(*q, *g, *J, D)
    K1, g1 = generated.transport(*q, *K), generated.transport(*q, *g)
    assert generated.invariants(*K, *g) == generated.invariants(*K1, *g1)
    back = (q[0], -q[1], -q[2], -q[3])
    assert [-x for x in generated.momentum(*back, *g1, *J, D)] == list(K1)


@given(VECTORS, VECTORS, testing.rational_balls())
def test_energy_is_half_of_the_momentum_on_the_velocity(g, spin, ball):
    J, D = ball
    K = generated.contact_momentum(*spin, *g, *J, D)
    assert generated.energy(*K, *g, *J, D) == dot(K, spin) / 2
    assert list(generated.angular_velocity(*K, *g, *J, D)) == list(spin)


def test_contact_inertia_has_no_cancelling_terms():
    """B is a sum of non-negative terms on the diagonal, so it keeps its digits when D is large."""
    assert three.contact_inertia()[0, 0] == three.J2 + three.J3 + three.D * (three.g2**2 + three.g3**2)


def test_the_vertical_excess_is_derived():
    assert vertical.excess() == sp.factor(2 * three.D * three.q0 * three.gamma.dot(three.q))
