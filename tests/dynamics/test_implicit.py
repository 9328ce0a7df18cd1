"""Equations of any register as maps: the discrete Suslov top at every precision, and what has no proof."""

import importlib.util
import sys
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from odd_calls import Unwilling

from chapsym import BadInput, Digits, Enclosure, implicit_step
from chapsym.dynamics.kernels import on_arrays
from chapsym.numbers import named
from chapsym.numbers.precisions import flint_bits

PLACE = Path(__file__).parents[2] / "docs/examples/suslov/generated"
MASS = np.array([1.0, 2.0, 4.0, 0.3, 0.5])
START = [0.125, 0.25]


@pytest.fixture(scope="module")
def table():
    spec = importlib.util.spec_from_file_location(
        "suslov_generated", PLACE / "__init__.py", submodule_search_locations=[str(PLACE)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules["suslov_generated"] = package
    spec.loader.exec_module(package)
    yield package.TABLE
    for name in [name for name in sys.modules if name.startswith("suslov_generated")]:
        del sys.modules[name]


@pytest.fixture(scope="module")
def step(table):
    return implicit_step(table["residual"], table["residual_jacobian"], table["after"])


def taken(step, steps, precision, momentum=START):
    u, m = step([0, 0], momentum, MASS, precision=precision)
    for _ in range(steps - 1):
        u, m = step(u, m, MASS, precision=precision)
    return m


def test_a_batch_keeps_the_energy_and_the_steady_rotations(step, table):
    """The energy to a few units in the last place a step; at a steady rotation u = t(J23, -J13) the momentum, too."""
    random = np.random.default_rng(1)
    momentum = random.uniform(-0.5, 0.5, (40, 2))
    steady = np.array([[0.5, -0.3]]) * 0.1
    momentum = np.concatenate([momentum, on_arrays(table["after"])(steady, MASS)])
    energy, u, m = on_arrays(table["energy"]), 0 * momentum, momentum
    for _ in range(100):
        u, m = step(u, m, MASS)
    drift = np.abs(energy(m, MASS) / energy(momentum, MASS) - 1)
    assert drift.max() < 100 * 4 * 2.0**-52
    assert np.abs(m[-1] - momentum[-1]).max() < 100 * 2 * 2.0**-52 * np.abs(momentum[-1]).max()
    assert np.abs(m[:-1] - momentum[:-1]).max() > 0.01


def test_the_levels_agree_and_the_enclosures_contain(step):
    exact = taken(step, 20, Digits(50))
    for precision, within in (("single", 2e-6), ("double", 1e-14), ("double-double", 1e-29)):
        found = taken(step, 20, precision)
        assert max(abs(float(Fraction(str(x)) - value(y))) for x, y in zip(exact, found, strict=True)) < within
    balls = taken(step, 20, Enclosure(100))
    with flint_bits(200):
        for x, ball in zip(exact, balls, strict=True):
            assert ball.contains(named(Enclosure(160)).number(Fraction(str(x))) + 0)
            assert ball.rad() < 1e-25


def value(x):
    return x.exactly() if hasattr(x, "exactly") else Fraction(float(x))


def test_an_enclosure_is_for_all_known_numbers(step):
    """Those of a ball of momenta: the roots for its ends are inside, and those of others are not."""
    from flint import arb

    level = Enclosure(60)
    with level.working():
        ball = np.array([arb("0.125", "0.001"), arb("0.25")], dtype=object)
        u, _ = step([0, 0], ball, MASS, precision=level)
        for end, inside in ((0.124, True), (0.126, True), (0.2, False)):
            root, _ = step([0, 0], [end, 0.25], MASS, precision=Digits(30))
            assert all(b.contains(arb(str(x))) for b, x in zip(u, root, strict=True)) is inside


def square(x, a):
    return x * x - a


def slope(x, a):
    return 2 * x


GROUPS = (("x", 1), ("a", 1))


def test_what_is_singular_or_too_wide_is_not_proved():
    from flint import arb

    root = implicit_step((square, GROUPS, ()), (slope, GROUPS, ()))
    assert root([1.0], [4.0], precision=Enclosure(60))[0].contains(2)
    with Enclosure(60).working():
        wide = np.array([arb(1, 2)], dtype=object)
        with pytest.raises(BadInput, match="not proved"):
            root([1.0], wide, precision=Enclosure(60))
    for precision in ("double", Digits(20), Enclosure(60)):
        with pytest.raises(BadInput, match=r"does not settle|singular|not proved"):
            root([0.0], [0.0], precision=precision)
        with pytest.raises(BadInput, match="does not settle"):
            root([1.0], [-1.0], precision=precision)
    still = implicit_step((square, GROUPS, ()), (lambda x, a: x - x, GROUPS, ()))  # another slope
    with pytest.raises(BadInput, match="does not settle"):
        still([1.0], [4.0], precision=Enclosure(60))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (([0, 0], START), "takes 3 arrays, gibbs \\(2\\), momentum \\(2\\), mass_tensor \\(5\\), not 2"),
        (([0, 0], [1, 0, 0], MASS), "momentum must have 2 components"),
        ((np.zeros((3, 2)), np.zeros((4, 2)), MASS), "do not broadcast"),
        (([0, 0], [1e3, 0], MASS), "does not settle for number 0"),
    ],
)
def test_bad_input_is_one_sentence(step, given, said):
    with pytest.raises(BadInput, match=said):
        step(*given)


