"""The discrete principle, against a derivative of the action taken with numbers."""

import pytest
import sympy as sp

from chapsym.derive import gyrostat, principle
from chapsym.derive.derivation import allowed, dual, equations, rate, replaced, written
from chapsym.derive.principle import R0, R1, J, R, dR, dr, r, r0, r1, xi
from chapsym.derive.words import WordAlgebra, evaluate, matrix_symbols

S = sp.Symbol("s")


def cayley(a, b, c):
    skew = sp.Matrix([[0, -c, b], [c, 0, -a], [-b, a, 0]]) / 2
    return (sp.eye(3) - skew).inv() * (sp.eye(3) + skew)


#: Where the mass centre is in the body, from its centre.
off, off_T = matrix_symbols("off off^T")
OFF = WordAlgebra({**principle.ALGEBRA.transposes, off: off_T}, principle.ALGEBRA.rules)
FREE = WordAlgebra(OFF.transposes)


def action_off(a, b, x, y):
    """A ball whose mass centre is off its centre: the words of 𝕃 have a term in both steps."""
    return principle.lagrangian(principle.c, a, b, x, y) + principle.m * (y - x) * OFF.transpose((b - a) * off)


def balance():
    """Of the balanced ball."""
    return principle.momentum_balance(principle.c)


def varied_off():
    path = action_off(R0, R, r0, r) + action_off(R, R1, r, r1)
    action = written("action_off", "tr of it is 𝕃(k-1,k) + 𝕃(k,k+1) of an unbalanced ball", path, FREE)
    still = dict.fromkeys((R0, R1, r0, r1, J, off), sp.S.Zero)
    return rate("variation_off", "for free increments", action, OFF.with_transposes({**still, R: dR, r: dr}))


def balance_off():
    """By the functions that the ball's derivation uses."""
    rolling = written("rolling_off", "(4.2)", principle.rolling_constraint(dr, dR), FREE)
    increments = allowed("_off", "dR = ξR", {dR: xi * R}, rolling, dr, OFF)
    return dual("balance_off", "0", replaced("work_off", "tr", varied_off(), increments, OFF), xi)


@pytest.mark.parametrize(("balance_of", "shift"), [(balance, (0, 0, 0)), (balance_off, (1, -2, 4))])
def test_the_balance_is_the_derivative_of_the_action(balance_of, shift):
    """d/ds of the action along dR = ξR, dr = -ρξγ at a rational path equals ½ tr(ξ S)."""
    before, now, after = cayley(1, 2, 0), cayley(0, 1, 3), cayley(2, 0, 1)
    r0, r, r1 = (sp.Matrix(v) for v in ([1, 2, 0], [0, 1, 5], [3, 1, 1]))
    tensor, gamma = sp.diag(1, 2, 4), sp.Matrix([2, 3, 6]) / 7
    mass, rho, factor = sp.Rational(3, 2), sp.Rational(2, 5), sp.Rational(5, 3)
    xi = sp.Matrix([[0, 2, -1], [-2, 0, 5], [1, -5, 0]])

    def lagrangian(a, b, x, y):
        whole = factor * (a * tensor * b.T).trace() + mass / 2 * (y - x).dot(y - x)
        return whole + mass * (y - x).dot((b - a) * sp.Matrix(shift))

    turned, moved = now + S * xi * now, r - S * rho * xi * gamma
    action = lagrangian(before, turned, r0, moved) + lagrangian(turned, after, moved, r1)
    values = {
        principle.R0: before, principle.R: now, principle.R1: after,
        principle.r0: r0, principle.r: r, principle.r1: r1,
        principle.gamma: gamma, principle.J: tensor, principle.m: mass, principle.rho: rho,
    }  # fmt: skip
    values = OFF.with_transposes(values | {off: sp.Matrix(shift)})
    found = evaluate(balance_of(), values | {principle.c: factor})
    assert sp.diff(sp.expand(action), S).subs(S, 0) == (xi * found).trace() / 2


def test_multipliers_and_displacements_say_the_same():
    """The skew part of the equation in R times Rᵀ, with the multiplier of that in r, is less the balance."""
    varied, algebra = varied_off(), OFF
    holding = written(
        "holding_off", "the constraint times -f", -principle.rolling_constraint(dr, dR) * principle.fT, FREE
    )
    in_R, in_r = equations(varied, holding, {"R_off": dR, "r_off": dr}, algebra)
    force = algebra.normal(principle.f - in_r)
    places = algebra.with_transposes({principle.f: force})
    turning = replaced("turning_force", "with the force", in_R, places, algebra) * principle.RT
    half = turning - algebra.transpose(turning)
    assert algebra.is_zero(half + balance_off())
    assert not algebra.is_zero(half - balance_off())


def test_the_balance_is_skew():
    algebra = principle.ALGEBRA
    assert algebra.is_zero(balance() + algebra.transpose(balance()))


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
    values = principle.ALGEBRA.with_transposes(values)
    balance = evaluate(gyrostat.rotor_balance(), values)
    assert sp.diff(sp.expand(action), S).subs(S, 0) == (xi * balance).trace() / 2


def test_the_discrete_term_is_a_times_the_vector_of_the_odd_part():
    turn, rotor = cayley(2, 1, 3), sp.Matrix([[0, 3, -1], [-3, 0, 2], [1, -2, 0]])
    vector, odd = sp.Matrix([-2, -1, -3]), (turn - turn.T) / 2
    values = {principle.R: sp.eye(3), principle.RT: sp.eye(3), principle.R1: turn, gyrostat.step_A: rotor}
    found = evaluate(gyrostat.discrete_term(principle.R, principle.R1), values).trace()
    assert found == vector.dot(sp.Matrix([odd[2, 1], odd[0, 2], odd[1, 0]]))
