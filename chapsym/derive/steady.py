"""Steady rotation: the step if the axis of the rolling ball is constant, w = B(γ)⁻¹k with w × Iw = 0.

These are all states of a ball with three equal moments, and rotations about a principal axis.
"""

from functools import cache

import sympy as sp

from . import continuous, three
from .gibbs import k
from .three import J1, J2, J3, D, K, gamma

moment = sp.Symbol("moment")
#: Symbols for intermediate results: ⟨k,γ⟩D/(I|γ|²), and Λ = I + D.
SHARE, WHOLE = sp.symbols("share whole")


@cache
def spin() -> sp.ImmutableMatrix:
    """w = B(γ/|γ|)⁻¹k for I₁ = I₂ = I₃ = `moment`: ω(K, γ) of the continuous ball at K = k."""
    equal = dict.fromkeys((J1, J2, J3), moment / 2)
    values = {**equal, **dict(zip(K, k, strict=True))}
    vector = sp.Matrix(continuous.angular_velocity()).xreplace(values)
    return sp.ImmutableMatrix(vector.applyfunc(sp.cancel))


def spin_steps() -> tuple[three.Steps, sp.Matrix]:
    """`spin` in steps, as (k + Dγ⟨k,γ⟩/(I|γ|²))/Λ: cancellation is possible only in ⟨k,γ⟩ and in the sum with k."""
    steps = [
        (sp.Matrix([SHARE]), sp.Matrix([D * k.dot(gamma) / (moment * gamma.dot(gamma))])),
        (sp.Matrix([WHOLE]), sp.Matrix([moment + D])),
    ]
    return steps, (k + SHARE * gamma) / WHOLE
