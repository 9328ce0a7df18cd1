"""Section 5: the rotation in Euler parameters, the vector momentum, and the vector form of the map."""

import sympy as sp

from chapsym.derive import ball, continuous, limits, quaternions, three
from chapsym.derive.limits import omega
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, RING, D, K, axial, gamma, placed, q, q0, q1, q2, q3
from chapsym.proofs import glossary, second_routes
from chapsym.proofs.paper.s4_limits import exact_order
from chapsym.prove import Comparison, Equation, Fact, Proof, claim, equations, main, rational_point

equation = equations(RING)

#: Unit Euler parameters in general position.
UNIT = dict(zip((q0, *q), map(sp.Rational, ("4/5", "2/5", "1/5", "2/5")), strict=True))


def printed_rotation() -> sp.Matrix:
    """(5.1) as printed."""
    return sp.Matrix(
        [
            [q0**2 + q1**2 - q2**2 - q3**2, 2 * (q1 * q2 - q3 * q0), 2 * (q1 * q3 + q2 * q0)],
            [2 * (q1 * q2 + q3 * q0), q0**2 + q2**2 - q1**2 - q3**2, 2 * (q2 * q3 - q0 * q1)],
            [2 * (q1 * q3 - q2 * q0), -2 * (q2 * q3 - q0 * q1), q0**2 + q3**2 - q1**2 - q2**2],
        ]
    )


@claim(
    "5.1",
    r"\Omega = \begin{pmatrix}"
    r"q_0^2+q_1^2-q_2^2-q_3^2 & 2(q_1q_2-q_3q_0) & 2(q_1q_3+q_2q_0)\\"
    r"2(q_1q_2+q_3q_0) & q_0^2+q_2^2-q_1^2-q_3^2 & 2(q_2q_3-q_0q_1)\\"
    r"2(q_1q_3-q_2q_0) & -2(q_2q_3-q_0q_1) & q_0^2+q_3^2-q_1^2-q_2^2\end{pmatrix}",
)
def rotation_matrix(p: Proof) -> None:
    """The rotation matrix, entry by entry: the entry (3,2) is misprinted."""
    p.slips("typo")
    p.say("x ↦ q x q̄ with Hamilton's product, read off on the basis:")
    rotation = sp.Matrix(three.rotation())
    for row in range(3):
        p.show(f"row {row + 1}", rotation[row, :])
    p.lemma(equation("ΩᵀΩ = 1", rotation.T * rotation, sp.eye(3)))
    p.lemma(equation("det Ω = 1", rotation.det(), 1))
    p.lemma(equation("Ωq = q: the axis", rotation * q, q))
    p.lemma(equation("tr Ω = 4q₀² - 1 = 1 + 2cos θ with q₀ = cos(θ/2)", rotation.trace(), 4 * q0**2 - 1))
    p.lemma(equation("Ω - Ωᵀ = 4q₀ q×: right-handed about q", rotation - rotation.T, 4 * q0 * q.hat()))
    x, a, b = (sp.Matrix(sp.symbols(names)) for names in ("v1:4", "a0:4", "b0:4"))
    turning, pairs = Quotient((*x, *RING.symbols), RING.relations), Quotient((*a, *b), [])
    p.lemma(Equation("Ωx = x + (Ω - (q₀² + |q|²))x", three.rotated(x), rotation * x, turning))
    product = three.quaternion_product(a, b)
    conjugate, y = sp.Matrix([b[0], *(-b[1:, :])]), sp.Matrix(sp.symbols("p0:4"))
    p.lemma(Equation("⟨ab, p⟩ = ⟨a, p b̄⟩", [product.dot(y)], [a.dot(three.quaternion_product(y, conjugate))],
                     Quotient((*a, *b, *y), [])))  # fmt: skip
    once, twice, both = (three.rotation().xreplace(placed(((q0, *q), z))) for z in (a, b, product))
    p.lemma(Equation("Ω(ab) = Ω(a)Ω(b)", both, once * twice, pairs))
    printed = printed_rotation()
    turned = three.quaternion_product(
        three.quaternion_product(sp.Matrix([q0, *q]), sp.Matrix([0, *x])), sp.Matrix([q0, *(-q)])
    )

    def turns(text: str, matrix: sp.Matrix) -> Equation:
        return Equation(text, [sp.S.Zero, *(matrix * x)], list(turned), Quotient((*x, *RING.symbols)))

    entry = quaternions.on_vectors(quaternions.turned()[0])[1][3]
    p.reads(
        {f"q_{i}": (part, "an Euler parameter (5.1)") for i, part in enumerate((q0, *q))},
        (r"\Omega", rotation, "x ↦ q x q̄, read off on the basis"),
        (r"\Omega_{32}", entry, "the third component of q e₂ q̄, by the derivation"),
    )
    p.printed(equation("(5.1), nine entries", printed, rotation))
    corrected = printed.copy()
    corrected[2, 1] = 2 * (q2 * q3 + q0 * q1)
    p.corrected(
        r"\Omega_{32} = 2(q_2q_3 + q_0q_1)",
        Equation("(q e₂ q̄)₃ = 2(q₂q₃ + q₀q₁)", entry, corrected[2, 1], quaternions.RING),
    )
    p.lemma(turns("(5.1) with the entry (3,2) mended: Ωx = q x q̄ for every x", corrected))
    p.counterexample(
        rational_point(UNIT | dict(zip(x, (1, 2, 3), strict=True)), [equation("|q|² + q₀² = 1", q0**2 + q.dot(q), 1)])
    )
    p.control(equation("the printed matrix is orthogonal", printed.T * printed, sp.eye(3)))
    p.control(equation("the mended matrix is that of -q", corrected.T, rotation))
    mutated = corrected.copy()
    mutated[0, 1] = 2 * (q1 * q2 + q3 * q0)
    p.control(equation("the mended matrix with one more sign flipped", mutated, rotation))


