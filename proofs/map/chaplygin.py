"""Chaplygin's solution of the continuous ball in theta functions: lemmas of chapsym."""

import sympy as sp

from chapsym.derive import chaplygin
from chapsym.derive.chaplygin import LAMBDA, LIGHTER, c, d, direction, mu, nu, p, product, q, quadratic
from chapsym.derive.elliptic import L1, L2, L3
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import UNIT_VERTICAL
from chapsym.prove import Equation, Proof, claim, equations, main

#: γ = s₁p + s₂q and K = k₁p + k₂q; H₂ = ⟨K,ω⟩.
s1, s2, k1, k2, D, H2 = sp.symbols("s1 s2 k1 k2 D H2")
PLANE = Quotient((*p, *q, s1, s2, k1, k2, D, H2), [D * H2 * s1 * s2 + k1 * k2])
FREE = Quotient((*p, *q, L1, L2, L3, d), [])
ON = Quotient((*p, L1, L2, L3, d, mu, nu), [UNIT_VERTICAL])
#: q = xV₁ + yV₂, in terms of the squares X = x²|V₁|², Y = y²|V₂|², and the roots.
m1, m2, lead, P1, X, Y = sp.symbols("mu1 mu2 g2 P1 X Y")
ROOTS = Quotient((m1, m2, c, d, lead, P1, X, Y), [X + Y - 1, c * (m1 * X + m2 * Y) - 1])
INVERSE = LAMBDA.inv()

plane, free, on, roots = (equations(ring) for ring in (PLANE, FREE, ON, ROOTS))


def spin() -> sp.Matrix:
    """(1 - da)ω̃ = Λ⁻¹((1 - da)q + dbp)."""
    a, b = chaplygin.inverse_products()
    return INVERSE * ((1 - d * a) * q + d * b * p)


@claim(
    "chaplygin-reduction",
    r"\Lambda\omega = d\,p\langle p,\omega\rangle + c\,q\langle q,\omega\rangle,\quad "
    r"D\gamma\gamma^T + \tfrac{KK^T}{\langle K,\omega\rangle} = d\,pp^T + c\,qq^T,\quad 0 \le d \le D \le c",
    uses=("2.3",),
)
def reduction(proof: Proof) -> None:
    """Every motion of the ball is, in another time, one of the ball with d for D whose momentum q is normal to the vertical p."""
    proof.assume("K = Λω - Dγ⟨γ,ω⟩, Λ = I + D, |γ| = 1; p and q are orthonormal in a plane with γ and K; K ≠ 0")
    proof.say(
        "H₂ = ⟨K,ω⟩ > 0 is constant (2.3), so K = KKᵀω/H₂, and Λω = (Dγγᵀ + KKᵀ/H₂)ω. The form is constant in space, as",
        "γ, K and H₂ are. Let p and q be its eigenvectors in that plane, which are fixed in space, too: then",
    )
    form = D * H2 * (s1 * p + s2 * q) * (s1 * p + s2 * q).T + (k1 * p + k2 * q) * (k1 * p + k2 * q).T
    diagonal = (D * H2 * s1**2 + k1**2) * p * p.T + (D * H2 * s2**2 + k2**2) * q * q.T
    proof.printed(plane("H₂(Dγγᵀ + KKᵀ/H₂) = H₂(dppᵀ + cqqᵀ)", form, diagonal))
    proof.say(
        "Of the unit vectors in the plane one is normal to K, where the form is at most D, and γ, where it is at least D:",
        "so d ≤ D ≤ c. Both are at least 0, as the form is.",
        "Y = ⟨q,ω⟩ is not 0: else Λω = dp⟨p,ω⟩, where Λ - dppᵀ has positive moments, and ω = 0. So ω = cYω̃ with",
    )
    a, _ = chaplygin.inverse_products()
    proof.printed(free("(1 - da)(Λ - dppᵀ)ω̃ = (1 - da)q", momentum_of(spin()), (1 - d * a) * q))
    proof.say(
        "The vertical p and the momentum q of the ball with d are fixed in space as the body turns with ω, so that, in the",
        "time t̃ with dt̃ = cYdt, p' = p × ω̃ and q' = q × ω̃: its motion, with ⟨p,q⟩ = 0. As ⟨q,ω⟩ = cY⟨q,ω̃⟩,",
        "⟨q,ω̃⟩ = 1/c; and H₂ = k₁⟨p,ω⟩ + k₂⟨q,ω⟩ = Y(k₁cb/(1 - da) + k₂), a = ⟨p,Λ⁻¹p⟩, b = ⟨p,Λ⁻¹q⟩, by",
    )
    proof.lemma(free("⟨p,(1 - da)ω̃⟩ = b", p.dot(spin()), chaplygin.inverse_products()[1]))
    proof.control(plane("the form with γ in the place of K, too", form, diagonal + k1**2 * q * q.T))
    proof.control(free("ω̃ = Λ⁻¹q", momentum_of((1 - d * a) * INVERSE * q), (1 - d * a) * q))


