"""ρ(l) of many levels at once in float64, and the plateaus of a perturbed top, which float64 sees."""

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import BadInput
from chapsym.dynamics.ball import Floats
from chapsym.files import Data
from chapsym.generated import gibbs_newton, turn

from .circle import circle, halved

#: Newton rounds from u = 0, inside the bound of lemma `small-branch`.
ROUNDS = 7
#: Phases at which a displacement is sampled, for each of q pieces; halvings of an interval of levels.
SAMPLES, HALVINGS = 24, 46


class Levels:
    """Levels l (n,) around the outer axis, G_h on each and a kick φ ↦ φ + τ sin 2φ after it: as `Level`, in float64."""

    def __init__(self, tensor: list[int], D: float, height: float, l: ArrayLike, kick: float = 0.0) -> None:
        J = np.array([float(x) for x in tensor])
        self.I, self.D, self.h, self.kick = tuple(J.sum() - J), float(D), float(height), float(kick)
        moments = J.sum() - J + self.D
        order = np.argsort(-moments)
        self.axes = tuple(int(i) for i in order)
        level = np.atleast_1d(np.asarray(l, dtype=float))
        if not ((level > 1 / moments[order[1]]) & (level < 1 / moments[order[2]])).all():
            raise BadInput("the levels must lie around the outer axis")
        squares, self.m = circle(moments[order], level)
        sense = -1.0 if (self.axes[1] - self.axes[0]) % 3 == 1 else 1.0
        self.sizes = np.sqrt(squares[0]), sense * np.sqrt(squares[1]), np.sqrt(squares[2])

    def angles(self, phase: ArrayLike, steps: int) -> Floats:
        """φ~ - φ of successive steps from phases that go with the levels, (steps, n)."""
        phase = np.broadcast_to(phase, np.broadcast_shapes(np.shape(phase), self.m.shape))
        found = np.empty((steps, *phase.shape))
        for i in range(steps):
            moved = self._stepped(phase)
            found[i] = np.mod(moved - phase + np.pi, 2 * np.pi) - np.pi
            phase = moved  # not phase + angle: a phase that grows is rounded more and more
        return found

    def _stepped(self, phase: Floats) -> Floats:
        sine = np.sin(phase)
        g = [sine] * 3
        values = np.cos(phase), sine, np.sqrt(1 - self.m * sine * sine)
        for axis, size, value in zip(self.axes, self.sizes, values, strict=True):
            g[axis] = size * value
        k = [self.h / 2 * x for x in g]
        u: tuple[Floats | float, ...] = (0.0, 0.0, 0.0)
        for _ in range(ROUNDS):
            p0, p1, p2, p3, *_ = gibbs_newton(*(*u, *k, *g, *self.I, self.D))
            u = p1 / p0, p2 / p0, p3 / p0
        after = [x + d for x, d in zip(g, turn(1.0, *u, *g), strict=True)]
        a, b, _ = self.axes
        moved = np.arctan2(after[b] / self.sizes[1], after[a] / self.sizes[0])
        return np.asarray(moved + self.kick * np.sin(2 * moved))


def rotation_numbers(tensor: list[int], D: float, height: float, l: ArrayLike, steps: int, kick: float = 0.0) -> Floats:
    """Half turns a step on each level, by a weighted Birkhoff average."""
    t = np.arange(1, steps + 1) / (steps + 1)
    weights = np.exp(-1.0 / (t * (1.0 - t)))
    found = Levels(tensor, D, height, l, kick).angles(0.3, steps)
    return np.asarray(weights @ found / weights.sum() / np.pi)


def curve(tensor: list[int], D: str, height: str, kick: str, inside: list[float], points: int, steps: int) -> Data:
    """ρ on levels of equal distance in a part of the range around the outer axis."""
    d, h, tau = _floats(D, height, kick)
    l = np.linspace(*_range(tensor, d, inside), points)
    rho = rotation_numbers(tensor, d, h, l, steps, tau)
    levels, numbers = ([float(f"{x:.10g}") for x in values] for values in (l, rho))
    given = {"tensor": tensor, "D": D, "height": height, "kick": kick}
    return given | {"levels": levels, "rotation_numbers": numbers}


def edges(
    tensor: list[int], D: float, height: float, steps: int, turns: int, low: float, high: float, kick: float
) -> list[float] | None:
    """The plateau of p/q between two levels, where ρ grows: no point, then every point goes on by more than p.

    The greatest displacement is 0 at its lower end, the least at its upper one; None if ρ does not pass p/q.
    """
    phases = np.arange(SAMPLES * steps) * (np.pi / (SAMPLES * steps))

    def extremes(l: float) -> tuple[float, float]:
        moved = Levels(tensor, D, height, l, kick).angles(phases, steps).sum(axis=0) - np.pi * turns
        return float(moved.max()), float(moved.min())

    if not (extremes(low)[0] < 0 < extremes(high)[1]):
        return None
    ends = (halved(lambda l, which=which: extremes(l)[which] < 0, low, high, HALVINGS) for which in (0, 1))  # type: ignore[misc]
    return [(a + b) / 2 for a, b in ends]


def plateaus(
    tensor: list[int], D: str, height: str, kick: str, inside: list[float], fractions: list[list[int]]
) -> list[Data]:
    """The edges of the plateaus of p/q in half turns, in l."""
    d, h, tau = _floats(D, height, kick)
    low, high = _range(tensor, d, inside)
    found = []
    for turns, steps in fractions:
        if (at := edges(tensor, d, h, steps, turns, low, high, tau)) is not None:
            found.append({"half_turns": turns, "steps": steps, "edges": at})
    return found


def _floats(*texts: str) -> tuple[float, ...]:
    return tuple(float(Fraction(x)) for x in texts)


def _range(tensor: list[int], D: float, inside: list[float]) -> tuple[float, float]:
    J = np.array([float(x) for x in tensor])
    middle, high = np.sort(1 / (J.sum() - J + D))[1:]
    return float(middle + inside[0] * (high - middle)), float(middle + inside[1] * (high - middle))