@claim(
    "5.1-angle",
    r"\Omega \text{ is the rotation about } \mathbf q \text{ by } \theta,\ q_0=\cos\tfrac\theta2,\ "
    r"|\mathbf q|=\sin\tfrac\theta2,\ q_0>0",
    uses=["5.1"],
)
def axis_and_angle(p: Proof) -> None:
    """Axis and angle are right; q₀ > 0 leaves out the rotations by π."""
    p.infers("Rodrigues' formula is taken for the rotation by θ about n.")
    p.slips("reading")
    p.assume("Ω with the correction of (5.1); the axis is undefined at q = 0, where Ω = 1")
    p.say("Rodrigues: Ωx = cosθ x + sinθ n×x + (1-cosθ)⟨n,x⟩n.  With q₀ = cos(θ/2), q = sin(θ/2) n these are")
    p.say("cosθ = q₀² - |q|², sinθ n = 2q₀q, (1-cosθ) nnᵀ = 2qqᵀ:")
    rotation = sp.Matrix(three.rotation())

    def rodrigues(sign: int) -> sp.Matrix:
        return (q0**2 - q.dot(q)) * sp.eye(3) + sign * 2 * q0 * q.hat() + 2 * q * q.T

    p.printed(equation("Ω = (q₀²-|q|²) + 2q₀ q× + 2qqᵀ, nine entries", rotation, rodrigues(1)))
    p.say("As (q₀, q) and (-q₀, -q) give the same Ω, q₀ ≥ 0 can be had; but tr Ω = 4q₀² - 1 is -1 only for q₀ = 0.")
    half_turn, diagonal = sp.diag(1, -1, -1), sp.symbols("Omega11 Omega22 Omega33")
    square = (1 + sum(diagonal)) / 4
    at = dict(zip(diagonal, half_turn.diagonal(), strict=True))
    text = "Ω = diag(1,-1,-1) has Euler parameters with q₀ > 0: q₀² = (1 + tr Ω)/4 > 0"
    p.printed(Comparison(text, [square > 0], at))
    axis = {q0: sp.S.Zero, q1: sp.S.One, q2: sp.S.Zero, q3: sp.S.Zero}
    minus = {x: -x for x in (q0, *q)}
    p.under(
        "Ω is no rotation by π; with those, q₀ ≥ 0 and (0, q) ~ (0, -q)",
        Comparison(
            "q₀ = 0, q = e₁ gives diag(1,-1,-1)", [sp.Eq(a, b) for a, b in zip(rotation, half_turn, strict=True)], axis
        ),
        equation("(-q₀, -q) gives the same Ω", rotation.xreplace(minus), rotation),
        equation("4q₀² = 1 + tr Ω", 4 * q0**2, 1 + rotation.trace()),
    )
    p.control(equation("the same by the angle -θ", rotation, rodrigues(-1)))


