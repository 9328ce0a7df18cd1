"""Letters of kernels: sines, cosines, roots and π, with what holds for them and nothing else."""

import hashlib
import importlib.util
import math
from contextlib import nullcontext
from fractions import Fraction

import mpmath
import numpy as np
import pytest
import sympy as sp
from commands import answer, chapsym
from pendulum import KERNELS

from chapsym import Digits, Enclosure
from chapsym.checker import Rejected
from chapsym.checker import kernels as binding
from chapsym.checker.letters import check_moves, read
from chapsym.checker.polynomial import Ring, Work
from chapsym.checker.trees import value
from chapsym.codegen import left

pytestmark = pytest.mark.usefixtures("forgotten")

WITH_LETTERS = KERNELS.replace("KERNELS = [", "import sympy as sp\nq = sp.Symbol('q')\nKERNELS = [").replace(
    "lambda: [{expression}])", "lambda: [{expression}], letters={{@}})"
)
MOVED = '(("place", ({},)), ("velocity", (v, w)), ("gravity", (g,)))'


def written(register, letters, place="q", carrier="left('{id}', 'a at which that is 0')"):
    """The folder of the pendulum, whose kernel has letters."""
    kernels = WITH_LETTERS.replace("@", letters)
    return register(carrier=carrier, expression="pull()", groups=MOVED.format(place), kernels=kernels)


