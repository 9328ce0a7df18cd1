"""The kernels on double-double numbers: checked as the other generated files are, and against the class `Pair`."""

import re
from fractions import Fraction as F

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import TEXTS, program, text_of

from chapsym import generated as kernels
from chapsym.codegen import build, pairs, values
from chapsym.codegen.printer import NotStraightLine
from chapsym.generated import double_double as generated
from chapsym.numbers import Pair
from chapsym.proofs.kernels import PROGRAMS

U2 = 2.0**-106


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda p: p.name)
def test_any_changed_operation_or_half_changes_the_value(program):
    """Every call in turn: another function, and each of its arguments another."""
    text = text_of(pairs, program.name)
    trusted = build.stored_fingerprints(build.folder())[program.name]
    assert values.target_fingerprint(pairs, program, text) == trusted
    other = {"two_sum": "two_product", "two_product": "two_sum", "loose_add": "loose_subtract",
             "loose_subtract": "loose_add", "loose_multiply": "divide", "divide": "loose_multiply",
             "loose_add_float": "loose_multiply_float", "loose_multiply_float": "loose_add_float"}  # fmt: skip
    calls = list(re.finditer(r"^    \w+, \w+ = (\w+)\((.*)\)$", text, re.MULTILINE))
    assert len(calls) >= 35
    for call in calls:
        changed = text[: call.start(1)] + other[call[1]] + text[call.end(1) :]
        assert values.target_fingerprint(pairs, program, changed) != trusted, call[0]
        for i, argument in enumerate(call[2].split(", ")):
            arguments = call[2].split(", ")
            arguments[i] = argument.rstrip("_") if argument.endswith("_") else f"3 * {argument}"
            changed = text[: call.start(2)] + ", ".join(arguments) + text[call.end(2) :]
            if argument != "0":
                assert values.target_fingerprint(pairs, program, changed) != trusted, (call[0], argument)


numbers = st.fractions(F(-2), F(2), max_denominator=10**40).filter(lambda x: abs(x) > F(1, 10**6))


def pairs_of(values):
    return [half for x in values for half in Pair.of(x).halves()]


def gap(found, control):
    """The largest difference between flat halves and Pairs, in units of u²."""
    halves = zip(found[::2], found[1::2], control, strict=True)
    return max(abs(float(F(a) + F(b) - x.exactly())) for a, b, x in halves) / U2


@given(st.lists(numbers, min_size=6, max_size=6), st.lists(st.floats(-2, 2), min_size=3, max_size=3))
def test_the_residual_against_the_kernel_on_pairs(values, u):
    """Products of up to five factors in [-2, 2]: the terms add up to 200 at most, and each errs by some u²."""
    k, g = values[:3], values[3:]
    I, D = (F(1, 3), F(2, 3), F(5, 7)), 0.7
    found = generated.gibbs_residual_pairs(*u, *pairs_of(k), *pairs_of(g), *pairs_of(I), D)
    control = kernels.gibbs_residual(*map(Pair, u), *map(Pair.of, (*k, *g, *I)), Pair(D))
    assert gap(found, control) <= 2000


@given(st.lists(numbers, min_size=9, max_size=9))
def test_turns_against_the_kernel_on_pairs(values):
    u, k, g = values[:3], values[3:6], values[6:]
    found = generated.turn_pairs(*map(float, pairs_of(values)))
    control = []
    for v in (k, g):
        moved = kernels.turn(Pair(1.0), *map(Pair.of, (*u, *v)))
        control += [Pair.of(x) + y for x, y in zip(v, moved, strict=True)]
    assert gap(found, control) <= 400


def test_kinds_of_operands():
    """Floats stay floats where an operation with a pair can use it, and what cannot be a pair is told."""
    lines = pairs.lowered(program("x = D * g1 + (g2 - D) * D * D - D\ny = D - g2", ("x", "y"), ("D",)), {})
    used = [line.split(" = ")[1].split("(")[0] for line in lines]
    assert used == [
        "loose_multiply_float", "loose_add_float", "loose_multiply_float", "loose_multiply_float", "loose_add",
        "loose_add_float", "loose_add_float", "two_sum", "two_sum",
    ]  # fmt: skip
    with pytest.raises(NotStraightLine, match="x is no pair"):
        pairs.lowered(program("x = D", floats=("D",)), {})
    assert "t1, t1_ = 2 * g1, 2 * g1_" in pairs.lowered(program("x, y = twice(g1)", ("x", "y")), TEXTS)
    assert pairs.lowered(program("x = 1 * g1 * 1 / 2"), {})[0] == "t0, t0_ = g1 / 2, g1_ / 2"


def test_what_a_program_costs():
    lines = pairs.lowered(program("x = g1 * g2 + D", floats=("D",)), {})
    assert pairs.flops(lines) == 6 + 7 + 6