def half_momentum(h1: sp.Expr, h2: sp.Expr, h3: sp.Expr, sign: int = 1) -> sp.Matrix:
    """½M⃗ of (5.2) as printed, for the mass tensor diag(h1, h2, h3); `sign` is that of the second terms."""
    return sp.Matrix(
        [
            (h2 + h3) * q0 * q1 + sign * (h2 - h3) * q2 * q3,
            (h1 + h3) * q0 * q2 + sign * (h3 - h1) * q1 * q3,
            (h1 + h2) * q0 * q3 + sign * (h1 - h2) * q1 * q2,
        ]
    )


def printed_momentum(sign: int = 1, factor: int = 2) -> sp.Matrix:
    """𝒦⃗ of (5.2) as printed; the arguments mutate its last term."""
    return 2 * half_momentum(J1, J2, J3) + factor * D * q0 * (q - sign * gamma.dot(q) * gamma)


def second_derivatives() -> list[sp.Expr]:
    """The second derivatives of 𝒦⃗(q(1, w)) in w, for 11, 22, 33, 23, 13, 12; 𝒦⃗ is a quadratic form of (q₀, q)."""

    def at(w: sp.Matrix) -> sp.Matrix:
        turned = three.quaternion_product(sp.Matrix([q0, *q]), sp.Matrix([0, *w]))
        return sp.Matrix(three.momentum()).xreplace(placed(((q0, *q), turned)))

    e = sp.eye(3).columnspace()
    rows = [2 * at(x) for x in e]
    rows += [at(e[i] + e[j]) - at(e[i]) - at(e[j]) for i, j in ((1, 2), (0, 2), (0, 1))]
    return [x for row in rows for x in row]


@claim(
    "5.2",
    r"\vec M = 2((J_2+J_3)q_0q_1+(J_2-J_3)q_2q_3,\ (J_1+J_3)q_0q_2+(J_3-J_1)q_1q_3,\ "
    r"(J_1+J_2)q_0q_3+(J_1-J_2)q_1q_2)^T,\quad "
    r"\vec{\mathcal K} = \vec M + 2Dq_0(\mathbf q - \langle\gamma,\mathbf q\rangle\gamma)",
    uses=["prop-1", "5.1"],
)
def vector_momentum(p: Proof) -> None:
    """The vector momentum, by substituting the rotation into (4.13)."""
    centre, derived = three.turned_entries("M", ball.centre_momentum()), three.turned_entries("K", ball.momentum())
    p.reads(
        glossary.ball(),
        {f"J_{i}": (J, f"entry {i} of the mass tensor (5.2)") for i, J in enumerate((J1, J2, J3), 1)},
        {f"q_{i}": (x, f"entry {i} of q (5.1)") for i, x in enumerate(q, 1)},
        (r"\vec M", sp.Matrix(centre), "the vector of M_k (4.6), by the derivation"),
        (r"\vec{\mathcal K}", sp.Matrix(derived), "that of 𝒦_k (4.13), by the derivation"),
    )
    p.assume("|γ| = 1 and |q|² + q₀² = 1; Ω with the correction of (5.1)")
    p.say(
        "Into (4.13) go the matrix of the Euler parameters, J = diag(J₁,J₂,J₃) and Γ = γγᵀ; (A₃₂, A₁₃, A₂₁) comes out:"
    )
    p.show("𝒦", sp.Matrix(three.momentum()))
    p.printed(
        equation("M⃗ as printed", 2 * half_momentum(J1, J2, J3), centre),
        equation("𝒦⃗ as printed", printed_momentum(), derived),
    )
    p.lemma(equation("the collected form, which the kernels use", three.momentum(), derived))
    p.say("In vectors: 𝒦⃗ = 2q₀Λq + 2 q×Λq - 2Dq₀⟨γ,q⟩γ with Λ = diag(J₂+J₃+D, ...).")
    lam = three.lam()
    second = 2 * (q0 * lam * q + q.cross(lam * q) - D * q0 * gamma.dot(q) * gamma)
    p.lemma(equation("𝒦⃗ = 2(q₀Λq + q×Λq - Dq₀⟨γ,q⟩γ)", second, three.momentum()))
    p.say("It is a quadratic form of (q₀, q); so for a turn from q to q(1, w), of any length:")
    p.lemma(Equation("the second derivatives of 𝒦⃗(q(1, w)) in w, by 𝒦⃗ at q(0, w)", three.tangent_hessian(),
                     second_derivatives(), Quotient(RING.symbols, [])))  # fmt: skip
    for text, mutated in [
        ("𝒦⃗ with + ⟨γ,q⟩γ", printed_momentum(sign=-1)),
        ("𝒦⃗ with D in the place of 2D", printed_momentum(factor=1)),
        ("𝒦⃗ at -q₀", printed_momentum().subs(q0, -q0)),
    ]:
        p.control(equation(text, mutated, three.momentum()))
    free = Quotient(RING.symbols, [three.UNIT_QUATERNION])
    p.control(Equation("𝒦⃗ as printed, without |γ| = 1", printed_momentum(), three.momentum(), free))
    p.route(
        "from (4.13) as printed, Ω the Cayley transform of u×, q = q₀u with u free (no turn by π), γ on the unit sphere",
        *second_routes.vector_momentum(),
    )
    p.control(second_routes.mutated("𝒦⃗ with + ⟨γ,q⟩γ", second_routes.vector_momentum(sign=-1)[3]))
    p.control(second_routes.mutated("𝒦⃗ with D in the place of 2D", second_routes.vector_momentum(factor=1)[4]))
    p.control(second_routes.mutated("M⃗ with J₃-J₂, J₁-J₃, J₂-J₁", second_routes.vector_momentum(centre=-1)[2]))