def loaded(folder):
    spec = importlib.util.spec_from_file_location("pull", folder / "generated/pull.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.pull


@pytest.mark.parametrize(
    ("letters", "place", "at", "y"),
    [
        ("x: sp.sin(q), y: sp.cos(q)", "q", 0.3, math.cos(0.3)),
        ("y: sp.sin(2 * q), x: sp.cos(q + q)", "q", 0.3, math.sin(0.6)),
        ("y: sp.sqrt(1 - x**2)", "x", 0.6, 0.8),
        ("y: sp.cos(1), x: sp.sin(1)", "q", 0.6, math.cos(1)),
        ("q: sp.pi, y: sp.cos(q * a), x: sp.sin(a * q)", "a", 0.25, math.cos(math.pi / 4)),
    ],
)
def test_a_letter_is_a_function_of_what_is_given(register, letters, place, at, y):
    """The relation of the ring, x² + y² = 1, follows from the letters."""
    folder = written(register, letters, place)
    answer("codegen", "--register", folder)
    pull = loaded(folder)
    assert pull(at, 1.0, 2.0, 10.0) == 5 - 10 * y
    assert answer("codegen", "--check", "--register", folder)["kept"] is True
    found = pull(np.array([at, at]), np.array([1.0, 2.0]), 2.0, 10.0)
    assert np.abs(found - [5 - 10 * y, 8 - 10 * y]).max() < 1e-14
    digits, balls = Digits(30), Enclosure(100)
    exact = Fraction(*mpmath.libmp.to_rational(pull(digits.context.mpf(at), 1, 2, 10)._mpf_))
    with balls.working():
        difference = pull(balls.number(Fraction(at)), 1, 2, 10) - balls.number(exact)
        assert abs(float(difference.mid())) < 1e-29


@pytest.mark.parametrize(
    ("letters", "said"),
    [
        ("x: sp.sin(q), y: sp.cos(2 * q)", "a letter of which a relation of «a at which that is 0» does not follow"),
        ("x: sp.sin(q), y: sp.sin(2 * q)", "of which a relation of"),
        ("x: sp.sin(q), y: sp.sin(q)", "has the letters x and y for one thing"),
        ("x: sp.sqrt(q), y: sp.sqrt(2 + q)", "of which a relation of"),
        ("x: sp.sin(sp.pi * q), y: sp.cos(sp.pi * q)", "its letter x is of pi*q, which is no straight line: pi"),
        ("x: sp.sin(q + sp.Rational(1, 2)), y: sp.cos(q)", "is no straight line: the number 1/2 would be rounded"),
        ("x: sp.sin(q**v), y: sp.cos(q**v)", "is no straight line"),
        ("x: sp.sin(sp.Rational(1, 3)), y: sp.cos(q)", "is no straight line"),
        ("y: sp.cos(q)", "of which a relation of"),
        ("y: sp.tan(q)", "its letter y is tan(q); a letter is sin, cos or sqrt of something, or pi"),
        ("y: q**2", "its letter y is q**2; a letter is"),
        ("y: sp.cos(x)", "its letter y has x, which it does not know there"),
        ("q: sp.cos(v)", "q is an argument or a letter already"),
        ("'y': sp.cos(q)", "its letters are given as {symbol: expression}"),
    ],
)
def test_a_letter_that_is_none_is_refused_in_one_sentence(register, letters, said):
    folder = written(register, letters, "x, q" if letters.startswith("y: sp.cos(q") else "q")
    done = chapsym("codegen", "--register", folder)
    assert said in done.stderr
    assert (done.stderr.count("\n"), done.returncode) in ((1, 1), (1, 2))
    assert not (folder / "generated").exists()


HEAD = '"""A letter."""\n\nfrom chapsym.numbers.functions import cos, sin\n\n\ndef turned(q, x):\n    """x."""\n'
TEXT = HEAD + "    s = sin(q)\n    c = cos(q)\n    return s * x, c * x\n"
DEEP = "q"
for _ in range(900):
    DEEP = ["+", DEEP, 1]
LETTERS = [["s", "sin", "q"], ["c", "cos", "q"]]
RING = {"kind": "quotient", "variables": ["s", "c", "x", "q"], "relations": [["+", ["^", "s", 2], ["^", "c", 2], -1]]}
STATEMENT = {"text": "x", "left": [["*", "s", "x"], ["*", "c", "x"]], "right": [0, 0], "algebra": 0, "point": 0}
POINT = {"s": "3/5", "c": "4/5", "x": 1, "q": 1}
CERTIFICATES = {"x 0": {"algebras": [RING], "derivation": [], "points": [POINT], "statements": [STATEMENT]}}


def judged(text=TEXT, letters=LETTERS, carrier=None, point=POINT, name="turned", inputs=("q", "x"), **changes):
    """changes: of the certificate."""
    carrier = carrier or left("x", "x")
    carrier = carrier if isinstance(carrier, dict) else carrier.data(lambda _: "0")
    row = {"inputs": [*inputs], "letters": letters, "carriers": [carrier | {"point": point}]}
    row["text_sha256"] = hashlib.sha256(text.encode()).hexdigest()
    return binding.check(row, text, {"x 0": CERTIFICATES["x 0"] | changes}, name)


def test_the_checker_accepts_letters():
    assert judged() == ["x"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("sin(q)", "cos(q)", "has no letter s that is this cos"),
        ("sin(q)", "sin(2 * q)", "has no letter s that is this sin"),
        ("s = sin(q)", "t = sin(q)", "has no letter t that is this sin"),
        ("s = sin(q)", "s = sin(1)", "has a sin of something that is none"),
        ("s = sin(q)", "s = sin(q, x + x)", "has a sin of something that is none"),
        ("s = sin(q)", "n = 1\n    s = sin(q, n)", "has a sin of something that is none"),
        ("def turned", "def sin", "a function of another name|has sin as a name"),
        ("s = sin(q)", "s = sin(q, like=q)", "a call that is none of numbers"),
        ("s = sin(q)", "s = sin(*q)", "a call that is none of numbers"),
        ("s = sin(q)", "s = tan(q)", "calls what it does not import"),
        ("s = sin(q)", "s = q.sin(q)", "calls what it does not import"),
        ("s = sin(q)", "sin = q\n    s = sin(q)", "has sin as a name of something else"),
        ("return s * x", "return sin(q) * x", "neither a known name"),
        ("return s * x", "return c * x", "computes in its result 0 something else"),
        ("chapsym.numbers", "numpy", "has more than a docstring, functions of"),
        ("import cos, sin", "import cos as sin, sin as cos", "has more than a docstring, functions of"),
        ("import cos, sin", "import *", "has more than a docstring, functions of"),
        ("    s = sin(q)\n", "", "neither a known name"),
    ],
)
def test_a_text_with_other_letters_is_refused(old, new, said):
    assert old in TEXT
    with pytest.raises(Rejected, match=said):
        judged(TEXT.replace(old, new))


def test_a_function_is_not_called_as_what_it_calls():
    with pytest.raises(Rejected, match="has sin as a name of something else"):
        judged(TEXT.replace("def turned", "def sin"), name="sin")


@pytest.mark.parametrize(
    ("letters", "said"),
    [
        ([["s", "sin", "q"], ["c", "cos", ["*", 2, "q"]]], "has no letter c|does not follow"),
        ([["s", "sin", "q"]], "has no letter c"),
        ([["s", "tan", "q"], ["c", "cos", "q"]], "a letter of turned"),
        ([["s", "sin", "c"], ["c", "cos", "q"]], "a letter 's' for an expression with unknown names"),
        ([["x", "sin", "q"], ["c", "cos", "q"]], "turned has a name twice"),
        ([["s", "sin", "q"], ["c", "cos", "q"], ["d", "cos", "q"]], "has the letters c and d for one thing"),
        ([["s", "sin", DEEP], ["c", "cos", "q"]], "for an expression with unknown names"),
        ([["s", "sin"], ["c", "cos", "q"]], "a letter of turned"),
        ("s", "turned"),
    ],
)
def test_letters_that_are_none_are_refused(letters, said):
    with pytest.raises(Rejected, match=said):
        judged(letters=letters)


