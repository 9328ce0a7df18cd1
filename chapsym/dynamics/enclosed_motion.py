"""The motion of the continuous ball with proved digits, from exact data, at given times."""

import math
import time as clock
from collections.abc import Callable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass
from decimal import Decimal, Inexact
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym.numbers.precisions import flint_bits, is_a
from chapsym.rationals import decimals

from .ball import Ball, brief, callback, in_principal_axes
from .errors import BadInput, TooWide
from .levels.start import exponent_of, fraction
from .map import check_body, check_tensor, time_limit, unit_exactly, whole_number
from .results import Bounds, Trajectory
from .shown import Brief

if TYPE_CHECKING:
    from flint import arb

    from .flow.path import Path

#: The parts of a frame, vectors of Arb balls.
Frame = dict[str, tuple["arb", ...]]

#: The quantities of a frame; `contact` if the ball has a radius.
PARTS = ("gamma", "angular_momentum", "omega", "attitude", "contact")
#: The bits of the first attempt beyond those of the digits, and for each doubling of the turns.
GUARD, OF_TURNS = 24, 2
#: The most digits, and the most bits that an attempt may have.
MOST_DIGITS, MOST_BITS = 4_000, 2**20
#: The largest limit in seconds; a larger one is no limit.
LONGEST = 1e9
#: The largest number of times; a generator may have no end.
MOST_TIMES = 10**6
#: The bits by which writing may enlarge a radius: radius and midpoint are rounded, which adds .15 of it.
ROUNDED = 0.25
#: The bits of the next attempt beyond the missing ones.
MARGIN = 6


@dataclass(frozen=True, repr=False)
class ExactBall(Brief):
    """A ball with exact numbers, where `Ball` has the nearest float64.

    A number is an int, a Fraction, a Decimal, a string such as "0.1" or "2/7", or a float, taken as its binary value.

    Parameters
    ----------
    mass_tensor : sequence
        J = ∫xxᵀdm in kg m²: three numbers in principal axes, or a symmetric tensor, three rows, in any axes.
    D : number
        m ρ² in kg m².
    radius : number, optional
        ρ in m, needed only for the contact point.

    Raises
    ------
    BadInput
        For numbers that no ball has.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.ExactBall(("1/3", "0.1", 1), 3, radius="2/7")
    >>> [str(x) for x in ball.mass_tensor], str(ball.radius), ball.diagonal
    (['1/3', '1/10', '1'], '2/7', True)
    """

    mass_tensor: tuple[Fraction, ...] | tuple[tuple[Fraction, ...], ...]
    D: Fraction
    radius: Fraction | None = None

    def __init__(self, mass_tensor: Any, D: Any, radius: Any = None) -> None:
        from .flow.start import exactly, first_of, vector

        contact = exactly(D, "D")
        rho = None if radius is None else exactly(radius, "radius")
        moments: tuple[Fraction, ...] | tuple[tuple[Fraction, ...], ...]
        rows = first_of(mass_tensor, 4) if is_a(mass_tensor, Sequence, np.ndarray) else []
        if len(rows) == 3 and all(is_a(x, list, tuple, np.ndarray) for x in rows):
            moments = check_tensor([vector(row, "mass_tensor") for row in rows], contact)
        else:
            moments = vector(mass_tensor, "mass_tensor")
            check_body(moments, contact)
        if rho is not None and rho <= 0:
            raise BadInput(f"radius must be positive, but it is {brief(radius)}")
        for name, value in zip(("mass_tensor", "D", "radius"), (moments, contact, rho), strict=True):
            object.__setattr__(self, name, value)

    @property
    def diagonal(self) -> bool:
        """Whether the tensor is given in principal axes."""
        return not isinstance(self.mass_tensor[0], tuple)


