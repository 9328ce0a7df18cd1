"""Division by a Gröbner basis, against SymPy's own."""

import random

import pytest
import sympy as sp

from chapsym.derive.quotient import Quotient

x = sp.symbols("q0 q1 q2 q3 g1 g2 g3 a")
SPHERES = [sum(v * v for v in x[:4]) - 1, sum(v * v for v in x[4:7]) - 1]


@pytest.mark.parametrize("relations", [SPHERES, [*SPHERES, 3 * x[7] * x[0] - x[4] * x[1]]], ids=["spheres", "more"])
def test_the_normal_form_is_that_of_sympy(relations):
    ring, rng = Quotient(x, relations), random.Random(5)
    for _ in range(20):
        factors = [[rng.choice(x) for _ in range(rng.randint(0, 7))] for _ in range(25)]
        polynomial = sum(sp.Rational(rng.randint(-9, 9), rng.randint(1, 5)) * sp.prod(one) for one in factors)
        _, wanted = sp.reduced(polynomial, list(sp.groebner(relations, *x, order="grevlex")), *x, order="grevlex")
        assert sp.expand(ring.normal(polynomial) - wanted) == 0
    assert ring.is_zero(relations[-1] * (x[2] - x[5]) / (1 + x[6]))
    assert not ring.is_zero(relations[-1] + x[3])