@claim(
    "5.2-expansion",
    r"\mathbf q = \tfrac\varepsilon2\omega + O(\varepsilon^3),\ q_0 = 1 - O(\varepsilon^2)",
    uses=["5.1"],
)
def parameter_expansion(p: Proof) -> None:
    """The Euler parameters of a small rotation, by the angle ε|ω| about ω."""
    p.assume("θ = εω, as the paper says: the rotation is Ω = exp(εω); for Ω = 1 + εω + O(ε²) alone it is false")
    turn, start, rate, spin = quaternions.turned()
    words, ring = equations(quaternions.ALGEBRA), equations(quaternions.RING)
    moved, spun = quaternions.on_vectors(turn), quaternions.on_vectors(spin)
    p.say("q(ε) with q' = ½ q ω and q(0) = 1 has the rotation exp(εω), as a product of 4 × 4 matrices:")
    p.lemma(
        words("x ↦ q x q̄ is 1 at ε = 0", start, 1),
        words("its derivative is itself after x ↦ ½(ωx - xω)", rate, turn * spin),
        ring("x ↦ q x q̄ is Ω", [x for column in moved for x in column[1:]], sp.Matrix(three.rotation()).T),
        ring(
            "½(ωx - xω) is ω × x",
            [x for column in spun for x in column],
            [x for e in omega.hat().T.tolist() for x in (0, *e)],
        ),
    )
    constant, terms = quaternions.expansion()
    vector, scalar = quaternions.remainders()
    zero, square, small = sp.zeros(3, 1), omega.dot(omega), sp.Symbol("epsilon")
    series = [small * terms[0][i] + small**2 * terms[1][i] for i in range(1, 4)]
    p.reads(
        (r"\omega", omega, "the angular velocity: the rotation is exp(εω)"),
        (r"\varepsilon", small, "ε"),
        (r"\mathbf q", sp.Matrix(series), "its terms in ε and ε², as q → 0, by the derivation"),
        ("q_0", 1 + small * terms[0][0], "its terms up to ε, as q₀ → 1, by the derivation"),
        (r"O(\varepsilon^3)", zero, "no term in 1, ε and ε²"),
        (r"O(\varepsilon^2)", sp.S.Zero, "no term in 1 and ε"),
    )
    p.lemma(words("q₀ → 1, and q → 0", constant, 1), ring("q/ε → ω/2", vector.limit, omega / 2))
    p.printed(
        ring("q is (ε/2)ω but for terms in ε³", series, small / 2 * omega),
        ring("q₀ is 1 but for terms in ε²", 1 + small * terms[0][0], 1),
    )
    p.lemma(exact_order("q - εω/2", vector, 3, less=1), exact_order("q₀ - 1", scalar, 2))
    p.lemma(ring("the leading term of q is -|ω|²ω/48", vector.leading, -square / 48 * omega))
    p.lemma(ring("the leading term of q₀ is -|ω|²/8", scalar.leading, -square / 8))
    p.say("Without it: Ω = exp(εω)exp(ε²a) is 1 + εω + O(ε²), too, and q = (ε/2)ω + (ε²/2)a + O(ε³):")
    first, second = quaternions.other_expansion()
    p.lemma(
        ring(
            "the term of q in ε is ω/2, that in ε² a/2", [*first[1:], *second[1:]], [*omega / 2, *quaternions.other / 2]
        )
    )
    p.control(ring("the term of q in ε² is 0 for Ω = exp(εω)exp(ε²a)", second[1:, :], zero))
    p.control(ring("q/ε → ω", vector.limit, omega))