def test_kernels_that_do_not_fit_are_refused(table):
    for rows, said in (
        ((table["residual"], table["after"]), "must have the groups of residual"),
        ((table["residual"], table["residual"]), "must return 4 numbers for 2 unknowns"),
        ((table["residual"], table["residual_jacobian"], (square, GROUPS, ())), "must be among those of residual"),
        ((1.5, table["residual_jacobian"]), "residual must be a row of a generated TABLE"),
        ((table["residual"], [1]), "jacobian must be a row of a generated TABLE"),
        ((table["residual"], table["residual_jacobian"], "3"), "then must be a row of a generated TABLE"),
    ):
        with pytest.raises(BadInput, match=said):
            implicit_step(*rows)


@pytest.mark.parametrize(
    ("large", "precision", "within"),
    [(1e4, "single", 1e-6), (1e12, "double", 1e-15), (1e16, "double-double", 1e-29), (1e16, Digits(30), 1e-30)],
)
def test_each_unknown_is_found_by_its_own_size(large, precision, within):
    """x is so large that a correction of y is small against it."""
    groups = (("x", 2), ("a", 1))
    root = implicit_step(
        (lambda x, y, a: (x - large * a, y * y * y - a), groups, (2,)),
        (lambda x, y, a: (1 + 0 * x, 0, 0, 3 * y * y), groups, (2, 2)),
    )
    y = Fraction(str(root([large, 30.0], [2.0], precision=precision)[1]) if precision == Digits(30) else 0)
    y = y or value(root([large, 30.0], [2.0], precision=precision)[1])
    assert abs(y**3 - 2) < 3 * within * 2


def test_a_double_root_is_refused_where_digits_would_be_missing():
    twice = implicit_step((lambda x, a: (x - 1) * (x - 1) + a, GROUPS, ()), (lambda x, a: 2 * (x - 1), GROUPS, ()))
    assert abs(twice([1.3], [0.0])[0] - 1) < 1e-15
    for precision in ("double-double", Digits(30), Enclosure(60)):
        with pytest.raises(BadInput, match="nearly singular"):
            twice([1.3], [0.0], precision=precision)
    with pytest.raises(BadInput, match="does not settle"):
        twice([1.3], [1e-17])


def test_numbers_are_taken_exactly_and_others_are_refused():
    same = implicit_step((lambda x, a: x - a, GROUPS, ()), (lambda x, a: 1 + 0 * x, GROUPS, ()))
    level = Enclosure(200)
    for exact in (10**17 + 1, Fraction(1, 3), Decimal("0.1")):
        (found,) = same([1.0], [exact], precision=level)
        with level.working():
            assert found.contains(level.number(Fraction(exact)))
    for wrong in ("1", None, 1j, float("nan"), 10**400):
        for precision in ("double", level):
            with pytest.raises(BadInput):
                same([1.0], np.array([wrong], dtype=object), precision=precision)
    digits = same([1.0], [1.0], precision=Digits(30))
    with pytest.raises(BadInput, match="a has a mpf, which is no number of Enclosure"):
        same([1.0], digits, precision=level)


