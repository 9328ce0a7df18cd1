"""Calls of the public functions with odd arguments, seeded: each ends in a result or in a sentence.

`python tests/odd_calls.py FIRST COUNT` prints what is wrong with calls, each by its seed.
"""

import contextlib
import inspect
import os
import random
import signal
import sys
import warnings
from collections import Counter
from decimal import Decimal
from fractions import Fraction

import mpmath
import numpy as np
import sympy

import chapsym
from chapsym import BadInput, Digits, Enclosure, NotRetraced, StepNotTaken

#: What a public function may raise.
DOCUMENTED = (BadInput, StepNotTaken, NotRetraced)
#: Functions that take other things: files, compiled functions, results (which are made here, `RESULTS`).
OTHERS = {"implicit_step", "open_result", "run_scene", "interpolated"}
#: Of these NaN is an answer: where there is no root there is no margin, and no increment in a batch.
MAY_BE_NAN = {"margin", "increment"}
#: Seconds of the processor after which a call counts as one that hangs, in a run of this file alone.
LONG = 20


class Strange:
    """An object that is nothing else."""


class Unshown:
    """What raises an error of its own where it is to be shown."""

    def __repr__(self):
        raise KeyError("unshown")


class Unwilling(float):
    """A number that raises an error of its own where it is to be a float."""

    def __float__(self):
        raise KeyError("unwilling")


def number(rng):
    """A number: most are ordinary."""
    if rng.random() < 0.7:
        return rng.choice([0.3, 1.0, 2, 0.05, 3.7, -0.4, 1e-3, 0])
    return rng.choice([
        1e300, -1e300, 1e-300, 5e-324, 1e-9, 1e9, float("nan"), float("inf"), -0.0, 10**400, -(10**30), np.int64(2),
        np.float32(0.1), np.longdouble(0.1), np.uint8(3), Fraction(1, 3), Fraction(10**400), Decimal("0.1"),
        Decimal("NaN"), mpmath.mpf("0.1"), mpmath.mpf("inf"), sympy.Rational(1, 7), sympy.pi, sympy.Symbol("x"), "0.1",
        "nan", "x", None, True, np.True_, 1j, np.complex128(1), b"1", [], [0.1], {}, Strange(), np.array(0.5),
        np.array([0.1, 0.2]), np.ma.masked, np.datetime64("2020-01-01"), 10**6000, Unshown(), Unwilling(0.1),
    ])  # fmt: skip


def vector(rng, n=3):
    """A vector, or a batch of some."""
    if rng.random() < 0.55:
        size = rng.choice([0.01, 0.1, 0.5, 1, 1, 3])
        return np.array([rng.gauss(0, 1) for _ in range(n)]) * size
    shape = rng.choice([(n,), (n,), (2, n), (3, 1, n), (0, n), (n - 1,), (n + 1,), (), (1, n), (n, n), (2, 0, n)])
    values = [rng.gauss(0, rng.choice([1e-300, 1e-9, 1, 1e9, 1e300])) for _ in range(int(np.prod(shape)))]
    plain = np.array(values).reshape(shape)
    with np.errstate(over="ignore", under="ignore"):
        narrow = plain.astype(np.float32)
    if plain.size and rng.random() < 0.4:
        odd = plain.astype(object)
        odd.flat[rng.randrange(plain.size)] = number(rng)
        return rng.choice([odd, odd.tolist()])
    return rng.choice([
        plain, plain, plain.tolist(), narrow, plain.astype(np.longdouble), np.flip(plain),
        np.ma.masked_array(plain, plain > 0), np.ma.masked_array(plain, False), plain.astype(complex),
        (1e3 * np.clip(plain, -1, 1)).astype(np.int64), plain > 0, np.zeros(shape), [[1, 2], [3]],
        "1,2,3", None, number(rng),
    ])  # fmt: skip


def unit(rng, n=3):
    """A unit vector, most times."""
    if rng.random() < 0.7:
        v = np.array([rng.gauss(0, 1) for _ in range(n)])
        return rng.choice([v / np.linalg.norm(v), np.eye(n)[rng.randrange(n)], v])
    return vector(rng, n)


def skew(rng):
    """A skew matrix, most times."""
    a = np.array([[rng.gauss(0, 0.3) for _ in range(4)] for _ in range(4)])
    return a - a.T if rng.random() < 0.7 else rng.choice([a, vector(rng), np.stack([a - a.T, a.T - a])])


