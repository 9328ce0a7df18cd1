"""The continuous ball (2.3) with its contact point, to as many digits as asked: its Taylor series in Arb numbers.

K' = K × ω, γ' = γ × ω, a' = a × ω and b' = b × ω, where a and b are the first two axes of space seen from the body;
the ball rolls, so the contact point moves with ρ R(ω × γ), whose components are -ρ⟨a, γ'⟩ and -ρ⟨b, γ'⟩.
It shares no formula of motion with the map.  The radii of the balls are dropped after each step: digits are checked by
another run.
"""

from collections.abc import Sequence
from fractions import Fraction
from operator import mul
from typing import Any

import flint
import numpy as np

from chapsym.dynamics import Ball
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.levels.balls import exact, least, unit
from chapsym.dynamics.levels.start import fraction

#: Digits carried beyond those that are asked for; and terms of the series for each digit, the best of what was tried.
GUARD = 10
TERMS_PER_DIGIT = 1.2
#: So many of the last terms, and the one before them, tell the length of a step.
LAST = 3


def continuous(
    ball: Ball, angular_momentum: Floats, gamma: Floats, attitude: Floats | None, times: Sequence[Fraction],
    digits: int,
) -> np.ndarray:  # fmt: skip
    """K (kg m²/s), γ and the contact point (m) at ascending times (s): Fractions, (times, 8).

    attitude: a quaternion, body to space; None for the least rotation that turns γ up.  All floats are taken as
    exact, γ and the attitude divided by their length.
    digits: of the state, at every time; `error` of two runs with other digits tells whether they are there.
    """
    bits = int((digits + GUARD) * 3.33) + 8
    with flint.ctx.workprec(bits):
        J, D = [exact(float(x)) for x in ball.mass_tensor], exact(float(ball.D))
        radius = exact(0.0 if ball.radius is None else float(ball.radius))
        K, g = [exact(x) for x in angular_momentum], unit(exact(x) for x in gamma)
        first = least(*g) if attitude is None else [exact(x) for x in attitude]
        state = [*K, *g, *_axes(unit(first)), flint.arb(0), flint.arb(0)]
        inverse, terms = [1 / (sum(J) - x + D) for x in J], max(8, int(TERMS_PER_DIGIT * digits))
        # K may be of any size, and the error of a step is that of its last terms, relative to the state.
        sizes = [max(abs(x) for x in K)] * 3 + [flint.arb(1)] * 9
        now, rows = Fraction(0), []
        for time in times:
            while now < time:
                series = _taylor(state, inverse, D, radius, terms)
                step = min(time - now, _length(series, sizes, digits + 3, terms))
                h = exact(step)
                state = [_value(one, h).mid() for one in series]
                now += step
            rows.append([fraction(x) for x in (*state[:6], *state[12:])])
    return np.array(rows, dtype=object)


def _taylor(state: list[Any], inverse: list[Any], D: Any, radius: Any, terms: int) -> list[list[Any]]:
    K, g, a, b = ([[x] for x in state[i : i + 3]] for i in (0, 3, 6, 9))
    spot = [[x] for x in state[12:]]
    F: list[Any] = []  # 1 - D⟨γ,Λ⁻¹γ⟩
    lift: list[Any] = []  # ⟨γ,ω⟩ = ⟨γ,Λ⁻¹K⟩/F
    w: list[list[Any]] = [[], [], []]
    weighted = [[inverse[i] * g[i][0]] for i in range(3)]  # Λ⁻¹γ
    for n in range(terms):
        F.append((n == 0) - D * sum(_cauchy(weighted[i], g[i], n) for i in range(3)))
        known = sum(map(mul, F[1:], lift[::-1]))
        lift.append((sum(_cauchy(weighted[i], K[i], n) for i in range(3)) - known) / F[0])
        for i in range(3):
            w[i].append(inverse[i] * (K[i][n] + D * _cauchy(lift, g[i], n)))
        for v in (K, g, a, b):
            rates = [_cauchy(v[i - 2], w[i - 1], n) - _cauchy(v[i - 1], w[i - 2], n) for i in range(3)]
            for component, rate in zip(v, rates, strict=True):
                component.append(rate / (n + 1))
        for i in range(3):
            weighted[i].append(inverse[i] * g[i][n + 1])
        for x, axis in zip(spot, (a, b), strict=True):
            moved = sum(_along(axis[i], g[i], n) for i in range(3))
            x.append(-radius * moved / (n + 1))
    return [*K, *g, *a, *b, *spot]


def _cauchy(a: list[Any], b: list[Any], n: int) -> Any:
    """The coefficient n of the product of two power series."""
    return sum(map(mul, a[: n + 1], b[n::-1]))


def _along(a: list[Any], b: list[Any], n: int) -> Any:
    """The coefficient n of a·b'."""
    return sum((n - k + 1) * x * b[n - k + 1] for k, x in enumerate(a[: n + 1]))


def _length(series: list[list[Any]], sizes: list[Any], digits: int, terms: int) -> Fraction:
    """A step, a short fraction, whose last terms are 10^-digits of the state at most; some may vanish by a symmetry."""
    tails = [
        (digits * np.log(10) + float((one[k].abs_upper() / size).log())) / k
        for one, size in zip(series, sizes, strict=False)
        for k in range(terms - LAST, terms + 1)
        if one[k].abs_upper() > 0
    ]
    if not tails:
        return Fraction(2**62)
    mantissa, exponent = np.frexp(np.exp(-max(tails)))
    return Fraction(int(mantissa * 2**8)) * Fraction(2) ** (int(exponent) - 8)


def _value(series: list[Any], h: Any) -> Any:
    total = flint.arb(0)
    for x in reversed(series):
        total = total * h + x
    return total


def _axes(q: Sequence[Any]) -> list[Any]:
    """The first two rows of the rotation matrix of a unit quaternion."""
    s, x, y, z = q
    first = [s * s + x * x - y * y - z * z, 2 * (x * y - s * z), 2 * (x * z + s * y)]
    return [*first, 2 * (x * y + s * z), s * s - x * x + y * y - z * z, 2 * (y * z - s * x)]
