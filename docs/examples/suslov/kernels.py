"""What the top runs on: the equations of a step with their derivatives, and what follows from their solution."""

from chapsym.codegen import Kernel, left, right

from .claims import ENERGY, NEXT, RESIDUAL, TURN
from .top import MASS, I, M, across, energy, residual, slip, turn, u

GIBBS, MOMENTUM, TENSOR = ("gibbs", tuple(u)), ("momentum", tuple(M)), ("mass_tensor", MASS)


def after():
    """The momentum with which the turn ends."""
    square = 1 + u.dot(u)
    return [2 * (i * v + slip(u) * w) / square for i, v, w in zip(I, u, across(u), strict=True)]


KERNELS = [
    Kernel(
        "residual",
        "What vanishes where the turn of a Gibbs vector starts with a momentum.",
        (right("S-gibbs", RESIDUAL),),
        (GIBBS, MOMENTUM, TENSOR),
        ("r1", "r2"),
        lambda: list(residual()),
    ),
    Kernel(
        "residual_jacobian",
        "Its derivatives by the Gibbs vector, row by row.",
        (right("S-gibbs", RESIDUAL).along({u[0]: 1}, {u[1]: 1}),),
        (GIBBS, MOMENTUM, TENSOR),
        ("a11", "a12", "a21", "a22"),
        lambda: list(residual().jacobian(u)),
    ),
    Kernel(
        "after",
        "The momentum with which the turn of a Gibbs vector ends, and the next one starts.",
        (left("S-gibbs", NEXT),),
        (GIBBS, TENSOR),
        ("m1", "m2"),
        after,
    ),
    Kernel(
        "energy",
        "The energy of a momentum, which the map keeps.",
        (left("S-energy", ENERGY),),
        (MOMENTUM, TENSOR),
        ("e",),
        lambda: [energy(M)],
    ),
    Kernel(
        "turn",
        "The matrix of the turn of a Gibbs vector, row by row.",
        (left("S-gibbs", TURN),),
        (GIBBS,),
        ("t11", "t12", "t13", "t21", "t22", "t23", "t31", "t32", "t33"),
        lambda: list(turn(1, *u, 0) / (1 + u.dot(u))),
        rows_of_three=True,
    ),
]
