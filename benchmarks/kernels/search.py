"""The worst states of a kernel: sampled from every stratum, and searched for with Hypothesis' `target`."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .errors import Exact, Kernel, exact, ulps
from .states import CHANGES, DRAWN, arguments

#: A search moves each number that a state is drawn from by multiples of one part of this.
FINENESS = 1 << 20


@dataclass(frozen=True)
class Worst:
    """The worst error that was met: in ulps, the condition number there, the stratum, and the arguments."""

    ulps: float
    condition: float
    stratum: str
    arguments: tuple[float, ...]

    @property
    def share(self) -> float:
        """The error in units of what a rounding of the arguments by an ulp does, or of an ulp if that is more."""
        return self.ulps / max(1.0, self.condition)


Points = list[tuple[str, list[float], Exact]]


def sampled(kernel: str, reference: Kernel, states: int, seed: int = 20071) -> Points:
    """`states` seeded points of each stratum, with their exact values."""
    points: Points = []
    for index, stratum in enumerate(CHANGES):
        rng = np.random.default_rng([seed, index])
        for _ in range(states):
            at = arguments(kernel, stratum, list(rng.uniform(size=DRAWN)))
            points.append((stratum, at, exact(kernel, reference, at)))
    return points


def met(kernel: str, function: Kernel, points: Points) -> dict[str, list[Worst]]:
    """The errors of a text at all points, by the view."""
    found: dict[str, list[Worst]] = {}
    for stratum, at, truth in points:
        for view, error in ulps(kernel, function, at, truth).items():
            found.setdefault(view, []).append(Worst(error, truth.conditions[view], stratum, tuple(at)))
    return found


def searched(kernel: str, function: Kernel, reference: Kernel, examples: int) -> dict[str, list[Worst]]:
    """What Hypothesis meets while it climbs to large shares, by the view."""
    from hypothesis import HealthCheck, Phase, given, settings, target
    from hypothesis import strategies as st

    found: dict[str, list[Worst]] = {}
    # Hypothesis climbs by whole numbers: a float it would leave where it is.
    numbers = st.tuples(*[st.integers(0, FINENESS).map(lambda n: n / FINENESS)] * DRAWN)

    @settings(
        max_examples=examples, database=None, derandomize=True, deadline=None, phases=[Phase.generate, Phase.target],
        suppress_health_check=list(HealthCheck),
    )  # fmt: skip
    @given(st.sampled_from(list(CHANGES)), numbers)
    def climb(stratum: str, drawn: Sequence[float]) -> None:
        at = arguments(kernel, stratum, drawn)
        points = [(stratum, at, exact(kernel, reference, at))]
        for view, (one,) in met(kernel, function, points).items():
            found.setdefault(view, []).append(one)
            if math.isfinite(one.share):
                target(math.log2(one.share + 2.0**-10), label=view or "share")

    climb()
    return found


def worst(found: Sequence[Worst], key: Callable[[Worst], float]) -> Worst:
    """The worst of some by a measure."""
    return max(found, key=key)
