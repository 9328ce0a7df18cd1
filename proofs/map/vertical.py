"""The basis of chapsym's reduced map: the closed rotation, its scalar equations, and the exact top."""

import sympy as sp

from chapsym.derive import continuous, elliptic, gibbs, three, vertical
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, D, gamma, q, q0
from chapsym.derive.vertical import CLOSED, INERTIA, LAMBDA, e, h, level, t, v
from chapsym.prove import Equation, Proof, claim, main

#: Λ - D = (J2 + J3, ...) solved for J, so that Λ is free.
BALL = dict(zip((J1, J2, J3), ((sum(INERTIA) - 2 * x - D) / 2 for x in INERTIA), strict=True))
RING = Quotient((h, D, *CLOSED.symbols), CLOSED.relations)


def rotation() -> tuple[sp.Expr, sp.Matrix]:
    """(q₀, q) of the closed rotation as functions of t, e, γ, Λ."""
    scalar, *vector = vertical.closed_rotation()
    return scalar, sp.Matrix(vector)


def momentum_of_it() -> sp.Matrix:
    """𝒦(q, γ) of the closed rotation, homogeneous of degree 2 in (q₀, q)."""
    scalar, vector = rotation()
    values = {**BALL, q0: scalar, **dict(zip(q, vector, strict=True))}
    return sp.Matrix(three.momentum()).xreplace(values)


def closed_momentum(text: str, sign: int = 1) -> Equation:
    """The equation 𝒦 = (2t(q₀² + |q|²) - 2Dq₀⟨γ,q⟩)γ + 2(q₀e - t⟨γ,q⟩)q."""
    scalar, vector = rotation()
    along = gamma.dot(vector)
    right = (2 * t * (scalar**2 + vector.dot(vector)) - 2 * D * scalar * along) * gamma
    return Equation(text, momentum_of_it(), right + sign * 2 * (scalar * e - t * along) * vector, RING)


@claim(
    "vertical-rotation",
    r"(q_0, q) \propto (\det M, t\,\mathrm{adj}(M)\gamma),\ M = \Lambda - e - t\,\gamma\times:\ "
    r"\vec{\mathcal K} = h\gamma \iff q_0e = t\langle\gamma,q\rangle,\ "
    r"(2t - h)(q_0^2+|q|^2) = 2Dq_0\langle\gamma,q\rangle",
    uses=["5.2", "5.4", "5.6-sigma"],
)
def closed_rotation(p: Proof) -> None:
    """The rotation of a step with vertical momentum in closed form, up to two scalars t = σ/2 and e."""
    p.assume("|γ| = 1; q₀ ≠ 0 and σ ≠ 0 for the step that is given")
    scalar, vector = rotation()
    p.say("Every step has this form.  (5.4) reads u×Λu + Λu = τγ with u = q/q₀, τ = t/q₀², and (1 + u×)⁻¹ gives")
    p.say("(1 + |u|²)Λu = τ(γ - u×γ + ⟨u,γ⟩u), that is Mu = tγ with e = t⟨γ,u⟩:")
    free = Quotient((*q, *gamma), [])
    solved = gamma - q.cross(gamma) + q.dot(gamma) * q
    p.lemma(
        Equation("(1 + u×)(γ - u×γ + ⟨u,γ⟩u) = (1 + |u|²)γ", list(solved + q.cross(solved)),
                 list((1 + q.dot(q)) * gamma), free)
    )  # fmt: skip
    matrix = sp.Matrix(vertical.closed_matrix())
    p.printed(Equation("M q = tγ q₀", matrix * vector, t * scalar * gamma, CLOSED))
    p.lemma(Equation("(det M, t adj(M)γ), shorter for |γ| = 1", vertical.closed_rotation(),
                     [matrix.det(), *(t * matrix.adjugate() * gamma)], CLOSED))  # fmt: skip
    p.say("And for every t, e, with nothing solved yet:")
    p.printed(closed_momentum("𝒦 = (2t(q₀²+|q|²) - 2Dq₀⟨γ,q⟩)γ + 2(q₀e - t⟨γ,q⟩)q"))
    p.say("Where q is not along γ both scalars must vanish for 𝒦 = h(q₀²+|q|²)γ; where they do, it holds.")
    p.control(closed_momentum("the same with -2(q₀e - t⟨γ,q⟩)q", -1))
    wrong = (LAMBDA - e * sp.eye(3) + t * gamma.hat()) * vector
    p.control(Equation("M q = tγ q₀ with M = Λ - e + t γ×", wrong, t * scalar * gamma, CLOSED))


