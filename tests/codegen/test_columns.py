"""The kernels as NumPy calls: the same operations as the scalar text, checked as the other generated files are."""

import contextlib
import json
import re

import numpy as np
import pytest
from programs import TEXTS, program, text_of

from chapsym.codegen import build, columns
from chapsym.codegen.printer import NotStraightLine
from chapsym.dynamics.loops import gibbs, sums
from chapsym.generated import columns as generated
from chapsym.generated import turn


@pytest.mark.parametrize("program", columns.PROGRAMS, ids=lambda p: p.name)
def test_any_changed_operation_or_buffer_changes_the_value(program):
    """Every call in turn: another operation, and another place for what it writes."""
    text = text_of(columns, program.name)
    trusted = build.stored_fingerprints(build.folder())[program.name]
    assert build.target_fingerprint(columns, program, text) == trusted
    calls = list(re.finditer(r"^    (add|subtract|multiply|divide|negative)\(.*, (\w+)\)$", text, re.MULTILINE))
    assert (
        len(calls) == json.loads((build.folder() / build.MANIFEST).read_text())["columns"][program.name]["operations"]
    )
    other = {"add": "subtract", "subtract": "add", "multiply": "add", "divide": "multiply"}
    for call in calls:
        if call[1] in other:
            changed = text[: call.start(1)] + other[call[1]] + text[call.end(1) :]
            assert build.target_fingerprint(columns, program, changed) != trusted, call[0]
        lost = text[: call.start()] + "    pass" + text[call.end() :]
        with contextlib.suppress(TypeError, AttributeError):  # a buffer that nothing wrote is read
            assert build.target_fingerprint(columns, program, lost) != trusted, call[0]


def test_a_changed_line_is_named(copy):
    path = copy / columns.FILE
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("    add(", "    subtract(", 1), encoding="utf-8")
    assert build.check(copy) == [
        "columns.py is changed",
        "newton_columns in columns.py computes another value than the derivation",
    ]
    path.write_text(text.replace("def turn_columns(", "def turned_columns("), encoding="utf-8")
    assert build.check(copy) == ["columns.py is changed", "turn_columns in columns.py does not run: 'turn_columns'"]
    path.unlink()
    assert build.check(copy) == ["columns.py is missing"]


def test_the_calls_have_the_bits_of_the_scalar_rounds():
    random = np.random.default_rng(3)
    lanes = 50
    u, k = 0.1 * random.normal(size=(2, 3, lanes))
    g, inertia, D = random.normal(size=(3, lanes)), random.uniform(1, 3, (3, lanes)), random.uniform(0, 2, lanes)
    pool = np.full((generated.POOL, lanes), np.nan)
    inputs = [*u, *k, *g, *inertia, D]
    once, twice, turned = (np.full((n, lanes), np.nan) for n in (11, 17, 6))
    generated.newton_columns(*inputs, *once, pool)
    generated.second_columns(*inputs, *twice, pool)
    generated.turn_columns(*once[:4], *k, *g, *turned, pool)
    for i in range(lanes):
        ball = [float(x[i]) for x in inputs]
        p0, p1, p2, p3, w1, w2, w3, first, d1, d2, d3, *cofactors = gibbs.newton_round(*ball)
        near = ball[0] * ball[0] + (ball[1] * ball[1] + ball[2] * ball[2])
        assert once[:, i].tolist() == [p0, p1, p2, p3, w1, w2, w3, near, d1, d2, d3]
        second = gibbs.second_round(p0, p1, p2, p3, *ball[3:6], d1, d2, d3, *cofactors, *ball[9:12])
        longer = second[3] * second[3] + (second[4] * second[4] + second[5] * second[5])
        assert twice[:, i].tolist() == [p0, p1, p2, p3, w1, w2, w3, near, first, *second, longer]
        both = *turn(p0, p1, p2, p3, *ball[3:6]), *turn(p0, p1, p2, p3, *ball[6:9])
        assert turned[:, i].tolist() == list(both)


def test_sums_and_filter_have_the_bits_of_the_loops_in_place():
    """Each writes over what it has read: the sum over the rest, the filter over what it moves on."""
    random = np.random.default_rng(4)
    total, rest, more, there = random.normal(size=(4, 50))
    filters, w = random.normal(size=(8, 50)), random.normal(size=50)
    added = [sums.added(*ball) for ball in zip(total, rest, more, strict=True)]
    moved = [sums.filtered(*ball[1:], x) for ball, x in zip(filters.T, w, strict=True)]
    generated.added_columns(total, rest, more, there, rest, np.empty((2, 50)))
    generated.filtered_columns(*filters[1:], w, *filters, np.empty((4, 50)))
    assert ([there, rest] == np.array(added).T).all()
    assert (filters == np.array(moved).T).all()


def test_shared_values_are_computed_once_and_idle_ones_not():
    text = "a, b = twice(g1)\nc, d = twice(g1)\nidle = g2 / g3\nx = a * g2 + g2 * c\ny = b - d"
    lines = columns.lowered(program(text, ("x", "y")), TEXTS)
    assert [operation for operation, _, _ in lines] == ["multiply", "add", "multiply", "add", "subtract"]
    assert lines[1][1] == ("g1", "g1")  # twice a value is a sum, and a product may be turned round
    assert [target for _, _, target in lines][-2:] == ["x", "y"]
    assert columns.buffers(lines) == 2


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("x = g1 ** 2", "is not a known name, an integer or"),
        ("x = 0.5 * g1", "is not a known name, an integer or"),
        ("x = g1 + h", "h is not a known name"),
        ("x, y = thrice(g1)", "may call kernels, and thrice is none"),
        ("x = g1", "every output must be a value of its own"),
        ("x = g1 + g2\ny = g2 + g1", "every output must be a value of its own"),
        ("for x in g1: pass", "may only assign and return"),
    ],
)
def test_what_is_no_straight_line_of_kernels_is_refused(text, sentence):
    outputs = ("x", "y") if "y" in text else ("x",)
    with pytest.raises(NotStraightLine, match=sentence):
        columns.lowered(program(text, outputs), TEXTS)