@claim(
    "5.2-limit",
    r"\tfrac1\varepsilon\vec{\mathcal K} = \Lambda\omega - D\langle\gamma,\omega\rangle\gamma,\ "
    r"\text{up to terms of order }\varepsilon,\ \Lambda = \mathrm{diag}(J_2+J_3+D, J_1+J_3+D, J_1+J_2+D)",
    uses=["5.2", "5.2-expansion"],
)
def vector_limit(p: Proof) -> None:
    """𝒦⃗/ε tends to the momentum of the continuous ball; the remainder has the exact order 1."""
    p.assume("|γ| = 1; the rotation of the step is exp(ε ω)")
    words = limits.momentum()
    limit = limits.in_vectors("K", words)
    p.reads(
        glossary.ball(),
        {f"J_{i + 1}": (x, "an entry of the mass tensor (5.2)") for i, x in enumerate((J1, J2, J3))},
        (r"\tfrac1\varepsilon\vec{\mathcal K}", limit.limit, "without its terms in ε, by the derivation"),
    )
    p.show("limit", limit.limit)
    p.show(f"leading remainder, order {limit.order}", limit.leading)
    p.lemma(Equation("𝒦 has no part without ε", words.constant, 0, ball.ALGEBRA))
    lam = sp.diag(J2 + J3 + D, J1 + J3 + D, J1 + J2 + D)
    printed = lam * omega - D * gamma.dot(omega) * gamma
    p.printed(Equation("𝒦⃗/ε → Λω - D⟨γ,ω⟩γ", limit.limit, printed, limits.RING))
    p.lemma(exact_order("the remainder", limit, 1))
    p.lemma(Equation("its leading term is ½ ω×Λω", limit.leading, omega.cross(lam * omega) / 2, limits.RING))
    p.control(Equation("𝒦⃗/ε → Λω + D⟨γ,ω⟩γ", limit.limit, lam * omega + D * gamma.dot(omega) * gamma, limits.RING))
    mass = sp.diag(J1 + D, J2 + D, J3 + D)
    p.control(
        Equation("the same with Λ = J + D", limit.limit, mass * omega - D * gamma.dot(omega) * gamma, limits.RING)
    )


