"""What the map is, and what it keeps.

A turn starts with the momentum with which the turn before it ended: this is the map.
"""

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import Proof, claim, equations, tends

from .top import (
    J13,
    J23,
    MASS,
    UNIT,
    I,
    J,
    M,
    across,
    energy,
    equal,
    free,
    inward,
    outward,
    p,
    q,
    residual,
    slip,
    turn,
    u,
    variation,
)

a, b = q[0], q[1:, :]
UNITS = ("the Euler parameters are unit", sp.Eq(UNIT, 0))
MOMENTS = ("the moments of inertia are not 0", *(sp.Ne(i, 0) for i in I))
BALANCE = "the derivatives of the action are the momentum that leaves less the one that arrives"
OUTWARD = "the momentum with which a turn starts"
INWARD = "the momentum with which it ends"
RESIDUAL = "the equations of the Gibbs vector"
NEXT = "the momentum with which the turn of a Gibbs vector ends"
ENERGY = "the energy"
TURN = "the matrix of a turn, in its Gibbs vector"


@claim("S-principle", r"M^{out}(\Omega_{k}) = M^{in}(\Omega_{k-1})")
def principle(proof: Proof) -> None:
    """A turn starts with the momentum with which the turn before it ended."""
    ring = equations(Quotient((*p, *q, *MASS)))
    left = outward(q[0], q[1:, :]) - inward(p[0], p[1:, :])
    proof.printed(ring(BALANCE, variation(p, q), left))
    proof.control(ring("the same with the sum", variation(p, q), left + 2 * inward(p[0], p[1:, :])))


@claim("S-outward", r"M^{out} = 2 q_0 I q - 2 (J_{13} q_1 + J_{23} q_2)(q_2, -q_1)")
def outward_momentum(proof: Proof) -> None:
    """The momentum with which a turn starts."""
    proof.assume(*UNITS)
    inertial = 2 * a * sp.diag(*I) * b
    proof.printed(equal(OUTWARD, inertial - 2 * slip(b) * across(b), outward(a, b)))
    proof.control(equal("with the other sign", inertial + 2 * slip(b) * across(b), outward(a, b)))


@claim("S-inward", r"M^{in} = 2 q_0 I q + 2 (J_{13} q_1 + J_{23} q_2)(q_2, -q_1)")
def inward_momentum(proof: Proof) -> None:
    """The momentum with which a turn ends."""
    proof.assume(*UNITS)
    inertial = 2 * a * sp.diag(*I) * b
    proof.printed(equal(INWARD, inertial + 2 * slip(b) * across(b), inward(a, b)))
    proof.control(equal("with the other sign", inertial - 2 * slip(b) * across(b), inward(a, b)))


@claim("S-energy", r"E = M_1^2/I_1 + M_2^2/I_2 \text{ is kept}")
def energy_kept(proof: Proof) -> None:
    """The map keeps the energy of the momentum, for every step."""
    proof.assume(*UNITS)
    proof.assume(*MOMENTS)
    proof.printed(equal("the energy of both momenta", energy(outward(a, b)), energy(inward(a, b))))
    weighted = (I[1] * M[0] ** 2 + I[0] * M[1] ** 2) / (I[0] * I[1])
    proof.lemma(free(ENERGY, energy(M), weighted))
    length = [v.dot(v) for v in (outward(a, b), inward(a, b))]
    proof.control(equal("the length of both momenta", *length))


@claim("S-steady", r"J_{13} q_1 + J_{23} q_2 = 0 \Rightarrow M^{in} = M^{out}")
def steady(proof: Proof) -> None:
    """The top turns steadily about the axes that meet no product of mass."""
    proof.assume(*UNITS)
    proof.assume("the axis meets no product of mass", sp.Eq(slip(b), 0))
    ring = equations(Quotient((*q, *MASS), [UNIT, slip(b)]))
    proof.printed(ring("both momenta", inward(a, b), outward(a, b)))
    proof.control(equal("both momenta, about any axis", inward(a, b), outward(a, b)))


@claim("S-reverse", r"M^{in}(\Omega^T) = -M^{out}(\Omega)")
def reverse(proof: Proof) -> None:
    """The map is its own inverse, up to the sign of the momentum."""
    proof.assume(*UNITS)
    proof.printed(equal("the turn back", inward(a, -b), -outward(a, b)))
    proof.control(equal("without the sign", inward(a, -b), outward(a, b)))


@claim("S-gibbs", r"(1 + |u|^2) M = 2 I u - 2 (J_{13} u_1 + J_{23} u_2)(u_2, -u_1)")
def gibbs(proof: Proof) -> None:
    """A step solves two equations of degree two for the Gibbs vector of its turn, and ends with a rational function."""
    bent = 2 * slip(u) * across(u)
    proof.printed(free(RESIDUAL, residual(), (1 + u.dot(u)) * M - 2 * sp.diag(*I) * u + bent))
    proof.control(free("with the other sign", residual(), (1 + u.dot(u)) * M - 2 * sp.diag(*I) * u - bent))
    square = 1 + u.dot(u)
    proof.lemma(
        free(NEXT, inward(1, u) / square, (2 * sp.diag(*I) * u + bent) / square),
        free(TURN, turn(1, *u, 0) / square, sp.eye(3) + 2 * (hat(u) + hat(u) ** 2) / square),
    )


def hat(v):
    """The matrix of the vector product with (v1, v2, 0)."""
    return sp.Matrix([[0, 0, v[1]], [0, 0, -v[0]], [-v[1], v[0], 0]])


@claim("S-limit", r"\lim_{h \to 0} (M^{in} - M^{out})/h^2 = (\omega \times J \omega)_{1,2}")
def limit(proof: Proof) -> None:
    """Of turns by h ω the map is an approximation of Suslov's equations, (I ω)' = ω × J ω along e1 and e2."""
    h, w = sp.Symbol("h"), sp.Matrix(sp.symbols("w1:3"))
    ring = Quotient((h, *w, *MASS))
    small = h * w / 2
    change = (inward(1, small) - outward(1, small)) / (1 + small.dot(small))
    spin = sp.Matrix([*w, 0])
    torque = spin.cross(J * spin)[:2]
    proof.printed(tends("the change of the momentum over the square of h", change, h, 2, torque, ring))
    proof.control(tends("the same the other way round", change, h, 2, [-y for y in torque], ring))


@claim(
    "S-volume",
    r"\det \partial M^{in}/\partial M^{out} = (I_1 I_2 - tW)/(I_1 I_2 + tW), W = I_2 J_{13}^2 + I_1 J_{23}^2",
)
def volume(proof: Proof) -> None:
    """About a steady rotation u = t (J23, -J13) the map draws momenta together, or apart: it keeps no area."""
    size = sp.Symbol("t")
    there = {u[0]: size * J23, u[1]: -size * J13}
    ends = [(end(1, u) / (1 + u.dot(u))).jacobian(u).det().subs(there) for end in (inward, outward)]
    weight, both = size * (I[1] * J13**2 + I[0] * J23**2), I[0] * I[1]
    ring = equations(Quotient((size, *MASS)))
    proof.printed(ring("the quotient of the determinants", ends[0] / ends[1], (both - weight) / (both + weight)))
    proof.control(ring("that they are equal", ends[0], ends[1]))
