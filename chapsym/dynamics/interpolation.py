"""The motion between the frames of a run: quintics through the states, with their rates by (2.3)."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from . import kernels
from .ball import Asked, Ball, Floats, checked_before, largest_moment, numbers
from .errors import BadInput
from .shown import Brief

#: The largest rotation between two frames, in radians, that the interpolation accepts.
MOST_TURN = 1.5
#: The least relative horizontal part of 𝒦 that defines a direction on the plane.
VERTICAL = 1e-9
#: The relative distance of a time outside of the frames that is a rounding: in decimals 3 times .35 is 1.05.
ROUNDED = 2.0**-50
#: The values that replace missing frames, if they are not 0.
RESTING = {"gamma": [0.0, 0.0, 1.0], "attitude": [1.0, 0.0, 0.0, 0.0]}

_torque = kernels.kernel("torque")


@dataclass(frozen=True, eq=False, repr=False)
class Moments(Brief):
    """States of a run at given times, (..., times, ...) or (...) for one time, in float64; NaN after a stop.

    time: seconds, or step numbers if the run has no time step.
    momentum, gamma, attitude, contact: as in the run;
    omega: in body axes, in rad/s, or in radians per step.
    """

    time: Floats
    momentum: Floats
    gamma: Floats
    omega: Floats
    attitude: Asked
    contact: Asked


@dataclass(frozen=True, eq=False)
class States:
    """The frames of a run in principal axes: clock (frames,), K in the unit of the clock, and the rest as `Moments`.

    there: which frames exist, (..., frames); the values of the others are finite (`standing`), and not used.
    """

    ball: Ball
    clock: Floats
    there: np.ndarray
    momentum: Floats
    gamma: Floats
    attitude: Asked = None
    contact: Asked = None

    @np.errstate(over="ignore", under="ignore", invalid="ignore")  # an overflow is a large rotation
    def turning(self) -> float:
        """The largest rotation between successive frames of all balls, in radians; 0 for a single frame."""
        return self._in_own_units()[0]._turning()

    def _turning(self) -> float:
        speed = np.sqrt((self._omega() ** 2).sum(axis=-1))
        turns = np.maximum(speed[..., 1:], speed[..., :-1]) * np.diff(self.clock)
        return float(np.max(turns, initial=0.0, where=self.there[..., 1:] & self.there[..., :-1]))

    def _in_own_units(self) -> tuple["States", int, np.ndarray, np.ndarray]:
        """The states in units in which the run takes about 1, and each ball's largest moment and radius are about 1.

        In the units of a run products of its numbers may be beyond float64.  Also returned are the exponents of the
        units, which are powers of two: of time, and, (...), of moments and lengths.
        """
        ball, time = self.ball, int(np.frexp(self.clock[-1] - self.clock[0])[1])
        mass = np.frexp(largest_moment(ball.mass_tensor, ball.D))[1]
        length = np.frexp(0.0 if ball.radius is None else ball.radius)[1]
        tensor, D = np.ldexp(ball.mass_tensor, -mass[..., np.newaxis]), np.ldexp(ball.D, -mass)
        own = checked_before(tensor, D, None if ball.radius is None else np.ldexp(ball.radius, -length))
        contact = None if self.contact is None else np.ldexp(self.contact, -length[..., np.newaxis, np.newaxis])
        K = np.ldexp(self.momentum, time - mass[..., np.newaxis, np.newaxis])
        scaled = replace(self, ball=own, clock=np.ldexp(self.clock, -time), momentum=K, contact=contact)
        return scaled, time, mass, length

    def _omega(self) -> Floats:
        return kernels.angular_velocity(self.momentum, self.gamma, *self._body())

    def _body(self) -> tuple[Floats, Floats]:
        return self.ball.mass_tensor[..., np.newaxis, :], np.asarray(self.ball.D)[..., np.newaxis]

    @np.errstate(over="ignore", under="ignore", invalid="ignore")  # a damaged frame may have any numbers
    def at(self, times: ArrayLike) -> Moments:
        """The states at these times, by quintics; raises BadInput for times out of range and frames too far apart."""
        if (given := numbers(times, "times")).ndim > 1:
            raise BadInput(f"times must be one number or a list of them, not an array with the axes {given.shape}")
        if not len(self.clock):
            raise BadInput("there is nothing between the frames: the run has none")
        asked, first, last = np.atleast_1d(given), float(self.clock[0]), float(self.clock[-1])
        wanted = np.clip(asked, first, last)
        if (np.abs(wanted - asked) > ROUNDED * max(abs(first), abs(last))).any():
            raise BadInput(f"times must lie between the first frame and the last, {first} and {last}")
        own, time, mass, length = self._in_own_units()
        if not (turn := own._turning()) <= MOST_TURN:
            raise BadInput(
                f"frames are up to {turn:.3g} radians of turning apart, too far to tell what is between (at most "
                f"{MOST_TURN}): keep more frames, with a smaller `every`"
            )
        K, gamma, omega, attitude, contact = own._between(np.ldexp(wanted, -time))
        K, omega = np.ldexp(K, (mass - time)[..., np.newaxis, np.newaxis]), np.ldexp(omega, -time)
        contact = None if contact is None else np.ldexp(contact, length[..., np.newaxis, np.newaxis])
        found = K, gamma, omega, attitude, contact
        if given.ndim == 0:
            return Moments(given, *(None if v is None else v[..., 0, :] for v in found))  # type: ignore[arg-type]
        return Moments(asked, *found)

    def _between(self, times: Floats) -> tuple[Floats, Floats, Floats, Asked, Asked]:
        """K, γ, ω, attitude and contact, (..., times, k); NaN where a ball stopped."""
        spin = self._omega()
        quintic = Quintic(self.clock, times)
        bent = kernels.angular_velocity(_torque(spin, self._body()[0]), self.gamma, *self._body())
        K, gamma = (quintic.through(v, *_fixed_in_space(v, spin, bent)) for v in (self.momentum, self.gamma))
        gamma = _unit(gamma)
        attitude = None
        if self.attitude is not None:
            attitude = _unit(quintic.through(continued(self.attitude), *_turning(continued(self.attitude), spin, bent)))
        contact = None
        if self.contact is not None and (rolling := self._rolling(spin, bent)) is not None:
            contact = quintic.through(self.contact, *rolling)
        gone = ~quintic.known(self.there)
        found = K, gamma, kernels.angular_velocity(K, gamma, *self._body()), attitude, contact
        for values in found:
            if values is not None:
                values[gone] = np.nan
        return found

    def _rolling(self, spin: Floats, bent: Floats) -> tuple[Floats, Floats] | None:
        """Velocity and acceleration of the contact point, (..., frames, 2): ρ ω × e₃ in space; None if unknown."""
        radius = np.asarray(self.ball.radius)[..., np.newaxis, np.newaxis]
        if self.attitude is not None:
            x, y = (kernels.transport(self.attitude, np.broadcast_to(e, self.gamma.shape)) for e in np.eye(3)[:2])
            return radius * _rolled(spin, x, y), radius * _rolled(bent, x, y)
        # Without the attitude, the horizontal part of 𝒦, which is constant in space, gives the directions up to one
        # angle.
        level = self.momentum - (self.momentum * self.gamma).sum(axis=-1, keepdims=True) * self.gamma
        vertical = (level**2).sum(axis=-1) <= VERTICAL**2 * (self.momentum**2).sum(axis=-1)
        if (vertical & self.there).any():
            return None
        x = _unit(np.where(vertical[..., np.newaxis], [1.0, 0.0, 0.0], level))
        y = np.cross(self.gamma, x)
        rate, second = radius * _rolled(spin, x, y), radius * _rolled(bent, x, y)
        h = np.diff(self.clock)[:, np.newaxis]
        expected = h * (rate[..., 1:, :] + rate[..., :-1, :]) / 2 - h * h * np.diff(second, axis=-2) / 12
        way = np.diff(np.asarray(self.contact), axis=-2)
        both = self.there[..., 1:] & self.there[..., :-1]
        turned = (way @ [1, 1j] * (expected @ [1, -1j])).sum(axis=-1, where=both)[..., np.newaxis]
        turned = np.exp(1j * np.angle(turned))
        rate, second = (v @ [1, 1j] * turned for v in (rate, second))
        return np.stack([rate.real, rate.imag], axis=-1), np.stack([second.real, second.imag], axis=-1)


def standing(**arrays: Asked) -> tuple[np.ndarray, dict[str, Asked]]:
    """Which frames (...) are finite in all arrays (..., k), and the arrays with a ball at rest in the other frames."""
    given = {name: np.array(array, dtype=np.float64) for name, array in arrays.items() if array is not None}
    there = np.all([np.isfinite(array).all(axis=-1) for array in given.values()], axis=0)
    for name, array in given.items():
        array[~there] = RESTING.get(name, 0.0)
    return there, {name: given.get(name) for name in arrays}


class Quintic:
    """Hermite's quintics on frames at `clock`, (frames,), evaluated at `times`, (times,)."""

    def __init__(self, clock: Floats, times: Floats) -> None:
        self.at = np.clip(np.searchsorted(clock, times, side="right") - 1, 0, max(len(clock) - 2, 0))
        self.next = np.minimum(self.at + 1, len(clock) - 1)
        self.h = (clock[self.next] - clock[self.at])[:, np.newaxis]
        away = (times - clock[self.at])[:, np.newaxis]
        self.s = np.divide(away, self.h, out=np.zeros_like(away), where=self.h > 0)

    def through(self, value: Floats, rate: Floats, second: Floats) -> Floats:
        """The curve (..., times, k) with these values and derivatives at the frames, (..., frames, k)."""
        i, j, h, s = self.at, self.next, self.h, self.s
        r = 1 - s
        found = _half(value[..., i, :], rate[..., i, :], second[..., i, :], h, s, r)
        found = found + _half(value[..., j, :], rate[..., j, :], second[..., j, :], -h, r, s)
        return np.where(s == 0, value[..., i, :], np.where(s == 1, value[..., j, :], found))

    def known(self, there: np.ndarray) -> np.ndarray:
        """At which times, (..., times), the required frames exist; there: (..., frames)."""
        s = self.s[:, 0]
        return np.asarray((there[..., self.at] | (s == 1)) & (there[..., self.next] | (s == 0)))


