"""The modified equations of the map: the equations whose flow over ε is the step of size ε, up to ε⁴; K = 𝒦/ε.

γ̇ = γ × Ω̃ and K̇ = K × Ω̃ with Ω̃ = ω + ε²ω₃ + O(ε⁴): |γ|, |K|, ⟨K,γ⟩ are conserved, and there is no term in ε as the
map is self-adjoint.  In terms of ω, its rate ω' along the continuous ball, and γ: K = B(γ)ω and B(γ)ω' = Iω × ω.
"""

import sympy as sp

from . import three
from .limits import omega
from .three import J1, J2, J3, D, gamma

#: ω' and ω'' along the continuous ball, and the solution of B(γ) share = `load`.
rate = sp.Matrix(sp.symbols("a1:4"))
second = sp.Matrix(sp.symbols("b1:4"))
share = sp.Matrix(sp.symbols("e1:4"))

INERTIA = sp.diag(J2 + J3, J1 + J3, J1 + J2)


def carried(x: sp.Matrix) -> sp.Matrix:
    """B(γ)x."""
    return sp.Matrix(three.contact_inertia()) * x


def torque() -> sp.Matrix:
    """B(γ)ω' = Iω × ω along the continuous ball."""
    return (INERTIA * omega).cross(omega)


def load() -> sp.Matrix:
    """ω × Iω' + ω' × Iω + 2D(⟨γ,ω'⟩γ̇ + ⟨γ̇,ω'⟩γ) with γ̇ = γ × ω."""
    moving = gamma.cross(omega)
    contact = gamma.dot(rate) * moving + moving.dot(rate) * gamma
    return omega.cross(INERTIA * rate) + rate.cross(INERTIA * omega) + 2 * D * contact


def correction() -> sp.Matrix:
    """12 ω₃ = 2|ω|²ω - ω × ω' - B(γ)⁻¹ load."""
    return 2 * omega.dot(omega) * omega - omega.cross(rate) - share


def gibbs_jet() -> list[sp.Matrix]:
    """The coefficients of ε, ε², ε³ of the Gibbs vector of the step, in which `second` is ω''."""
    third = correction() / 12 + second / 6 + omega.cross(rate) / 12 + omega.dot(omega) * omega / 12
    return [omega / 2, rate / 4, third / 2]


def energy_rate() -> sp.Expr:
    """X₃(H) = (D/4)⟨γ,ω'⟩⟨γ̇,ω'⟩: the energy (2.5) changes by ε³X₃(H) + O(ε⁴) in a step."""
    return D * gamma.dot(rate) * gamma.cross(omega).dot(rate) / 4


def step_jet(x: sp.Matrix) -> list[sp.Matrix]:
    """The coefficients of 1, ε, ε², ε³ of Ωᵀx = x + 2(u × (u × x) - u × x)/(1 + |u|²)."""
    jet = [sp.zeros(3, 1), *gibbs_jet()]
    once = [-u.cross(x) for u in jet]
    for i, u in enumerate(jet):
        for j, v in enumerate(jet[: 4 - i]):
            once[i + j] += u.cross(v.cross(x))
    square = omega.dot(omega) / 4
    return [x, 2 * once[1], 2 * once[2], 2 * (once[3] - square * once[1])]


def ball_jet(x: sp.Matrix) -> list[sp.Matrix]:
    """The coefficients of 1, ε, ε², ε³ of the flow of ẋ = x × ω along the continuous ball over the time ε."""
    first = x.cross(omega)
    twice = first.cross(omega) + x.cross(rate)
    thrice = twice.cross(omega) + 2 * first.cross(rate) + x.cross(second)
    return [x, first, twice / 2, thrice / 6]


def flow_jet(x: sp.Matrix) -> list[sp.Matrix]:
    """The coefficients of 1, ε, ε², ε³ of the flow of ẋ = x × Ω̃ over the time ε."""
    *lower, third = ball_jet(x)
    return [*lower, third + x.cross(correction()) / 12]


def equation_jet() -> list[sp.Matrix]:
    """The coefficients of ε, ε², ε³ of B(γ)u + u × Iu - (1 + |u|²)εK/2, which is 0 for the step, at K = B(γ)ω."""
    u1, u2, u3 = gibbs_jet()
    half = carried(omega) / 2
    return [
        carried(u1) - half,
        carried(u2) + u1.cross(INERTIA * u1),
        carried(u3) + u1.cross(INERTIA * u2) + u2.cross(INERTIA * u1) - u1.dot(u1) * half,
    ]


def along(expr: sp.Matrix | sp.Expr, direction: sp.Matrix) -> sp.Matrix | sp.Expr:
    """The derivative in γ along `direction`."""
    eps = sp.Symbol("epsilon")
    moved = expr.xreplace(dict(zip(gamma, gamma + eps * direction, strict=True)))
    return moved.diff(eps).subs(eps, 0)
