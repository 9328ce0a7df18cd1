"""Steps of every kind: small and odd batches, compositions, the contact point, lengths beyond the lemma's bound."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

import chapsym

from .batch import SEED
from .harness import Say
from .results import Reached, Result, timed
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D


class Case(NamedTuple):
    """Steps with this |𝒦| of this many balls."""

    epsilon: float
    order: int
    balls: int
    contact: bool = False


#: The bound of lemma `small-branch` is about .48, the least fold of the balls at about .64 of |𝒦|/ε.
SHORT, LONG = 0.05, 0.4
MANY = 1000
#: (order, balls): one, less than a register, one, a little more, a block, a little more, many blocks; compositions.
SIZES = [(2, balls) for balls in (1, 2, 8, 9, 40, 41, MANY)] + [(order, MANY) for order in (4, 6, 8)]
CASES = [Case(epsilon, *size, contact) for epsilon in (SHORT, LONG) for size in SIZES for contact in (False, True)]
BEYOND = [Case(epsilon, 2, balls) for epsilon in (0.5, 0.6, 0.8) for balls in (1, MANY)]
#: The number of steps from one state that is kept to the next.
EVERY = 50
#: At most: with the contact point, to the same without; a stage of order 8, to a step; a step beyond the bound, to one
#: below it.
CONTACT, STAGE, FAR = 2.2, 2.0, 2.5


def rolling(case: Case, steps: int) -> Callable[[], chapsym.Trajectory]:
    """The public trajectory of balls near that of the section `trajectory`, on one core."""
    balls, order, contact = case.balls, case.order, case.contact
    g = GAMMA + 0.3 * np.random.default_rng(SEED).normal(size=(balls, 3)) * (balls > 1)
    K, g = np.tile(case.epsilon * MOMENTUM, (balls, 1)), g / np.linalg.norm(g, axis=1, keepdims=True)
    ball, (K, g) = chapsym.Ball(MASS_TENSOR, D, 0.1), (K, g) if balls > 1 else (K[0], g[0])
    return lambda: chapsym.trajectory(ball, K, g, steps, order=order, every=EVERY, contact=contact, threads=1)


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Times every case, all of them interleaved."""
    work, rounds = (50_000, 3) if quick else (1_000_000, 21)
    sides = {}
    for case in CASES + BEYOND:
        stages = len(chapsym.substeps(case.order))
        steps = max(EVERY, work // max(case.balls, 40) // stages)
        sides[str(case)] = rolling(case, steps), steps * stages * case.balls
    timings = timed(sides, rounds, on_round, "steps")
    rows = [
        {"|𝒦|": case.epsilon, "order": case.order, "balls": case.balls, "contact": case.contact}
        | {"ns a ball and step": timings[str(case)].median * 1e9}
        for case in CASES + BEYOND
    ]
    traced, alone = Case(SHORT, 2, MANY, True), Case(SHORT, 2, MANY)
    compared = [(f"{MANY} balls, with the contact point / without", traced, alone, CONTACT)]
    compared += [
        (f"|𝒦| = {epsilon:g}: a stage of order 8 / a step", Case(epsilon, 8, MANY), Case(epsilon, 2, MANY), STAGE)
        for epsilon in (SHORT, LONG)
    ]
    for far in BEYOND:
        compared.append((f"balls: {far.balls}, |𝒦| = {far.epsilon:g} / {LONG:g}", far, far._replace(epsilon=LONG), FAR))
    reach = [Reached(what, timings[str(a)].ratio_to(timings[str(b)])[0], most, False) for what, a, b, most in compared]
    return Result("steps of every kind, one core", rows, {}, reach)
