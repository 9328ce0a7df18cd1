"""Certificates of kind motion: the state of the continuous ball at given times, each number with an error radius.

The ball has the mass tensor diag(J1, J2, J3), D = m·radius², and optionally a rotor, whose angular momentum is part of
K and constant in the body.  The equation of motion is that of attitude.py.  The contact point, below the centre, has
the velocity radius·(Ω₂, -Ω₁), Ω = Rω: the ball rolls.

1. The start is enclosed: the unit quaternions of all quaternions of the file, and k = RK.
2. Steps of rolling.py enclose the solutions from there, and the integral of the velocity of the contact point.  The
   checker chooses the steps.  The units are powers of 2 in which the ball and its rotation are about 1.
3. Each number of a frame is proved to be within its radius of the number of the motion.  The sign of the quaternion is
   such that its first number that is not 0 up to its radius is positive.
4. No radius is more than 10^-digits: of K and ω relative to their greatest number, of contact to the ball's radius.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import pairwise
from math import ceil
from typing import NamedTuple

from .attitude import Turning, rotation
from .document import DIGITS, Data, exact
from .form import HEAD, check_shape
from .interval import Interval, Rejected
from .linear import Vector, dot
from .rolling import BITS, Flow, Rolling
from .taylor import Model

#: The vectors of a frame, and their dimensions; `contact` only if the ball has a radius.
PARTS = {"gamma": 3, "angular_momentum": 3, "omega": 3, "attitude": 4, "contact": 2}
NUMBERS, PAIR = (exact,) * 3, (exact, exact)
START = {"attitude": (PAIR,) * 4, "momentum": (PAIR,) * 3}
FORM = HEAD | {
    "ball": {"J": NUMBERS, "D": exact, "radius?": exact, "rotor?": NUMBERS}, "digits": DIGITS,
    "bits": range(BITS, 4097), "order": range(8, 1025),
}  # fmt: skip


def statement(data: Data) -> str:
    """The theorem, with the numbers of the file."""
    ball, frames = data["ball"], data["frames"]
    rolls = f", radius = {ball['radius']}" if "radius" in ball else ""
    a, K = (shown(data["start"][name]) for name in ("attitude", "momentum"))
    inside = f", a rotor with ({', '.join(ball['rotor'])}) in K" if "rotor" in ball else ""
    place = f", in ({', '.join(data['start']['position'])})" if rolls else ""
    return (
        f"The continuous ball with J = ({', '.join(ball['J'])}), D = {ball['D']}{rolls}{inside}, that starts with the "
        f"attitude ({a}), divided by its length, and K = ({K}){place}, is at {len(frames)} times from "
        f"{frames[0]['time']} to {frames[-1]['time']} where the frames say: each number up to its radius, which is at "
        f"most 1e-{data['digits']}, relative to the greatest number of K and of omega, and to the ball's radius."
    )


def check_form(data: Data) -> None:
    """Raises Rejected unless the file has all its numbers, in their form, and radii as small as `digits` says."""
    rolls = isinstance(data.get("ball"), dict) and "radius" in data["ball"]
    parts = {name: (PAIR,) * n for name, n in PARTS.items() if rolls or name != "contact"}
    start = START | ({"position": PAIR} if rolls else {})
    check_shape(data, FORM | {"start": start, "frames": [{"time": exact} | parts]})
    J, D = [exact(x, "J") for x in data["ball"]["J"]], exact(data["ball"]["D"], "D")
    if min(*J, D) < 0 or min(sum(J) - x + D for x in J) <= 0:
        raise Rejected("J and D must not be negative, and the ball must resist every turn")
    size = exact(data["ball"].get("radius", "1"), "radius")
    if size <= 0:
        raise Rejected("radius must be positive")
    pairs = {name: _fractions(data["start"][name]) for name in START}
    for name, found in pairs.items():
        _check_radii(name, found)
    rotor = [exact(x, "rotor") for x in data["ball"].get("rotor", ["0"] * 3)]
    if [x for x, _ in pairs["momentum"]] == rotor:
        raise Rejected("the momentum of the start is that of the rotor, or 0: a ball at rest stays where it is")
    if not data["frames"]:
        raise Rejected("frames must not be empty")
    for frame in data["frames"]:
        for name in parts:
            _check_claim(name, _fractions(frame[name]), Fraction(1, 10 ** data["digits"]), size)
    moments = [exact(frame["time"], "a time") for frame in data["frames"]]
    if moments[0] < 0 or any(x >= y for x, y in pairwise(moments)):
        raise Rejected("the times of the frames must be from 0 on, each later than the one before")


def _check_radii(name: str, pairs: Sequence[Sequence[Fraction]]) -> None:
    if any(radius < 0 for _, radius in pairs):
        raise Rejected(f"{name} has a negative radius")


def _check_claim(name: str, pairs: Sequence[Sequence[Fraction]], share: Fraction, radius: Fraction) -> None:
    """Raises Rejected unless the radii are at most this share of the size, and the attitude has the right sign."""
    _check_radii(name, pairs)
    if name in ("angular_momentum", "omega"):
        size = max(abs(x) - off for x, off in pairs)  # a lower bound for the greatest number
    else:
        size = radius if name == "contact" else Fraction(1)
    if max(off for _, off in pairs) > share * size:
        raise Rejected(f"a radius of {name} is greater than the digits say")
    if name == "attitude" and next((x for x, off in pairs if abs(x) > off), Fraction(1)) < 0:
        raise Rejected("the first number of an attitude that is not 0 must be positive")


class Piece(NamedTuple):
    """A part of the motion: models of attitude and contact point, begin, length, and the error at the end."""

    attitude: list[Model]
    place: list[Model]
    begin: int
    length: int
    error: Fraction

    @property
    def end(self) -> int:
        """The time of the end."""
        return self.begin + self.length

    def at(self, moment: Fraction) -> tuple[Vector, Vector]:
        """The attitude and the contact point at a time in this part."""
        s = Interval.about((moment - self.begin) / self.length, self.attitude[0].bits)
        return [x.at(s) for x in self.attitude], [x.at(s) for x in self.place]


class Motion:
    """The motion of a certificate, in units (powers of 2) with the ball and ω about 1; lengths in radii."""

    def __init__(self, data: Data):
        J, D, bits = [Fraction(x) for x in data["ball"]["J"]], Fraction(data["ball"]["D"]), data["bits"]
        (a, off), (K, wide) = (zip(*_fractions(data["start"][name]), strict=True) for name in ("attitude", "momentum"))
        moments = [sum(J) - x for x in J]
        mass = power(max(moments) + D)
        ball = [x / mass for x in moments], D / mass
        rotor = [Fraction(x) / mass for x in data["ball"].get("rotor", ())]
        own = [x / mass - y for x, y in zip(K, rotor or [Fraction(0)] * 3, strict=True)]
        time = 1 / power(rate(Rolling.of(*ball, Fraction), own, a))
        rotor = [x * time / 2 for x in rotor]
        self.units = {"angular_momentum": mass / time, "omega": 1 / time, "time": time}
        self.units["contact"] = Fraction(data["ball"].get("radius", "1"))
        start = [Interval.about(x, bits, by) for x, by in zip(a, off, strict=True)]
        length = dot(start, start).sqrt()
        self.start = [x / length for x in start]
        half = [Interval.about(x * time / mass / 2, bits, by * time / mass / 2) for x, by in zip(K, wide, strict=True)]
        half = [dot(row, half) for row in rotation(self.start)]
        one, fine_one, rough_one = (
            partial(Interval.about, bits=bits),
            partial(Model.constant, bits=bits),
            partial(Interval.about, bits=BITS),
        )
        self.ball = Turning.of(*ball, one, half, [one(x) for x in rotor])
        fine = Turning.of(*ball, fine_one, [Model.enclosing(x) for x in half], [fine_one(x) for x in rotor])
        rough = Turning.of(*ball, rough_one, [x.rescaled(BITS) for x in half], [rough_one(x) for x in rotor])
        self.flow = Flow(fine, rough, [Fraction(1)] * 4, data["order"])
        self.place = [one(Fraction(x) / self.units["contact"]) for x in data["start"].get("position", ())]

    def frames(self, times: Sequence[Fraction]) -> Iterator[dict[str, Vector]]:
        """The frames at these times, enclosed, in the units of the motion."""
        wanted = [x / self.units["time"] * 2**self.flow.bits for x in times]
        piece = self.first()
        for moment in wanted:
            while piece.end < moment:
                piece = self.after(piece, ceil(wanted[-1]))
            yield self.frame(*piece.at(moment))

    def first(self) -> Piece:
        """The start, as a piece that ends at time 0."""
        attitude, place = ([Model.enclosing(x) for x in v] for v in (self.start, self.place))
        return Piece(attitude, place, -1, 1, Fraction(sum(x.off for x in attitude), 2**self.flow.bits))

    def after(self, piece: Piece, end: int) -> Piece:
        """The next piece after `piece`, which ends at the time `end` at the latest."""
        start = [sum(x.terms) for x in piece.attitude]
        attitude, length, error = self.flow.step(start, piece.error, end - piece.end)
        place = [Model.enclosing(x) for x in piece.at(Fraction(piece.end))[1]]
        if place:
            h, half = Model([2 * length], 0, self.flow.bits), self.flow.fine.spin(attitude)
            along, across, _ = (dot(row, half) for row in rotation(attitude))
            place = [x + y.integral() * h for x, y in zip(place, (across, -along), strict=True)]
        return Piece(attitude, place, piece.end, length, error)

    def frame(self, a: Vector, place: Vector) -> dict[str, Vector]:
        """The vectors of a frame; the sign of the attitude is arbitrary."""
        vectors, half = self.ball.vectors(a), self.ball.spin(a)
        K, omega = ([2 * x for x in v] for v in (vectors[:3], half))
        found = {"gamma": vectors[3:], "angular_momentum": K, "omega": omega, "attitude": a}
        return found | {"contact": place} if place else found


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless every number of every frame is proved; returns the last frame."""
    motion, frames = Motion(data), data["frames"]
    for frame, found in zip(frames, motion.frames([Fraction(x["time"]) for x in frames]), strict=True):
        for name, values in found.items():
            claims, unit = _fractions(frame[name]), motion.units.get(name, Fraction(1))
            if name == "attitude" and not _agree(values, claims):
                values = [-x for x in values]
            for x, (centre, radius), pair in zip(values, claims, frame[name], strict=True):
                if not x.within(centre / unit, radius / unit):
                    raise Rejected(f"{name} at {frame['time']} is not proved to be {' up to '.join(pair)}")
    return {f"{name} at {frames[-1]['time']}": shown(frames[-1][name]) for name in PARTS if name in frames[-1]}


def _agree(a: Vector, claims: Sequence[Sequence[Fraction]]) -> bool:
    """Whether a has the sign of the claimed quaternion, in the greatest component of the latter."""
    x, (centre, _) = max(zip(a, claims, strict=True), key=lambda pair: abs(pair[1][0]))
    return x.sign == (1 if centre > 0 else -1)


def _fractions(pairs: Sequence[Sequence[str]]) -> list[list[Fraction]]:
    return [[Fraction(x) for x in pair] for pair in pairs]


def shown(pairs: Sequence[Sequence[str]]) -> str:
    """A vector as text: its numbers with their radii."""
    return ", ".join(" up to ".join(pair) if pair[1] != "0" else pair[0] for pair in pairs)


def rate(ball: Rolling, momentum: Sequence[Fraction], attitude: Sequence[Fraction]) -> Fraction:
    """The greatest |ω_i| at the start, approximately."""
    try:
        return max(map(abs, ball.spin([*momentum, *rotation(attitude)[2]])))
    except ZeroDivisionError:
        raise Rejected("the rotation at the start does not follow from the momentum") from None


def power(x: Fraction) -> Fraction:
    """A power of 2 near a positive number."""
    return Fraction(2) ** (x.numerator.bit_length() - x.denominator.bit_length())
