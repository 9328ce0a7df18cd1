"""A homogeneous ball that slides along a line under Coulomb friction until it rolls: the closed form.

The ball moves along a horizontal unit vector d with the velocity v, and turns with the rate w about n = e₃ × d alone,
which friction does not change; its point at the plane has the velocity u = v - rw along d.  While u > 0 friction is
-μmg d, so v' = -μg and kr w' = μg for the moment of inertia kmr²; u falls with (1 + 1/k)μg, and is 0 at `end`.  From
there on v and w stay.  The angle about n is a polynomial in each phase.  tests/studies/test_rolling_cases.py decides
the equations and the joint exactly.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from flint import arb, ctx
from sympy import Expr

from chapsym import generated
from chapsym.dynamics.enclosed_motion import PARTS, CertifiedMotion, decimal, written
from chapsym.dynamics.flow.start import ball, balls
from chapsym.files import Data

#: A rational number, or a formula.
Exact: TypeAlias = Fraction | Expr


class State(NamedTuple):
    """The way along d from the start, the velocity, the angle about n, and its rate."""

    way: Exact
    velocity: Exact
    angle: Exact
    rate: Exact


@dataclass(frozen=True)
class Slide:
    """A start: velocity > radius · rate, which are along d and about n; SI units, any exact numbers."""

    title: str
    mass: Exact
    radius: Exact
    friction: Exact
    gravity: Exact
    direction: tuple[Exact, Exact]
    velocity: Exact
    rate: Exact
    time: Exact = Fraction(3)
    frames: int = 60
    #: k of the moment of inertia kmr².
    part: Exact = Fraction(2, 5)

    @property
    def end(self) -> Exact:
        """When it begins to roll."""
        slip = self.velocity - self.radius * self.rate
        return slip * self.part / ((1 + self.part) * self.friction * self.gravity)

    def slides(self, t: Exact) -> State:
        """The state until `end`."""
        slowed = self.friction * self.gravity
        turned = slowed / (self.part * self.radius)
        return State(
            self.velocity * t - slowed * t * t / 2, self.velocity - slowed * t,
            self.rate * t + turned * t * t / 2, self.rate + turned * t,
        )  # fmt: skip

    def rolls(self, t: Exact) -> State:
        """The state from `end` on."""
        way, velocity, angle, rate = self.slides(self.end)
        return State(way + velocity * (t - self.end), velocity, angle + rate * (t - self.end), rate)


#: A billiard ball with so much backspin that it comes back.
START = Slide(
    "A billiard ball with backspin: it slides, comes back, and rolls from 1.33 s on",
    mass=Fraction("0.17"), radius=Fraction("0.0285"), friction=Fraction("0.2"), gravity=Fraction("9.81"),
    direction=(Fraction("0.6"), Fraction("0.8")), velocity=Fraction(2), rate=Fraction(-250),
)  # fmt: skip


def made(digits: int) -> Data:
    """The case as `make.made` has those of scenes, with friction, gravity, `rolls_from` and each frame's velocity."""
    slide = START
    times = tuple(i * slide.time / slide.frames for i in range(slide.frames + 1))
    first, second = slide.direction
    moment, bits = slide.part * slide.mass * slide.radius**2, 4 * digits + 24
    with ctx.workprec(bits):
        d, n = balls((first, second)), balls((-second, first, Fraction(0)))
        arrays: dict[str, list[Sequence[arb]]] = {part: [] for part in PARTS}
        velocities = []
        for at in times:
            state = slide.slides(at) if at < slide.end else slide.rolls(at)
            half = ball(state.angle) / 2
            attitude = (half.cos(), *(half.sin() * x for x in n))
            if attitude[0] < 0:
                attitude = tuple(-x for x in attitude)
            carried = ball(moment * state.rate + slide.mass * slide.radius * state.velocity)
            arrays["gamma"].append(generated.rotation(*attitude)[6:])
            arrays["angular_momentum"].append([carried * x for x in n])  # n is the same in the body
            arrays["omega"].append([ball(state.rate) * x for x in n])
            arrays["attitude"].append(attitude)
            arrays["contact"].append([ball(state.way) * x for x in d])
            velocities.append([list(written(x, digits)) for x in (*(ball(state.velocity) * x for x in d), arb(0))])
        parts: dict[str, Any] = {part: np.array(rows, dtype=object) for part, rows in arrays.items()}
        found = CertifiedMotion(times, **parts, digits=digits, steps=2, bits=bits).write()
        rolls_from = list(written(ball(slide.end), digits))
    for frame, velocity in zip(found["frames"], velocities, strict=True):
        frame["velocity"] = velocity
    numbers = {"mass": decimal(slide.mass), "radius": decimal(slide.radius), "inertia": [decimal(moment)] * 3}
    return {
        "case": "sliding", "title": slide.title, "ball": numbers, "friction": decimal(slide.friction),
        "gravity": decimal(slide.gravity), "rolls_from": rolls_from, **found,
    }  # fmt: skip
