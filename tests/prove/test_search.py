"""Points that are searched for, variants that are made, and limits as equations."""

from fractions import Fraction

import pytest
import sympy as sp
from budget import examples
from hypothesis import given

from chapsym import testing
from chapsym.derive import Quotient
from chapsym.derive.words import WordAlgebra
from chapsym.prove import Equation, Proof, Verdict, counterexample, equations, mutations, tends

x, y, z, h = sp.symbols("x y z h")
q = sp.symbols("q0:3")
CIRCLE = Quotient((x, y, z), [x**2 + y**2 - 1])
RINGS = {
    "a circle": CIRCLE,
    "two planes": Quotient((x, y, z), [x - y, y - z]),
    "a sphere and a plane through an axis": Quotient((*q, x, y), [sum(v**2 for v in q) - 1, x * q[1] + y * q[2]]),
    "a hyperbola, and a cube": Quotient((x, y, z), [x * y - 6, z**3 - 8]),
    "two cylinders": Quotient((x, y, z), [x**2 + y**2 - 1, y**2 + z**2 - 1]),
    "no relation": Quotient((x, y)),
}
equal = equations(CIRCLE)


@pytest.mark.parametrize("name", RINGS)
def test_points_of_a_ring_obey_its_relations_and_differ(name):
    seen = set()

    @examples(12)
    @given(testing.of_ring(RINGS[name], x <= 3))
    def look(point):
        exact = {symbol: sp.Rational(point[symbol.name]) for symbol in RINGS[name].symbols}
        assert all(relation.xreplace(exact) == 0 for relation in RINGS[name].relations)
        assert point["x"] <= 3
        assert all(type(value) is Fraction for value in point.values())
        seen.add(tuple(point.values()))

    look()
    assert len(seen) > 5 or name == "two cylinders"  # of which one point is known


def test_where_no_point_is_known_this_is_said():
    @given(testing.of_ring(Quotient((x,), [x**2 - 2])))
    def look(point):
        """No point gets here."""

    with pytest.raises(ArithmeticError, match=r"no rational point is known where x\*\*2 - 2 = 0"):
        look()


def test_a_false_statement_is_refuted_at_a_point_that_is_found():
    wrong, right = equal("x + y = 1", x + y, 1), equal("(x + y)² = 1 + 2xy", (x + y) ** 2, 1 + 2 * x * y)
    proof = Proof()
    proof.printed(wrong)
    proof.corrected("(x + y)^2 = 1 + 2xy", right)
    proof.counterexample(counterexample(wrong, x > 0, y < 0))
    proof.control(*mutations(right))
    assert proof.verdict() is Verdict.CORRECTED
    (point,) = proof.counterexamples
    assert sp.Rational(point["point"]["x"]) > 0 > sp.Rational(point["point"]["y"])
    for statement, assumed, said in (
        (right, (), "holds in its ring, so there is no"),
        (wrong, (x > 0, x < 0), "no point was found among 40 where all that is assumed"),
        (wrong, (sp.Ne(1 / (x**2 + y**2 - 1), 0),), "no point was found"),
        (wrong, (sp.Eq(x + y, 1),), "no point where «x [+] y = 1» fails was found among "),
    ):
        with pytest.raises(ArithmeticError, match=said):
            counterexample(statement, *assumed, tries=40)


def test_a_point_is_found_where_the_hypotheses_hold(tmp_path):
    """Of equations that are no relation of the ring, and of inequalities; a witness that obeys them not is refused."""
    n1, n2, c, j = sp.symbols("n1 n2 c J")
    same = equations(Quotient((n1, n2, c, j), [n1 * (j - c)]))
    for values, verdict in (({}, Verdict.HOLDS), ({"n1": "1", "n2": "1"}, Verdict.OPEN)):
        proof = Proof()
        proof.assume("unit", sp.Eq(n1**2 + n2**2, 1))
        proof.assume("signs", c > 1, j > 1, n2 < 0)
        proof.printed(same("along", j * n1, c * n1))
        proof.control(same("whole", j, c))
        if values:
            proof.witness("mine", values)
        assert proof.verdict() is verdict
        assert (proof.problems == []) is (not values)
    assert proof.problems == ["the witness mine violates the hypothesis unit"]