@dataclass(frozen=True, eq=False, repr=False)
class CertifiedMotion(Brief):
    """Arb balls that contain the motion, at the times that were reached.

    Attributes
    ----------
    times : tuple of Fraction
        In s, exact.
    gamma, angular_momentum, omega : numpy.ndarray
        γ, K in kg m²/s and ω in rad/s, (frames, 3).
    attitude : numpy.ndarray
        Unit quaternions, (frames, 4); the first component that is proved not to be 0 is positive.
    contact : numpy.ndarray or None
        In m, (frames, 2).
    digits : int
        Every radius is at most 10^-digits, relative to the length of K and of ω, and to the ball's radius.
    steps, bits : int
        The steps and the working bits of the run that proved it.
    stopped : str or None
        One sentence if not all times were reached; else None.

    Examples
    --------
    >>> import chapsym
    >>> found = chapsym.certified_motion(chapsym.ExactBall((1, 2, 4), 3), (3, 1, 4), ("2/7", "3/7", "6/7"), "0.5", 12)
    >>> found.digits, found.omega.shape, found.write()["frames"][0]["omega"][0]
    (12, (1, 3), ['0.49466556719891945', '9.4e-16'])
    """

    times: tuple[Fraction, ...]
    gamma: np.ndarray
    angular_momentum: np.ndarray
    omega: np.ndarray
    attitude: np.ndarray
    contact: np.ndarray | None
    digits: int
    steps: int
    bits: int
    stopped: str | None = None

    def write(self) -> dict[str, Any]:
        """For JSON: each number as decimal strings [middle, radius]; the true number is in that interval."""
        arrays = [(name, array) for name in PARTS if (array := getattr(self, name)) is not None]
        frames = [
            {"time": decimal(at)} | {name: [list(written(x, self.digits)) for x in array[i]] for name, array in arrays}
            for i, at in enumerate(self.times)
        ]
        found: dict[str, Any] = {"frames": frames, "digits": self.digits, "steps": self.steps, "bits": self.bits}
        return found if self.stopped is None else found | {"stopped": self.stopped}


def certified_motion(
    ball: Ball | ExactBall,
    angular_momentum: Any,
    gamma: Any,
    times: Any,
    digits: int = 20,
    *,
    attitude: Any = None,
    rotor: Any = (0, 0, 0),
    limit: float = 600.0,
    progress: Callable[[str], None] = lambda sentence: None,
) -> CertifiedMotion:
    """Encloses the motion of the continuous ball (2.3) at given times, to proved digits.

    Each step bounds the error of polynomials in time in Arb's balls (`dynamics/flow`); the run is repeated with more
    bits until the digits are proved.  If this takes longer than the limit, the times that were reached are returned,
    and `stopped` gives the reason.  All input is exact (see `ExactBall`).

    Parameters
    ----------
    ball : ExactBall or Ball
        An `ExactBall`, or one `Ball` in principal axes, whose floats are taken exactly.  If the tensor is not diagonal,
        its principal axes are enclosed, and all vectors are in the axes in which it is given.
    angular_momentum : array_like
        K in kg m²/s, in the axes of the body.
    gamma : array_like
        The vertical, upwards; it is divided by its length.
    times : number or sequence of numbers
        One time ≥ 0 in s, or several in ascending order.
    digits : int, optional
        Every radius is at most 10^-digits, relative to the length of K and of ω, and to the ball's radius.
    attitude : array_like, optional
        A quaternion, scalar first, that turns γ to the vertical; it is divided by its length; by default the least
        rotation.  If the two differ by rounding, at most 1e-5, γ follows from the attitude.
    rotor : array_like, optional
        a in kg m²/s, the constant angular momentum of a rotor inside, in the axes of the body (lemmas `gyrostat-rotor`,
        `gyrostat-motion`); then K = B(γ)ω + a, and K ≠ a.
    limit : float, optional
        The largest duration of all attempts, in seconds.
    progress : callable, optional
        Called with one sentence at a time on the progress.

    Returns
    -------
    CertifiedMotion

    Raises
    ------
    BadInput
        For input that defines no motion.

    References
    ----------
    Equation (2.3) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> found = chapsym.certified_motion(chapsym.ExactBall((1, 2, 4), 3), (3, 1, 4), ("2/7", "3/7", "6/7"), ["0.5"], 12)
    >>> print(found.omega[0, 0].str(12))
    [0.494665567199 +/- 8.15e-14]
    """
    from chapsym.numbers import Digits

    from .flow.start import Start, Turns, balls, fixed, principal_exactly, upright, vector

    exact = _exact_ball(ball)
    vertical = vector(gamma, "gamma")
    unit_exactly(vertical, Digits(5))
    if attitude is None:
        turned = upright(vertical)
    else:
        quaternion = vector(attitude, "attitude", 4)
        _check_up(quaternion, vertical)
        turned = lambda: balls(quaternion)  # noqa: E731
    momentum, inside = vector(angular_momentum, "angular_momentum"), vector(rotor, "rotor")
    if any(inside) and momentum == inside:
        raise BadInput("angular_momentum must differ from the rotor's: otherwise the ball is at rest, and stays there")
    moments: Any = exact.mass_tensor
    start = Start(
        moments if exact.diagonal else (), exact.D, turned, fixed(momentum), exact.radius,
        rotor=tuple(map(Turns, inside)),
        axes=None if exact.diagonal else lambda: principal_exactly(moments),
    )  # fmt: skip
    return follow(start, _ascending(times), digits, limit=limit, progress=progress)