def moments(rng, n=3):
    """A mass tensor, most times."""
    if rng.random() < 0.75:
        plain = sorted(rng.choice([0.0, 1e-6, 0.5, 1, 1, 2, 4]) for _ in range(n))
        return rng.choice([plain, tuple(plain), np.array(plain), [plain, plain[::-1]]])
    return vector(rng, n)


def ball(rng):
    """A ball, most times."""
    if rng.random() < 0.05:
        return rng.choice([None, "ball", vector(rng), Strange(), chapsym.BallN((1, 2, 3, 4), 1.0)])
    given = moments(rng), rng.choice([0, 0.5, 3, 3, 1e6, number(rng)]), rng.choice([None, None, 0.1, 1.0, number(rng)])
    return chapsym.Ball(*given)


def exact_ball(rng):
    """A ball, exactly or not."""
    if rng.random() < 0.5:
        return ball(rng)
    J = rng.choice([(1, 2, 4), (Fraction(1, 2), 1, 1), moments(rng)])
    return chapsym.ExactBall(J, rng.choice([3, Fraction(1, 3), number(rng)]), rng.choice([None, 1, number(rng)]))


def ball_n(rng):
    """A ball in four dimensions, most times."""
    return chapsym.BallN(moments(rng, 4), rng.choice([0.5, 3, number(rng)])) if rng.random() < 0.95 else ball(rng)


def count(rng):
    """A small whole number, most times."""
    return (
        rng.randrange(6) if rng.random() < 0.8 else rng.choice([-1, 1.5, 2.0, np.int8(3), "3", None, True, number(rng)])
    )


def precision(rng):
    """A precision, most times."""
    return rng.choice(["double"] * 6 + ["single", "double-double", Digits(30), Enclosure(100), "quad", 40, None])


def attitude(rng):
    """Whether the attitude is followed, or the first."""
    q = np.array([rng.gauss(0, 1) for _ in range(4)])
    return rng.choice([False, False, True, q / np.linalg.norm(q), vector(rng, 4), number(rng)])


def run(rng):
    """A run to go on with."""
    given = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1), (0.03, -0.02, 0.035), (2 / 7, 3 / 7, 6 / 7)
    order, level = rng.choice([2, 4]), rng.choice(["double", "single", "double-double"])
    made = chapsym.trajectory(*given, rng.randrange(5), order=order, precision=level, attitude=rng.random() < 0.5)
    return rng.choice([made, made, made, Strange(), None, vector(rng)])


def run_n(rng):
    """The same in four dimensions."""
    matrix = np.array([[0, 1, 2, 3], [-1, 0, 4, 5], [-2, -4, 0, 6], [-3, -5, -6, 0]]) * 0.01
    made = chapsym.trajectory_n(chapsym.BallN((1, 2, 3, 4), 1.0), matrix, (0, 0, 0, 1), rng.randrange(4))
    return rng.choice([made, made, run(rng)])


def curve(rng):
    """A curve of tops, most times."""
    return (
        chapsym.Curve.through(chapsym.Ball((1, 2, 4), 3), (2 / 7, 3 / 7, 6 / 7)) if rng.random() < 0.9 else number(rng)
    )


def flag(rng):
    """True or false, most times."""
    return rng.random() < 0.5 if rng.random() < 0.9 else number(rng)


def either(*choices):
    """One of these, or a number."""
    return lambda rng: rng.choice(choices) if rng.random() < 0.9 else number(rng)