def test_the_point_of_a_kernel_has_its_letters():
    with pytest.raises(Rejected, match="a point at which a relation fails"):
        judged(point=POINT | {"s": 1})
    with pytest.raises(Rejected, match="no value for c"):
        judged(point={x: v for x, v in POINT.items() if x != "c"})


def test_a_name_that_the_certificate_derives_is_no_argument_or_letter():
    """Or an entry that is derived would be whatever the text computes for its name."""
    statement = STATEMENT | {"left": [["*", "s", "x"], "w"]}
    text = TEXT.replace("def turned(q, x)", "def turned(q, x, w)").replace("c * x\n", "w\n")
    with pytest.raises(Rejected, match="which has 'w' without a value"):
        judged(text, inputs="qxw", point=POINT | {"w": 1}, statements=[statement])


def test_the_point_of_roots_is_positive_and_cofactors_are_of_known_names():
    text = TEXT.replace("cos, sin", "sqrt").replace("    s = sin(q)\n    c = cos(q)\n", "    s = sqrt(q)\n")
    text = text.replace("return s * x, c * x", "return s * x, s * x")
    changes = {"statements": [STATEMENT | {"left": [["*", "s", "x"]] * 2}], "algebras": [RING | {"relations": []}]}
    for point, cofactors, said in (
        ({"s": 2, "q": 4, "x": 1}, [], None),
        ({"s": -2, "q": 4, "x": 1}, [], "a point at which the root s is negative"),
        ({"s": 2, "q": 4, "x": 1}, [[0, ["foo"]]], "has the name 'foo', which is not among its variables"),
    ):
        carrier = left("x", "x").data(lambda _: "0") | {"cofactors": cofactors}
        with nullcontext() if said is None else pytest.raises(Rejected, match=said):
            assert judged(text, [["s", "sqrt", "q"]], carrier, point | {"c": 1}, **changes) == ["x"]


def test_nothing_is_put_in_after_derivatives_of_letters():
    angle, sine, cosine = sp.symbols("q s c")
    carrier = left("x", "x").along({angle: 1, sine: cosine, cosine: -sine}).at({sine: cosine, cosine: sine})
    with pytest.raises(Rejected, match="puts in expressions after derivatives"):
        judged(TEXT.replace("s * x, c * x", "s * x, -c * x"), carrier=carrier)


ONE = ["s", "sqrt", ["+", 1, ["*", -1, "q", "q"]]]


@pytest.mark.parametrize(
    ("rows", "move", "said"),
    [
        (LETTERS, {"q": 1, "s": "c", "c": ["*", -1, "s"]}, None),
        (LETTERS, {"q": "x", "s": ["*", "c", "x"], "c": ["*", -1, "s", "x"]}, None),
        (LETTERS, {"x": 1}, None),
        (LETTERS, {"q": 1}, "letter s at another rate"),
        (LETTERS, {"s": "c", "c": ["*", -1, "s"]}, "letter s at another rate"),
        (LETTERS, {"q": 2, "s": "c", "c": ["*", -1, "s"]}, "letter s at another rate"),
        (LETTERS, {"q": 1, "s": "c", "c": "s"}, "letter c at another rate"),
        ([["c", "cos", "q"]], {"q": 1, "c": "s"}, "letter c, whose derivative is no letter"),
        ([ONE], {"q": "s", "s": ["*", -1, "q"]}, None),
        ([ONE], {"q": "s", "s": "q"}, "letter s at another rate"),
        ([["c", "pi", 1]], {"c": 1}, "letter c at another rate"),
        ([["c", "pi", 1]], {"q": 1}, None),
    ],
)
def test_letters_move_as_what_they_stand_for(rows, move, said):
    ring = Ring(["c", "q", "s", "x"], Work())
    given = {name: value(tree, ring.names(), ring.number) for name, tree in move.items()}
    with nullcontext() if said is None else pytest.raises(Rejected, match=said):
        check_moves(read(rows, ring, "turned"), [given], "turned")


def test_a_carrier_is_differentiated_with_its_letters():
    """Of s x and c x by the angle: without the rates of s and c all of it would be 0."""
    angle, sine, cosine = sp.symbols("q s c")
    text = TEXT.replace("s * x, c * x", "c * x, -s * x")
    assert judged(text, carrier=left("x", "x").along({angle: 1, sine: cosine, cosine: -sine})) == ["x: its derivatives"]
    with pytest.raises(Rejected, match="moves the letter s at another rate"):
        judged(text, carrier=left("x", "x").along({angle: 1}))
