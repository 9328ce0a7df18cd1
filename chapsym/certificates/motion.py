"""A certificate of a motion of the continuous ball: the frames of a certified motion, and their start."""

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

from flint import arb

from chapsym import checker
from chapsym.dynamics import BadInput
from chapsym.dynamics.enclosed_motion import CertifiedMotion
from chapsym.dynamics.flow.start import Principal, Start, balls
from chapsym.dynamics.levels.balls import unit
from chapsym.dynamics.levels.start import decade, fraction
from chapsym.numbers.precisions import flint_bits

from .balls import shortest
from .document import Document, Say, first_accepted, stated

KIND = "motion"
#: Bits of the first attempt beyond those of the digits, the increment for the next attempts, and the maximum.
GUARD, MORE, MOST = 48, 1.5, 512
#: The largest denominator of a number of the start that is written as a quotient, and the known bits that this needs.
SIMPLE, KNOWN = 10**18, 512
#: What a user can do.
LESS = "ask for less time or fewer digits"


def check_start(start: Start, frames: int) -> None:
    """Raises BadInput for principal axes other than the given axes, a rotor with π in its numbers, too many frames."""
    if frames > checker.form.MOST:
        raise BadInput(f"a certificate has at most {checker.form.MOST} frames, not {frames}")
    if start.axes is not None:
        raise BadInput("a certificate is of principal axes: give the principal moments, and all vectors in their axes")
    if any(x.of_pi for x in start.rotor):
        raise BadInput("a certificate has the rotor's angular momentum as rational numbers: give it in kg m^2/s")


def motion(
    start: Start, found: CertifiedMotion, progress: Say = lambda what: None, limit: float = math.inf
) -> Document:
    """The certificate of the frames from a start, accepted by the checker.

    The checker tries increasing bits, as it loses some bits per turn, more for a ball with unequal moments.  Raises
    BadInput if it accepts none with MOST bits beyond those of the digits, LimitReached if it has accepted none after
    `limit` s, and as `check_start`.
    """
    check_start(start, len(found.times))
    digits = math.ceil(found.digits * math.log2(10))
    bits = _increasing(digits + GUARD, digits + MOST)
    try:
        return first_accepted(bits, lambda n: document(start, found, n), progress, limit, LESS)
    except checker.Rejected as error:
        raise BadInput(f"the checker proves too few digits of this motion, {LESS}: {error}") from None


def _increasing(bits: int, most: int) -> Iterator[int]:
    while bits <= most:
        yield bits
        bits = math.ceil(MORE * bits)


def document(start: Start, found: CertifiedMotion, bits: int) -> Document:
    """The unchecked certificate, for a checker with this many bits."""
    ball: Document = {"J": [shortest(x) for x in start.mass_tensor], "D": shortest(start.D)}
    if any(map(any, start.rotor)):
        ball["rotor"] = [shortest(x.rational) for x in start.rotor]
    began: Document = _start(start, bits)
    if start.radius is not None:
        ball["radius"] = shortest(start.radius)
        began["position"] = [shortest(x) for x in start.position]
    arrays = {name: getattr(found, name) for name in checker.motion.PARTS if getattr(found, name) is not None}
    share, radius = Fraction(1, 10**found.digits), start.radius or Fraction(1)
    frames = [
        {"time": shortest(at), **{name: _claims(name, rows[i], share, radius) for name, rows in arrays.items()}}
        for i, at in enumerate(found.times)
    ]
    order = min(bits // 2, 1024)
    return stated(KIND, ball=ball, start=began, digits=found.digits, bits=bits, order=order, frames=frames)


def _start(start: Start, bits: int) -> dict[str, list[list[str]]]:
    """The attitude, scaled to greatest number 1, and the momentum: likely quotients as such, else [middle, radius]."""
    with flint_bits(bits + KNOWN):
        a = start.attitude()
        greatest = max(a, key=lambda x: abs(fraction(x)))
        return {
            "attitude": [_known(x / greatest, bits) for x in a],
            "momentum": [_known(x, bits) for x in start.momentum(unit(a), Principal(balls(start.mass_tensor)))],
        }


def _known(x: arb, bits: int) -> list[str]:
    """A ball as [middle, radius]; with radius 0 if it contains a quotient with a small denominator.

    The certificate defines its start: its proof does not depend on whether a number of a scene was this quotient.
    """
    middle, radius = fraction(x.mid()), fraction(x.rad())
    if abs((simple := middle.limit_denominator(SIMPLE)) - middle) <= radius:
        return [shortest(simple), "0"]
    share = Fraction(1, 2**bits) * max(abs(middle), Fraction(1, 2**bits))
    return _pair(middle, Fraction(10) ** (decade(max(share, 8 * radius)) + 1))


def _claims(name: str, row: Sequence[arb], share: Fraction, radius: Fraction) -> list[list[str]]:
    """The numbers of a frame, rounded to a power of 10 that is at most this share of their size."""
    middles = [fraction(x.mid()) for x in row]
    if name in ("angular_momentum", "omega"):
        size = max(map(abs, middles))
    else:
        size = radius if name == "contact" else Fraction(1)
    off = Fraction(10) ** decade(size * share)
    if name == "attitude" and next(x for x in middles if abs(x) > 2 * off) < 0:
        middles = [-x for x in middles]
    return [_pair(x, off) for x in middles]


def _pair(middle: Fraction, radius: Fraction) -> list[str]:
    """[middle, radius], the middle with a decimal more than the radius, a power of 10."""
    place = radius / 10
    return [shortest(round(middle / place) * place), shortest(radius)]
