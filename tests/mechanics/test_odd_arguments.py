"""Odd arguments: a result or the sentence of BadSystem; no text is evaluated, wherever it is."""

import builtins
from contextlib import suppress
from fractions import Fraction
from numbers import Number

import numpy as np
import pytest
import sympy as sp

from chapsym.mechanics import METHODS, Quaternion, Runner, Turned, certified, flag, measured, moved, verdicts, volume
from chapsym.mechanics.equations import agree, conserved, in_symbols, of_kane
from chapsym.mechanics.system import STEP, BadSystem, Discrete, System, after, dot, loaded, rate

x, y = sp.symbols("x y")
ENERGY, RULE = (dot(x) ** 2 + dot(y) ** 2) / 2, dot(y) - dot(x)
SLED = System("sled", (x, y), ENERGY, [RULE], start={dot(x): 1})
POINT = System("point", (x,), dot(x) ** 2 / 2, start={dot(x): 1})  # of which all certificates are had at once
OWN = {"lagrangian": (after(x) - x) ** 2 / STEP, "constraints": [after(y) - y], "integrals": {}}
#: A text that leaves a trace where it is evaluated.
TEXT = "setattr(__import__('builtins'), 'evaluated', True)"


def discretized(**of):
    return System("sled", (x, y), ENERGY, [RULE], discrete=Discrete(**of))


#: Functions, with arguments that they accept.
CALLS = {
    "System": (System, {
        "name": "sled", "coordinates": (x, y), "lagrangian": ENERGY, "constraints": [RULE], "holonomic": (),
        "forces": {}, "parameters": {}, "start": {}, "discrete": None, "integrals": {},
    }),
    "Discrete": (discretized, OWN), "dot": (dot, {"x": x}), "after": (after, {"x": x}),
    "rate": (rate, {"expr": x**2, "coordinates": [x]}), "in_symbols": (in_symbols, {"expr": x}),
    "agree": (agree, {"system": SLED, "accelerations": {x: 0, y: 0}}), "of_kane": (of_kane, {"method": None}),
    "conserved": (conserved, {"system": SLED, "quantity": dot(x)}), "flag": (flag, {"system": SLED}),
    "volume": (volume, {"system": SLED}), "verdicts": (verdicts, {"system": SLED, "scheme": None}),
    "certified": (lambda **of: list(certified(**of)), {"system": POINT, "methods": ()}),
    "moved": (moved, {"system": SLED, "method": "dla", "steps": 2, "length": None, "every": 1, "precision": "double"}),
    "measured": (measured, {"system": SLED, "method": "dla", "steps": 2, "length": None, "progress": print}),
    "march": (lambda **of: Runner(SLED, "dla").march(**of), {"steps": 2, "progress": print}),
    "loaded": (loaded, {"path": "none"}), "Quaternion": (Quaternion, {"name": "q"}),
    "Turned": (lambda turn: Turned(turn), {"turn": ("x", x)}),
    "an angle": (lambda angle: Turned(("x", angle)), {"angle": x}),
    "scheme": (METHODS["dla"].scheme, {"system": SLED}),
}  # fmt: skip


class Unwilling:
    """An object that raises an error of its own wherever it is asked."""

    def __getattribute__(self, name):
        raise KeyError("unwilling")


class Shown:
    """An object that prints what could be evaluated."""

    def __repr__(self):
        return TEXT


class Counted(Number, tuple):
    """A number that is a tuple, too, which SymPy reads item by item."""


class Loose(list):
    def __iter__(self):
        raise KeyError("loose")


ODD = [
    None, 1.5, float("nan"), Fraction(1, 3), 10**400, "", "x", [], {}, [None], (x, TEXT), {x: None}, {x: TEXT},
    {x: [TEXT]}, {"a": [TEXT]}, {"a": {1: TEXT}}, {1: TEXT}, {TEXT}, {TEXT: 1}, frozenset([TEXT]), TEXT, [TEXT],
    [[TEXT]], np.array([TEXT]), np.array([TEXT], dtype=object), np.array(TEXT, dtype=object), Shown(), [Shown()],
    {x: Shown()}, {"a": Shown()}, Unwilling(), [Unwilling()], {x: Unwilling()}, Loose([x]), Counted([TEXT]), x,
    [x, x], sp.nan, sp.I,
    sp.Symbol("x", positive=True), sp.Symbol("x", commutative=False), sp.Eq(x, y), sp.Matrix([x]), SLED, np.array(1.5),
]  # fmt: skip


@pytest.mark.parametrize("name", CALLS)
def test_odd_arguments_end_in_a_result_or_a_sentence_and_no_text_is_evaluated(name, monkeypatch):
    monkeypatch.setattr(builtins, "evaluated", False, raising=False)
    function, given = CALLS[name]
    for argument in given:
        for odd in ODD:
            with suppress(BadSystem):
                function(**given | {argument: odd})
            assert not builtins.evaluated, argument