def of_motion(run: Trajectory, limit: float = 600.0, progress: Callable[[str], None] = lambda sentence: None) -> Bounds:
    """Bounds of the distance of the frames of a ball from the motion that starts at the numbers of frame 0.

    run: in float64, with a time step, in principal axes.  The enclosure has two digits more than the estimated error of
    the run.  A frame that is not reached within `limit` seconds has inf.
    """
    from flint import fmpq

    from .certified import errors_of, exactly

    epsilon, index = Fraction(run.time_step or 0.0), run.index.tolist()
    K = exactly(run, "momentum")
    digits = min(17, max(4, math.ceil(-math.log10(max(float(np.max(run.error)), 1e-17))) + 2))
    found = certified_motion(
        ExactBall(*run.ball.exact), [x / epsilon for x in K[0]], run.gamma[0], [epsilon * i for i in index], digits,
        attitude=None if run.attitude is None else run.attitude[0], limit=limit, progress=progress,
    )  # fmt: skip
    count, bits, scale = len(found.times), found.bits, fmpq(epsilon.numerator, epsilon.denominator)
    bounds: dict[str, Any] = {}
    with flint_bits(bits):
        arrays = {"momentum": found.angular_momentum * scale}
        opposite = -found.attitude
    arrays |= {name: getattr(found, name) for name in ("gamma", "attitude", "contact")}
    for name, balls in arrays.items():
        if getattr(run, name) is not None:
            ours = exactly(run, name)
            of = errors_of(balls, ours[:count], bits)
            if name == "attitude":  # of the two signs
                of = np.minimum(of, errors_of(opposite, ours[:count], bits))
            bounds[name] = np.concatenate([of, np.full(len(index) - count, np.inf)])
    return Bounds(**bounds, steps=np.array(index[max(count - 1, 0)]))


def _exact_ball(ball: Ball | ExactBall) -> ExactBall:
    if is_a(ball, ExactBall):
        return ball
    one = in_principal_axes(ball)
    if one.mass_tensor.ndim != 1 or one.D.ndim or (one.radius is not None and one.radius.ndim):
        raise BadInput("certified_motion takes one ball, not a batch")
    return ExactBall(*one.exact)


def _check_up(attitude: Sequence[Fraction], gamma: Sequence[Fraction]) -> None:
    """Raises BadInput unless the quaternion turns γ up, to rounding."""
    from chapsym import generated

    if not (square := sum(x * x for x in attitude)):
        raise BadInput("attitude must not be 0: it is a unit quaternion, scalar first")
    off = [float(x / square - y) for x, y in zip(generated.rotation(*attitude)[6:], gamma, strict=True)]
    if max(map(abs, off)) > 1e-5:
        raise BadInput("attitude must turn gamma to (0, 0, 1): give those two together, or gamma alone")