@pytest.mark.parametrize("precision", ["single", "double", "double-double", Digits(30), Enclosure(60)])
def test_what_follows_is_defined_at_the_root(precision):
    step = implicit_step((square, GROUPS, ()), (slope, GROUPS, ()), (lambda x, a: 1 / (x - a), GROUPS, ()))
    root, after = step([2.1], [4.0], precision=precision)
    assert (root.shape, after.shape) == ((1,), ())
    assert float(after) == -0.5
    empty, none = step(np.zeros((0, 1)), [4.0], precision=precision)
    assert (empty.shape, none.shape) == ((0, 1), (0,))
    with pytest.raises(BadInput, match="not defined at a root"):
        step([0.9], [1.0], precision=precision)


@pytest.mark.parametrize("precision", ["single", "double", "double-double"])
def test_a_far_guess_gives_no_root_where_there_is_none(precision):
    """x² + 1: a large correction at the start must not make a later one small."""
    none = implicit_step((lambda x, a: x * x + a, GROUPS, ()), (lambda x, a: 2 * x, GROUPS, ()))
    for guess in (1e-12, 1e12, 38457702956.94342, 71766687001.56982, *1.37 * 10.0 ** np.arange(-15, 16, 5)):
        with pytest.raises(BadInput, match="does not settle"):
            none([guess], [1.0], precision=precision)
    assert abs(none([1e12], [-4.0])[0] - 2) < 1e-15


def test_an_image_that_leaves_its_box_proves_nothing():
    """Of F with F(0) = 1 and F' = 1/(1 + r) in the box of radius r: the image is beyond r for every r."""
    from flint import arb

    from chapsym.dynamics.levels.proved_root import isolated

    assert isolated([arb(1)], lambda box: [1 / (1 + box[0].abs_upper())]) is None
    assert isolated([arb(1)], lambda box: [arb("0.5", "0.4")])[0].contains(-2)


@pytest.mark.filterwarnings("error")
def test_rows_that_are_none_kernels_that_return_something_else_and_odd_numbers_are_refused():
    """Their shapes, sizes and names; and results that are too many, none, or no real numbers."""
    right = (square, GROUPS, ()), (slope, GROUPS, ())
    for groups, shape in ((GROUPS, 3), (GROUPS, ("1",)), ((("x",), ("a", 1)), ()), ((("x", 0),), ())):
        odd = square, groups, shape
        for rows in ((odd, right[1]), (right[0], odd), (*right, odd)):
            with pytest.raises(BadInput, match="must be a row of a generated TABLE"):
                implicit_step(*rows)
    twice = (("x", 1), ("x", 1))
    with pytest.raises(BadInput, match="must be a row of a generated TABLE"):
        implicit_step((square, twice, ()), (slope, twice, ()))
    for result in ((1, 2), None, "1", np.ones(7), 1j):

        def other(*_, result=result):
            return result

        for rows in ((other, square), (square, other)):
            root = implicit_step(*((one, GROUPS, ()) for one in rows))
            for precision in ("double", Digits(20)):
                with pytest.raises(BadInput, match="other does not return 1 real numbers"):
                    root([1.0], [2.0], precision=precision)
        root = implicit_step(*right, (other, GROUPS, ()))
        with pytest.raises(BadInput, match="other does not return 1 real numbers"):
            root([1.0], [2.0])
    root = implicit_step(*right)
    for given, precision, said in (
        (([1.0], [2.0]), "half", "precision must be"),
        (([1e300], [2.0]), "single", "x is beyond the range of float32"),
        (([5e-324], [-1e300]), "double", "does not settle"),
        (([1.0], [[1], [1, 2]]), "double", "a must"),
        (([1.0], np.array([np.ma.masked, Unwilling(1)], object)), "double", "a must"),
    ):
        with pytest.raises(BadInput, match=said):
            root(*given, precision=precision)
