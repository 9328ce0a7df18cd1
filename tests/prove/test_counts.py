"""Numbers of solutions: found by elimination, and as data that the checker judges.

Of the rotations of a momentum they are those that are found one by one: tests/dynamics/test_branches.py.
"""

import pytest
import sympy as sp

from chapsym import checker
from chapsym.derive.quotient import Quotient
from chapsym.prove import COMPLEX, COMPLEX_MULTIPLE, REAL, REAL_MULTIPLE, Count, Fact, Proof
from chapsym.prove.certificates import certificate
from chapsym.prove.elimination import NotCounted

w, x, y, z, a = sp.symbols("w x y z a")


def count(equations, *relations, unknowns=(w, x), point=None, nonzero=(), text="so many"):
    return Count(text, equations, unknowns, point or {}, relations, Quotient(tuple(point or {})), nonzero)


@pytest.mark.parametrize(
    ("equations", "unknowns", "expected"),
    [
        ([(x**2 + w**2) * (x - w) ** 2 * (2 * w - x)], (w, x), (2, 4, 3, 5)),
        ([x**2 + y**2 - 2 * w**2, x * y - w**2], (w, x, y), (2, 2, 4, 4)),
        ([x**2 - y * w, y**2 - x * w], (w, x, y), (2, 4, 2, 4)),  # one at infinity in the unknowns themselves
        ([x**2 + y * z - w**2, y**2 - x * z, z**2 - w * x], (w, x, y, z), (2, 8, 2, 8)),
    ],
)
def test_the_numbers_of_other_equations(equations, unknowns, expected):
    relations = [sp.Eq(n, k) for n, k in zip((REAL, COMPLEX, REAL_MULTIPLE, COMPLEX_MULTIPLE), expected, strict=True)]
    data = certificate("0", "x", proof(count(equations, *relations, unknowns=unknowns)))
    assert (len(data["counts"]), data["sentences"]) == (1, [])


@pytest.mark.parametrize("equations", [[x * y, x * w], [x**2, x * y, y**2], [w, x, y]])
def test_what_cannot_be_counted_so_is_said(equations):
    with pytest.raises(NotCounted, match="infinitely many, or none, or some touch"):
        count(equations, REAL >= 0, unknowns=(w, x, y)).holds()


def proof(*statements):
    made = Proof()
    made.printed(*statements)
    return made


def test_a_printed_count_that_is_false_is_its_own_counterexample():
    made = proof(count([x**2 + a * w**2], REAL >= 2, point={a: 1}, text="the number of real x/w"))
    data = certificate("0", "x", made)
    assert [one["holds"] for one in data["counts"]] == [False]
    assert data["sentences"] == []
    sides = {"statement": "the number of real x/w", "left": ["0"], "right": ["at least 2"]}
    assert made.counterexamples == [{"point": {"a": "1"}, "printed": [sides], "corrected": []}]
    assert made.problems == []


def test_a_count_off_the_hypotheses_is_no_counterexample():
    made = Proof()
    made.assume("a is negative", a < 0)
    made.printed(count([x**2 + a * w**2], REAL >= 2, point={a: 1}))
    assert made.problems == ["the counterexample violates the hypothesis a is negative"]


def test_what_vanishes_at_a_solution_is_seen_and_a_false_count_that_is_not_printed_is_a_sentence():
    assert count([x**2 - w**2], REAL >= 2, nonzero=[x - 2 * w]).holds()
    wrong = count([x**2 - w**2], REAL >= 2, nonzero=[x - w])
    assert not wrong.holds()
    made = proof(wrong, Fact("seven", True))
    made.lemma(count([x**2 - w**2], REAL > 2, text="three"))
    data = certificate("0", "x", made)
    assert (data["counts"], made.counterexamples) == ([], [])
    assert [one["text"].partition(" (")[0] for one in data["sentences"]] == ["false: so many", "seven", "false: three"]


def test_equations_that_are_not_homogeneous_are_not_accepted():
    with pytest.raises(checker.Rejected, match="no homogeneous polynomial"):
        certificate("0", "x", proof(count([x**2 - w], REAL > 1)))
