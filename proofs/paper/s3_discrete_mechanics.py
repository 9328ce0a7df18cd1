"""Section 3: the energy of a nonholonomic system, the discrete principle, its equations, and consistency."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import derivation
from chapsym.derive.derivation import written
from chapsym.derive.quotient import Quotient
from chapsym.derive.words import WordAlgebra, matrix_symbols
from chapsym.prove import Comparison, Equation, Fact, Proof, claim, equations, main, rational_point


@claim(
    "3.3-energy",
    r"E = \langle\tfrac{\partial L}{\partial\dot q},\dot q\rangle - L \text{ is conserved by (3.3), coupled with (3.2)}",
)
def energy(p: Proof) -> None:
    """The energy is an integral of the Lagrange equations with multipliers, on the constraint."""
    p.infers("Every number of coordinates, from 4: each sum is coordinate by coordinate.")
    p.assume("L and the forms A^j do not depend on time, and q̇ is in the distribution, as (3.2) says")
    size, count = 4, 2
    position, velocity = sp.symbols(f"x1:{size + 1}"), sp.symbols(f"v1:{size + 1}")
    acceleration, multiplier = sp.symbols(f"a1:{size + 1}"), sp.symbols(f"u1:{count + 1}")
    forms = sp.Matrix(count, size, sp.symbols(f"A1:{count * size + 1}"))
    lagrangian = sp.Function("L")(*position, *velocity)

    def rate(expr: sp.Expr) -> sp.Expr:
        """The time derivative along (q̇, v̇) = (v, a)."""
        moved = sum(sp.diff(expr, x) * v for x, v in zip(position, velocity, strict=True))
        return moved + sum(sp.diff(expr, v) * a for v, a in zip(velocity, acceleration, strict=True))

    p.say(f"For a free function L of {size} coordinates and velocities (each sum is coordinate by coordinate):")
    impulse = [sp.diff(lagrangian, v) for v in velocity]
    total = rate(sum(f * v for f, v in zip(impulse, velocity, strict=True)) - lagrangian)
    balance = [rate(f) - sp.diff(lagrangian, x) for f, x in zip(impulse, position, strict=True)]
    power = sum(b * v for b, v in zip(balance, velocity, strict=True))
    slots = sorted(sp.expand(total).atoms(sp.Derivative) | sp.expand(power).atoms(sp.Derivative), key=str)
    plain = dict(zip(slots, sp.symbols(f"d1:{len(slots) + 1}"), strict=True))
    free = Quotient((*plain.values(), *velocity, *acceleration))
    p.lemma(Equation("dE/dt = ⟨d/dt ∂L/∂q̇ - ∂L/∂q, q̇⟩", total.xreplace(plain), power.xreplace(plain), free))
    p.lemma(*power_for_every_size())
    p.say("(3.3) puts Σ λ_j A^j in the place of the bracket:")
    work = (sp.Matrix([multiplier]) * forms * sp.Matrix(velocity))[0]
    on_constraint = list(forms * sp.Matrix(velocity))
    ring = Quotient((*forms, *velocity, *multiplier), on_constraint)
    p.printed(Equation("dE/dt = Σ λ_j ⟨A^j, q̇⟩ = 0 on the constraint", work, 0, ring))
    point = {"A": "(1,-1,0,0), (0,0,1,-1)", "q̇": "(2,2,3,3)", "λ": "(5,7)"}
    values = dict(zip((*forms, *velocity, *multiplier), (1, -1, 0, 0, 0, 0, 1, -1, 2, 2, 3, 3, 5, 7), strict=True))
    kept = work.subs(values) == 0 and not any(e.subs(values) for e in on_constraint)
    p.witness("generic", point, Fact("dE/dt = 0 there", kept))
    p.witness("λ = 0: no constraint force", {"λ": "0"}, Fact("dE/dt = 0", work.subs(dict.fromkeys(multiplier, 0)) == 0))
    p.control(Equation("the same off the constraint: (3.3) alone", work, 0, Quotient(ring.symbols)))
    affine = Quotient((*ring.symbols, sp.Symbol("b")), [on_constraint[0] - sp.Symbol("b"), on_constraint[1]])
    p.control(Equation("the same for ⟨A^1, q̇⟩ = b, not homogeneous", work, 0, affine))


def power_for_every_size() -> list[Equation]:
    """The rate of energy for all numbers of coordinates and forms: L̇ = ⟨∂L/∂q, q̇⟩ + ⟨∂L/∂q̇, v̇⟩, and Aq̇ = 0."""
    v, a, A, L = matrix_symbols("v a A_forms L_value")  # columns; the forms are the rows of A; L, of 3 systems
    impulse, force, slope, multiplier = matrix_symbols("p^T f^T g^T lambda^T")  # rows: ∂L/∂q̇, its rate, ∂L/∂q, λ
    rows = {impulse: [[1, 2, 3], [0, 1, 1], [1, 0, 0]], force: [[1, 0, 2], [2, 2, 0], [0, 1, 0]]}
    rows |= {slope: [[0, 1, 1], [3, 0, 1], [1, 1, 0]], multiplier: [[5, 1, 0], [2, 0, 1], [0, 1, 3]]}
    rows |= {A: [[1, 1, -1], [1, -1, 0], [2, 0, -1]], L: [[7], [4], [1]], v: [[1], [1], [2]], a: [[3], [0], [1]]}
    example = {x: sp.Matrix(of) for x, of in rows.items()}
    free, constrained = WordAlgebra({}, {}, example), WordAlgebra({}, {(A, v): 0}, example)
    whole = written("E_system", "⟨∂L/∂q̇, q̇⟩ - L", impulse * v - L, free)
    chain = "dE/dt by the chain rule: dL/dt = ⟨∂L/∂q, q̇⟩ + ⟨∂L/∂q̇, v̇⟩"
    moved = derivation.rate("E_rate", chain, whole, {impulse: force, v: a, L: slope * v + impulse * a})
    text = "by (3.3): d/dt ∂L/∂q̇ = ∂L/∂q + Σ λ_j A^j"
    balanced = derivation.replaced("E_rate_by_33", text, moved, {force: slope + multiplier * A}, constrained)
    return [
        Equation("dE/dt = ⟨d/dt ∂L/∂q̇ - ∂L/∂q, q̇⟩, for every n", moved, (force - slope) * v, free),
        Equation("dE/dt = 0 by (3.3) where Aq̇ = 0, for every n and s", balanced, 0, constrained),
    ]


# One degree of freedom suffices to determine the terms of a sum in Section 3: 𝕃 = a x² + b x y + c y².
PATH = sp.symbols("x_ x0:4")  # q_{-1}, q_0, ..., q_3: N = 3 steps, from q_0 to q_3
CHANGE = sp.symbols("d0:4")
QUADRATIC = sp.symbols("a b c")


def step_action(x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """𝕃(x, y), a general quadratic form."""
    a, b, c = QUADRATIC
    return a * x**2 + b * x * y + c * y**2


def first_variation() -> sp.Expr:
    """δ Σ_{k=0}^{N-1} 𝕃(q_k, q_{k+1}) for the path q_0 ... q_N."""
    action = sum(step_action(PATH[k + 1], PATH[k + 2]) for k in range(3))
    return sum(sp.diff(action, PATH[k + 1]) * CHANGE[k] for k in range(4))


def discrete_sum(first: int) -> sp.Expr:
    """Σ_{k=first}^{N-1} (D1 𝕃(q_k, q_{k+1}) + D2 𝕃(q_{k-1}, q_k)) δq_k."""
    x, y = sp.symbols("X Y")
    slope_1, slope_2 = sp.diff(step_action(x, y), x), sp.diff(step_action(x, y), y)
    total = sp.S.Zero
    for k in range(first, 3):
        before, now, after = PATH[k : k + 3]
        total += (slope_1.subs({x: now, y: after}) + slope_2.subs({x: before, y: now})) * CHANGE[k]
    return sp.expand(total)


@claim(
    "3.4-principle",
    r"\sum_{k=0}^{N-1}(D_1\mathbb L(q_k,q_{k+1})+D_2\mathbb L(q_{k-1},q_k))\,\delta q_k = 0,\ "
    r"\delta q_k\in\mathcal D_{q_k},\ (q_k,q_{k+1})\in\mathcal D_d",
)
def discrete_principle(p: Proof) -> None:
    """The discrete principle: its sum must begin at k = 1, with the ends fixed."""
    p.infers("Every N and every number of coordinates, by induction on the steps, from N = 3 and one coordinate.")
    p.slips("typo")
    p.assume("the path is q_0, ..., q_N, with N steps, as in the source that the paper quotes; it prints no path")
    p.say("The variation of Σ_{k=0}^{N-1} 𝕃(q_k, q_{k+1}); N = 3 and one coordinate show which terms there are.")
    p.say("The term k = 0 as printed has q_{-1}, which the path q_0, ..., q_N does not have.")
    end = [CHANGE[3]]
    symbols = (*PATH, *CHANGE, *QUADRATIC)
    last_fixed, both_fixed = Quotient(symbols, end), Quotient(symbols, [*end, CHANGE[0]])
    p.printed(
        Equation(
            "δ Σ_{k=0}^{N-1} 𝕃(q_k, q_{k+1}), N = 3, is the printed sum, for every δq_k, δq_N = 0",
            first_variation(),
            discrete_sum(0),
            last_fixed,
        )
    )
    values = dict(zip((*PATH, *CHANGE, *QUADRATIC), (5, 0, 1, 3, 4, 1, 0, 0, 0, "1/2", -1, "1/2"), strict=True))
    shown = {"𝕃": "(y - x)²/2", "q_{-1}, ..., q_3": "5, 0, 1, 3, 4", "δq": "1, 0, 0, 0"}
    p.counterexample(replace(rational_point(values), values=shown))
    p.corrected(
        r"\sum_{k=1}^{N-1}(D_1\mathbb L(q_k,q_{k+1})+D_2\mathbb L(q_{k-1},q_k))\,\delta q_k = 0,\ \delta q_0 = \delta q_N = 0,\ \delta q_k\in\mathcal D_{q_k},\ (q_k,q_{k+1})\in\mathcal D_d",
        Equation("δS = Σ_{k=1}^{N-1}, for δq_0 = δq_N = 0", first_variation(), discrete_sum(1), both_fixed),
    )
    p.say(
        "With δq_0 = 0 the printed sum says the same, but then its first term is void; the paper does not fix the ends.",
        "For every N and every number of coordinates, with free ends, δS = the sum from k = 1 + the two terms of the ends:",
        "for N = 1 the sum is empty, and one step more adds to both sides the same.",
    )
    p.lemma(one_step_more())
    p.say("For a path that begins at q_{-1}, with both ends fixed, the printed range would be right:")
    longer = first_variation() + sp.diff(step_action(PATH[0], PATH[1]), PATH[1]) * CHANGE[0]
    p.lemma(
        Equation("δ Σ_{k=-1}^{N-1} 𝕃 = the printed sum, for δq_{-1} = δq_N = 0", longer, discrete_sum(0), last_fixed)
    )
    p.control(Equation("δS = Σ_{k=2}^{N-1}", first_variation(), discrete_sum(2), both_fixed))
    p.control(Equation("δS = Σ_{k=1}^{N-1} with free ends", first_variation(), discrete_sum(1), Quotient(symbols)))


def one_step_more() -> Equation:
    """The induction step: P + D2(q_{N-1}, q_N)δq_N, P the sum from 1 to N - 1, increases by δ𝕃(q_N, q_{N+1})."""
    P, before, slope_1, slope_2 = matrix_symbols("P_N D_2_before D_1 D_2")  # P: the sum
    now, after = matrix_symbols("dq_N dq_next")
    slopes = {
        before: sp.Matrix([[1, 2], [0, 1]]),
        slope_1: sp.Matrix([[3, -1], [1, 1]]),
        slope_2: sp.eye(2),
    }  # for two 𝕃
    example = {P: sp.Matrix([7, 5]), now: sp.Matrix([1, 4]), after: sp.Matrix([2, -1]), **slopes}
    grown = P + (slope_1 + before) * now + slope_2 * after - (P + before * now)
    text = "from N to N + 1 the sum and the term of its end grow by D1 δq_N + D2 δq_{N+1}"
    return Equation(text, grown, slope_1 * now + slope_2 * after, WordAlgebra({}, {}, example))


@claim(
    "3.5", r"D_1\mathbb L(q_k,q_{k+1})+D_2\mathbb L(q_{k-1},q_k) = \sum_{j=1}^s\lambda_j^kA_j(q_k)", ["3.4-principle"]
)
def discrete_equations(p: Proof) -> None:
    """The discrete equations with multipliers: what vanishes on the distribution is a combination of its forms."""
    p.infers(
        "Forms that are independent have coordinates, near each point, in which s of the differentials are solved for; every n and s, from n = 5, s = 2."
    )
    p.assume("the s forms are independent; the principle with the range of 3.4 as corrected")
    p.say(
        "Coordinates in which the forms are the rows (1 | B): δq = (-Bt, t), t free, is the distribution (n = 5, s = 2):"
    )
    bound, free = 2, 3
    B = sp.Matrix(bound, free, sp.symbols(f"B1:{bound * free + 1}"))
    t, e = sp.Matrix(sp.symbols(f"t1:{free + 1}")), sp.Matrix(sp.symbols(f"e1:{bound + free + 1}"))
    forms = sp.Matrix.hstack(sp.eye(bound), B)
    displacement = sp.Matrix([*(-B * t), *t])
    ring = Quotient((*B, *t, *e))
    p.lemma(Equation("every such δq is in the distribution", forms * displacement, [sp.S.Zero] * bound, ring))
    p.say("⟨e, δq⟩ = 0 for every t says that these vanish:")
    conditions = [sp.expand((e.T * displacement)[0]).coeff(x) for x in t]
    on_principle = Quotient(ring.symbols, conditions)
    combination = forms.T * sp.Matrix(e[:bound])
    p.printed(Equation("e = Σ λ_j A_j with λ = the first s entries of e", e, combination, on_principle))
    p.say("and the other way round, a combination of the forms annihilates every δq:")
    p.lemma(Equation("⟨Σ λ_j A_j, δq⟩ = 0", (combination.T * displacement)[0], 0, ring))
    p.say(
        "The same for every n and s, with e = (e', e''): e''ᵀ = e'ᵀB follows, as t is free, and eᵀ = λᵀ(1 | B) for λ = e':"
    )
    p.lemma(*blocks())
    values = dict(zip((*B, *t), (1, 2, 0, -1, 1, 3, 1, 1, 2), strict=True))
    exact = combination.subs({**values, e[0]: 2, e[1]: 5})
    work = (exact.T * displacement.subs(values))[0]
    p.witness(
        "generic", {"B": "(1,2,0), (-1,1,3)", "t": "(1,1,2)", "λ": "(2,5)"}, Fact("⟨Σ λ_j A_j, δq⟩ = 0", work == 0)
    )
    p.control(Equation("e is the multiple of one form", e, e[0] * forms[0, :], on_principle))
    p.control(Equation("the same without the principle", e, combination, ring))


def blocks() -> list[Equation]:
    """(3.5) in blocks, for all numbers of coordinates and forms."""
    B, t, upper, lower = matrix_symbols("B_forms t_free e_upper e_lower")  # e' and e'' as rows
    example = {
        B: sp.Matrix([[1, 2], [0, 3]]),
        t: sp.Matrix([3, 1]),
        upper: sp.Matrix([[2, 4]]),
        lower: sp.Matrix([[1, 5]]),
    }
    algebra = WordAlgebra({}, {}, example)
    equal = equations(algebra)
    work = written("e_dq", "⟨e, δq⟩ for δq = (-Bt, t)", -upper * B * t + lower * t, algebra)
    annihilated = derivation.replaced("lambda_A_dq", "for e = λᵀ(1 | B)", work, {lower: upper * B}, algebra)
    return [
        equal("⟨e, δq⟩ = (e''ᵀ - e'ᵀB)t", work, (lower - upper * B) * t),
        equal("⟨λᵀ(1 | B), δq⟩ = 0", annihilated, 0),
    ]


@claim(
    "remark-1",
    r"\mathbb L = L\circ\Psi:\ \mathcal D_d = \{A^j\circ\Psi = 0\};\ "
    r"\text{if } \mathcal D \text{ is integrable, } \mathcal D_d = \mathcal N\times\mathcal N",
)
def consistency(p: Proof) -> None:
    """A discrete constraint of an integrable distribution: not one product N×N but the union over all leaves."""
    p.infers(
        "A dimension that is too small, and a pair that is missing, refute the printed set; leaves are straightened locally by Frobenius' theorem."
    )
    p.slips("reading")
    size, count = sp.symbols("n s")
    p.say("D_d must have the dimension of D as a bundle over Q, n + (n - s), and contain (q, q) for every q in Q.")
    ring = Quotient((size, count))
    needed = 2 * size - count
    product = 2 * (size - count)
    p.printed(Equation("dim N×N = dim D", product, needed, ring))
    x1, x2, y1, y2, step = sp.symbols("x1 x2 y1 y2 epsilon")
    p.say("Q = R², A = dx2, the leaf N = {x2 = 0}: (q, q) with q = (0, 1) must be in D_d, and is not in N×N.")
    point = {x1: 0, x2: 1, y1: 0, y2: 1}
    p.printed(Comparison("N×N contains (q, q) for q = (0, 1)", [sp.Eq(x2, 0), sp.Eq(y2, 0)], point))
    plane = Quotient((x1, x2, y1, y2, step))
    flat = (y2 - x2) / step
    p.corrected(
        r"\mathcal D_d = \bigcup_c\mathcal N_c\times\mathcal N_c \text{ over all leaves, locally, if } \Psi "
        r"\text{ is taken in coordinates that straighten them}",
        Equation("its dimension: s parameters of leaves and two points", count + 2 * (size - count), needed, ring),
        Equation("A∘Ψ = 0 in such coordinates is x2 = y2: the same leaf", flat * step, y2 - x2, plane),
        Comparison("it contains (q, q) for q = (0, 1)", [sp.Eq(flat, 0)], point | {step: 1}),
    )
    point_of = {"Q": "R²", "A": "dx2", "N": "{x2 = 0}", "n, s": "2, 1"}
    p.counterexample(replace(rational_point(point | {size: 2, count: 1, step: 1}), values=point_of))
    p.say("Ψ matters: with the leaves x1² + x2² = c and Ψ(q, q') = (q, (q' - q)/ε) the pair (1, 0), (1, 1) is in D_d:")
    tangent = (x1 * (y1 - x1) + x2 * (y2 - x2)) / step
    pair = {x1: 1, x2: 0, y1: 1, y2: 1, step: 1}
    p.lemma(
        Comparison("A∘Ψ = 0 for that pair", [sp.Eq(tangent, 0)], pair),
        Comparison("its points are on two leaves", [sp.Ne(x1**2 + x2**2, y1**2 + y2**2)], pair),
    )
    p.witness(
        "generic", {"q": "(0, 1)", "q'": "(5, 1)", "A": "dx2"}, Fact("A∘Ψ = 0", flat.subs({x2: 1, y2: 1, step: 1}) == 0)
    )
    apart = y1**2 + y2**2 - x1**2 - x2**2
    p.control(Equation("A∘Ψ = 0 is the same leaf, for circles and that Ψ", tangent * step * 2, apart, plane))


if __name__ == "__main__":
    main(__file__)
