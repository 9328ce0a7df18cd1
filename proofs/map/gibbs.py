"""The map in the Gibbs vector u = q/q₀: lemmas of chapsym, which the paper does not state."""

import sympy as sp

from chapsym.derive import gibbs, three
from chapsym.derive.gibbs import BY_INERTIA, I1, I2, I3, INERTIA, d, k, u, v
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import D, gamma, placed, q, q0
from chapsym.prove import Comparison, Equation, Proof, Theorem, claim, equations, main

#: The ring of free symbols: no relations; |γ| = 1 is not used.
FREE = Quotient((*u, *k, *d, *v, *gamma, I1, I2, I3, D), [])
#: The ring of a quaternion of any length and a vector.
ANY = Quotient((gibbs.p0, *gibbs.p, *v), [])
NORM = 1 + u.dot(u)
#: A matrix of symbols for the cofactors.
C_ = gibbs.C


def momentum_of(point: dict[sp.Symbol, sp.Expr]) -> sp.Matrix:
    """𝒦(q, γ) in terms of the moments of inertia, at (q₀, q) of `point`."""
    return sp.Matrix(three.momentum()).xreplace(BY_INERTIA).xreplace(point)


equal = equations(FREE)


def columns(a: sp.Matrix) -> list[sp.Matrix]:
    """The columns of a matrix."""
    return [a[:, i] for i in range(a.cols)]


def staged(names: sp.Matrix) -> sp.Matrix:
    """The expressions that the steps of the kernel give these names, in terms of the inputs alone."""
    return three.unrolled(gibbs.newton_steps()[0], names).applyfunc(sp.expand)


@claim("gibbs", r"B(\gamma)u + u\times Iu = \tfrac12(1+|u|^2)\mathcal K, \quad u = q/q_0", uses=("5.2",))
def gibbs_form(p: Proof) -> None:
    """With u = q/q₀ the vector equation (5.2) is quadratic in u, without a root."""
    p.assume("q₀ ≠ 0: a rotation by π has no Gibbs vector")
    p.say("𝒦(q, γ) is homogeneous of degree 2 in (q₀, q), and q₀² = 1/(1 + |u|²); with k = 𝒦/2:")
    scale = sp.Symbol("r")
    ring = Quotient((scale, *u, *gamma, I1, I2, I3, D), [])
    scaled = momentum_of(placed(((q0, *q), (scale, *(scale * u)))))
    at_u = momentum_of(placed(((q0, *q), (1, *u))))
    p.lemma(equal("𝒦(ru) = r²𝒦(u) for (q₀, q) = r(1, u)", scaled, scale**2 * at_u, ring))
    residual = sp.Matrix(gibbs.residual())
    p.show("G(u)", residual)
    p.lemma(equal("½(𝒦(1, u) - 2k(1 + |u|²)) = G(u)", (at_u - 2 * k * NORM) / 2, residual))
    B = sp.Matrix(gibbs.contact_inertia())
    form = B * u + u.cross(INERTIA * u) - NORM * k
    p.printed(equal("G(u) = B(γ)u + u × Iu - (1 + |u|²)k", residual, form))
    p.lemma(equal("B(γ) = I + D(|γ|² - γγᵀ)", B, INERTIA + D * (gamma.dot(gamma) * sp.eye(3) - gamma * gamma.T)))
    p.lemma(equal("u × Iu = u × Λu, as Λ = I + D", u.cross(INERTIA * u), u.cross((INERTIA + D * sp.eye(3)) * u)))
    p.lemma(equal("∂G/∂u is the derivative of G", gibbs.jacobian(), residual.jacobian(u)))
    p.control(equal("the same with Iu × u", residual, B * u - u.cross(INERTIA * u) - NORM * k))
    p.control(equal("the same without |u|²", residual, B * u + u.cross(INERTIA * u) - k))


