"""Numbers with units: exact conversion, and a sentence for what does not fit."""

import math
import re
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym.scene.read import units
from chapsym.scene.read.units import ANGLE, LENGTH, MASS, MOMENT, PURE, RATE, SPEED, TIME, number


@pytest.mark.parametrize(
    ("text", "dimension", "si"),
    [
        ("108.5 mm", LENGTH, 0.1085),  # 108.5 * 0.001 in floats is another number
        ("1/4 in", LENGTH, 0.00635),
        ("3mm", LENGTH, 0.003),
        ("-3e2 mm", LENGTH, -0.3),
        ("16 lb", MASS, 7.25747792),
        ("320 kg cm^2", MOMENT, 0.032),
        ("320 kg cm²", MOMENT, 0.032),
        ("320 kg*cm**2", MOMENT, 0.032),
        ("1 g m2", MOMENT, 0.001),
        ("29 km/h", SPEED, 29 / 3.6),
        ("3 m s-1", SPEED, 3.0),
        ("10 ms", TIME, 0.01),
        ("180 deg", ANGLE, math.pi),
        ("1/4 rev", ANGLE, math.pi / 2),
        ("2 min", TIME, 120.0),
        ("5 millis", TIME, 0.005),
        ("30 rpm", RATE, math.pi),
        ("1.5 rev/s", RATE, 3 * math.pi),
        ("180 deg/s", RATE, math.pi),
        ("2/7", RATE, 2 / 7),
        ("2/7", PURE, 2 / 7),
        (3, LENGTH, 3.0),
        (0.25, PURE, 0.25),
    ],
)
def test_a_unit_is_converted_to_the_nearest_float(text, dimension, si):
    assert number(text, dimension) == si


@pytest.mark.parametrize(
    ("text", "dimension", "sentence"),
    [
        ("3 kg", LENGTH, "it is a length, but '3 kg' is a mass; write metres, such as 0.1085, or '108.5 mm'"),
        ("3 N m", MOMENT, "it is a moment of inertia, but '3 N m' measures something else; write kg m²"),
        ("3 Hz", RATE, "'3 Hz' does not say which angle"),  # to pint 1 Hz is 1 rad/s
        ("3 1/s", RATE, "'3 1/s' does not say which angle"),
        ("2 kilos", MASS, "it is a mass, but '2 kilos' says no unit, only how many; write kilograms"),
        ("3 kilos m2", MOMENT, "'3 kilos m2' says no unit, only how many"),
        ("3 foo", LENGTH, "'foo' in '3 foo' is not a known unit"),
        ("30 deg", PURE, "it has no unit, but '30 deg' has one"),
        ("abc", LENGTH, "'abc' is not a number"),
        ("", LENGTH, "'' is not a number"),
        ("1/0 m", LENGTH, "'1/0' divides by zero"),
        ("1e9999 m", LENGTH, "it is beyond the range of float64"),
        ("1e-320 m", LENGTH, "it is below 2.2e-308"),
        ("3 m^99999999", LENGTH, "'3 m^99999999' is not a number with a unit"),
        ("3 (2**9**9**9) m", LENGTH, "is not a number with a unit"),
        ("3 __import__('os')", LENGTH, "is not a number with a unit"),
        ("3 degC", LENGTH, "measures something else"),
        ("3 dB", LENGTH, "it is a length"),
        ("3 dB", ANGLE, "'3 dB' does not say which angle"),
        ("30 deg", LENGTH, "'30 deg' is an angle"),
        ("5 percent", LENGTH, "'5 percent' measures something else"),
        ("5 percent", ANGLE, "'5 percent' does not say which angle; write '30 deg' or '0.5 rad'"),
        ("1 Hz", ANGLE, "'1 Hz' measures something else"),
        (True, LENGTH, "it must be a number"),
        (None, LENGTH, "it must be a number"),
        (10**400, LENGTH, "it is beyond the range of float64"),
        (math.nan, LENGTH, "it must be finite, not nan"),
    ],
)
def test_what_is_no_such_quantity_is_refused(text, dimension, sentence):
    with pytest.raises(ValueError, match=re.escape(sentence)) as caught:
        number(text, dimension)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("damaged", [False, True])
def test_a_unit_is_told_to_need_pint_and_why_pint_cannot_be_loaded(tmp_path, monkeypatch, damaged):
    (tmp_path / "pint.py").write_text("raise ImportError('a library of pint is damaged')")
    units._registry.cache_clear()
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setitem(sys.modules, "pint", None)
    if damaged:
        monkeypatch.delitem(sys.modules, "pint")
    said = "cannot be loaded: a library of pint is damaged" if damaged else "cannot be loaded"
    try:
        with pytest.raises(ValueError, match=f"it has a unit, and pint, which reads units, {said}"):
            number("3 cm", LENGTH)
    finally:
        units._registry.cache_clear()


@given(st.text(st.characters(codec="utf-8", max_codepoint=0x300), max_size=30), st.sampled_from(["", "3 ", "1e3 "]))
def test_any_text_is_a_number_or_a_sentence(text, start):
    try:
        found = number(start + text, LENGTH)
    except ValueError:
        return
    assert isinstance(found, float)