#: What an argument is, by its name; by the function and the name where that differs.
ARGUMENTS = {
    "ball": ball, "momentum": vector, "angular_momentum": vector, "omega": vector, "gamma": unit, "rotation": attitude,
    "mass_tensor": moments, "D": number, "radius": either(None, 1.0, 0.1), "axes": either(None, "body", "space"),
    "time": either(0.1, 1.0), "accuracy": either(None, 1e-6, 1e-3, 1e-9), "of": either("state", "contact"),
    "frames": count, "attitude": attitude, "limit": either(1.0), "matrix": skew, "settle": flag, "times": vector,
    "digits": either(10, 15), "rotor": either((0, 0, 0)), "trajectory": run, "bits": either(64, 128),
    "order": either(2, 4, 8),
    "time_step": either(0.01, 0.1, None), "steps": count, "columns": either(None, 2, 4), "every": either(1, 2, None),
    "contact": flag, "precision": precision, "threads": either(0, 1), "path": vector, "curve": curve, "height": number,
    "u": number, "run": run, "back": run, "position": either((0, 0)), "map": flag, "proved": flag, "vector": vector,
    "index": either([0, 1, 5], range(4), 3), "progress": either(lambda done: None),
    **{("skew", "vector"): vector, ("certified_motion", "ball"): exact_ball, ("reverse_n", "run"): run_n},
    **{(f, "ball"): ball_n for f in ("step_n", "trajectory_n", "StepperN")},
    **{(f, "momentum"): skew for f in ("step_n", "trajectory_n", "StepperN", "invariants_n")},
    **{(f, "gamma"): lambda rng: unit(rng, 4) for f in ("step_n", "trajectory_n", "StepperN", "invariants_n")},
}  # fmt: skip
#: The functions, and the classes that are made of numbers.
NAMES = sorted(
    name
    for name in chapsym.__all__
    if (inspect.isfunction(getattr(chapsym, name)) and name not in OTHERS)
    or name in ("Ball", "BallN", "ExactBall", "Stepper", "StepperN")
)


def made(seed):
    """The call of a seed: the name and the arguments; BadInput where a ball among them is none."""
    rng = random.Random(seed)
    name = rng.choice(NAMES)
    given = {}
    for key, one in inspect.signature(getattr(chapsym, name)).parameters.items():
        if one.default is inspect.Parameter.empty or rng.random() < 0.3:
            given[key] = ARGUMENTS.get((name, key), ARGUMENTS.get(key))(rng)
    return name, given


def ordinary(name):
    """The arguments of a call that has a result, of those without a default."""
    parameters = inspect.signature(getattr(chapsym, name)).parameters.items()
    needed = [key for key, one in parameters if one.default is inspect.Parameter.empty]
    for seed in range(1_000):
        rng = random.Random(seed)
        with contextlib.suppress(*DOCUMENTED), warnings.catch_warnings(action="ignore"):
            given = {key: ARGUMENTS.get((name, key), ARGUMENTS.get(key))(rng) for key in needed}
            getattr(chapsym, name)(**given)
            return given
    raise LookupError(name)


def wrong(seed):
    """What is wrong with a call, in words; None if nothing is."""
    try:
        name, given = made(seed)
    except BadInput:  # a ball that is none
        return None
    with np.errstate(all="raise" if seed % 2 else "warn"):
        return said_of(name, given)


def said_of(name, given):
    """What is wrong with the call of a function with these arguments, in words; None if nothing is."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            before = {key: value.copy() for key, value in given.items() if issubclass(type(value), np.ndarray)}
            found = getattr(chapsym, name)(**given)
            if name != "ExactBall":  # whose numbers may have more digits than Python writes
                repr(found)
        except DOCUMENTED as error:
            return None if len(str(error)) > 10 else f"{name}: says {error!s:.60}"
        except Exception as error:
            return f"{name}: {type(error).__name__}: {error!s:.120}"
    for key, value in before.items():
        if repr(value) != repr(given[key]):
            return f"{name}: changes {key}"
    return f"{name}: NaN in silence" if name not in MAY_BE_NAN and is_silent(found) else None


def is_silent(found):
    """Whether a result has NaN in a place that its status does not explain."""
    if isinstance(found, np.ndarray | float):
        return np.asarray(found).dtype.kind == "f" and bool(np.isnan(found).any())
    status = getattr(found, "status", None)
    arrays = [getattr(found, key, None) for key in ("momentum", "gamma", "attitude", "contact", "rotation")]
    if status is None or np.any(np.asarray(status) != 0):
        return False
    return any(a.dtype.kind == "f" and bool(np.isnan(a).any()) for a in arrays if isinstance(a, np.ndarray))


if __name__ == "__main__":
    first, calls = int(sys.argv[1]), int(sys.argv[2])
    kinds = Counter()

    def hangs(*_):
        raise TimeoutError(f"more than {LONG} s")

    signal.signal(signal.SIGPROF, hangs)
    for seed in range(first, first + calls):
        signal.setitimer(signal.ITIMER_PROF, LONG)
        said = wrong(seed)
        signal.setitimer(signal.ITIMER_PROF, 0)
        if said:
            kinds[said] += 1
            print(seed, said, flush=True)
    print(f"{calls} calls, {sum(kinds.values())} wrong", file=sys.stderr)
    os._exit(0)