@claim(
    "gibbs-newton",
    r"\partial_uG(u)\,u' = u\times Iu + (1-|u|^2)k \ \Rightarrow\ G(u') = d\times Id - |d|^2k,\quad d = u'-u",
    uses=("gibbs",),
)
def newton_leaves(p: Proof) -> None:
    """The next Newton iterate without the residual, and what it leaves: a second correction needs no evaluation."""
    residual, jacobian = sp.Matrix(gibbs.residual()), gibbs.jacobian()
    after = residual.xreplace(placed((u, u + d)))
    p.printed(
        equal("∂G(u)u - G(u) = u × Iu + (1 - |u|²)k", jacobian * u - residual, gibbs.newton_target()),
        equal("G(u + d) = G(u) + ∂G(u)d + d × Id - |d|²k", after, residual + jacobian * d + gibbs.bilinear(d)),
    )
    p.say(
        "For the solve: with the cofactors C of a matrix A, A Cᵀ = det A; so u' = Cᵀr/det A, a quaternion (det A, Cᵀr)."
    )
    A, C = gibbs.A, gibbs.A.cofactor_matrix()
    generic = Quotient(tuple(A), [])
    p.lemma(equal("A Cᵀ = (first row · first cofactors)", A * C.T, (A[0, :] * C[0, :].T)[0] * sp.eye(3), generic))
    p.lemma(equal("the steps of the kernel compute ∂G/∂u", staged(gibbs.A), jacobian))
    p.lemma(equal("and the right side", staged(gibbs.R), gibbs.newton_target()))
    first, second, third = columns(residual.jacobian(u))
    crossed = sp.Matrix.hstack(second.cross(third), third.cross(first), first.cross(second))  # the cofactors
    entries = placed((A, jacobian))
    adjugate = A.adjugate().xreplace(entries)
    p.lemma(equal("det ∂G, adj(∂G) times the right side, and the cofactors, by vector products of the columns",
                  [first.dot(crossed[:, 0]), *(crossed.T * gibbs.newton_target()), *crossed],
                  [A.det().xreplace(entries), *(adjugate * gibbs.newton_target()), *adjugate.T]))  # fmt: skip
    left_over = Quotient((*FREE.symbols, *C_, *gibbs.e), [])
    p.lemma(equal("Cᵀ(d × Id - |d|²k) = Cᵀ(G(u + d) - G(u) - ∂G(u)d)", gibbs.second(),
                  C_.T * (after - residual - jacobian * d), left_over))  # fmt: skip
    both = gibbs.bilinear(d + gibbs.e) - gibbs.bilinear(d) - gibbs.bilinear(gibbs.e)
    p.lemma(equal("what is bilinear in d and e of that, for d + e", gibbs.mixed(), C_.T * both, left_over))
    p.control(equal("G(u + d) with + |d|²k", after, residual + jacobian * d + d.cross(INERTIA * d) + d.dot(d) * k))
    p.control(equal("G(u + d) with ½∂G", after, residual + jacobian * d / 2 + gibbs.bilinear(d)))
    p.control(equal("the right side with 1 + |u|²", jacobian * u - residual, u.cross(INERTIA * u) + NORM * k))
    p.control(equal("A C = det A", A * C, (A[0, :] * C[0, :].T)[0] * sp.eye(3), generic))


@claim(
    "gibbs-rotation",
    r"\Omega^Tv = v + \tfrac{2}{p_0^2+|p|^2}\,(p\times(p\times v) - p_0\,p\times v)",
    uses=("5.1", "5.3"),
)
def gibbs_rotation(proof: Proof) -> None:
    """The rotation of a quaternion of any length is rational: Ωᵀv from two vector products."""
    p0, p = gibbs.p0, gibbs.p
    proof.assume("(p₀, p) ≠ 0; the Gibbs vector is p/p₀")
    rotation = sp.Matrix(three.rotation()).xreplace(placed(((q0, *q), (p0, *p))))
    norm, once = p0**2 + p.dot(p), p.cross(v)
    proof.say("Ω of (5.1) is homogeneous of degree 2, and (p₀² + |p|²)Ω for any (p₀, p):")
    proof.printed(equal("|(p₀, p)|²(Ωᵀv - v) = 2(p × (p × v) - p₀ p × v)", rotation.T * v - norm * v,
                        2 * (p.cross(once) - p0 * once), ANY))  # fmt: skip
    steps, value = gibbs.turn_steps()
    value = three.unrolled(steps, value)
    proof.lemma(equal("the steps of the kernel compute Ωᵀv - v", value, rotation.T * v / norm - v, ANY))
    proof.control(equal("the same with + p₀ p × v", rotation.T * v - norm * v, 2 * (p.cross(once) + p0 * once), ANY))


