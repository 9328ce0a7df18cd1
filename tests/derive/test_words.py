"""Words in noncommuting symbols: the decision procedure that proves statements for every n."""

import pytest
import sympy as sp

from chapsym.derive import ball, limits
from chapsym.derive.derivation import written
from chapsym.derive.words import Traces, WordAlgebra, evaluate, matrix_symbols

R, RT, J, X, XT, xi = matrix_symbols("R RT J X XT xi")
ALGEBRA = WordAlgebra({R: RT, RT: R, J: J, X: XT, XT: X, xi: -xi}, {(R, RT): 1, (RT, R): 1})


def test_an_example_must_obey_and_rules_must_end():
    turn = {R: sp.Matrix([[0, -1], [1, 0]]), RT: sp.Matrix([[0, 1], [-1, 0]])}
    WordAlgebra({R: RT, RT: R}, {(R, RT): 1, (RT, R): 1}, turn)
    with pytest.raises(ValueError, match=r"the example breaks the rule for R RT"):
        WordAlgebra({}, {(R, RT): 1}, turn | {RT: turn[R]})
    with pytest.raises(ValueError, match="the example breaks the transpose of R"):
        WordAlgebra({R: RT, RT: R}, {}, turn | {RT: turn[R]})
    for strange in ("1", [[1]], sp.Matrix([[sp.sqrt(2)]]), sp.sqrt(2), 0.5):
        with pytest.raises(ValueError, match=r"the example of R must be a sp\.Matrix of rational numbers"):
            WordAlgebra({}, {}, {R: strange})
    with pytest.raises(ValueError, match="do not end"):
        WordAlgebra({}, {(X, J): X * J})


def test_rules_apply_until_none_matches():
    assert ALGEBRA.normal((R * RT) ** 2 * J * RT * R * R) == J * R


def test_a_letter_and_its_transpose_are_given_once():
    one = WordAlgebra({R: RT, J: J, X: XT, xi: -xi}, ALGEBRA.rules)
    assert [*one.transposes.items()] == [*ALGEBRA.transposes.items()]
    square = sp.Matrix([[1, 2], [3, 4]])
    found = one.with_transposes({R: square, xi: J, X: -R * J})
    assert found == {R: square, RT: square.T, xi: J, X: -R * J, XT: -J * RT}


def test_a_rule_may_have_several_terms():
    algebra = WordAlgebra({X: XT, XT: X, J: J}, {(X, J): X + 2 * J})
    assert algebra.normal(X * J * X) == sp.expand(X * X + 2 * J * X)


def test_the_product_does_not_commute():
    assert not ALGEBRA.is_zero(X * J - J * X)


def test_transposition_reverses_words():
    assert ALGEBRA.transpose(2 * R * J * X) == 2 * XT * J * RT
    assert ALGEBRA.transpose(xi * J) == -J * xi


def test_trace_is_cyclic_and_blind_to_transposition():
    assert ALGEBRA.trace(X * J * R - R * X * J) == 0
    assert ALGEBRA.trace(X * J - J * XT) == 0
    assert ALGEBRA.trace(R * X * RT) == ALGEBRA.trace(X)
    assert ALGEBRA.trace(X * J - XT * RT) != 0


def test_trace_of_a_skew_matrix_vanishes():
    assert ALGEBRA.trace(xi) == 0
    assert ALGEBRA.trace(xi * J) == 0
    assert ALGEBRA.trace(xi * X) != 0


def test_the_dual_of_a_trace_agrees_with_numbers():
    expr = 3 * J * xi * X
    dual = ALGEBRA.dual_of_skew(expr, xi)
    skew = sp.Matrix([[0, 2, -1], [-2, 0, 5], [1, -5, 0]])
    x = sp.Matrix([[1, 2, 0], [3, 1, 1], [0, 4, 2]])
    values = {J: sp.diag(1, 2, 3), X: x, XT: x.T, xi: skew}
    assert evaluate(expr, values).trace() == (skew * evaluate(dual, values)).trace() / 2


def test_derived_momentum_agrees_with_the_matrix_formula_in_four_dimensions():
    """n = 4, an exact rational rotation (a Cayley transform): nothing in the derivation knows n."""
    s = sp.Matrix(4, 4, lambda i, j: sp.Rational((i + 1) * (j + 2) - (j + 1) * (i + 2), 3))
    omega = (sp.eye(4) - s).inv() * (sp.eye(4) + s)
    g = sp.Matrix([1, 1, 1, 1]) / 2
    tensor, half = sp.diag(1, 2, 3, 5), sp.Rational(7, 2)
    values = {ball.Omega: omega, ball.OmegaT: omega.T, ball.J: tensor, ball.Gamma: g * g.T, ball.D: sp.Integer(7)}
    shifted = tensor + half * g * g.T
    expected = omega * shifted - shifted * omega.T + half * (g * g.T * omega - omega.T * g * g.T)
    assert evaluate(ball.momentum(), values) == expected


def letter(name, expression):
    return written(name, "a text", expression, ball.ALGEBRA)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: WordAlgebra({}, {(X, J): 1, (J, R): X}), "not confluent"),
        (lambda: WordAlgebra({X: -XT, XT: X}), "transposing X twice"),
        (lambda: ALGEBRA.dual_of_skew(xi * xi, xi), "not linear"),
        (lambda: Traces(ALGEBRA).is_zero(sp.Integer(2)), "the trace of a number"),
        (lambda: limits.expand_words(letter("at_once", J + ball.Omega), limits.STEP), "there is no limit"),
        (lambda: limits.expand_words(letter("never", ball.omega * 0), limits.STEP), "may be exact"),
        (lambda: letter("once", ball.J * ball.Omega), "the letter once is defined twice"),
    ],
)
def test_what_is_no_algebra_and_what_it_has_not_is_refused(call, said):
    assert letter("once", ball.Omega * ball.J) is letter("once", ball.Omega * ball.J)
    with pytest.raises((ValueError, ArithmeticError), match=said):
        call()


def test_a_trace_is_0_where_that_of_every_matrix_is():
    assert Traces(ALGEBRA).is_zero(J * X - X * J)
    assert not Traces(ALGEBRA).is_zero(J * X)