def _ascending(times: object) -> tuple[Fraction, ...]:
    from .flow.start import exactly, vector

    if is_a(times, str) or not is_a(times, Iterable) or getattr(times, "ndim", 1) == 0:
        found: tuple[Fraction, ...] = (exactly(times, "times"),)
    else:
        found = () if is_a(times, bytes, Mapping, Set) else vector(times, "times", MOST_TIMES, exact=False)
    if not found or found[0] < 0 or any(x >= y for x, y in pairwise(found)):
        raise BadInput("times must be one or more numbers of seconds from 0 on, each later than the one before")
    return found


def follow(
    start: Any, times: Sequence[Fraction], digits: int, *, limit: float = 600.0,
    progress: Callable[[str], None] = lambda sentence: None,
) -> CertifiedMotion:  # fmt: skip
    """`certified_motion` from a `flow.start.Start`."""
    callback(progress)
    digits, limit = whole_number(digits, "digits", 1, MOST_DIGITS), min(time_limit(limit), LONGEST)
    search = _Search(start, tuple(times), digits, clock.monotonic() + limit, progress)
    bits = math.ceil(digits * math.log2(10)) + GUARD + OF_TURNS * search.doublings()
    why = None
    while why is None and not search.done:
        more = search.attempt(bits)
        if search.done:
            break
        if more is None:
            why = f"{limit:g} s were not enough"
        elif bits + more > MOST_BITS:
            why = f"more than {MOST_BITS} bits would be needed"
        else:
            bits += more
    return search.found(why)


class _TimeUp(Exception):
    """The time limit is reached."""


class _Search:
    """Attempts with increasing bits, and the frames of the best attempt."""

    def __init__(
        self, start: Any, times: tuple[Fraction, ...], digits: int, deadline: float, progress: Callable[[str], None]
    ) -> None:
        self.start, self.times, self.digits, self.deadline, self.progress = start, times, digits, deadline, progress
        self.frames: list[Frame] = []
        self.kept = self.bits = self.steps = 0

    @property
    def done(self) -> bool:
        """Whether all times are reached."""
        return self.kept == len(self.times)

    def doublings(self) -> int:
        """About log₂ of the angle turned at the rate of the start, in radians; BadInput if K does not determine ω."""
        from .levels.proved_root import upper

        with flint_bits(1024):
            try:
                omega = upper(self.start.path(1024).frame(Fraction(0))["omega"])
            except TooWide:
                raise BadInput(
                    "two principal moments are nearly equal, and their axes are not given: give the principal "
                    "moments, and all vectors in their axes"
                ) from None
            if not omega.is_finite():
                raise BadInput("the ball does not resist a turn about the vertical: ω does not follow from K")
            turns = fraction(omega) * self.times[-1]
        return max(exponent_of(turns), 0) if turns else 0

    @np.errstate(under="ignore")
    def attempt(self, bits: int) -> int | None:
        """Follows the motion with this many bits; returns the number of missing bits, or None if the time is up."""
        missing, frames = -math.inf, list[Frame]()
        with flint_bits(bits):
            try:
                path = self.start.path(bits)
            except TooWide:
                return bits
            path.tick = lambda: self._tell(path.time, bits)
            try:
                for end in self.times:
                    while path.time < end:
                        path.advance(self.times[-1])
                    frames.append(_signed(path.frame(end)))
                    missing = max(missing, _missing(frames[-1], self.digits, self.start.radius))
                    if missing <= 0 and len(frames) > self.kept:
                        self.frames, self.kept, self.bits, self.steps = frames, len(frames), bits, path.steps
                    self._tell(end, bits)
            except TooWide:
                return self._more(path, bits)
            except _TimeUp:
                return None
            except (np.linalg.LinAlgError, ArithmeticError):  # an overflow of the floats that propose the steps
                raise BadInput("the numbers are too far apart in size to find steps of the motion") from None
        return math.ceil(missing) + MARGIN if math.isfinite(missing) else bits

    def _more(self, path: "Path", bits: int) -> int:
        """The bits that were lost, extrapolated to the whole time, but at most twice the present ones."""
        if path.time == 0:
            return bits
        lost = max(bits + path.width, 0.0)
        foreseen = 1.1 * lost * float(self.times[-1] / path.time)
        return math.ceil(min(max(foreseen - bits, bits / 4), bits)) + math.ceil(self.digits * math.log2(10))

    def _tell(self, time: Fraction, bits: int) -> None:
        """Reports the progress, at the end of each step and at each frame."""
        if clock.monotonic() > self.deadline:
            raise _TimeUp
        last = float(self.times[-1])
        part = float(time) / last if last else 1.0
        self.progress(f"{bits} bits: {float(time):.6g} s of {last:.6g} s, {part:.0%}")

    def found(self, why: str | None) -> CertifiedMotion:
        """The proved frames; why: the reason why not all are proved, as a part of a sentence."""
        kept, frames = self.times[: self.kept], self.frames[: self.kept]
        stopped = None
        if why is not None:
            clause = f"{len(kept)} of {len(self.times)} frames are proved"
            until = f", until {decimal(kept[-1])} s" if kept else ""
            stopped = f"{why} for {self.digits} digits at {decimal(self.times[-1])} s: {clause}{until}"
        names = PARTS if self.start.radius is not None else PARTS[:-1]
        shape = len(frames), -1 if frames else 0
        arrays: dict[str, Any] = {
            name: np.array([frame[name] for frame in frames], dtype=object).reshape(shape) for name in names
        }
        arrays.setdefault("contact", None)
        return CertifiedMotion(kept, **arrays, digits=self.digits, steps=self.steps, bits=self.bits, stopped=stopped)