@claim(
    "vertical-level",
    r"q_0e = t\langle\gamma,q\rangle \iff v\det(\Lambda - e) + e\,\mathrm{tr}\Lambda - 2e^2 = "
    r"\det(\Lambda)\,l + t^2,\ e = vt^2",
    uses=["vertical-rotation", "prop-3"],
)
def level_equation(p: Proof) -> None:
    """The first scalar equation depends on γ through the integral l only: for D = 0 its root serves a whole orbit."""
    p.assume("|γ| = 1, t ≠ 0")
    scalar, vector = rotation()
    ring = Quotient((t, v, *gamma, *INERTIA), [three.UNIT_VERTICAL])
    balance = (e * scalar - t * gamma.dot(vector)).subs(e, v * t**2)

    def factored(text: str, shift: sp.Expr) -> Equation:
        residual = vertical.level_residual().subs(level, vertical.weighted_square()) + shift
        return Equation(text, balance, t**2 * residual, ring)

    p.printed(factored("q₀e - t⟨γ,q⟩ = t²(v det(Λ-e) + e tr Λ - 2e² - det(Λ)l - t²)", sp.S.Zero))
    at_v, free = v * t**2, Quotient((t, v, level, *INERTIA), [])
    p.lemma(Equation("that factor, with a letter for det(Λ)l", [vertical.level_residual()],
                     [v * (LAMBDA - at_v * sp.eye(3)).det() + at_v * LAMBDA.trace() - 2 * at_v**2 - level - t**2], free))  # fmt: skip
    p.say("So with D = 0, where t = h/2, the pair (t, e) is constant on an orbit and the map is rational in γ.")
    p.say(
        "With any t at all the root e makes ⟨γ,Λ⁻¹γ⟩ an integral: (q, 2t) is a step of a ball with D = 0 and the same Λ."
    )
    p.control(factored("the same with + t²", 2 * t**2))
    p.control(factored("the same with 3e²", -(v**2) * t**4))


@claim(
    "vertical-top",
    r"K = H\gamma \Rightarrow \omega = \frac H{1-Dl}\Lambda^{-1}\gamma,\ \dot\gamma = \gamma\times\omega,\ "
    r"l = \langle\gamma,\Lambda^{-1}\gamma\rangle = \mathrm{const}",
    uses=["2.5-inverse", "2.7"],
)
def rolling_as_a_top(p: Proof) -> None:
    """With vertical momentum the rolling ball turns as the free top with the inertia Λ and the momentum Hγ/(1 - Dl)."""
    p.assume("|γ| = 1, 1 - Dl ≠ 0, which holds for every ball: 1 - Dl = ⟨γ, (Λ-D)Λ⁻¹γ⟩ > 0")
    scale = sp.Symbol("H")
    ring = Quotient((scale, *three.RING.symbols), three.RING.relations)
    lam = three.lam()
    form = gamma.dot(lam.inv() * gamma)
    values = dict(zip(three.K, scale * gamma, strict=True))
    omega = sp.Matrix(continuous.angular_velocity()).xreplace(values)

    def spin(text: str, contact: sp.Expr) -> Equation:
        return Equation(text, omega * (1 - contact * form), scale * lam.inv() * gamma, ring)

    p.printed(spin("(1 - Dl)ω = HΛ⁻¹γ", D))
    motion = gamma.cross(lam.inv() * gamma)
    p.printed(Equation("d/dt ⟨γ,Λ⁻¹γ⟩ = 0 along γ' ∝ γ×Λ⁻¹γ", gamma.dot(lam.inv() * motion), 0, ring))
    p.say("The top with the mass tensor J + D/2 and D = 0 has the same Λ: its motion is this one, and the discrete")
    p.say("top of (4.14) moves on the same curves by a constant increment (5.15-euler): only its rate is to be set.")
    shifted = lam.xreplace({J1: J1 + D / 2, J2: J2 + D / 2, J3: J3 + D / 2, D: 0})
    p.lemma(Equation("Λ of J + D/2 and D = 0", shifted, lam, ring))
    p.control(spin("(1 - 2Dl)ω = HΛ⁻¹γ", 2 * D))
    p.control(Equation("⟨γ,Λγ⟩ is constant, too", gamma.dot(lam * motion), 0, ring))