def momentum_of(x: sp.Matrix) -> sp.Matrix:
    """(Λ - dppᵀ)x, multiplied out."""
    return chaplygin.momentum(x).applyfunc(sp.cancel)


def squared_rate() -> sp.Expr:
    """(dμ₁/dt̃)² = 4y²μ₂²|V₁|²|V₂|²/(g₂(μ₁ - μ₂))², with |V₁|² = (1 - dμ₁)g₂(μ₁ - μ₂)P(μ₁)."""
    return 4 * Y * m2**2 * (1 - d * m1) * P1 / (lead * (m1 - m2))


@claim(
    "chaplygin-separation",
    r"\frac{d\mu_1}{w_1}+\frac{d\mu_2}{w_2} = -dT,\ \frac{\mu_1d\mu_1}{w_1}+\frac{\mu_2d\mu_2}{w_2} = 0,\quad "
    r"w_i^2 = (\mu_i-\tfrac1c)(1-d\mu_i)\prod_j(1-\mu_i\Lambda_j),\quad "
    r"\sum_i\frac{p_i^2(\Lambda_i-d)}{1-\mu\Lambda_i} = 0 \text{ at } \mu_1, \mu_2",
    uses=("chaplygin-reduction",),
)
def separation(proof: Proof) -> None:
    """The roots μ₁ and μ₂ move on a curve of genus two, at constant rates of its two integrals in a time T."""
    proof.assume(
        "the ball of chaplygin-reduction: (Λ - dppᵀ)ω̃ = q, p' = p × ω̃, |p| = |q| = 1, ⟨p,q⟩ = 0, ⟨q,ω̃⟩ = 1/c; "
        "Λ₁, Λ₂, Λ₃ differ, d > 0, p₁p₂p₃ ≠ 0"
    )
    proof.say(
        "V(μ) = P(μ)(1 - μΛ)⁻¹(Λ - d)p, P = Π(1 - μΛⱼ), N(μ) = ⟨p,V(μ)⟩ = g₂(μ - μ₁)(μ - μ₂). With B = Λ - dppᵀ and",
        "F = N/P, V/P = v:",
    )
    V, W, N, M, P, Q = direction(), direction(nu), quadratic(), quadratic(nu), product(), product(nu)
    proof.lemma(
        on("(1 - μB)V = P·Bp + dμNp", V - mu * chaplygin.momentum(V), P * chaplygin.momentum(p) + d * mu * N * p),
        on("(μ - ν)⟨V(μ),V(ν)⟩ = (1 - dμ)N(μ)P(ν) - (1 - dν)N(ν)P(μ)",
           (mu - nu) * V.dot(W), (1 - d * mu) * N * Q - (1 - d * nu) * M * P),
        on("|V|² = (1 - dμ)(N'P - NP') - dNP",
           V.dot(V), (1 - d * mu) * (sp.diff(N, mu) * P - N * sp.diff(P, mu)) - d * N * P),
    )  # fmt: skip
    proof.say(
        "So at the roots B⁻¹Vᵢ = μᵢVᵢ + P(μᵢ)p, V₁, V₂ and p are orthogonal to each other, and |Vᵢ|² = (1 - dμᵢ)P(μᵢ)N'(μᵢ)",
        "with N'(μ₁) = g₂(μ₁ - μ₂), N'(μ₂) = -g₂(μ₁ - μ₂). The residues of F are positive: a root lies between each two of",
        "the 1/Λⱼ. Let q = xV₁ + yV₂: |q| = 1 and ⟨q,ω̃⟩ = 1/c are x²|V₁|² + y²|V₂|² = 1 and its sum with μ₁ and μ₂ = 1/c:",
        "so 1/c is between the two roots.",
        "p × ω̃ = xμ₁ p × V₁ + yμ₂ p × V₂, and N changes along p' by 2⟨V,p'⟩:",
    )
    moved = sp.Matrix(sp.symbols("r1:4"))
    change = sum((sp.diff(N, x) * y for x, y in zip(p, moved, strict=True)), sp.S.Zero)
    ring = Quotient((*p, *moved, L1, L2, L3, d, mu), [])
    proof.lemma(Equation("N' along p' is 2⟨V,p'⟩", change, 2 * V.dot(moved), ring))
    proof.say("so dμ₁/dt̃ = 2yμ₂δ/N'(μ₁), δ = det(p,V₁,V₂), δ² = |V₁|²|V₂|², and dμ₂/dt̃ = -2xμ₁δ/N'(μ₂). Squared:")
    phi = (m1 - 1 / c) * (1 - d * m1) * P1
    proof.printed(roots(
        "(dμ₁/dt̃)² = 4μ₂²φ(μ₁)/(g₂(μ₁ - μ₂)²), times c g₂(μ₁ - μ₂)²",
        sp.cancel(c * lead * (m1 - m2) ** 2 * squared_rate()), sp.expand(4 * c * m2**2 * phi),
    ))  # fmt: skip
    proof.say("and with the indices changed for μ₂. In the time T of dt̃ = ½√g₂ dT, where")
    a, _ = chaplygin.inverse_products()
    proof.lemma(
        on("g₂ = Λ₁Λ₂Λ₃(1 - da)", chaplygin.leading(), sp.expand(sp.cancel(L1 * L2 * L3 * (p.dot(p) - d * a)))),
        on("d²N(1/d) = (Λ₁ - d)(Λ₂ - d)(Λ₃ - d)",
           sp.expand(sp.cancel(d**2 * quadratic(1 / d))), LIGHTER.det() * p.dot(p)),
    )  # fmt: skip
    proof.say(
        "let w₁ = (dμ₁/dT)(μ₁ - μ₂)/μ₂ and w₂ = -(dμ₂/dT)(μ₁ - μ₂)/μ₁: their squares are φ(μ₁) and φ(μ₂), dμ₁/w₁ + dμ₂/w₂",
        "= (μ₂ - μ₁)/(μ₁ - μ₂) dT, and with the factors μ₁ and μ₂ the sum is 0. All of it extends to p₁p₂p₃ = 0 by continuity.",
    )
    proof.control(on("|V|² = (N'P - NP') - dNP", V.dot(V), sp.diff(N, mu) * P - N * sp.diff(P, mu) - d * N * P))
    proof.control(on("(1 - μB)V = P·Bp", V - mu * chaplygin.momentum(V), P * chaplygin.momentum(p)))
    proof.control(roots("the rate with μ₁ in the place of μ₂",
                        sp.cancel(c * lead * (m1 - m2) ** 2 * squared_rate()), sp.expand(4 * c * m1**2 * phi)))  # fmt: skip


