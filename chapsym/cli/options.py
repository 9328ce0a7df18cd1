"""Options that several commands share, and the ball that they describe."""

import inspect
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from chapsym.rationals import mass_tensor_from, rational, rationals

from .output import fail

if TYPE_CHECKING:
    from chapsym.numbers import Precision

Command = TypeVar("Command", bound=Callable[..., Any])


def takes(metavar: str, help: str, *names: str, **more: Any) -> Any:
    """An option with a value: what stands for that in the help, and its line there."""
    return typer.Option(*names, metavar=metavar, help=help, **more)


def writes(metavar: str, help: str) -> Any:
    """The option of where the output goes."""
    return takes(metavar, help, "-o", "--output", readable=False)


def argument(metavar: str, help: str) -> Any:
    """An argument, the same way."""
    return typer.Argument(metavar=metavar, help=help)


#: Packages of research, in a checkout.
STUDIES = ("rotation", "energy", "chaos")

#: The precisions that a command takes by name.
NAMES = ("single", "double", "double-double")
#: By how much, relatively, a symmetric tensor may differ from its transpose, as in scenes.
ASYMMETRY = Fraction(1, 10**12)

Records = Annotated[
    Path | None, takes("FILE", "The JSON Lines file of verdicts; in the user's cache by default.", "--records")
]
OWN = "Claims of your own: a folder of Python scripts, one script, or a package. It is code, and it is run."
Own = Annotated[str | None, takes("FOLDER", OWN, "--register")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object on standard output.")]
#: The options of a ball, by parameter.
BALL = {
    "mass_tensor": Annotated[str | None, takes("J1,J2,J3", "J: second moments of mass (pseudo-inertia).")],
    "inertia": Annotated[
        str | None, takes("I1,I2,I3", "Or principal moments, I1 = J2 + J3; or a tensor: I11,I12,I13;I21,...;I33.")
    ],
    "contact": Annotated[str | None, takes("D", "D = m rho^2.", "--D")],
    "mass": Annotated[str | None, takes("M", "Mass, with --radius, instead of --D.")],
    "radius": Annotated[str | None, takes("RHO", "Radius.")],
}


def with_options(options: Mapping[str, object]) -> Callable[[Command], Command]:
    """Gives a command that takes `**given` these options, None by default, before its own."""

    def made(command: Command) -> Command:
        only = inspect.Parameter.KEYWORD_ONLY
        own = inspect.signature(command).parameters.values()
        first = [inspect.Parameter(name, only, default=None, annotation=kind) for name, kind in options.items()]
        others = [one.replace(kind=only) for one in own if one.kind is not one.VAR_KEYWORD]
        command.__signature__ = inspect.Signature([*first, *others])  # type: ignore[attr-defined]
        return command

    return made


def ball_from(given: Mapping[str, str | None]) -> tuple[tuple[Fraction, ...], Fraction]:
    """J and D from the options, exactly; ends the command where these are in other axes than the principal ones."""
    mass_tensor, inertia = given.get("mass_tensor"), given.get("inertia")
    if (mass_tensor is None) == (inertia is None):
        fail("give either --mass-tensor J1,J2,J3 or --inertia I1,I2,I3", 2)
    if mass_tensor is not None:
        J = rationals(mass_tensor, "--mass-tensor", 3)
    else:
        if tensor_from(given) is not None:
            clause = "give its principal moments, --inertia I1,I2,I3, and all vectors in their axes"
            fail(f"--inertia is a tensor that is not diagonal, and this command takes principal axes only: {clause}", 2)
        moments = _inertia(str(inertia))
        J = mass_tensor_from(moments if len(moments) == 3 else moments[::4])
        if min(J) < 0:
            fail(f"no body has the inertia {inertia}: each principal moment is at most the sum of the other two", 2)
    return J, contact_from(given)


def tensor_from(given: Mapping[str, str | None]) -> list[list[Fraction]] | None:
    """The rows of an inertia tensor that is not diagonal; None for all else, which `ball_from` takes."""
    inertia = given.get("inertia")
    I = () if inertia is None or given.get("mass_tensor") is not None else _inertia(inertia)
    if len(I) < 9 or not any(x for i, x in enumerate(I) if i % 4):
        return None
    for i, j in ((0, 1), (0, 2), (1, 2)):
        if abs(I[3 * i + j] - I[3 * j + i]) > ASYMMETRY * max(map(abs, I)):
            clause = f"I{i + 1}{j + 1} = {float(I[3 * i + j]):g} and I{j + 1}{i + 1} = {float(I[3 * j + i]):g}"
            fail(f"--inertia must be a symmetric tensor, not one with {clause}", 2)
    return [list(I[k : k + 3]) for k in (0, 3, 6)]


def _inertia(text: str) -> tuple[Fraction, ...]:
    """Three principal moments, or the nine components of a tensor, row by row."""
    flat = text.replace(";", ",")
    count = flat.count(",") + 1
    if count not in (3, 9):
        fail(f"--inertia takes 3 principal moments, or the 9 components of a tensor; {text!r} has {count} numbers", 2)
    return rationals(flat, "--inertia", count)


def contact_from(given: Mapping[str, str | None]) -> Fraction:
    """D from the options, exactly."""
    contact, mass, radius = (given.get(name) for name in ("contact", "mass", "radius"))
    if contact is not None and (mass is not None or radius is not None):
        fail("give either --D, or --mass and --radius", 2)
    if contact is not None:
        return rational(contact, "--D")
    if mass is None or radius is None:
        fail("D is missing: give --D, or --mass and --radius", 2)
    m, rho = rational(mass, "--mass"), rational(radius, "--radius")
    if m <= 0 or rho <= 0:
        fail("--mass and --radius must be positive", 2)
    return m * rho * rho


def precision_from(
    digits: int | None, precision: str | None, ball: int | None, known: Sequence[str] = NAMES
) -> "Precision":
    """The precision that the options name; `known` are the names that the command takes."""
    if sum(x is not None for x in (digits, precision, ball)) > 1:
        fail("choose one of --digits, --precision and --ball", 2)
    from chapsym.numbers import NAMED, Digits, Enclosure, own_name

    if digits is not None:
        return Digits(digits)
    if ball is not None:
        return Enclosure(ball)
    precision = own_name(precision)
    if precision is not None and precision not in known:
        listed = " or ".join(filter(None, (", ".join(known[:-1]), known[-1])))
        fail(f"--precision {precision}: give {listed}, or for any number of digits --digits N or --ball BITS", 2)
    return NAMED[precision or "double"]