@claim(
    "5.3",
    r"\vec{\mathcal K}_k = \Omega_{k-1}^T\vec{\mathcal K}_{k-1},\ \gamma_k = \Omega_{k-1}^T\gamma_{k-1}",
    uses=["prop-1", "4.11", "5.1"],
)
def vector_form(p: Proof) -> None:
    """The vector form of the map, and its continuum limit."""
    ring, rotation = Quotient((*K, *RING.symbols), RING.relations), sp.Matrix(three.rotation())
    moved = axial(rotation.T * K.hat() * rotation)
    p.reads(
        glossary.ball(),
        (r"\vec{\mathcal K}_k", moved, "the vector of ΩᵀKΩ (4.12)"),
        (r"\vec{\mathcal K}_{k-1}", K, "that of 𝒦 (4.12)"),
        (r"\Omega_{k-1}", rotation, "the rotation by the Euler parameters (5.1 as corrected)"),
        (r"\gamma_k", rotation.T * gamma, "Ωᵀγ (4.11)"),
        (r"\gamma_{k-1}", gamma, "the vertical before the step (4.11)"),
    )
    p.say("The axial vector of Ωᵀ𝒦Ω, for a skew 𝒦 with the free vector (K₁,K₂,K₃):")
    p.printed(Equation("the axial vector of Ωᵀ𝒦Ω = Ωᵀ𝒦⃗", moved, rotation.T * K, ring))
    p.lemma(Equation("Ωᵀx = x + (Ω - (q₀² + |q|²))ᵀx, here of 𝒦⃗", three.transported(K), rotation.T * K, ring))
    p.say("γ_k = Ωᵀγ_{k-1} is (4.11).")
    p.assume("in the limit the rotation of the step is exp(ε ω)")
    words = limits.transport("K", ball.K)
    limit = limits.in_vectors("moved", words)
    p.lemma(Equation("Ωᵀ𝒦Ω - 𝒦 has no part without ε", words.constant, 0, ball.ALGEBRA))
    p.show(f"(Ωᵀ𝒦⃗ - 𝒦⃗)/ε, leading remainder of order {limit.order}", limit.leading)
    p.lemma(Equation("(Ωᵀ𝒦⃗ - 𝒦⃗)/ε → 𝒦⃗×ω", limit.limit, K.cross(omega), limits.RING))
    p.lemma(Equation("its leading remainder is ½(𝒦⃗×ω)×ω", limit.leading, K.cross(omega).cross(omega) / 2, limits.RING))
    p.lemma(exact_order("that remainder", limit, 1))
    p.control(Equation("the axial vector of Ωᵀ𝒦Ω = Ω𝒦⃗", moved, rotation * K, ring))
    p.control(Equation("𝒦̇ = ω×𝒦", limit.limit, omega.cross(K), limits.RING))


@claim(
    "5.3-integrals",
    r"\langle\mathcal K,\gamma\rangle = h,\ \langle\mathcal K,\mathcal K\rangle = n,\ \text{two integrals that are independent}",
    uses=["5.3"],
)
def vector_integrals(p: Proof) -> None:
    """The two momentum integrals of the vector map, whatever the branch."""
    p.infers("Independent: a minor of the gradients is not 0 at one point, hence on an open dense set.")
    ring = Quotient((*K, *RING.symbols), RING.relations)
    rotation = sp.Matrix(three.rotation())
    moved, vertical = rotation.T * K, rotation.T * gamma
    p.printed(
        Equation("⟨Ωᵀ𝒦, Ωᵀγ⟩ = ⟨𝒦, γ⟩", moved.dot(vertical), K.dot(gamma), ring),
        Equation("⟨Ωᵀ𝒦, Ωᵀ𝒦⟩ = ⟨𝒦, 𝒦⟩", moved.dot(moved), K.dot(K), ring),
    )
    p.reads(
        (r"\mathcal K", moved, "Ωᵀ𝒦, after a step (5.3)"),
        (r"\gamma", vertical, "Ωᵀγ, after a step (5.3)"),
        ("h", K.dot(gamma), "⟨𝒦,γ⟩ before the step"),
        ("n", K.dot(K), "⟨𝒦,𝒦⟩ before the step"),
    )
    p.lemma(Equation("|Ωᵀγ| = |γ|", vertical.dot(vertical), gamma.dot(gamma), ring))
    p.say("Only ΩᵀΩ = 1 is used: the branch of Ω does not matter.")
    gradients = sp.Matrix([K.dot(gamma), K.dot(K), gamma.dot(gamma)]).jacobian(sp.Matrix([*K, *gamma]))
    at = three.placed((K, (1, "-1/2", "3/4")), (gamma, ("2/7", "3/7", "6/7")))
    p.printed(
        Comparison(
            "with |γ|² they are independent: a minor of the gradients is not 0 at 𝒦 = (1, -1/2, 3/4), γ = (2, 3, 6)/7",
            [sp.Ne(gradients[:, :2].row_join(gradients[:, 3]).det(method="berkowitz"), 0)], at,
        )
    )  # fmt: skip
    size = sp.Symbol("t")
    dependent = gradients[1, :] - 2 * size * gradients[0, :] + size**2 * gradients[2, :]
    dependent = dependent.xreplace(three.placed((K, size * gamma)))
    p.lemma(Equation("where 𝒦 = tγ: ∇(⟨𝒦,𝒦⟩ - 2t⟨𝒦,γ⟩ + t²⟨γ,γ⟩) = 0 for this t", dependent, [sp.S.Zero] * 6,
                     Quotient((size, *gamma))))  # fmt: skip
    p.control(Equation("⟨Ωᵀ𝒦, Ωγ⟩ = ⟨𝒦, γ⟩", moved.dot(rotation * gamma), K.dot(gamma), ring))