@claim(
    "chaplygin-theta",
    r"p_i = C_i\frac{\theta_i}{\theta_d},\ q_i = C_i'\frac{\theta_{cdi}}{\theta_d},\ \sqrt{1-da} = C\frac{\theta}{\theta_d},\ "
    r"\frac b{\sqrt{1-da}} = C'\frac{\theta_{cd}}{\theta_d}\ \text{ at } x_0 + UT",
    uses=("chaplygin-separation",),
)
def theta(proof: Proof) -> None:
    """All but the time and the contact point is a quotient of theta functions of genus two, linear in T."""
    proof.assume(
        "as in chaplygin-separation; θ is the translate of Riemann's function that is 0 at the sums x(P₁) + x(P₂) of "
        "points of which one is at infinity, θ_S is it after half the periods of the branch points in S"
    )
    proof.say(
        "x₀ + UT is the sum of the integrals x of the two normal differentials to (μ₁,w₁) and (μ₂,w₂): linear in T by",
        "chaplygin-separation.",
        "Each of the functions, f, is written by the roots e_k - μ, S₁² = (1/c - μ₂)P(μ₁)/(1 - dμ₁) and S₂, the same with the",
        "indices changed. With q = xV₁ + yV₂, x²(μ₁ - μ₂)²g₂P(μ₁)² = S₁², y likewise (chaplygin-separation):",
    )
    V, N, P = direction(), quadratic(), product()
    a, _ = chaplygin.inverse_products()
    first = sp.expand(sp.cancel(L1**2 * quadratic(1 / L1)))
    weight = LIGHTER[0, 0] * (L1 - L2) * (L1 - L3)
    volume = L1 * L2 * L3
    left = sp.expand(sp.cancel(volume * p.dot(INVERSE * V)))
    right = sp.expand(sp.cancel(volume * (P * (p.dot(p) - d * a) + mu * N)))
    proof.printed(
        on("Λ₁²N(1/Λ₁) = p₁²(Λ₁ - d)(Λ₁ - Λ₂)(Λ₁ - Λ₃)", first, weight * p[0] ** 2),
        on("⟨p,Λ⁻¹V⟩ = P(1 - da) + μN", left, right),
    )
    proof.say(
        "So p_i² is, up to constants, (1/Λᵢ - μ₁)(1/Λᵢ - μ₂)/((1 - dμ₁)(1 - dμ₂)), as g₂ is 1/((1 - dμ₁)(1 - dμ₂)) by",
        "d²N(1/d); 1 - da is g₂; b²/(1 - da) is (1 - da)(xP(μ₁) + yP(μ₂))², that is (S₁ + S₂)²/(μ₁ - μ₂)²; and q_i is",
        "√((1/Λᵢ - μ₁)(1/Λᵢ - μ₂))(S₁/(1 - μ₁Λᵢ) + S₂/(1 - μ₂Λᵢ))/(μ₁ - μ₂).",
        "Poles. Where P₁ goes to e₅ = 1/d, f has a pole of order 1 in its local parameter √(1 - dμ₁). Nowhere else has it one:",
        "at infinity S₁ grows as μ₁ and S₂ as √μ₁, and all quotients stay finite; at 1/Λᵢ S₁ is as small as √(1 - μ₁Λᵢ); on",
        "the diagonal S₁² = S₂², and S₁ + S₂ = 0 at P₁ = P₂, as x and y are -w₂ and w₁ times one factor (δ/√g₂ as dμ₁/dt̃ and",
        "dμ₂/dt̃ say); the pairs of conjugate points are one point of the Jacobian.",
        "Signs. f² is a function on the Jacobian, so f changes its sign, at most, along a period. √((e_k - μ₁)(e_k - μ₂)) does",
        "so as θ_k/θ does, since (e_k - μ₁)(e_k - μ₂) has the zeros of θ_k² and the poles of θ². In f there are these roots: of",
        "1/Λᵢ and d in p_i, d in √(1 - da), c in b/√(1 - da) (S₁ = √((1/c - μ₁)(1/c - μ₂))·w₁/((1 - dμ₁)(1/c - μ₁)) up to a",
        "constant), 1/Λᵢ and c in q_i. θ_S/θ_d changes as the roots in S and d together do: so S is i, empty, cd, cdi.",
        "f θ_d/θ_S then has the periods of the Jacobian and at most the poles of 1/θ_S, of order 1. Such functions are",
        "constant (the divisor of θ is a principal polarization, whose sections are one up to factors).",
    )
    proof.control(on("⟨p,Λ⁻¹V⟩ = P(1 - da)", left, sp.expand(right - volume * mu * N)))
    proof.control(on("N(1/Λ₁) with Λ₁ in the place of Λ₁ - d", first, L1 * (L1 - L2) * (L1 - L3) * p[0] ** 2))