BOUND = "|𝒦| < I_min, ϱ(½(I_max - I_min) + |𝒦|) < I_min, ϱ = tan(½ arcsin(|𝒦|/I_min))"
SPLIT = "for 0 < t ≤ 1 every root at t𝒦 has |u| ≤ ϱ(t) or |u| ≥ 1/ϱ(t), ϱ(t) < 1"
MONOTONE = "G at t𝒦 is strictly monotone on |u| ≤ ϱ(1) for 0 ≤ t ≤ 1"
ONE_ROOT = "one rotation with |u| < 1 has the momentum 𝒦, a regular root, and it is that of the small branch"


@claim(
    "small-branch",
    r"|\mathcal K| < I_{\min},\ \varrho\,(\tfrac12(I_{\max}-I_{\min}) + |\mathcal K|) < I_{\min},\ "
    r"\varrho = \tan(\tfrac12\arcsin(|\mathcal K|/I_{\min})) \ \Rightarrow\ "
    r"\text{one rotation with } |u| < 1, \text{ that of the small branch}",
    uses=("gibbs", "gibbs-newton"),
)
def small_branch(p: Proof) -> None:
    """A bound on |𝒦| under which a root with θ < 90° is the small branch's, whatever γ is."""
    ball = "|γ| = 1, I_min > 0, D ≥ 0"
    p.assume(ball)
    p.state(Theorem((), (ball, BOUND), (ONE_ROOT,)))
    B, jacobian = sp.Matrix(gibbs.contact_inertia()), gibbs.jacobian()
    inertial = (u.T * INERTIA * u)[0]
    residual = sp.Matrix(gibbs.residual())
    along = equal("⟨u, G(u)⟩ = ⟨u, Bu⟩ - (1 + |u|²)⟨k, u⟩", u.dot(residual), (u.T * B * u)[0] - NORM * k.dot(u))
    p.printed(along)
    above = Equation("⟨x, Bx⟩ = ⟨x, Ix⟩ + D|γ × x|² at x = u", [(u.T * B * u)[0]],
                     [inertial + D * gamma.cross(u).dot(gamma.cross(u))], FREE)  # fmt: skip
    p.lemma(above)
    p.say("So a root has I_min|u| ≤ ½|𝒦|(1 + |u|²).  For t𝒦 with t|𝒦| < I_min this quadratic has the roots ϱ(t) < 1")
    p.say(
        "and 1/ϱ(t): every solution has |u| ≤ ϱ(t) or |u| ≥ 1/ϱ(t), ϱ(t) = tan(½ arcsin(t|𝒦|/I_min)), which grows with t."
    )
    s, b = sp.symbols("s b")
    curve = Quotient((s, b), [])
    p.lemma(Equation("with |𝒦| = 2sb/(1 + s²), b = I_min: ½|𝒦|(1 + x²) - bx vanishes at x = s and at x = 1/s",
                     [s * b * (1 + s**2) - b * s * (1 + s**2), s * b * (1 + s**2) - b * s**2 * (s + 1 / s)],
                     [sp.S.Zero, sp.S.Zero], curve))  # fmt: skip
    p.step(SPLIT, ball, BOUND)
    p.printed(Equation("⟨d, ∂G(u)d⟩ = ⟨d, Bd⟩ - ⟨u, d × Id⟩ - 2⟨d, k⟩⟨u, d⟩", [(d.T * jacobian * d)[0]],
                       [(d.T * B * d)[0] - u.dot(d.cross(INERTIA * d)) - 2 * d.dot(k) * u.dot(d)], FREE))  # fmt: skip
    p.say("|d × Id| = |d × (I - c)d| ≤ ½(I_max - I_min)|d|² for c in the middle.  So ⟨d, ∂G d⟩ > 0 for d ≠ 0 while")
    p.say("|u|(½(I_max - I_min) + |𝒦|) < I_min: G is strictly monotone on that ball, and has one root there at most;")
    p.say("for t𝒦 with t < 1 the ball is larger.  It contains |u| ≤ ϱ(1).")
    p.step(MONOTONE, ball, BOUND)
    p.say(
        "So the curve from u = 0 never meets a fold for t ≤ 1 and cannot leave |u| ≤ ϱ(t) across the gap: at t = 1 it is the one root with |u| < 1."
    )
    p.step(ONE_ROOT, SPLIT, MONOTONE)
    c = sp.Symbol("c")
    shifted = Quotient((*d, I1, I2, I3, c), [])
    p.lemma(equal("d × Id = d × (I - c)d", d.cross(INERTIA * d), d.cross((INERTIA - c * sp.eye(3)) * d), shifted))
    p.lemma(_sharp())
    p.control(equal("⟨u, G(u)⟩ = ⟨u, Bu⟩ - ⟨k, u⟩", u.dot(residual), (u.T * B * u)[0] - k.dot(u)))
    p.control(Equation("⟨d, ∂G d⟩ without the vector product", [(d.T * jacobian * d)[0]],
                       [(d.T * B * d)[0] - 2 * d.dot(k) * u.dot(d)], FREE))  # fmt: skip


