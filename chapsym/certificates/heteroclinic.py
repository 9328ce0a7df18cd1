"""Certificate `heteroclinic`: two orbits between the unstable rotations whose ends differ, so that Δ is not constant.

On the level ⟨γ,Λ⁻¹γ⟩ = 1/Λ2 the reduced map is that of lemma `separatrix-map`: u ↦ ũ with F(X) = D(tanh ũ - tanh u),
X = coth ½(ũ - u).  Here e^Δ is computed in Arb's numbers without proof; the checker encloses the numbers of the file
again.
"""

import math
from fractions import Fraction

from flint import arb, ctx

from chapsym import checker
from chapsym.checker.document import MOST_DIGITS
from chapsym.checker.heteroclinic import MOST_STEPS
from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.levels.balls import exact
from chapsym.dynamics.levels.start import decade, fraction
from chapsym.numbers.precisions import flint_bits

from .balls import decimal, shortest
from .document import Document, Say, accepted, stated, widest
from .reduced import Top

KIND = "heteroclinic"
#: The least number of digits of the difference in the file, and decimals of the ends of the orbits beyond those.
SIGNIFICANT, SPARE = 3, 3
#: Bits beyond the digits, and Newton iterations of a step.
SPARE_BITS, CORRECTIONS = 96, 60
#: The number of trial radii, from the last decimal on, each a tenth of the one before.
RADII = 12


class Orbits:
    """The map at the precision of flint's context."""

    def __init__(self, top: Top) -> None:
        I1, I2, I3 = (exact(sum(top.J) - x) for x in top.J)
        self.D, self.height, self.middle = exact(top.D), exact(top.height), I2
        self.kappa = ((I1 - I2) * (I2 - I3) / ((I1 + self.D) * (I3 + self.D))).sqrt()
        self.last = ((I2 + (I2**2 - self.height**2).sqrt()) / (self.height * self.kappa)).mid()
        self.growth = (self.last + 1) / (self.last - 1)

    def end(self, x: Fraction, digits: int) -> tuple[arb, int]:
        """e^Δ, and the number of steps of both orbits that give it to the digits."""
        first, steps = self._half(exact(x), digits)
        if x == 1:
            return first * first, steps
        other, more = self._half(exact(1 / x), digits)
        return first * other, max(steps, more)

    def _half(self, x: arb, digits: int) -> tuple[arb, int]:
        product, X, far = arb(1), self.last, arb(10) ** (digits + SPARE)
        for steps in range(MOST_STEPS + 1):
            if x > far:
                return product, steps
            X = self._root(x, X)
            s = (X + 1) / (X - 1)
            product, x = (product * s / self.growth).mid(), (s * s * x).mid()
        raise BadInput(f"more than {MOST_STEPS} steps would be needed for {digits} digits; take a larger height")

    def _root(self, x: arb, X: arb) -> arb:
        for _ in range(CORRECTIONS):
            Q = x * (X + 1) ** 2 + (X - 1) ** 2
            off = self.height * (self.kappa * X**2 + 1 / self.kappa) - 2 * self.middle * X
            off -= self.D * 8 * x * X / ((x + 1) * Q)
            slope = 2 * (self.height * self.kappa * X - self.middle) - self.D * 8 * x * (1 - X**2) / Q**2
            before, X = X, (X - off / slope).mid()
            if abs(X - before) < abs(X) * arb(2) ** (8 - ctx.prec):
                break
        return X


def heteroclinic(
    top: Top, *, starts: tuple[Fraction, Fraction] | None = None, digits: int | None = None,
    radius: Fraction | None = None, progress: Say = lambda what: None,
) -> Document:  # fmt: skip
    """Finds the certificate that Δ is not constant on the level 1/Λ2 of a top with J1 < J2 < J3, h > 0.

    starts: two x = e^2u; by default 1 and about e^c, c the limit of the increments.  digits: decimals of the file; by
    default as needed for the difference.  radius: of J, D and h; by default the largest power of 10.
    Returns the object of the file (`document`).  Raises BadInput if there is no certificate.
    """
    _check(top, starts, digits, radius)
    if starts is None:
        with flint_bits(SPARE_BITS):
            starts = Fraction(1), Fraction(round(1000 * float(Orbits(top).growth)), 1000)
    needed = _digits(top, starts, progress)
    if digits is not None and digits < needed:
        raise BadInput(f"{digits} digits are too few for this difference; take {needed} or more")
    digits = needed if digits is None else digits
    progress(f"two orbits to {digits} digits")
    with flint_bits(_bits(digits)):
        orbits = [_orbit(Orbits(top), x, digits) for x in starts]
    radii = [Fraction(1, 10 ** (digits + n)) for n in range(RADII)] if radius is None else [radius]
    if min(top.J) == 0 and radius is None:
        radii = [Fraction(0)]
    ball = {"J": [str(x) for x in top.J], "D": str(top.D), "height": str(top.height)}

    def found(off: Fraction) -> Document:
        return accepted(stated(KIND, ball=ball, radius=shortest(off), digits=digits, orbits=orbits))

    try:
        return widest(radii, found, progress)
    except checker.Rejected as error:
        raise BadInput(f"the checker does not accept what was found: {error}") from None


def _check(top: Top, starts: tuple[Fraction, Fraction] | None, digits: int | None, radius: Fraction | None) -> None:
    if not top.J[0] < top.J[1] < top.J[2]:
        raise BadInput("the entries of J must grow, J1 < J2 < J3: the axes are named so that I1 > I2 > I3")
    if top.D == 0:
        raise BadInput("for D = 0 there is nothing to find: all increments on this level are c, and Δ is 0")
    moments = [sum(top.J) - x for x in top.J]
    if not 0 < top.height < moments[2]:
        raise BadInput(f"the height must be positive and below the bound of lemma small-branch, less than {moments[2]}")
    if starts is not None and not (min(starts) > 0 and starts[0] != starts[1]):
        raise BadInput("the starts must be two different positive numbers x = e^2u")
    if digits is not None and not 1 <= digits <= MOST_DIGITS:
        raise BadInput(f"the number of digits must be from 1 to {MOST_DIGITS}, not {digits}")
    if radius is not None and not 0 <= radius <= min(top.J):
        raise BadInput("the radius must not be negative, nor more than the least component of J")


def _bits(digits: int) -> int:
    return math.ceil(digits * 10 / 3) + SPARE_BITS


def _digits(top: Top, starts: tuple[Fraction, Fraction], progress: Say) -> int:
    """The number of decimals with which the two ends differ by SIGNIFICANT digits."""
    digits = 20
    while digits <= MOST_DIGITS:
        progress(f"looking for the difference with {digits} digits")
        with flint_bits(_bits(digits)):
            ends = [Orbits(top).end(x, digits)[0] for x in starts]
            off = abs(fraction(ends[0] - ends[1]))
        if off > Fraction(10) ** (SIGNIFICANT - digits):
            return SIGNIFICANT - 1 - decade(off)
        digits *= 2
    raise BadInput(f"{MOST_DIGITS} digits do not distinguish the difference of the two ends from 0; take larger h")


def _orbit(orbits: Orbits, x: Fraction, digits: int) -> Document:
    end, steps = orbits.end(x, digits)
    return {"start": str(x), "steps": steps, "end": decimal(round(fraction(end), digits), digits)}
