"""Certificates of kind map-run: bounds for the distance of a computed run of the map, in any precision, to its orbit.

The file has the ball, the start, frames (the step, 𝒦, γ, and bounds for the distances of 𝒦 and γ), and the number of
bits for the checker, of which it loses about two per step, more for a heavy ball.  The orbit is that of step.py from 𝒦
and γ/|γ|, on the small branch.  It is enclosed step by step, each root by Newton's test near the root of the step
before, and the distances of the frames from it are compared with their bounds.  The steps preserve |𝒦| and |γ|: so the
small branch is proved for all of them at the start.  A root with |u| < 1 for all states of a box is also the root for
the true state, which is in the box.
"""

from fractions import Fraction
from itertools import pairwise

from .document import STEPS, Data, check_work, exact
from .form import HEAD, check_shape
from .interval import Interval, Rejected
from .linear import Vector, dot, minus, times
from .step import Ball, check_small_branch, gibbs_vector, moved

NUMBERS = (exact,) * 3
STATE = {"momentum": NUMBERS, "gamma": NUMBERS}
FORM = HEAD | {
    "ball": {"J": NUMBERS, "D": exact}, "start": STATE, "bits": range(64, 8193),
    "frames": [{"step": STEPS, **STATE, "bounds": {"momentum": exact, "gamma": exact}}],
}  # fmt: skip


def statement(data: Data) -> str:
    """The theorem, with the numbers of the file."""
    ball, start, last = data["ball"], data["start"], data["frames"][-1]
    return (
        f"The ball with J = ({', '.join(ball['J'])}), D = {ball['D']}, that starts with 𝒦 = "
        f"({', '.join(start['momentum'])}) and γ = ({', '.join(start['gamma'])}), divided by its length, is at "
        f"{len(data['frames'])} steps of the map up to step {last['step']} as near to the 𝒦 and γ of the frames as "
        f"their bounds say: at the last within {last['bounds']['momentum']} and {last['bounds']['gamma']}."
    )


def check_form(data: Data) -> None:
    """Raises Rejected unless the file has all its numbers, in their form, and the frames are in order."""
    check_shape(data, FORM)
    steps = [0, *(frame["step"] for frame in data["frames"])]
    if len(steps) == 1 or any(x >= y for x, y in pairwise(steps)):
        raise Rejected("frames must not be empty, and each of a later step than the one before")
    if not any(Fraction(x) for x in data["start"]["gamma"]):
        raise Rejected("the γ of the start is 0, and has no direction")


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless each frame is proved to be within its bounds; returns the bounds of the last frame."""
    J, D = [Fraction(x) for x in data["ball"]["J"]], Fraction(data["ball"]["D"])
    K, g = ([Fraction(x) for x in data["start"][name]] for name in STATE)
    frames, steps = data["frames"], data["frames"][-1]["step"]
    check_work(steps, bits := data["bits"])

    def enclosed(v: list[Fraction]) -> Vector:
        return [Interval.enclosing(x, x, bits) for x in v]

    ball, momentum, vertical = Ball.within(J, D, Fraction(0), bits, True), enclosed(K), enclosed(g)
    state = momentum, times(1 / dot(vertical, vertical).sqrt(), vertical)
    check_small_branch(ball, dot(momentum, momentum).sqrt() if any(K) else momentum[0])
    u: Vector = [x / y for x, y in zip(times(ball.D._of(1) / 2, momentum), ball.contact, strict=True)]
    done = 0
    for frame in frames:
        while done < frame["step"]:
            u, done = gibbs_vector(ball, state, [x.point() for x in u]), done + 1
            state = moved(u, state)
        for name, exactly in zip(STATE, state, strict=True):
            off, bound = minus(exactly, enclosed([Fraction(x) for x in frame[name]])), Fraction(frame["bounds"][name])
            if bound < 0 or sum(x.most**2 for x in off) > (bound * 2**bits) ** 2:
                raise Rejected(f"{name} after step {done} is not proved to be within its bound")
    return {f"{name} after step {done}, off by at most": frames[-1]["bounds"][name] for name in STATE}