@claim("5.3-energy", r"\text{the energy integral (2.5) is not preserved}:\ E_k \ne E_{k+1}", uses=["5.3", "2.5"])
def energy_changes(p: Proof) -> None:
    """One exact step that changes the energy, (2.5) as corrected; as printed it changes, too."""
    p.infers("Not preserved: one step at which it changes is enough.")
    p.assume("the energy is (2.5) as corrected, in 𝒦")
    momentum, turn = sp.Matrix(three.momentum()), sp.Matrix(three.rotation()).T
    inverse, factor = three.lam().inv(), continuous.rolling_factor()
    quadratic, lifted = K.dot(inverse * K), D * gamma.dot(inverse * K) ** 2 / factor

    def ends(energy: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
        """The energy before and after the step with these Euler parameters."""
        before = energy.xreplace(three.placed((K, momentum)))
        return before, energy.xreplace(three.placed((K, turn * momentum), (gamma, turn * gamma)))

    def changes(name: str, energy: sp.Expr, at: dict) -> Comparison:
        """The statement that the energy differs before and after the step."""
        return Comparison(name, [sp.Ne(*ends(energy))], at)

    ball = {J1: 1, J2: 2, J3: 4, D: 8}
    state = three.placed((gamma, map(sp.Rational, ("2/7", "3/7", "6/7")))) | UNIT | ball
    state = {symbol: sp.Rational(value) for symbol, value in state.items()}
    p.say("J = (1, 2, 4), D = 8, γ = (2, 3, 6)/7, Ω by (4, 2, 1, 2)/5; 𝒦 and γ after the step are Ωᵀ𝒦 and Ωᵀγ.")
    units = [sp.Eq(three.UNIT_QUATERNION, 0), sp.Eq(three.UNIT_VERTICAL, 0)]
    p.lemma(Comparison("|γ| = 1 and |(q₀, q)| = 1 there", units, state))
    for symbol, value, when in zip(("E_k", "E_{k+1}"), ends(quadratic + lifted), ("before", "after"), strict=True):
        p.reads({symbol: (value, f"(2.5) as corrected, {when} the step")})
    p.printed(changes("(2.5) as corrected changes in that step", quadratic + lifted, state))
    p.lemma(changes("(2.5) as printed changes in that step", quadratic - lifted, state))
    p.lemma(
        Equation("(2.5) as corrected is twice the energy", quadratic + lifted, 2 * continuous.energy(), limits.RING)
    )
    here = momentum.xreplace(state)
    shown = {"J": "(1, 2, 4)", "D": "8", "γ": "(2, 3, 6)/7", "q₀, q": "(4, 2, 1, 2)/5", "𝒦": str(list(here))}
    p.witness("generic", shown, Fact("|γ| = 1", gamma.dot(gamma).xreplace(state) == 1))
    p.say(
        "It may be kept in a step: a turn about an axis of the body that is vertical, or vertical momentum (6-vertical-energy)."
    )
    upright = three.placed(((q0, *q), ("4/5", 0, 0, "3/5")), (gamma, (0, 0, 1)))
    p.control(changes("it changes in a turn about e₃ with 𝒦, γ along e₃", quadratic + lifted, state | upright))


if __name__ == "__main__":
    main(__file__)
