"""Runs of `roll` near unstable rotations, seeded: the stated error is compared with the true one.

One in `CERTIFIED`, and each whose true error is more than a tenth of the stated one, is judged by the certified motion
as well.
"""

import random
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

import chapsym

FRAMES, CERTIFIED, TENTH = 4, 20, 0.1
#: Radians after which a start is left that is more stable than most, and by what part a run becomes longer.
SHORTEST, LONGEST, LONGER = 12.0, 100.0, 1.1
#: The powers of ten that D is between, of moments of inertia up to 2.
LIGHT, HEAVY = (-2, 1), (1, 4.5)
#: Radians of a step in double-double.
TURN = 0.25


@dataclass
class Start:
    """omega is along the middle axis but for 1e-9 to 1e-4 of it; of one start in four it is any.

    A run is as long as its stated error takes to grow to `enough`, from a tenth to a thousand times the accuracy.
    """

    ball: chapsym.Ball
    omega: tuple
    gamma: np.ndarray
    accuracy: float
    enough: float


def start(seed, heavy=False):
    """The start of a seed; heavy: of a ball whose D is up to a million times its least moment of inertia."""
    rng = random.Random(seed)
    tensor = sorted(rng.uniform(0.02, 1) for _ in range(3))
    omega, aside, gamma = ([rng.gauss(0, 1) for _ in range(3)] for _ in range(3))
    rate, off, kind = rng.uniform(0.5, 5), 10 ** rng.uniform(-9, -4), rng.randrange(4)
    if kind:
        omega = [rate * (i == 1) + rate * off * x for i, x in enumerate(aside)]
    if kind == 1:
        gamma = [off * aside[2], 1.0, off * aside[0]]
    if kind == 2:
        gamma[1] = 0.0
    ball = chapsym.Ball(tensor, 10 ** rng.uniform(*(HEAVY if heavy else LIGHT)), 1.0)
    accuracy = 10 ** rng.uniform(-11, -3)
    return Start(
        ball, tuple(omega), np.array(gamma) / np.linalg.norm(gamma), accuracy, 10 ** rng.uniform(-1, 3) * accuracy
    )


def rolled(asked):
    """The run; None where `roll` refuses the accuracy from the first."""
    run, turn = None, SHORTEST
    while turn < LONGEST and (run is None or run.error < asked.enough):
        interval = turn / np.linalg.norm(asked.omega) / FRAMES
        options = {"gamma": asked.gamma, "attitude": True, "contact": True, "accuracy": asked.accuracy}
        try:
            run = chapsym.roll(asked.ball, asked.omega, interval, FRAMES, **options)
        except chapsym.BadInput:
            break
        turn *= LONGER
    return run


def momentum(asked):
    """K of exactly the floats that `roll` was given, with the unit vector along γ."""
    moments, w, g = ([Fraction(float(x)) for x in v] for v in (asked.ball.mass_tensor, asked.omega, asked.gamma))
    D = Fraction(float(asked.ball.D))
    along = sum(x * y for x, y in zip(w, g, strict=True)) / sum(x * x for x in g)
    return [(sum(moments) - m + D) * x - D * along * y for m, x, y in zip(moments, w, g, strict=True)]


def by_extrapolation(asked, run):
    """K, γ, attitude and contact point of each frame in double-double, to order 24, from steps of `TURN` radians."""
    each = int(np.ceil(run.time_step * np.linalg.norm(asked.omega) / TURN))
    fine = chapsym.extrapolate(
        asked.ball, momentum(asked), asked.gamma, Fraction(run.time_step) / each, int(run.index[-1]) * each, every=each,
        attitude=True, contact=True, precision="double-double",
    )  # fmt: skip
    return fine.angular_momentum, fine.gamma, fine.attitude, fine.contact


def by_certified_motion(asked, run):
    times = [Fraction(run.time_step) * int(i) for i in run.index]
    digits = max(8, 3 - round(np.log10(run.error)))
    found = chapsym.certified_motion(
        chapsym.ExactBall(*asked.ball.exact), momentum(asked), [Fraction(float(x)) for x in asked.gamma], times, digits
    )
    return tuple(np.vectorize(float)(x) for x in (found.angular_momentum, found.gamma, found.attitude, found.contact))


def distance(asked, run, true):
    """The largest at any frame, by the parts that `roll` states an error of, without that of ω."""
    K, gamma, attitude, contact = true
    size = np.linalg.norm
    chord = np.minimum(size(run.attitude - attitude, axis=-1), size(run.attitude + attitude, axis=-1))
    return max(
        size(run.angular_momentum() - K, axis=-1).max() / size(K[0]),
        size(run.gamma - gamma, axis=-1).max(),
        4 * np.arcsin(np.minimum(chord / 2, 1)).max(),
        size(run.contact - contact, axis=-1).max(),
    )


def part(seed, heavy=False, certify=True):
    """Which part of the stated error the true one is, by both; 0 of a refused accuracy."""
    asked = start(seed, heavy)
    if (run := rolled(asked)) is None:
        return 0.0
    error = distance(asked, run, by_extrapolation(asked, run))
    if certify and (seed % CERTIFIED == 0 or error > TENTH * run.error):
        error = max(error, distance(asked, run, by_certified_motion(asked, run)))
    return error / float(run.error)


def passing(seed):
    """The same of a run that meets its accuracy, through two or more passages of the middle axis, with few frames."""
    rng = random.Random(seed)
    tensor = sorted(rng.uniform(0.02, 1) for _ in range(3))
    off, gamma = 10 ** rng.uniform(-11, -6), [rng.gauss(0, 1) for _ in range(3)]
    omega = tuple((i == 1) * rng.choice([-1, 1]) + off * rng.gauss(0, 1) for i in range(3))
    ball, accuracy = chapsym.Ball(tensor, 10 ** rng.uniform(-3, 0.5), 1.0), 10 ** rng.uniform(-4, -0.7)
    asked = Start(ball, omega, np.array(gamma) / np.linalg.norm(gamma), accuracy, accuracy)
    turn, frames = 10 ** rng.uniform(1.8, 2.3), rng.randrange(1, 3)
    run = chapsym.roll(
        ball, omega, turn / frames, frames, gamma=asked.gamma, attitude=True, contact=True, accuracy=accuracy
    )
    return distance(asked, run, by_extrapolation(asked, run)) / float(run.error) if run.error <= accuracy else 0.0