@claim(
    "top-commutes",
    r"D = 0:\quad R' = R[\omega],\ \tilde R = R\Omega(\gamma)\ \Rightarrow\ \tilde R' = \tilde R[\tilde\omega],\quad "
    r"\omega = \Lambda^{-1}\gamma,\ \tilde\omega = \Lambda^{-1}\tilde\gamma",
    uses=["gibbs", "5.6"],
)
def commuting_tops(p: Proof) -> None:
    """A step of the discrete top and the motion of the continuous one commute, the attitude included."""
    p.assume("D = 0, q₀ ≠ 0, and ∂(γ)/∂(u) is regular at the step (no fold); γ stands for 𝒦/|𝒦|")
    p.say(
        "With u = q/q₀ the step with 𝒦 = hγ is (1+|u|²)(h/2)γ = Λu + u×Λu, and γ~ has u×Λu with the other sign (5.6)."
    )
    u, norm = gibbs.u, 1 + gibbs.u.dot(gibbs.u)
    ring = Quotient((*u, *INERTIA), [])
    crossed = u.cross(LAMBDA * u)
    before, after = ((LAMBDA * u + sign * crossed) / norm for sign in (1, -1))
    rates = [LAMBDA.inv() * x for x in (before, after)]
    p.say("In units with h/2 = 1: where γ' = γ×Λ⁻¹γ, the u of the step from γ moves by")
    motion = -(sp.eye(3) + u * u.T) * LAMBDA.inv() * crossed / norm
    p.say("    u' = -(1 + uuᵀ)Λ⁻¹(u×Λu)/(1 + |u|²)")

    def carried(text: str, velocity: sp.Matrix) -> Equation:
        return Equation(text, before.jacobian(u) * velocity, before.cross(rates[0]), ring)

    p.printed(carried("(∂γ/∂u)u' = γ×Λ⁻¹γ", motion))
    p.say("R~ = RΩ follows the continuous top, R~' = R~[ω~], when (1, u)' = ½((1, u)∘ω~ - ω∘(1, u)) up to its length:")

    def followed(text: str, first: sp.Matrix, last: sp.Matrix) -> Equation:
        one = sp.Matrix([1, *u])
        left, right = (sp.Matrix([0, *x]) for x in (first, last))
        scalar, *vector = three.quaternion_product(one, right) - three.quaternion_product(left, one)
        return Equation(text, motion, (sp.Matrix(vector) - scalar * u) / 2, ring)

    p.printed(followed("u' = ½(vector - scalar·u) of (1, u)∘ω~ - ω∘(1, u)", *rates))
    p.say(
        "So one step takes a motion of the continuous top to a motion of it.  On a curve of γ both are translations of u",
        "(5.7); when the increments are equal, R~ and the continuous R one increment later differ by a rotation about",
        "the fixed 𝒦, and it is the same along the motion: both follow the same ω.",
    )
    p.control(carried("the same with u' without uuᵀ", -LAMBDA.inv() * crossed / norm))
    p.control(followed("the same with ω and ω~ exchanged", *rates[::-1]))


y_ = sp.Symbol("y")


