r"""The values of the symbols of the paper's formulas, by which the checker reads the printed formulas.

Each table gives the values of symbols, in the letters of the statements, and their meanings, with their place in the
paper.  A claim uses a table and its own definitions.
"""

from typing import Any

import sympy as sp

from chapsym.derive import continuous, three
from chapsym.derive.limits import omega

Symbols = dict[str, tuple[Any, str]]


def ball() -> Symbols:
    """The ball and its state for n = 3 (Sections 2 and 5)."""
    return {
        r"\Lambda": (three.lam(), "diag(J2 + J3 + D, J1 + J3 + D, J1 + J2 + D), J the mass tensor (2.2, 5.2)"),
        "D": (three.D, "mρ² (2.2)"),
        r"\gamma": (three.gamma, "the vertical unit vector in the body (2.1)"),
        r"\omega": (omega, "the angular velocity in the body (2.1)"),
        r"\mathbf q": (three.q, "the vector part of the Euler parameters (5.1)"),
        "q_0": (three.q0, "their scalar part (5.1)"),
    }


def classical() -> Symbols:
    """The tensor of inertia and F of Section 2."""
    return ball() | {
        "J": (three.lam() - three.D * sp.eye(3), "the tensor of inertia, Λ - D, in Section 2 (2.1)"),
        "F": (continuous.rolling_factor(), "⟨Jγ, Λ⁻¹γ⟩ (2.2)"),
    }