def _sharp() -> Comparison:
    """|d × Id| reaches ½(I_max - I_min)|d|², at the bisector of the two axes: the bound cannot be halved."""
    product = d.cross(INERTIA * d)
    largest, _, least = INERTIA.diagonal()
    return Comparison(
        "|d × Id| = ½(I_max - I_min)|d|² at d = (1, 0, 1), I = (3, 2, 1)",
        [sp.Eq(product.dot(product), (largest - least) ** 2 / 4 * d.dot(d) ** 2)],
        placed((d, (1, 0, 1)), (INERTIA.diagonal(), (3, 2, 1))),
    )


@claim(
    "straight-path",
    r"G(u)=0,\ t=s+cs(1-s),\ |G_t(su)| < \frac{m^2}{4\sigma},\ \langle d,\partial G_t(su)d\rangle \ge m|d|^2 "
    r"\ (0\le s\le 1,\ m > 0,\ 0\le c\le 1) \ \Rightarrow\ u \text{ is the root of the small branch}",
    uses=("gibbs", "gibbs-newton", "small-branch"),
)
def straight_path(p: Proof) -> None:
    """A root beyond the bound of small-branch is proved to be the small branch's by the straight path to it."""
    p.assume("|γ| = 1, I_min > 0, D ≥ 0; G_t is G with tk in place of k; σ = ½(I_max - I_min) + |𝒦|; m depends on s")
    s, c, t = sp.symbols("s c t")
    ring = Quotient((*u, *k, *d, *v, *gamma, I1, I2, I3, D, s, c, t), [])
    at, path = s + c * s * (1 - s), placed((u, s * u))
    residual, jacobian, n = sp.Matrix(gibbs.residual()), gibbs.jacobian(), u.dot(u)
    stretched = jacobian.xreplace(placed((k, at * k)) | path)
    along = residual.xreplace(placed((k, at * k)) | path)
    rest = (n * (1 + s) - c * (1 + s**2 * n)) * k - u.cross(INERTIA * u)
    p.printed(equal("G_t(su) = sG(u) + s(1 - s)R(s), R(s) = (|u|²(1 + s) - c(1 + s²|u|²))k - u × Iu",
                    along, s * residual + s * (1 - s) * rest, ring))  # fmt: skip
    B = sp.Matrix(gibbs.contact_inertia())
    form = (d.T * ((1 - s) * B + s * jacobian) * d)[0] + 2 * s * (1 - s) * (1 - c * s) * d.dot(k) * u.dot(d)
    p.printed(Equation("⟨d, ∂G_t(su)d⟩ = (1 - s)⟨d, Bd⟩ + s⟨d, ∂G(u)d⟩ + 2s(1 - s)(1 - cs)⟨d, k⟩⟨u, d⟩",
                       [(d.T * stretched * d)[0]], [form], ring))  # fmt: skip
    p.lemma(Equation("2⟨d, a⟩⟨d, b⟩ = ½⟨d, a + b⟩² - ½⟨d, a - b⟩², a = u, b = v", [2 * d.dot(u) * d.dot(v)],
                     [d.dot(u + v) ** 2 / 2 - d.dot(u - v) ** 2 / 2], ring))  # fmt: skip
    p.say(
        "With |a| = |b| this is at least -½|a - b|²|d|² = (⟨a, b⟩ - |a||b|)|d|²; so 2⟨d, k⟩⟨u, d⟩ ≥ (⟨k, u⟩ - |k||u|)|d|²,"
    )
    p.say("and as 0 ≤ 1 - cs ≤ 1 one may take m(s) = (1 - s)m₀ + sm₁ - s(1 - s)(|k||u| - ⟨k, u⟩) with the smallest")
    p.say("eigenvalues m₀ of B and m₁ of the symmetric part of ∂G(u).")
    moved = jacobian.xreplace(placed((k, t * k), (u, u + v)))
    still = jacobian.xreplace(placed((k, t * k)))
    p.lemma(Equation("⟨d, (∂G_t(u + v) - ∂G_t(u))d⟩ = -⟨v, d × Id⟩ - 2t⟨d, k⟩⟨v, d⟩", [(d.T * (moved - still) * d)[0]],
                     [-v.dot(d.cross(INERTIA * d)) - 2 * t * d.dot(k) * v.dot(d)], ring))  # fmt: skip
    p.say("which is at most σ|v||d|² (small-branch: |d × Id| ≤ ½(I_max - I_min)|d|²).  So in the ball of radius m/(2σ)")
    p.say("round su G_t is strictly monotone with the constant ½m, and as |G_t(su)| < ½m · m/(2σ) it has one root y(s)")
    p.say(
        "in the ball, inside, and a regular one.  By the theorem of implicit functions y is continuous; y(0) = 0, y(1) = u,"
    )
    p.say("and t grows from 0 to 1 with s: y is the curve from u = 0 that the small branch follows, and meets no fold.")
    symmetric, matrix = gibbs.symmetric_part(), sp.Matrix(gibbs.symmetric_part())
    trace, minors, determinant = gibbs.symmetric()
    p.lemma(
        Equation("⟨d, ∂G d⟩ = ⟨d, Sd⟩, S = ½(∂G + ∂Gᵀ)", [(d.T * jacobian * d)[0]], [(d.T * symmetric * d)[0]], ring)
    )
    p.lemma(Equation("det(s - S) = s³ - s² tr S + s minors - det S", [(s * sp.eye(3) - matrix).det(method="berkowitz")],
                     [s**3 - trace * s**2 + minors * s - determinant], ring))  # fmt: skip
    steps, in_entries = gibbs.symmetric_steps()
    first, second, third = columns(matrix)
    p.lemma(Equation("tr S, the minors by the length of S, det S by its columns", three.unrolled(steps, sp.Matrix(in_entries)),
                     [matrix.trace(), (matrix.trace() ** 2 - sum(x.dot(x) for x in columns(matrix))) / 2,
                      third.dot(first.cross(second))], ring))  # fmt: skip
    p.control(equal("G_t(su) = s(1 - s)R(s) with + u × Iu", along,
                    s * residual + s * (1 - s) * (rest + 2 * u.cross(INERTIA * u)), ring))  # fmt: skip
    p.control(Equation("⟨d, ∂G_t(su)d⟩ without what is quadratic in s", [(d.T * stretched * d)[0]],
                       [(d.T * ((1 - s) * B + s * jacobian) * d)[0]], ring))  # fmt: skip


