"""The kernels on fixed-point integers: what the text computes, and that any change of it is seen."""

import re
from fractions import Fraction as F

import pytest
from programs import text_of

from chapsym import generated as kernels
from chapsym.codegen import build, fixed
from chapsym.generated import fixed as generated

BITS = 200


@pytest.mark.parametrize("program", fixed.PROGRAMS, ids=lambda p: p.name)
def test_any_changed_operation_changes_the_value(program):
    text = text_of(fixed, program.name)
    trusted = build.stored_fingerprints(build.folder())[program.name]
    assert build.target_fingerprint(fixed, program, text) == trusted
    lines = text[text.rindex('"""') :]
    start = len(text) - len(lines)
    for found in re.finditer(r" ([-+*]) |>> (P)", lines):
        operator = found[1] or found[2]
        other = {"+": "-", "-": "+", "*": "+", "P": "(P - 1)"}[operator]
        at = start + found.start(1 if found[1] else 2)
        changed = text[:at] + other + text[at + 1 :]
        assert build.target_fingerprint(fixed, program, changed) != trusted, found[0]


def test_integers_are_the_kernels_to_a_few_units():
    """On integers, scaled, each value is within a few units of that of the kernel on fractions."""
    u, k, g = (F(1, 7), F(-2, 9), F(3, 11)), (F(1, 5), F(1, 3), F(-1, 8)), (F(2, 7), F(3, 7), F(6, 7))
    I, D = (F(21, 10), F(17, 10), F(6, 10)), F(7, 10)
    exact = kernels.gibbs_residual(*u, *k, *g, *I, D)
    found = generated.residual_fixed(*(int(x * 2**BITS) for x in (*u, *k, *g, *I, D)), BITS)
    assert all(abs(F(a, 2**BITS) - b) < F(16, 2**BITS) for a, b in zip(found, exact, strict=True))
    exact = [v + x for v, x in zip((*k, *g), (*kernels.turn(1, *u, *k), *kernels.turn(1, *u, *g)), strict=True)]
    found = generated.turns_fixed(*(int(x * 2**BITS) for x in (*u, *k, *g)), BITS)
    assert all(abs(F(a, 2**BITS) - b) < F(16, 2**BITS) for a, b in zip(found, exact, strict=True))