def _half(value: Floats, rate: Floats, second: Floats, h: Floats, s: Floats, r: Floats) -> Floats:
    """The contribution of one end, at the fraction s of the interval from it and r = 1 - s from the other."""
    return np.asarray(
        r**3 * ((1 + 3 * s + 6 * s * s) * value + h * s * (1 + 3 * s) * rate + h * h * s * s / 2 * second)
    )


def _fixed_in_space(v: Floats, spin: Floats, bent: Floats) -> tuple[Floats, Floats]:
    """v' = v × ω and v'' of a vector that is constant in space, in body axes."""
    rate = np.cross(v, spin)
    return rate, np.cross(rate, spin) + np.cross(v, bent)


def _turning(q: Floats, spin: Floats, bent: Floats) -> tuple[Floats, Floats]:
    """q' = q ω/2 and q''."""
    rate = _times(q, spin) / 2
    return rate, (_times(rate, spin) + _times(q, bent)) / 2


def _times(q: Floats, v: Floats) -> Floats:
    """The quaternion product of q (..., 4) and the vector v (..., 3)."""
    return kernels.compose(q, np.concatenate([np.zeros_like(v[..., :1]), v], axis=-1))


def continued(q: Floats) -> Floats:
    """Each quaternion with the sign that makes it nearer to the one before: q and -q are one attitude."""
    turned = np.where((q[..., 1:, :] * q[..., :-1, :]).sum(axis=-1, keepdims=True) < 0, -1.0, 1.0)
    return np.concatenate([q[..., :1, :], q[..., 1:, :] * np.cumprod(turned, axis=-2)], axis=-2)


def _rolled(spin: Floats, x: Floats, y: Floats) -> Floats:
    """(⟨ω,y⟩, -⟨ω,x⟩), (..., 2): ω × e₃ along the horizontals x and y."""
    return np.stack([(spin * y).sum(axis=-1), -(spin * x).sum(axis=-1)], axis=-1)


def _unit(v: Floats) -> Floats:
    return np.asarray(v / np.sqrt((v * v).sum(axis=-1, keepdims=True)))
