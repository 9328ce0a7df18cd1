"""Families of periodic orbits of the whole map, found from the symmetric orbits.

A reversor (𝒦, γ) ↦ -R(𝒦, γ), R the rotation by π about an axis a, preserves the level M and fixes the states with
𝒦_a = γ_a = 0.  If the reversor of a fixes x, and after n steps the reversor of b fixes the state or maps it to the next
one, then x returns after 2n or 2n + 1 steps, up to R_aR_b.  On M such points are exceptional: two conditions for one
unknown.  But ⟨𝒦, γ⟩ may vary: a family of periodic orbits passes through each such point.  The reversor mirrors the
family, which therefore has a fold of ⟨𝒦, γ⟩ in the middle; elsewhere the orbits are not symmetric.  As the map is
nearly integrable, ⟨𝒦, γ⟩ hardly changes along the family.
"""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
from flint import arb

from chapsym.dynamics.ball import Ball, Floats
from chapsym.dynamics.errors import TooWide
from chapsym.dynamics.levels.balls import exact
from chapsym.dynamics.levels.start import fraction
from chapsym.dynamics.loops.vectors import cross, dot
from chapsym.dynamics.map import step

from .balls import NotProved
from .passage import Level, Map, Vector, columns

#: Starts along each of the angles of 𝒦 and γ, the most Newton iterations, their largest correction, and the tolerance.
GRID, ROUNDS, LONGEST, SETTLED = (8, 16), 24, 0.2, 1e-11
DIFFERENCE = 1e-6
#: The computed members of a family, their distance, Newton iterations for each, and halvings of the distance.
MEMBERS, APART, CORRECTIONS, HALVINGS = 16, 0.02, 6, 6
#: The errors of a family that cannot be followed with so few bits.
LOST = (NotProved, TooWide, ZeroDivisionError)
#: The tolerance for equal ⟨𝒦, γ⟩ of equal families; and the variation of γ_i below which a motion is a steady rotation.
SAME = 1e-7


@dataclass(frozen=True)
class Member:
    """One orbit of a family: ⟨𝒦, γ⟩, the start, and the direction of the family as by `Passage.change`."""

    height: arb
    momentum: Vector
    gamma: Vector
    along: Floats = field(default_factory=lambda: np.zeros(4))

    def mirrored(self) -> "Member":
        """The image by the reversor -1: a member of the reversed orbit, with the inverse derivative."""
        return Member(self.height, [-x for x in self.momentum], [-x for x in self.gamma])


def families(level: Level, steps: int, progress: Callable[[str], None]) -> Iterator[list[Member]]:
    """The families of orbits with this many steps at this |𝒦|², a stretch of each; `level.height` is not used."""
    found: list[float] = []
    for state in _symmetric(level, steps):
        height = abs(float(state[:3] @ state[3:]))
        if any(abs(height - x) < SAME for x in found):
            continue
        found.append(height)
        progress(f"orbits of {steps} steps: the family {len(found)}, with <momentum, gamma> = {height:.9f}")
        with suppress(*LOST):
            yield _followed(level, steps, state)


