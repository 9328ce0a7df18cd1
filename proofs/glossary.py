r"""What the symbols of the paper's formulas stand for, by sections: a checker reads the formulas with them.

A section's table gives each symbol its value in the letters of the statements and its meaning, with the place in the
paper.  A claim takes its section's table, and what it defines itself.
"""

from typing import Any

import sympy as sp

from chapsym.derive import continuous, three, vertical
from chapsym.derive.limits import omega

Symbols = dict[str, tuple[Any, str]]

#: n = 3 (Sections 2 and 5): the ball and its state.
BALL: Symbols = {
    r"\Lambda": (three.lam(), "diag(J2 + J3 + D, J1 + J3 + D, J1 + J2 + D), J the mass tensor (2.2, 5.2)"),
    "D": (three.D, "mρ² (2.2)"),
    r"\gamma": (three.gamma, "the vertical unit vector in the body (2.1)"),
    r"\omega": (omega, "the angular velocity in the body (2.1)"),
    r"\mathbf q": (three.q, "the vector part of the Euler parameters (5.1)"),
    "q_0": (three.q0, "their scalar part (5.1)"),
}

#: Vertical momentum (Section 5): γ and γ~ in q and σ.
VERTICAL: Symbols = {
    r"\Lambda": BALL[r"\Lambda"],
    "D": BALL["D"],
    r"\mathbf q": BALL[r"\mathbf q"],
    "q_0": BALL["q_0"],
    r"\sigma": (vertical.sigma, "h + 2D⟨γ, q₀q⟩ (5.6 as corrected)"),
    r"\gamma": (sp.Matrix(vertical.gamma_now()), "(2/σ)(q₀Λq + q×Λq), the vertical in the body (5.6)"),
    r"\tilde\gamma": (sp.Matrix(vertical.gamma_next()), "(2/σ)(q₀Λq - q×Λq), the next vertical (5.6)"),
    "h": (vertical.height(), "of 𝒦 = hγ, here σ - 2D⟨γ, q₀q⟩ (5.4)"),
}

#: The integral F of the classical ball (2.2).
FACTOR = (continuous.rolling_factor(), "⟨Jγ, Λ⁻¹γ⟩, J the tensor of inertia (2.2)")
