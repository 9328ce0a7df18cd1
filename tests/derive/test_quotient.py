"""Division by a Gröbner basis, against SymPy's own."""

import os
import random
import subprocess
import sys

import pytest
import sympy as sp

from chapsym.derive.quotient import Quotient

x = sp.symbols("q0 q1 q2 q3 g1 g2 g3 a")
SPHERES = [sum(v * v for v in x[:4]) - 1, sum(v * v for v in x[4:7]) - 1]


@pytest.mark.parametrize("relations", [SPHERES, [*SPHERES, 3 * x[7] * x[0] - x[4] * x[1]]], ids=["spheres", "more"])
def test_the_normal_form_is_that_of_sympy(relations):
    ring, rng = Quotient(x, relations), random.Random(5)
    for _ in range(8):
        factors = [[rng.choice(x) for _ in range(rng.randint(0, 7))] for _ in range(25)]
        polynomial = sum(sp.Rational(rng.randint(-9, 9), rng.randint(1, 5)) * sp.prod(one) for one in factors)
        _, wanted = sp.reduced(polynomial, list(sp.groebner(relations, *x, order="grevlex")), *x, order="grevlex")
        assert sp.expand(ring.normal(polynomial) - wanted) == 0
    assert ring.is_zero(relations[-1] * (x[2] - x[5]) / (1 + x[6]))
    assert not ring.is_zero(relations[-1] + x[3])


def random_rational(rng, depth):
    if depth == 0:
        return rng.choice([*x, sp.Integer(rng.randint(-3, 3)), sp.Rational(rng.randint(1, 5), 3)])
    a, b = random_rational(rng, depth - 1), random_rational(rng, depth - 1)
    return rng.choice([a + b, a - b, a * b, a / (b + x[7]), (a + x[7]) ** -2, a**3 - b])


def test_the_numerator_is_that_of_sympy_up_to_a_factor_without_zeros():
    """It and the divisors are those of the rational function: left - right of the cross products vanishes."""
    rng, ring = random.Random(7), Quotient(x)
    for _ in range(8):
        expr = random_rational(rng, 3)
        above, below = sp.fraction(sp.together(expr))
        assert ring.is_zero(expr - above / below)
        assert ring.is_zero(expr) == (sp.expand(above) == 0)
        assert not ring.is_zero(expr - above / below + x[0] / (1 + x[1]))


def test_each_expression_that_is_divided_by_is_looked_at():
    """One that cancels or that is in the denominator of a denominator, too."""
    ring, one = Quotient(x, SPHERES), sum(v * v for v in x[:4])
    for zero in (one - 1, one * x[4] - x[4], (one - 1) ** 2 / x[7]):
        for expr in (1 / zero, x[0] + x[1] * zero * (x[2] - 1 / zero), x[0] / (1 + 1 / zero)):
            with pytest.raises(ZeroDivisionError, match="is zero under the hypotheses"):
                ring.is_zero(expr)
    assert ring.is_zero((one**-2 - 1) / (one + x[0]))


@pytest.mark.parametrize("expr", [sp.sqrt(x[0]) - 1, sp.sin(x[0]), sp.Symbol("other") * x[0], x[0] ** x[1]])
def test_what_is_no_rational_function_of_the_symbols_is_refused(expr):
    with pytest.raises(ValueError, match="is not a rational function of"):
        Quotient(x).is_zero(expr)


def test_a_text_is_not_evaluated_and_a_ring_may_have_no_symbol():
    text = "__import__('os').abort()"
    for expr in ("x - x", text, [text], (text,), {text}, {x[0]: text}):
        with pytest.raises(TypeError, match="is neither an expression of SymPy nor a number"):
            Quotient(x).is_zero(expr)
        with pytest.raises(TypeError, match="is neither an expression of SymPy nor a number"):
            Quotient(x).normal(expr)
    assert Quotient(()).is_zero(sp.Rational(1, 2) - sp.Rational(2, 4))
    assert not Quotient(()).is_zero(sp.Integer(3))
    with pytest.raises(ZeroDivisionError):
        Quotient(()).is_zero(sp.Pow(sp.Add(1, -1, evaluate=False), -1, evaluate=False))


PROGRAM = """
import sympy as sp
from chapsym.derive import Quotient
x, y = sp.symbols("x y")
print(Quotient((x, y), [y**2 - x**3]).normal(x**3 / 2 + x**2))
"""


@pytest.mark.parametrize("types", ["python", "flint"])
def test_normal_forms_are_exact_whatever_sympy_computes_with(types):
    """SymPy does not compute with a python-flint that is newer than it knows: powers must not become floats."""
    env = os.environ | {"SYMPY_GROUND_TYPES": types}
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, env=env)
    assert done.stdout == "x**2 + y**2/2\n", done.stderr
