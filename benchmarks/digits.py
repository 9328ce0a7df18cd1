"""Many digits: a step of one ball in `Digits`, and Newton's iteration in the Gibbs vector on mpmath's numbers."""

from collections.abc import Sequence
from functools import partial

import numpy as np
from mpmath import mp, mpf

import chapsym

from .harness import NotComparable, Say
from .peers import MOST, SETTLED, moments_of, newton_in_u, turned
from .results import Reached, Result, beside, timed
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D

#: Digits, and the most that a step may cost in ms: a fifth of its cost on Python's integers.
DIGITS = {50: None, 1000: 0.38}
EPSILON = 0.05
CHAPSYM, PEER = "chapsym", "mpmath, Newton in u"


def with_chapsym(digits: int, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """The last (𝒦, γ)."""
    ball, precision = chapsym.Ball(MASS_TENSOR, D), chapsym.Digits(digits)
    run = chapsym.trajectory(ball, EPSILON * MOMENTUM, GAMMA, steps, every=steps, precision=precision)
    return run.momentum[-1], run.gamma[-1]


def with_mpmath(digits: int, steps: int) -> tuple[Sequence[mpf], Sequence[mpf]]:
    """The same, from the last step's u, with a Newton iterate more for each doubling of the digits."""
    with mp.workdps(digits + 10):
        K, g, J = ([mpf(float(x)) for x in v] for v in (EPSILON * MOMENTUM, GAMMA, MASS_TENSOR))
        length = mp.sqrt(sum(x * x for x in g))
        g, u, contact = [x / length for x in g], [mpf(0)] * 3, mpf(float(D))
        reached = -float(np.log10(SETTLED))
        for _ in range(steps):
            for more in range(MOST):
                settled, *u = newton_in_u(*u, *K, *g, *moments_of(*J), contact)  # type: ignore[call-arg]
                if not settled:
                    raise NotComparable("Newton's iteration in u does not converge")
                if 2 ** (more + 1) * reached > digits + 10:
                    break
            f = 2 / (1 + u[0] * u[0] + u[1] * u[1] + u[2] * u[2])
            K, g = turned(*u, f, *K), turned(*u, f, *g)  # type: ignore[call-arg]
        return K, g


def difference(digits: int, steps: int) -> float:
    """The difference of the two ends, in units of the last digit; raises NotComparable where it is not small."""
    ends = [side(digits, steps) for side in (with_chapsym, with_mpmath)]
    with mp.workdps(digits + 10):
        most = max(abs(mpf(x) - y) for one, two in zip(*ends, strict=True) for x, y in zip(one, two, strict=True))
        last = float(most * mpf(10) ** digits)
    if last > 1e3:
        raise NotComparable(f"{PEER} differs from {CHAPSYM} by {last:.0e} in the last of {digits} digits")
    return last


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Times runs of 20 steps."""
    steps, rounds = 20, 3 if quick else 15
    rows, reach = [], []
    for digits, wanted in DIGITS.items():
        sides = {CHAPSYM: with_chapsym, PEER: with_mpmath}
        runs = {name: (partial(side, digits, steps), steps) for name, side in sides.items()}
        timings = timed(runs, rounds, on_round, f"{digits} digits")
        columns = {"digits": digits, "differs by, in the last digit": difference(digits, steps)}
        rows += beside(timings, PEER, "ms a step", columns, label="mpmath")
        if wanted:
            reach.append(Reached(f"ms a step of Digits({digits})", timings[CHAPSYM].median * 1e3, wanted, False))
    return Result("many digits, one core", rows, {}, reach)