@claim(
    "state-error",
    r"\tilde v = v(\xi{=}0),\ v = \Omega(\xi)^T\tilde v \ (v = k, \gamma) \ \Rightarrow\ A(u - \tilde u) = -S\xi,\ "
    r"(1,-\tilde u)(1,\xi)(1,u) = (1+|\tilde u|^2)(1, \Omega(\tilde u)^T\xi) + (1,-\tilde u)(1,\xi)(0,u-\tilde u)",
    uses=("gibbs", "gibbs-newton", "gibbs-rotation"),
)
def state_error(p: Proof) -> None:
    """How a small rotation ξ of the state changes the step: the mean-value form of the enclosures."""
    p.assume("|γ| = 1; u and ũ are the Gibbs vectors at k, γ and at k̃, γ̃, which are turned by the Gibbs vector ξ = d")
    p.say("With 1 + |ξ|² on both sides, for k̃ = v and as well for γ̃:")
    once = v.cross(d)
    p.lemma(equal("(1 + |ξ|²)(Ωᵀv - v) = 2(v + v × ξ) × ξ", 2 * (d.cross(d.cross(v)) - d.cross(v)),
                  2 * (v + once).cross(d)))  # fmt: skip
    w, n, m = (sp.Matrix(sp.symbols(f"{name}1:4")) for name in "wnm")
    wide = Quotient((*u, *v, *k, *d, *gamma, *w, *n, *m, I1, I2, I3, D), [])
    p.say("Let γ = γ̃ + n, k = k̃ + m, with B of |γ| = |γ̃| = 1, so that B(γ) = I + D - Dγγᵀ; ũ stands as u:")

    def residual(at: sp.Matrix, momentum: sp.Matrix, vertical: sp.Matrix) -> sp.Matrix:
        return (
            INERTIA * at + D * (at - vertical * vertical.dot(at)) + at.cross(INERTIA * at) - (1 + at.dot(at)) * momentum
        )

    change = -D * ((gamma + n).dot(u) * n + gamma * u.dot(n)) - NORM * m
    p.printed(equal("G(ũ; k, γ) - G(ũ; k̃, γ̃) = -D(⟨γ, ũ⟩n + γ̃⟨ũ, n⟩) - (1 + |ũ|²)m",
                    residual(u, k + m, gamma + n) - residual(u, k, gamma), change, wide))  # fmt: skip
    middle = sp.Matrix(gibbs.residual()).jacobian(u).xreplace(placed((u, u + w / 2)))
    moved = sp.Matrix(gibbs.residual()).xreplace(placed((u, u + w)))
    p.printed(equal("G(ũ + w) - G(ũ) = A(ũ + w/2)w", moved - sp.Matrix(gibbs.residual()), middle * w, wide))
    p.say("So w = u - ũ has Aw = -Sξ.  For the rotation after the step, with Hamilton's product:")
    product = three.quaternion_product
    first = product(sp.Matrix([1, *-u]), sp.Matrix([1, *d]))
    after, steady = (product(first, sp.Matrix([1, *x])) for x in (u + w, u))
    turned = (1 - u.dot(u)) * d + 2 * u * u.dot(d) - 2 * u.cross(d)
    p.lemma(Equation("(1, -ũ)(1, ξ)(1, ũ) = (1 + |ũ|², (1 - |ũ|²)ξ + 2ũ⟨ũ, ξ⟩ - 2ũ × ξ)",
                     steady, [NORM, *turned], wide))  # fmt: skip
    beside = product(sp.Matrix([1, *-u]), product(sp.Matrix([0, *d]), sp.Matrix([0, *w])))
    p.printed(Equation("(1, -ũ)(1, ξ)(1, ũ + w) is that, and (⟨ũ, w⟩, w - ũ × w) and (1, -ũ)(0, ξ)(0, w) more",
                       after - steady, sp.Matrix([u.dot(w), *(w - u.cross(w))]) + beside, wide))  # fmt: skip
    p.say("The last has the length (1 + |ũ|²)^½|ξ||w| at most, as quaternions multiply in length.")
    p.control(equal("G(ũ; k, γ) - G(ũ; k̃, γ̃) without γ̃⟨ũ, n⟩", residual(u, k + m, gamma + n) - residual(u, k, gamma),
                    change + D * gamma * u.dot(n), wide))  # fmt: skip
    p.control(Equation("(1, -ũ)(1, ξ)(1, ũ) with + 2ũ × ξ", steady[1:, :], turned + 4 * u.cross(d), wide))


