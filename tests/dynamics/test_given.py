"""What users hand over, at every precision: arrays of every make give the same bits; what is no number is refused."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import chapsym
from chapsym import BadInput, Ball, Digits, Enclosure
from chapsym.rationals import exact_fraction
from research.extremes.judging import number, whole

J, D, G, K = (1.0, 2.0, 4.0), 3.0, (2 / 7, 3 / 7, 6 / 7), (1.0, -0.5, 0.75)
STEPS = 3
#: A momentum and its vertical, of one state and of a batch.
STATES = [
    (np.array(K), np.array(G)),
    (np.array([K, (0.3, 0.2, -0.1), (-0.4, 0.1, 0.2)]), np.array([G, (0.6, 0.0, 0.8), (0.0, 0.0, 1.0)])),
]
precisions = pytest.mark.parametrize("precision", ["single", "double", "double-double", Digits(50), Enclosure(200)])


def run(precision, momentum=K, gamma=G, J=J, D=D, steps=STEPS, **options):
    return chapsym.trajectory(Ball(J, D), momentum, gamma, steps, precision=precision, **options)


def bits(found):
    """All numbers of a run, exactly."""
    return [number(x) for name in ("momentum", "gamma") for x in whole(found, name).flat]


def strided(x):
    """Every second element of a larger array, backwards in the components."""
    wide = np.zeros((*x.shape[:-1], 6))
    wide[..., ::-2] = x
    return wide[..., ::-2]


def read_only(x):
    copy = x.copy()
    copy.flags.writeable = False
    return copy


MADE = {
    "not contiguous, backwards": strided,
    "column order": np.asfortranarray,
    "wrong byte order": lambda x: x.astype(x.dtype.newbyteorder()),
    "read-only": read_only,
    "lists": lambda x: x.tolist(),
    "fractions": np.vectorize(Fraction, otypes=[object]),
    "decimals": np.vectorize(Decimal, otypes=[object]),
    "long doubles": lambda x: x.astype(np.longdouble),
    "memory views": lambda x: np.ascontiguousarray(x).data,
}


@precisions
@pytest.mark.parametrize("made", MADE)
def test_the_same_bits_come_from_arrays_that_are_made_otherwise(precision, made):
    for plain in STATES:
        given = [MADE[made](x) for x in (*plain, np.array(J))]
        before = [np.array(x, copy=True) for x in given]
        assert bits(run(precision, *given)) == bits(run(precision, *plain))
        assert not any((np.asarray(x) != y).any() for x, y in zip(given, before, strict=True))


LARGE = 2**53 + 1
BEYOND = {
    "integers": lambda x: (LARGE * np.array(x)).astype(np.int64),
    "natural numbers": lambda x: (LARGE * np.array(x)).astype(np.uint64),
    "long doubles": lambda x: np.array(x, np.longdouble) / 3,
}


@pytest.mark.parametrize("precision", ["double-double", Digits(50), Enclosure(200)])
@pytest.mark.parametrize("made", BEYOND)
def test_numbers_that_float64_does_not_hold_are_not_rounded(precision, made):
    momentum, moments, contact = (BEYOND[made](x) for x in ((1, 2, 3), (30, 40, 50), 60))
    if isinstance(precision, str):  # the ball of double-double is one of floats
        moments, contact = np.array(moments, float), np.array(contact, float)
    exact = [np.vectorize(exact_fraction, otypes=[object])(x) for x in (momentum, moments, contact)]
    found = run(precision, momentum, G, moments, contact, steps=1)
    assert bits(found) == bits(run(precision, exact[0], G, *exact[1:], steps=1))
    assert bits(found) != bits(run(precision, momentum.astype(float), G, moments, contact, steps=1))


@precisions
def test_float32_arrays_are_the_numbers_that_they_hold(precision):
    momentum, gamma = (np.array(x, np.float32) for x in (K, (0.6, 0.0, 0.8)))
    wide = gamma.astype(np.float64)
    found = run(precision, momentum, gamma, np.array(J, np.float32), np.float32(D))
    plain = run(precision, momentum.astype(np.float64), wide / np.sqrt(wide @ wide))
    for name in ("momentum", "gamma"):
        one, other = (np.vectorize(float)(getattr(x, name)) for x in (found, plain))
        assert np.abs(one - other).max() <= 16 * 2.0**-23


@precisions
def test_no_balls_and_no_steps_have_their_shapes(precision):
    for shape in ((0, 3), (2, 0, 3)):
        found = run(precision, np.zeros(shape))
        assert found.momentum.shape == found.gamma.shape == (*shape[:-1], STEPS + 1, 3)
        assert found.status.shape == shape[:-1]
        assert chapsym.step(Ball(J, D), np.zeros(shape), G, precision=precision).momentum.shape == shape
    assert run(precision, steps=0, attitude=True).momentum.shape == (1, 3)
    assert run(precision, gamma=np.float32((0, 0, 1)), D=np.array(D), steps=np.int64(5)).momentum.shape == (6, 3)
    assert {number(x) for x in run(precision, (0, 0, 0)).momentum.flat} == {0}


def anywhere(value):
    """A value in the place of a component of everything that is given."""
    bad = (value, -0.5, 0.75)
    return [
        {"momentum": bad}, {"gamma": (0.6, value, 0.8)}, {"J": (value, 2.0, 4.0)}, {"D": value}, {"momentum": [K, bad]},
    ]  # fmt: skip


LONG = np.longdouble
MASKED = np.ma.masked_array([1.0, 2.0, 3.0], mask=[False, True, False])
REFUSED = {
    "NaN": anywhere(float("nan")),
    "infinities": [*anywhere(float("inf")), *anywhere(float("-inf"))],
    "beyond float64": [{"momentum": (10**400, 0, 0)}, *anywhere(LONG("1e4000"))],
    "below float64": [*anywhere(LONG("1e-4000")), *anywhere(Fraction(1, 10**400))],
    "times": [{"momentum": np.array((np.timedelta64(1, "s"), 0.1, 0.2), object)}, *anywhere(np.timedelta64(1, "s"))],
    "complex numbers": anywhere(1j),
    "texts": anywhere("1"),
    "masked arrays": [{"momentum": MASKED}, {"momentum": [MASKED, MASKED]}, {"momentum": (MASKED[1], 0.1, 0.2)}],
    "zero-dimensional": [{"momentum": np.array(1.0)}, {"gamma": 1.0}],
    "wrong shapes": [
        {"momentum": (1.0, 2.0)}, {"momentum": np.zeros((2, 3)), "gamma": np.tile(G, (3, 1))},
        {"momentum": [[1.0, 2.0, 3.0], [1.0]]},
    ],
    "gamma of length 0, 2 and 1 + 1e-9": [{"gamma": np.array(G) * size} for size in (0.0, 2.0, 1 + 1e-9)],
    "negative moments": [{"J": (-1e-300, 1.0, 2.0)}, {"D": -1e-300}],
    "more frames than memory": [{"steps": 10**15}],
}  # fmt: skip


@precisions
@pytest.mark.parametrize("kind", REFUSED)
def test_what_is_no_number_or_no_state_is_refused_in_a_sentence(precision, kind):
    for given in REFUSED[kind]:
        with pytest.raises(BadInput) as refusal:
            run(precision, **given)
        assert len(str(refusal.value).split()) >= 4
