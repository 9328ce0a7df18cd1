"""The discrete principle, against a derivative of the action taken with numbers."""

import sympy as sp

from chapsym.derive import gyrostat, principle
from chapsym.derive.words import evaluate

S = sp.Symbol("s")


def cayley(a, b, c):
    skew = sp.Matrix([[0, -c, b], [c, 0, -a], [-b, a, 0]]) / 2
    return (sp.eye(3) - skew).inv() * (sp.eye(3) + skew)


def test_the_balance_is_the_derivative_of_the_action():
    """d/ds of the action along dR = ξR, dr = -ρξγ at a rational path equals ½ tr(ξ S)."""
    before, now, after = cayley(1, 2, 0), cayley(0, 1, 3), cayley(2, 0, 1)
    r0, r, r1 = (sp.Matrix(v) for v in ([1, 2, 0], [0, 1, 5], [3, 1, 1]))
    tensor, gamma = sp.diag(1, 2, 4), sp.Matrix([2, 3, 6]) / 7
    mass, rho, factor = sp.Rational(3, 2), sp.Rational(2, 5), sp.Rational(5, 3)
    xi = sp.Matrix([[0, 2, -1], [-2, 0, 5], [1, -5, 0]])

    def lagrangian(a, b, x, y):
        return factor * (a * tensor * b.T).trace() + mass / 2 * (y - x).dot(y - x)

    turned, moved = now + S * xi * now, r - S * rho * xi * gamma
    action = lagrangian(before, turned, r0, moved) + lagrangian(turned, after, moved, r1)
    values = {
        principle.R0: before, principle.R: now, principle.R1: after,
        principle.r0: r0, principle.r: r, principle.r1: r1,
        principle.gamma: gamma, principle.J: tensor, principle.m: mass, principle.rho: rho,
    }  # fmt: skip
    values |= {principle.ALGEBRA.transposes[k]: v.T for k, v in list(values.items())[:7]}
    balance = evaluate(principle.momentum_balance(factor), values)
    assert sp.diff(sp.expand(action), S).subs(S, 0) == (xi * balance).trace() / 2


def test_the_balance_is_skew():
    algebra = principle.ALGEBRA
    balance = principle.momentum_balance(principle.c)
    assert algebra.is_zero(balance + algebra.transpose(balance))


def test_the_kinetic_energy_asks_for_minus_the_trace():
    assert principle.kinetic_factor() == -1


def test_the_rotors_balance_is_the_derivative_of_its_action():
    """d/ds of ½ tr(AᵀRᵀR_+) of both steps along dR = ξR at a rational path equals ½ tr(ξ S)."""
    before, now, after = cayley(1, 2, 0), cayley(0, 1, 3), cayley(2, 0, 1)
    rotor = sp.Matrix([[0, 3, -1], [-3, 0, 2], [1, -2, 0]])
    xi = sp.Matrix([[0, 2, -1], [-2, 0, 5], [1, -5, 0]])
    turned = now + S * xi * now
    action = ((rotor.T * before.T * turned).trace() + (rotor.T * turned.T * after).trace()) / 2
    values = {principle.R0: before, principle.R: now, principle.R1: after, gyrostat.step_A: rotor}
    values |= {principle.ALGEBRA.transposes[k]: v.T for k, v in list(values.items())[:3]}
    balance = evaluate(gyrostat.rotor_balance(), values)
    assert sp.diff(sp.expand(action), S).subs(S, 0) == (xi * balance).trace() / 2


def test_the_discrete_term_is_a_times_the_vector_of_the_odd_part():
    turn, rotor = cayley(2, 1, 3), sp.Matrix([[0, 3, -1], [-3, 0, 2], [1, -2, 0]])
    vector, odd = sp.Matrix([-2, -1, -3]), (turn - turn.T) / 2
    values = {principle.R: sp.eye(3), principle.RT: sp.eye(3), principle.R1: turn, gyrostat.step_A: rotor}
    found = evaluate(gyrostat.discrete_term(principle.R, principle.R1), values).trace()
    assert found == vector.dot(sp.Matrix([odd[2, 1], odd[0, 2], odd[1, 0]]))