NEAR_ROOT = "m|u - ũ| ≤ |G(ũ; k, γ)|"
STEEP = "⟨x, ∂G(v)x⟩ ≥ m|x|², m > 0, for v between ũ and u, and G(u) = 0"


@claim(
    "step-bound",
    r"\langle w, G(\tilde u + w) - G(\tilde u)\rangle = \langle w, \partial_uG(\tilde u + \tfrac12w)w\rangle,"
    r"\ w = u - \tilde u,\ G(u) = 0 \ \Rightarrow\ m|u - \tilde u| \le |G(\tilde u)|",
    uses=("gibbs", "small-branch", "straight-path", "state-error"),
)
def step_bound(p: Proof) -> None:
    """A residual bounds the distance of the root from any point, and what is quadratic in the error of the state."""
    p.assume(STEEP)
    p.state(Theorem((), (STEEP,), (NEAR_ROOT,)))
    w, n, m, x = (sp.Matrix(sp.symbols(f"{name}1:4")) for name in "wnmx")
    wide = Quotient((*u, *v, *k, *d, *gamma, *w, *n, *m, *x, I1, I2, I3, D), [])
    residual = sp.Matrix(gibbs.residual())
    jacobian = residual.jacobian(u)
    rise = residual.xreplace(placed((u, u + w))) - residual
    middle = jacobian.xreplace(placed((u, u + w / 2)))
    p.printed(Equation("⟨w, G(ũ + w) - G(ũ)⟩ = ⟨w, ∂G(ũ + w/2)w⟩", [w.dot(rise)], [(w.T * middle * w)[0]], wide))
    p.say("With G(ũ + w) = 0 the left side is at most |w||G(ũ)|, the right one at least m|w|²; ũ may be any point.")
    p.step(NEAR_ROOT, STEEP)
    p.say("For a run, with γ = γ̃ + n, k = k̃ + m, |γ| = |γ̃| = 1, and A = ∂G(ũ) at k̃ and γ̃ (ũ stands as u):")

    def steepness(at: sp.Matrix, momentum: sp.Matrix, vertical: sp.Matrix) -> sp.Matrix:
        unit = INERTIA + D * (sp.eye(3) - vertical * vertical.T)
        return unit * x + at.cross(INERTIA * x) + x.cross(INERTIA * at) - 2 * momentum * at.dot(x)

    more = (w.cross(INERTIA * x) + x.cross(INERTIA * w)) / 2 - (k + m) * w.dot(x) - 2 * m * u.dot(x)
    p.lemma(equal("(∂G(ũ + w/2) at k, γ - A)x = ½(w × Ix + x × Iw) - ⟨w,x⟩k - 2⟨ũ,x⟩m - D(⟨γ,x⟩n + ⟨n,x⟩γ̃)",
                  steepness(u + w / 2, k + m, gamma + n) - steepness(u, k, gamma),
                  more - D * ((gamma + n).dot(x) * n + n.dot(x) * gamma), wide))  # fmt: skip
    p.say("of a length of at most ((½(I_max - I_min) + |k|)|w| + 2|ũ||m| + 2D|n|)|x|; and what turns by ξ,")
    once = v.cross(d)
    p.lemma(equal("(1 + |ξ|²)(Ωᵀv - v - 2v × ξ) = 2(v × ξ) × ξ - 2|ξ|²v × ξ, ξ = d",
                  2 * (d.cross(d.cross(v)) - d.cross(v)) - 2 * (1 + d.dot(d)) * once,
                  2 * once.cross(d) - 2 * d.dot(d) * once, wide))  # fmt: skip
    p.say("has |m| ≤ 2|k||ξ| and |m - 2k̃ × ξ| ≤ 3|k||ξ|² for |ξ| ≤ 1/4, as n with |γ| = 1.  The constants of")
    p.say("`dynamics.loops.proved` follow from these by the triangle inequality.")
    p.control(Equation("the same with ∂G(ũ)", [w.dot(rise)], [(w.T * jacobian * w)[0]], wide))
    p.control(equal("(1 + |ξ|²)(Ωᵀv - v - 2v × ξ) without the last", 2 * (d.cross(d.cross(v)) - d.cross(v))
                    - 2 * (1 + d.dot(d)) * once, 2 * once.cross(d), wide))  # fmt: skip


if __name__ == "__main__":
    main(__file__)