def _signed(frame: Frame) -> Frame:
    """The frame with the sign of its quaternion that makes the first component proved not to be 0 positive."""
    a = frame["attitude"]
    first = next((x for x in a if not x.contains(0)), None)
    return frame | {"attitude": tuple(-x for x in a)} if first is not None and first < 0 else frame


def _missing(frame: Frame, digits: int, radius: Fraction | None) -> float:
    """The number of bits that the radii still lack; at most 0 if they are small enough."""
    worst = -math.inf
    for name, vector in frame.items():
        if not (widest := fraction(max(x.rad() for x in vector))):
            continue
        if name in ("angular_momentum", "omega"):
            size = fraction(max(abs(x.mid()) for x in vector))
        else:
            size = radius if name == "contact" and radius is not None else Fraction(1)
        if not size:
            return math.inf
        worst = max(worst, _log2(widest / size * 10**digits) + ROUNDED)
    return worst


def _log2(x: Fraction) -> float:
    return math.log2(x.numerator) - math.log2(x.denominator)


def decimal(x: Fraction) -> str:
    """A fraction as a decimal number if it is finite, else as a quotient."""
    context = decimals(x.numerator.bit_length() + x.denominator.bit_length() + 1)
    found = context.divide(x.numerator, x.denominator)
    return str(x) if context.flags[Inexact] else f"{found:f}"


def written(x: "arb", digits: int) -> tuple[str, str]:
    """(middle, radius), decimal strings of a ball that contains the ball x; the radius has two or three digits.

    digits: those of a number whose radius is 0.
    """
    middle, radius = fraction(x), fraction(x.rad())
    if not radius and (text := decimal(middle)) and len(text) <= 40:
        return text, "0"
    if not radius:
        radius = abs(middle) / 10 ** (digits + 2)
    place = math.floor(_log2(radius) * math.log10(2)) - 1
    # In whole numbers, of which fractions would find the common divisors: both and the unit of the last place.
    ten, below = 10 ** abs(place), math.lcm(middle.denominator, radius.denominator)
    unit, times = (below * ten, below) if place > 0 else (below, below * ten)
    whole, more = (x.numerator * (times // x.denominator) for x in (middle, radius))
    rounded, left = divmod(whole, unit)
    rounded += 2 * left + rounded % 2 > unit  # a half to the even one
    off = -(-(more + abs(whole - rounded * unit)) // unit)
    shown, error = (Decimal(f"{x}e{place}") for x in (rounded, off))
    return f"{shown:f}" if len(str(abs(rounded))) + 12 > -place else f"{shown:e}", f"{error:e}"