#: A = Λ⁻¹ on the axes f, m and s; z is q_m².
Af, Am, As, l, z = sp.symbols("A_f A_m A_s l z")
TOP = Quotient((Af, Am, As, l, z), [])


def others() -> tuple[sp.Expr, sp.Expr]:
    """(A_f - A_s) times q_f² and q_s², from q_m² = z, |q| = 1 and ⟨q,Aq⟩ = l."""
    return l - As - (Am - As) * z, Af - l - (Af - Am) * z


@claim(
    "euler-top",
    r"D = 0 \text{ or } K \parallel \gamma:\ \omega = \varkappa\Lambda^{-1}q,\ q = \tfrac K{|K|},\ \varkappa = \tfrac{|K|}{1-Dl};\quad "
    r"\dot q_m^2 = \varkappa^2(A_f-l-(A_f-A_m)q_m^2)(l-A_s-(A_m-A_s)q_m^2)",
    uses=("2.3",),
)
def top(proof: Proof) -> None:
    """Where D = 0 or K is vertical the ball turns as Euler's top does, and its angle about K is a quadrature."""
    proof.assume("Λ = I + D, A = Λ⁻¹; the axes m, s, f of the body in any order; K ≠ 0")
    ring = Quotient((*p, L1, L2, L3, D), [UNIT_VERTICAL])
    spun = INVERSE * p
    turned = LAMBDA * spun - D * p * p.dot(spun)
    scaled = sp.cancel(L1 * L2 * L3 * (p.dot(p) - D * p.dot(spun)))
    left = (L1 * L2 * L3 * turned).applyfunc(sp.cancel)
    proof.printed(Equation("B(γ)Λ⁻¹γ = (1 - Dl)γ at |γ| = 1", left, scaled * p, ring))
    rate = (p.cross(spun)).dot(2 * spun)
    proof.lemma(
        Equation("l = ⟨q,Aq⟩ is constant along q × Aq", sp.expand(sp.cancel((L1 * L2 * L3) ** 2 * rate)), 0, ring)
    )
    proof.say("For K = |K|q, q = ±γ, that is ω = κAq; for D = 0 it is K = Iω. So q' = κq × Aq, κ constant, and with")
    f_square, s_square = others()
    top_equal = equations(TOP)
    proof.lemma(
        top_equal("q_m² + q_s² + q_f² = 1", (Af - As) * z + f_square + s_square, Af - As),
        top_equal("⟨q,Aq⟩ = l", (Af - As) * Am * z + Af * f_square + As * s_square, (Af - As) * l),
    )
    proof.say(
        "q_m' = ±κ(A_f - A_s)q_f q_s has the square κ² times the product of the two: so q_m is a multiple of sn u, q_s of",
        "cn u and q_f of dn u, with k² = (A_f - l)(A_m - A_s)/((l - A_s)(A_f - A_m)) and u'² = κ²(l - A_s)(A_f - A_m): as z =",
        "sn² (A_f - l)/(A_f - A_m) gives",
    )
    S = sp.symbols("S")
    jacobi = Quotient((Af, Am, As, l, S), [])
    zed = S * (Af - l) / (Af - Am)
    proof.printed(
        Equation("(A_f - A_m)·q_f² ~ (l - A_s)(A_f - A_m)(1 - k²S)",
                 sp.cancel((Af - Am) * f_square.subs(z, zed)), (l - As) * (Af - Am) - (Af - l) * (Am - As) * S, jacobi),
        Equation("q_s² ~ (A_f - l)(1 - S)", sp.cancel(s_square.subs(z, zed)), (Af - l) * (1 - S), jacobi),
    )  # fmt: skip
    proof.say(
        "In space the axis e_f moves by ω × e_f, so that it turns about K by χ' = ⟨q, e_f × (ω × e_f)⟩/|e_f × q|² =",
        "(⟨q,ω⟩ - q_fω_f)/(1 - q_f²) = κ(A_m q_m² + A_s q_s²)/(1 - q_f²); its part normal to K is not 0, as q_m and q_s are",
        "not 0 together. With q and χ the attitude is known, and with ω in space the contact point.",
    )
    proof.control(Equation("B(γ)Λ⁻¹γ = γ", left, L1 * L2 * L3 * p, ring))
    proof.control(
        top_equal(
            "⟨q,Aq⟩ = l with q_f and q_s exchanged", (Af - As) * Am * z + Af * s_square + As * f_square, (Af - As) * l
        )
    )


if __name__ == "__main__":
    main(__file__)