@given(testing.of_ring(Quotient((x, y, z)), x > 0, y > 0, z >= 0))
def test_positive_numbers_are_drawn(point):
    assert min(point["x"], point["y"]) > 0


def test_each_mutation_is_false_and_names_its_term():
    square = equal("x²", x**2 + 0 * y, (x + y) * (x - y) + y**2 + z * (x**2 + y**2 - 1))
    made = mutations(square, most=10)
    assert len(made) >= 3
    assert not any(one.holds() for one in made)
    assert all("with the sign of" in one.text for one in made)
    assert not any("x**2 + y**2" in one.text for one in made)  # z(x² + y² - 1) is 0 here
    with pytest.raises(ValueError, match="no term"):
        mutations(equal("false itself", x, -x))
    a, b, c = sp.symbols("A B C", commutative=False)
    words = WordAlgebra({})
    (one, *_) = mutations(Equation("words", (b + c) * a + c, b * a + c * a + c, words), most=9)
    assert not one.holds()
    assert len(mutations(Equation("words", b * a + c * a + c, (b + c) * a + c, words), most=9)) == 4
    with pytest.raises(ValueError, match="no term"):
        mutations(equal("0", x - x, 0))


def test_a_limit_is_an_equation_with_a_rest_that_is_regular():
    ring = Quotient((x, h))
    expression = (1 + h * x) / (1 - h) - 1 - h
    assert tends("it", expression, h, 1, x, ring).holds()
    assert not tends("it", expression, h, 1, -x, ring).holds()
    assert not tends("it", expression, h, 2, x, ring).holds()
    both = tends("two", [expression, h / (x + h)], h, 0, [0, 0], ring)
    assert both.holds()
    assert both.right[2:] == [1 + h / x]  # x is not 0
    with pytest.raises(ArithmeticError, match="a pole where h is 0"):
        tends("it", x / h, h, 0, x, ring)
    with pytest.raises(ValueError, match="not a rational function"):
        tends("it", sp.sin(h), h, 1, 1, ring)


def test_no_limit_is_taken_where_the_relations_forbid_it():
    with pytest.raises(ZeroDivisionError, match="zero under the hypotheses"):
        tends("it", h / (x**2 + y**2 - 1 + h), h, 0, 0, Quotient((x, y, h), [x**2 + y**2 - 1])).holds()
    with pytest.raises(ValueError, match="cannot have h, which tends to 0"):
        tends("it", h, h, 0, h, Quotient((h,)))
    with pytest.raises(ValueError, match="cannot tend to 0 by itself"):
        tends("it", h * x**2, h, 0, 0, Quotient((x, h), [x * h - 1]))


@pytest.mark.parametrize("assumed", [sp.Eq(x, h), x < h, sp.Ne(h, x), h > 1, h * (h - 1) > 0])
def test_no_limit_is_taken_where_a_hypothesis_forbids_it(assumed):
    for more in ((), (assumed,)):
        proof = Proof()
        proof.assume("some", sp.Ne(x, 0), h > 0, *more)
        proof.printed(tends("h/x", h / x, h, 0, 0, Quotient((h, x))))
        proof.control(tends("to 1", h / x, h, 0, 1, Quotient((h, x))))
        assert (proof.verdict() is Verdict.HOLDS) is (not more)
    assert "h cannot tend to 0 in «h/x»: the hypothesis some has it" in proof.problems


def test_assumptions_are_exact():
    with pytest.raises(ValueError, match="has a float: write exact numbers"):
        counterexample(equal("x = 1", x, 1), x > 0.5)