def on_curve(y: sp.Expr | int) -> list[sp.Expr]:
    """⟨γ,Λ⁻²γ⟩ - l² and (⟨γ,Λγ⟩l - 1)/det Λ at sn²u = y on the curve of (5.8), as corrected."""
    L1, L2, L3 = elliptic.LAMBDA
    first = L1 * (1 - L3 * elliptic.l) / (L1 - L3) * (1 - y)
    second = L2 * (1 - L3 * elliptic.l) / (L2 - L3) * y
    modulus = (L1 - L2) * (1 - L3 * elliptic.l) / ((L2 - L3) * (L1 * elliptic.l - 1))
    third = L3 * (L1 * elliptic.l - 1) / (L1 - L3) * (1 - modulus * y)
    inverse = first / L1**2 + second / L2**2 + third / L3**2
    direct = first * L1 + second * L2 + third * L3
    return [inverse - elliptic.l**2, (direct * elliptic.l - 1) / (L1 * L2 * L3)]


@claim(
    "top-precession",
    r"\gamma' = b = \gamma\times\Lambda^{-1}\gamma:\quad \langle\gamma\times b, b' + \Lambda^{-1}\gamma\times b\rangle = "
    r"\langle b,\Lambda^{-1}b\rangle = \tfrac{\langle\gamma,\Lambda\gamma\rangle l - 1}{\det\Lambda},\quad "
    r"|b|^2 = \langle\gamma,\Lambda^{-2}\gamma\rangle - l^2",
    uses=["vertical-top"],
)
def precession(p: Proof) -> None:
    """In space Rb turns about the fixed Rγ by ⟨b,Λ⁻¹b⟩/|b|², which is a quotient of linear functions of sn²u."""
    p.assume("|γ| = 1; ω = Λ⁻¹γ, and Rb changes by R(b' + ω×b)")
    p.say("The rate of the angle of Rb about Rγ is ⟨γ×b, b' + ω×b⟩/|b|², as b is across γ.")
    ring = Quotient((*gamma, *INERTIA), [three.UNIT_VERTICAL])
    spin = LAMBDA.inv() * gamma
    b = gamma.cross(spin)
    rate = b.jacobian(gamma) * b + spin.cross(b)
    weighted = b.dot(LAMBDA.inv() * b)

    def turning(text: str, value: sp.Expr) -> Equation:
        return Equation(text, gamma.cross(b).dot(rate), value, ring)

    form = gamma.dot(spin)
    p.printed(
        turning("⟨γ×b, b' + ω×b⟩ = ⟨b,Λ⁻¹b⟩", weighted),
        Equation("det(Λ)⟨b,Λ⁻¹b⟩ = ⟨γ,Λγ⟩l - 1", LAMBDA.det() * weighted, gamma.dot(LAMBDA * gamma) * form - 1, ring),
        Equation("|b|² = ⟨γ,Λ⁻²γ⟩ - l²", b.dot(b), spin.dot(spin) - form**2, ring),
    )
    p.say("On the curve γ² = (C1²(1-y), C2²y, C3²(1-k²y)), y = sn²u (5.7 as corrected), both are linear in y:")
    (square_0, square_1), (weighted_0, weighted_1) = zip(*map(on_curve, (0, 1)), strict=True)
    values = [square_0, square_1 - square_0, weighted_0, weighted_1 - weighted_0]
    free = Quotient((*elliptic.LAMBDA, elliptic.l, y_), [])
    p.lemma(Equation("|b|² and ⟨b,Λ⁻¹b⟩ on the curve: their values at y = 0, and the differences to those at y = 1",
                     elliptic.precession_parts(), values, free))  # fmt: skip
    p.lemma(
        Equation("both are linear in y", on_curve(y_), [values[0] + values[1] * y_, values[2] + values[3] * y_], free)
    )
    p.control(turning("⟨γ×b, b' + ω×b⟩ = ⟨b,Λb⟩", b.dot(LAMBDA * b)))


if __name__ == "__main__":
    main(__file__)
