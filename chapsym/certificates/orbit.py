"""Certificate `periodic-orbit`: a periodic point of q steps, where det DG^q ≠ 1 and det(1 - DG^q) ≠ 0 on the
level M.

Newton's method finds it, with as many bits as the checker needs for its proof.
"""

import math
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat

from chapsym import checker
from chapsym.checker.document import MOST_DIGITS, MOST_STEPS
from chapsym.checker.orbit import attracts
from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.levels.start import fraction
from chapsym.numbers.precisions import flint_bits

from . import families
from .balls import NotProved, rounded, shortest, simplest
from .document import MADE, Document, Say, accepted, stated, widest
from .families import Member
from .passage import Level, Map, Passage, Vector, identity

KIND = "periodic-orbit"
#: The working bits for families; ⟨𝒦, γ⟩ must vary by more than 2^-RESOLVED along a family.
SEARCH_BITS, RESOLVED = 256, 160
#: Squares of larger numbers, and sums of these, may be beyond float64.
FAR = 2**500
#: The least number of decimals beyond those of det(1 - DG^q); by default one more per step, for the growth of boxes.
SIGNIFICANT, SPARE_DIGITS = 3, 20
#: A bound of the decimals that a box of parameters loses in a step.
GROWTH = 4


def periodic_orbit(
    J: tuple[Fraction, Fraction, Fraction], D: Fraction, size: Fraction, steps: int, height: Fraction | None = None,
    digits: int | None = None, attracting: bool = False, radius: Fraction | None = None,
    progress: Say = lambda what: None,
) -> Document:  # fmt: skip
    """Finds the certificate of an orbit of this many steps, not symmetric, with det DG^q < 1 and without an eigenvalue
    1.

    The orbit contracts volumes; its mirror image has the reciprocal determinant.

    J, D: the ball.  size: |𝒦|².  height: ⟨𝒦, γ⟩; the shortest decimal in the middle of the widest family by default.
    digits: decimals of the numbers in the file; by default as needed.  attracting: whether all eigenvalues must be
    inside the unit circle.  radius: of J, D and the integrals; by default the largest power of 10, and none if a
    component of J is 0.
    Returns the object of the file (`document`).  Raises BadInput if there is no certificate.
    """
    _check(J, D, size, steps, height, digits)
    level, near = _found(Level(J, D, size, Fraction(0)), steps, height, attracting, progress)
    bits = SEARCH_BITS
    while True:
        progress(f"<momentum, gamma> = {shortest(level.height)}: {bits} bits")
        try:
            with flint_bits(bits):
                start = families.solved(level, steps, near, 4 + bits.bit_length())
                passage = Map.of(level).passage(*start, steps)
                found = _document(level, steps, start, passage, _digits(passage, steps, digits), attracting)
            checker.check(found)
            return _with_radius(found, radius, steps, progress)
        except checker.Rejected as error:
            raise BadInput(f"the checker does not accept what was found: {error}; take other digits") from None
        except families.LOST:
            if bits > 8 * (SEARCH_BITS + 4 * (digits or 0)):
                raise BadInput(f"no orbit of {steps} steps is proved there; choose another <momentum, gamma>") from None
            bits = 2 * bits


def _with_radius(found: Document, radius: Fraction | None, steps: int, progress: Say) -> Document:
    """The certificate for all numbers within a radius, which must be 0 if a component of J is 0."""
    if radius == 0 or (radius is None and min(map(Fraction, found["ball"]["J"])) == 0):
        return found
    fields = {name: value for name, value in found.items() if name not in (*MADE, "radius")}
    digits = found["digits"]
    radii = [Fraction(1, 10 ** (digits + n)) for n in range(GROWTH * steps)] if radius is None else [radius]
    try:
        return widest(radii, lambda off: accepted(stated(KIND, **fields, radius=shortest(off))), progress)
    except checker.Rejected:
        raise BadInput(
            f"the checker does not accept the radius {shortest(radii[-1])}; take a smaller one, or 0"
        ) from None