def _symmetric(level: Level, steps: int) -> Iterator[Floats]:
    """The starts (𝒦, γ) of symmetric orbits, with ⟨𝒦, γ⟩ > 0, in float64."""
    periods = [(steps, a, a) for a in range(3)]
    if steps % 2 == 0:
        periods += [(steps // 2, a, b) for a, b in product(range(3), repeat=2) if a != b]
    ball, size = Ball(np.array(level.J, dtype=float), np.array(float(level.D))), float(level.size) ** 0.5
    for period, a, b in periods:
        for state in _solved(ball, size, period, a, b):
            state[3:] *= np.copysign(1.0, state[:3] @ state[3:])  # γ ↦ -γ commutes with the map
            if SAME < state[:3] @ state[3:] < size * (1 - SAME) and not _steady(ball, state, period):
                yield state


def _solved(ball: Ball, size: float, period: int, a: int, b: int) -> list[Floats]:
    """Newton's method in the angles of 𝒦 and γ in the plane normal to the axis a, from a grid of starts."""
    x, y = (np.linspace(0, turn, n, endpoint=False) + 0.01 for n, turn in zip(GRID, (np.pi, 2 * np.pi), strict=True))
    angles = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)

    def off(angles: Floats) -> Floats:
        end = before = _fixed(angles, size, a)
        for _ in range((period + 1) // 2):
            before, end = end, _after(ball, end)
        # Odd: the last two states are mirror images of each other, so their sum is fixed.
        middle = end + before if period % 2 else end
        return middle[:, [b, 3 + b]]

    for _ in range(ROUNDS):
        steps = DIFFERENCE * np.eye(2)
        slope = np.stack([(off(angles + h) - off(angles - h)) / (2 * DIFFERENCE) for h in steps], axis=-1)
        regular = np.abs(np.linalg.det(slope)) > SETTLED
        angles, slope = angles[regular], slope[regular]
        if not len(angles):
            return []
        move = np.linalg.solve(slope, off(angles)[..., np.newaxis])[..., 0]
        angles = angles - move * np.minimum(1, LONGEST / np.maximum(np.abs(move).max(axis=-1), LONGEST))[:, np.newaxis]
    return list(_fixed(angles[np.abs(off(angles)).max(axis=-1) < SETTLED], size, a))


def _fixed(angles: Floats, size: float, a: int) -> Floats:
    """(𝒦, γ), normal to the axis a, with these angles from the next axis."""
    state = np.zeros((len(angles), 6))
    for at, length, angle in ((0, size, angles[:, 0]), (3, 1.0, angles[:, 1])):
        state[:, at + (a + 1) % 3], state[:, at + (a + 2) % 3] = length * np.cos(angle), length * np.sin(angle)
    return state


def _after(ball: Ball, state: Floats) -> Floats:
    gamma = state[..., 3:] / np.linalg.norm(state[..., 3:], axis=-1, keepdims=True)
    done = step(ball, state[..., :3], gamma)
    return np.concatenate([done.momentum, done.gamma], axis=-1)


def _steady(ball: Ball, state: Floats, period: int) -> bool:
    """Whether a body axis keeps its angle with γ, so that the whole circle of states is periodic, at one ⟨𝒦, γ⟩."""
    states = [state]
    for _ in range(period):
        states.append(_after(ball, states[-1]))
    return bool(np.ptp(np.abs(np.array(states)[:, 3:]), axis=0).min() < SAME)


def _followed(level: Level, steps: int, state: Floats) -> list[Member]:
    """A stretch of the family of a symmetric orbit, at the working precision of Arb."""
    K, g = ([exact(x) for x in v] for v in (state[:3], state[3:]))
    members = [_corrected(level, steps, Member(dot(K, g), K, g))]
    while len(members) < MEMBERS:
        before = members[-1]
        found = _corrected(level, steps, _ahead(level, before, Fraction(APART)))
        same_way = np.dot(found.along, before.along) >= 0
        members.append(found if same_way else replace(found, along=-found.along))
    return members


def _ahead(level: Level, member: Member, distance: Fraction) -> Member:
    """A point near the family, at this distance along it."""
    return _moved(level, member, [exact(distance * Fraction(x)) for x in member.along])


def _corrected(level: Level, steps: int, member: Member) -> Member:
    """The nearest member of the family, by Newton's method with the shortest corrections, and its direction."""
    at = Map.of(level)
    for _ in range(CORRECTIONS):
        now = at.passage(member.momentum, member.gamma, steps)
        slope = now.slope()
        back = slope.transpose() * (slope * slope.transpose()).solve(now.error())
        member = _moved(level, member, [-1 * back[i, 0] for i in range(4)])
    return replace(member, along=np.linalg.svd([[float(x) for x in row] for row in slope.tolist()])[2][3])


def _moved(level: Level, member: Member, by: Vector) -> Member:
    """The member, varied as in `Passage.change`."""
    K, g = member.momentum, member.gamma
    towards = cross(cross(K, g), K)
    K = [(x + y + by[3] * z).mid() for x, y, z in zip(K, cross(by[:3], K), towards, strict=True)]
    g = [(x + y).mid() for x, y in zip(g, cross(by[:3], g), strict=True)]
    scale, length = (exact(level.size) / dot(K, K)).sqrt(), dot(g, g).sqrt()
    K, g = [(x * scale).mid() for x in K], [(x / length).mid() for x in g]
    return Member(dot(K, g).mid(), K, g)


def solved(level: Level, steps: int, member: Member, rounds: int) -> tuple[Vector, Vector]:
    """The orbit of the exact level by Newton's method from a nearby one; on the level to rounding."""
    at = Map.of(level)
    K, g = on_level(level, member.momentum, member.gamma)
    for _ in range(rounds):
        now = at.passage([x.mid() for x in K], [x.mid() for x in g], steps)
        found = columns(now.slope(), 3).mid().solve(now.error())
        w = [-found[i, 0].mid() for i in range(3)]
        K, g = ([(x + y).mid() for x, y in zip(v, cross(w, v), strict=True)] for v in (K, g))
        K, g = on_level(level, K, g)
    return K, g


def on_level(level: Level, momentum: Vector, gamma: Vector) -> tuple[Vector, Vector]:
    """Balls of a point that is exactly on the level, near 𝒦 and γ."""
    length = dot(gamma, gamma).sqrt()
    g = [x / length for x in gamma]
    along = dot(momentum, g)
    across = [x - along * y for x, y in zip(momentum, g, strict=True)]
    height = exact(level.height)
    scale = ((exact(level.size) - height * height) / dot(across, across)).sqrt()
    return [height * y + scale * x for x, y in zip(across, g, strict=True)], g


def extent(family: list[Member]) -> tuple[Fraction, Fraction]:
    """The least and the largest ⟨𝒦, γ⟩ of the members."""
    heights = [fraction(x.height) for x in family]
    return min(heights), max(heights)


def near(level: Level, steps: int, family: list[Member]) -> Member:
    """A member whose ⟨𝒦, γ⟩ is near `level.height`, which must be in the extent of the family, by bisection."""
    before, after = next(
        (x, y)
        for x, y in pairwise(family)
        if (fraction(x.height) - level.height) * (fraction(y.height) - level.height) <= 0
    )
    distance, below = Fraction(APART), fraction(before.height) < level.height
    for _ in range(HALVINGS):
        distance /= 2
        member = _corrected(level, steps, _ahead(level, before, distance))
        if (fraction(member.height) < level.height) == below:
            before = replace(member, along=before.along)
        else:
            after = member
    return min(before, after, key=lambda x: abs(fraction(x.height) - level.height))
