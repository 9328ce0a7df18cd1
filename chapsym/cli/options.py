"""Options that several commands share, and the ball that they describe."""

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from chapsym.exact import mass_tensor_from, rational, rationals

from .output import fail

if TYPE_CHECKING:
    from chapsym.numbers import Rung

Records = Annotated[
    Path | None,
    typer.Option(
        "--records",
        metavar="FILE",
        help="The JSON Lines file of verdicts; in the user's cache by default.",
    ),
]


Json = Annotated[bool, typer.Option("--json", help="Print one JSON object on standard output.")]


MassTensor = Annotated[str | None, typer.Option("--mass-tensor", metavar="J1,J2,J3", help="J of Sections 4 and 5.")]


Inertia = Annotated[str | None, typer.Option(metavar="I1,I2,I3", help="Principal moments instead, I1 = J2 + J3.")]


Contact = Annotated[str | None, typer.Option("--D", metavar="D", help="D = m rho^2.")]


Mass = Annotated[str | None, typer.Option(metavar="M", help="Mass, with --radius, instead of --D.")]


Radius = Annotated[str | None, typer.Option(metavar="RHO", help="Radius.")]


def ball_from(
    mass_tensor: str | None, inertia: str | None, contact: str | None, mass: str | None, radius: str | None
) -> tuple[tuple[Fraction, ...], Fraction]:
    """J and D from the options, exactly."""
    if (mass_tensor is None) == (inertia is None):
        fail("give either --mass-tensor J1,J2,J3 or --inertia I1,I2,I3", 2)
    if mass_tensor is not None:
        J = rationals(mass_tensor, "--mass-tensor", 3)
    else:
        moments = rationals(str(inertia), "--inertia", 3)
        J = mass_tensor_from(moments)
        if min(J) < 0:
            fail(f"no body has the inertia {inertia}: each principal moment is at most the sum of the other two", 2)
    if contact is not None and (mass is not None or radius is not None):
        fail("give either --D, or --mass and --radius", 2)
    if contact is not None:
        return J, rational(contact, "--D")
    if mass is None or radius is None:
        fail("D is missing: give --D, or --mass and --radius", 2)
    m, rho = rational(mass, "--mass"), rational(radius, "--radius")
    if m <= 0 or rho <= 0:
        fail("--mass and --radius must be positive", 2)
    return J, m * rho * rho


def rung_from(
    digits: int | None, rung: str | None, ball: int | None, known: Sequence[str] = ("single", "double", "quad")
) -> "Rung":
    """The rung of the precision ladder that the options name; `known` are the names that the command takes."""
    if sum(x is not None for x in (digits, rung, ball)) > 1:
        fail("choose one of --digits, --rung and --ball", 2)
    from chapsym.numbers import NAMED, Ball, Digits

    if digits is not None:
        return Digits(digits)
    if ball is not None:
        return Ball(ball)
    if rung is not None and rung not in known:
        listed = " or ".join(filter(None, (", ".join(known[:-1]), known[-1])))
        fail(f"--rung {rung}: give {listed}, or for any number of digits --digits N or --ball BITS", 2)
    return NAMED[rung or "double"]