def _check(
    J: tuple[Fraction, ...], D: Fraction, size: Fraction, steps: int, height: Fraction | None, digits: int | None
) -> None:
    if len(set(J)) < 3 or min(J) < 0:
        raise BadInput("the three entries of J must differ and be at least 0: else a measure is preserved")
    if max(*J, D, size) > FAR:
        raise BadInput("the search begins in float64, for which the numbers are too large")
    if D <= 0:
        raise BadInput("D must be positive: for D = 0 the map preserves a volume, and det DG^q = 1")
    if size <= 0:
        raise BadInput("<momentum, momentum> must be positive")
    if height is not None and height**2 >= size:
        raise BadInput("<momentum, gamma> must be less than |momentum|: else the two are parallel")
    if not 2 <= steps <= MOST_STEPS:
        raise BadInput(f"the number of steps must be from 2 to {MOST_STEPS}, not {steps}")
    if digits is not None and not 1 <= digits <= MOST_DIGITS:
        raise BadInput(f"the number of decimals must be from 1 to {MOST_DIGITS}, not {digits}")
    with flint_bits(SEARCH_BITS):
        Map.of(Level((J[0], J[1], J[2]), D, size, Fraction(0)))  # the bound of the lemma


def _found(level: Level, steps: int, height: Fraction | None, attracting: bool, progress: Say) -> tuple[Level, Member]:
    """The level of the widest suitable family, and a member near it."""
    best: tuple[Fraction, Level, Member] | None = None
    with flint_bits(SEARCH_BITS):
        for family in families.families(level, steps, progress):
            low, high = families.extent(family)
            inside = height is None or low < height < high
            if not inside or high - low < max(Fraction(1, 2**RESOLVED), best[0] if best else Fraction(0)):
                continue
            at = replace(level, height=simplest(low, high) if height is None else height)
            with suppress(*families.LOST):
                member = families.near(at, steps, family)
                W = Map.of(level).passage(member.momentum, member.gamma, steps).derivative()
                if W.det() > 1:
                    member, W = member.mirrored(), W.inv()
                if not attracting or attracts(*multipliers(W)):
                    best = high - low, at, member
    if best is None:
        where = "" if height is None else f" with <momentum, gamma> = {shortest(height)}"
        kind = "attract" if attracting else "are not symmetric"
        raise BadInput(f"no orbits of {steps} steps{where} that {kind} were found")
    return best[1], best[2]


def multipliers(W: arb_mat) -> tuple[Any, Any, Any]:
    """det W, det(1 - W) and tr W."""
    return W.det(), (identity() - W).det(), W[0, 0] + W[1, 1] + W[2, 2]


def determinants(passage: Passage) -> tuple[arb, arb]:
    """det DG^q and det(1 - DG^q) on M; raises NotProved unless they are proved not to be 1 and 0."""
    det, unit, _ = multipliers(passage.derivative())
    if det.contains(1) or unit.contains(0):
        raise NotProved("det DG^q may be 1, or an eigenvalue may be")
    return det, unit


def _digits(passage: Passage, steps: int, wanted: int | None) -> int:
    """The number of decimals that show det DG^q - 1 and det(1 - DG^q); raises BadInput if fewer are wanted."""
    det, unit = determinants(passage)
    least = math.ceil(-math.log10(min(abs(fraction(det.mid()) - 1), abs(fraction(unit.mid())))))
    if wanted is not None and wanted < least + SIGNIFICANT:
        raise BadInput(f"{wanted} digits are too few to show the determinants; take {least + SIGNIFICANT} or more")
    return wanted or SPARE_DIGITS + steps + least


def _document(
    level: Level, steps: int, start: tuple[Vector, Vector], passage: Passage, digits: int, attracting: bool
) -> Document:
    """The object of the file, for the checker to prove."""
    det, unit, trace = multipliers(passage.derivative())
    more = {"trace": rounded(trace, digits)} if attracting else {}
    numbers = [[rounded(x, digits) for x in v] for v in (*start, *passage.gibbs)]
    return stated(
        KIND, ball={"J": [str(x) for x in level.J], "D": str(level.D)},
        integrals={"momentum.momentum": str(level.size), "momentum.gamma": shortest(level.height)},
        steps=steps, digits=digits, start={"momentum": numbers[0], "gamma": numbers[1]},
        orbit=[{"u": u} for u in numbers[2:]],
        determinant=rounded(det, digits), unit_eigenvalue=rounded(unit, digits), **more,
    )  # fmt: skip
