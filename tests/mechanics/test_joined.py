"""The ball that mechanics has from its file is that of derive, which has it for every n: equal, whatever the values."""

import pytest
import sympy as sp
from systems import example

from chapsym.derive import Quotient, ball, evaluate, motion, principle, three
from chapsym.mechanics import METHODS, STEP, Quaternion, dot, rate

BALL = example("ball")
Q, N = BALL.coordinates, len(BALL.coordinates)
BEFORE, AFTER, ACCELERATION = ([sp.Symbol(f"{x}_{when}") for x in Q] for when in ("before", "next", "rate"))
mass, radius, *J = BALL.parameters
BODY = Quaternion("q")
DOWN = sp.Matrix([0, 0, -1])
AXES = sp.eye(3).columnspace()
MULTIPLIERS = [sp.Symbol(f"lam {i}") for i in range(3)]
NORMS = [sum(x**2 for x in place[2:]) - 1 for place in (BEFORE, Q, AFTER)]
STEPS = Quotient((*BEFORE, *Q, *AFTER, *MULTIPLIERS, *BALL.parameters, STEP), NORMS)


def attitude(place):
    return BODY.rotation.xreplace(dict(zip(Q, place, strict=True)))


def displacement(axis):
    """Of the coordinates, where the ball turns about an axis of space and rolls."""
    turn = three.quaternion_product(sp.Matrix([0, *axis]) / 2, sp.Matrix(Q[2:]))
    return sp.Matrix([*(-radius * axis.cross(DOWN))[:2], *turn])


def path(down=DOWN):
    """The letters of the words at three places."""
    values = {principle.gamma: down, principle.J: sp.diag(*J), principle.m: mass, principle.rho: radius}
    letters = ((principle.R0, principle.r0), (principle.R, principle.r), (principle.R1, principle.r1))
    for (turned, centre), place in zip(letters, (BEFORE, Q, AFTER), strict=True):
        values |= {turned: attitude(place), centre: sp.Matrix([*place[:2], 0])}
    return principle.ALGEBRA.with_transposes(values)


@pytest.fixture(scope="module")
def residual():
    """What two steps of the method set to 0, with the momenta of the first."""
    scheme = METHODS["own"].scheme(BALL)

    def of_step(expressions, start, end, momenta):
        velocity = [(b - a) / STEP for a, b in zip(start, end, strict=True)]
        put = dict(zip((*scheme.state, *scheme.unknowns), (*start, *momenta, *velocity, *MULTIPLIERS), strict=True))
        return [e.xreplace(put) for e in expressions]

    return of_step(scheme.residual, Q, AFTER, of_step(scheme.after[N:], BEFORE, Q, scheme.state[N:]))


def test_displacements_are_all_that_the_constraints_allow():
    fields = sp.Matrix([displacement(axis).T for axis in AXES])
    assert all(STEPS.is_zero(e) for e in BALL.rows * fields.T)
    at = {x: sp.Rational(v) for x, v in zip((*Q, radius), ("1", "2", "1/5", "2/5", "4/5", "2/5", "3"), strict=True)}
    assert fields.xreplace(at).rank() + BALL.rows.xreplace(at).rank() == N


@pytest.mark.parametrize("axis", range(3))
def test_the_discrete_equations_are_those_of_the_words(residual, axis):
    """The work of the method's equations along a displacement ξ is ½ tr(ξ S), in which there are no multipliers."""
    work = STEP * displacement(AXES[axis]).dot(residual[:N])

    def words(factor, down):
        return (AXES[axis].hat() * evaluate(principle.momentum_balance(factor), path(down))).trace() / 2

    assert STEPS.is_zero(work - words(principle.kinetic_factor(), DOWN))
    assert not STEPS.is_zero(work - words(sp.Rational(1, 2), DOWN))
    assert STEPS.is_zero(work - words(principle.kinetic_factor(), -DOWN)) is (axis == 2)  # about the vertical


def test_the_discrete_constraint_is_that_of_the_words(residual):
    def words(down):
        return evaluate(principle.discrete_constraint(principle.R, principle.R1, principle.r, principle.r1), path(down))

    assert all(STEPS.is_zero(a - b) for a, b in zip([*residual[N : N + 2], 0], words(DOWN), strict=True))
    assert not all(STEPS.is_zero(a - b) for a, b in zip([*residual[N : N + 2], 0], words(-DOWN), strict=True))


def test_the_discrete_momentum_is_that_of_the_words():
    """𝒦 of the file, in the axes of space, is R 𝒦 for the rotation from Ω = RᵀR_next and γ upwards."""
    ends = {**dict(zip(Q, Q, strict=True)), **{sp.Symbol(f"{x}_after"): y for x, y in zip(Q, AFTER, strict=True)}}
    start, end = attitude(Q), attitude(AFTER)
    up = start.T * -DOWN
    values = ball.ALGEBRA.with_transposes({ball.Omega: start.T * end, ball.J: sp.diag(*J)})
    values |= {ball.Gamma: up * up.T, ball.D: mass * radius**2}
    momentum = start * three.axial(evaluate(ball.momentum(), values))
    rolling = dict(zip(AFTER[:2], of_rolling(), strict=True))
    for name, expected in (("|𝒦|²", momentum.dot(momentum)), ("⟨𝒦,γ⟩", momentum[2])):
        found = BALL.discrete.integrals[name].xreplace(ends).xreplace(rolling)
        assert STEPS.is_zero(found - expected)
        assert not STEPS.is_zero(found - 2 * expected)


def of_rolling():
    """Where the centre is after a step, by the discrete constraint of the words."""
    gone = evaluate(principle.turning_step(), path())
    return [x - e for x, e in zip(Q[:2], gone, strict=False)]


def test_the_equations_of_motion_are_those_of_the_words():
    """The work of the equations along a displacement η of the body is -½ tr(η S), S of d'Alembert's principle."""
    v, spin, vertical = BALL.velocities, BODY.spin, BODY.rotation.T * DOWN
    moving = dict(zip(v, ACCELERATION, strict=True))
    slip = [radius * BODY.spin_in_space[1], -radius * BODY.spin_in_space[0]]

    def by_time(expr):
        return rate(expr, Q) + sum((sp.diff(expr, x) * a for x, a in moving.items()), sp.zeros(*expr.shape))

    rolling = dict(zip(v[:2], slip, strict=True)) | dict(zip(ACCELERATION[:2], by_time(sp.Matrix(slip)), strict=True))
    norm = sum(x**2 for x in Q[2:])
    kept = [norm - 1, rate(norm, Q) / 2]
    kept.append(sum(dot(x) ** 2 + x * moving[dot(x)] for x in Q[2:]))
    ring = Quotient((*Q, *v, *ACCELERATION, *MULTIPLIERS, *BALL.parameters), kept)
    matrix, right = BALL.equations
    equations = (matrix * sp.Matrix([*ACCELERATION, *MULTIPLIERS]) - right)[:N]
    values = {motion.omega: spin.hat(), motion.alpha: by_time(spin).hat(), motion.J: sp.diag(*J)}
    values |= {motion.gamma: vertical, motion.gammaT: vertical.T, motion.Gamma: vertical * vertical.T}
    words = evaluate(motion.eliminated(), values | {motion.D: mass * radius**2})
    for axis in AXES:
        work = displacement(BODY.rotation * axis).dot(equations).xreplace(rolling)
        assert ring.is_zero(work + (axis.hat() * words).trace() / 2)
        assert not ring.is_zero(work - (axis.hat() * words).trace() / 2)
