"""What is generated for other numbers than scalars: rounds of a step, as straight-line programs that call kernels.

They do in double-double what `double_double_loop` needs.
"""

from dataclasses import dataclass

import sympy as sp

from .kernels import BODY, CONTACT, FIRST, GAMMA, GIBBS, HALF, INERTIA, MOMENT, MOMENTUM, QUATERNION, Group


@dataclass(frozen=True)
class Program:
    """Straight-line Python of kernel calls and + - * /: named inputs in groups, and the names that are its outputs."""

    name: str
    summary: str
    groups: tuple[Group, ...]
    outputs: tuple[str, ...]
    text: str
    #: Of the inputs, those that stay float64 where the others are pairs.
    floats: tuple[str, ...] = ()
    #: On pairs: whether every sum is normalised: the halves of one that cancels overlap, which costs a product digits.
    normal: bool = False

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of the arguments."""
        return tuple(symbol.name for _, symbols in self.groups for symbol in symbols)


PAIR_PROGRAMS: tuple[Program, ...] = (
    Program(
        "gibbs_residual_pairs",
        "G(u) = B(γ)u + u × Iu - (1 + |u|²)k at a float64 u; what is small of it has the error of its terms.",
        (GIBBS, HALF, GAMMA, INERTIA, CONTACT),
        ("r1", "r2", "r3"),
        """
r1, r2, r3 = gibbs_residual(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)
""",
        ("u1", "u2", "u3", "D"),
    ),
    Program(
        "residual_pairs",
        "𝒦(q, γ) - 𝒦 (5.2) at Euler parameters of length 1.",
        (QUATERNION, MOMENTUM, *BODY),
        ("r1", "r2", "r3"),
        """
r1, r2, r3 = residual(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D)
""",
        ("J1", "J2", "J3", "D"),
        normal=True,
    ),
    Program(
        "moved_pairs",
        "q ∘ (1, w), divided by its length where w is small.",
        (QUATERNION, ("correction", sp.symbols("w1:4"))),
        ("b0", "b1", "b2", "b3"),
        """
c0, c1, c2, c3 = compose(q0, q1, q2, q3, 1, w1, w2, w3)
t = (3 - ((c0 * c0 + c1 * c1) + (c2 * c2 + c3 * c3))) / 2
b0, b1, b2, b3 = c0 * t, c1 * t, c2 * t, c3 * t
""",
        ("w1", "w2", "w3"),
    ),
    Program(
        "turn_pairs",
        "Ωᵀk and Ωᵀγ for the rotation with the Gibbs vector u.",
        (GIBBS, HALF, GAMMA),
        ("l1", "l2", "l3", "h1", "h2", "h3"),
        """
x1, x2, x3 = turn(1, u1, u2, u3, k1, k2, k3)
y1, y2, y3 = turn(1, u1, u2, u3, g1, g2, g3)
l1, l2, l3 = k1 + x1, k2 + x2, k3 + x3
h1, h2, h3 = g1 + y1, g2 + y2, g3 + y3
""",
    ),
    Program(
        "rotate_pairs",
        "Ak and Aγ for the attitude A.",
        (FIRST, HALF, GAMMA),
        ("l1", "l2", "l3", "h1", "h2", "h3"),
        """
l1, l2, l3 = rotate(a0, a1, a2, a3, k1, k2, k3)
h1, h2, h3 = rotate(a0, a1, a2, a3, g1, g2, g3)
""",
    ),
    Program(
        "roll_pairs",
        "The attitude, divided by its length, and the contact point after the rotation q₀(1, u), q₀ = 1/√(1 + |u|²).",
        (
            ("scalar", sp.symbols("q0,")),
            GIBBS,
            GAMMA,
            FIRST,
            ("contact", sp.symbols("z1 z2")),
            ("radius", sp.symbols("rho,")),
        ),
        ("b0", "b1", "b2", "b3", "n1", "n2"),
        """
q1, q2, q3 = q0 * u1, q0 * u2, q0 * u3
s1, s2, s3 = centre_step(q0, q1, q2, q3, g1, g2, g3)
x1, x2, x3 = rotate(a0, a1, a2, a3, s1, s2, s3)
n1, n2 = z1 + rho * x1, z2 + rho * x2
c0, c1, c2, c3 = compose(a0, a1, a2, a3, q0, q1, q2, q3)
t = (3 - ((c0 * c0 + c1 * c1) + (c2 * c2 + c3 * c3))) / 2
b0, b1, b2, b3 = c0 * t, c1 * t, c2 * t, c3 * t
""",
        ("rho",),
    ),
    Program(
        "steady_pairs",
        "w = B(γ/|γ|)⁻¹k for three equal moments, and |w|².",
        (HALF, GAMMA, MOMENT, CONTACT),
        ("w1", "w2", "w3", "square"),
        """
w1, w2, w3 = isotropic_spin(k1, k2, k3, g1, g2, g3, moment, D)
square = w1 * w1 + w2 * w2 + w3 * w3
""",
        ("k1", "k2", "k3", "g1", "g2", "g3", "D"),
    ),
)
