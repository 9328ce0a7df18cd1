"""Periodic orbits of the whole map, 𝒦 not parallel to γ, and what they exclude: lemmas of chapsym on Section 6."""

from collections.abc import Iterable, Sequence

import sympy as sp

from chapsym.derive import gibbs
from chapsym.derive.gibbs import I1, I2, I3, D, d, k, u
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import determinant, gamma, placed
from chapsym.proofs.map.gibbs import FREE, equal
from chapsym.prove import Comparison, Equation, Proof, claim, equations, in_field, main

#: A steady rotation about e₃ by the angle θ: u = (0, 0, t), t = tan(θ/2), γ = (x, y, c).
t = sp.Symbol("t")
x, y, c = gamma
STEADY = Quotient((t, x, y, c, I1, I2, I3, D), [x**2 + y**2 + c**2 - 1])
equation = equations(STEADY)
#: 𝒜, 𝒜~, Y = 𝒜⁻¹𝒢 and the derivative S of a step.
A, A_back, Y, S = (sp.Matrix(3, 3, sp.symbols(f"{name}1:4(1:4)")) for name in "abys")
#: The example: a rotation by 45° per step, in Q(√2).
ROOT = sp.Symbol("r")
SQUARE = ROOT**2 - 2
EXAMPLE = {I1: sp.Integer(6), I2: sp.Integer(5), I3: sp.Integer(3), D: sp.Integer(1), t: ROOT - 1}
START = sp.Matrix([3, 4, 5]) * ROOT / 10


def turn(v: sp.Matrix) -> sp.Matrix:
    """Ωᵀ for the Gibbs vector v (lemma `gibbs-rotation`)."""
    V = v.hat()
    return sp.eye(3) + 2 * (V * V - V) / (1 + v.dot(v))


def at(expr: sp.Matrix, u_: sp.Matrix, gamma_: sp.Matrix, k_: sp.Matrix) -> sp.Matrix:
    """An expression with u, γ and k replaced."""
    return sp.Matrix(expr).xreplace(placed((u, u_), (gamma, gamma_), (k, k_)))


def half_momentum(u_: sp.Matrix, gamma_: sp.Matrix) -> sp.Matrix:
    """The k of the step whose Gibbs vector is given."""
    return at(gibbs.residual(), u_, gamma_, sp.zeros(3, 1)) / (1 + u_.dot(u_))


def slope(u_: sp.Matrix, gamma_: sp.Matrix) -> sp.Matrix:
    """∂G/∂u at the step whose Gibbs vector is given."""
    return at(gibbs.jacobian(), u_, gamma_, half_momentum(u_, gamma_))


def by_turns(u_: sp.Matrix, gamma_: sp.Matrix) -> sp.Matrix:
    """𝒢: the derivative of G in w for δγ = w × γ, δk = w × k."""
    residual = sp.Matrix(gibbs.residual())
    change = residual.jacobian(gamma) * -gamma.hat() + residual.jacobian(k) * -k.hat()
    return at(change, u_, gamma_, half_momentum(u_, gamma_))


def turning(v: sp.Matrix) -> sp.Matrix:
    """E: dΩᵀ = [E du]×Ωᵀ."""
    return 2 * (v.hat() - sp.eye(3)) / (1 + v.dot(v))


@claim(
    "step-determinant",
    r"\det D\Phi|_M = \frac{\det\partial_uG(-u;\, \Omega^T\gamma, -\Omega^Tk)}{\det\partial_uG(u;\, \gamma, k)}",
    uses=("gibbs", "gibbs-rotation", "self-adjoint"),
)
def stepdeterminant(p: Proof) -> None:
    """How a step changes volumes: the quotient of the Jacobians of the step back and of the step."""
    p.assume("𝒦 and γ not parallel, ∂G/∂u regular (below the bound of small-branch it is)")
    p.say(
        "M: |γ| = 1, |𝒦| and ⟨𝒦, γ⟩ fixed. It is the set of all (R𝒦, Rγ), R in SO(3), with the tangent vectors",
        "(w × 𝒦, w × γ); DΦ on M is w ↦ Sw in these coordinates. The volume of SO(3) that is invariant under rotations",
        "makes one of M; d³𝒦 dσ(γ) on the phase space is it times a function of |𝒦| and ⟨𝒦, γ⟩, as it is invariant, too.",
        "So all dets on M, on the 5-dimensional phase space and (at a fixed point) in R⁶ are one.  With T = Ωᵀ:",
    )
    turned = turn(u)
    p.lemma(equal("self-adjoint in u: G(-u; Tγ, -Tk) = -TG(u; γ, k), for all u, γ, k",
                  at(gibbs.residual(), -u, turned * gamma, -turned * k), -turned * sp.Matrix(gibbs.residual())))  # fmt: skip
    change = sum((turned.diff(a) * b for a, b in zip(u, d, strict=True)), sp.zeros(3, 3))
    p.lemma(equal("dT = [E du]×T, E = 2([u]× - 1)/(1 + |u|²)", change, (turning(u) * d).hat() * turned))
    p.say(
        "𝒜 = ∂G/∂u, 𝒢w its change by γ ↦ w × γ, k ↦ w × k: du = -𝒜⁻¹𝒢w, and S = T - E𝒜⁻¹𝒢; 𝒜~ and 𝒢~ are those at",
        "(-u; Tγ, -Tk).  For all u, γ, I, D, with the k of this step:",
    )
    change = by_turns(u, gamma) * turn(-u) * turning(u)

    def key(text: str, sign: int) -> Equation:
        return equal(text, slope(u, gamma) - sign * change, turn(-u) * slope(-u, turned * gamma), FREE)

    p.printed(key("T⁻¹𝒜~ = 𝒜 - 𝒢T⁻¹E", 1))
    p.say(
        "Let Y = 𝒜⁻¹𝒢, F = T⁻¹E, so S = T(1 - FY) and T⁻¹𝒜~ = 𝒜(1 - YF): det S = det(1 - FY) = det(1 - YF) = det 𝒜~/det 𝒜, by"
    )
    p.lemma(exchanged())
    p.say("For D = 0 the two dets are equal: there the volume is invariant.")
    without = {D: sp.S.Zero}
    p.printed(Equation("det 𝒜~ = det 𝒜 for D = 0", [determinant(slope(-u, gamma).subs(without))],
                     [determinant(slope(u, gamma).subs(without))], FREE))  # fmt: skip
    p.say("For one step, with Y and S as they are defined:")
    point, ball = sp.Matrix([sp.Rational(1, 3), sp.Rational(-1, 4), sp.Rational(1, 5)]), {I1: 6, I2: 5, I3: 3}
    here, there = slope(point, gamma).subs(ball), slope(-point, turn(point) * gamma).subs(ball)
    numbers = placed((gamma, sp.Matrix([2, 3, 6]) / 7)) | {D: sp.Integer(2)}
    gained = by_turns(point, gamma).subs(ball)
    slopes = here.subs(numbers).inv() * gained.subs(numbers)
    values = (here.subs(numbers), there.subs(numbers), slopes, turn(point) - turning(point) * slopes)
    numbers |= placed(*zip((A, A_back, Y, S), values, strict=True))
    pairs = ((A, here), (A_back, there), (A * Y, gained), (S, turn(point) - turning(point) * Y))
    defined = [sp.Eq(a, b) for left, right in pairs for a, b in zip(left, right, strict=True)]

    def by_definition(text: str, quotient: sp.Expr) -> Comparison:
        return Comparison(text, [*defined, sp.Eq(determinant(S), quotient)], numbers)

    quotient = determinant(A_back) / determinant(A)
    p.lemma(by_definition("det S by its definition is this quotient, at γ = (2, 3, 6)/7, D = 2", quotient))
    p.control(key("T⁻¹𝒜~ = 𝒜 + 𝒢T⁻¹E", -1))
    p.control(exchanged(-1))
    p.control(by_definition("det S = 1 at this γ and D", sp.S.One))


def exchanged(sign: int = 1) -> Equation:
    """det(1 - FY) = det(1 - YF) for any two matrices; the argument mutates it."""
    one = sp.eye(3)
    text = "det(1 - FY) = det(1 - YF)" if sign > 0 else "det(1 - FY) = det(1 + YF)"
    return Equation(text, [determinant(one - S * Y)], [determinant(one - sign * Y * S)], Quotient((*S, *Y), []))


def steady_level(t_: sp.Expr) -> sp.Expr:
    """P: the part of (1 + t²)/(1 - t²) det ∂G/∂u that is constant on the circle, even in t."""
    m = I1 * I2 + t_**2 * (I1 - I3) * (I2 - I3)
    outer = D * (1 - c**2) * ((D + I3) * (I1 + I2) / 2 + D * I3 * c**2 + m)
    return outer + I3 * (D**2 * c**4 + D * (I1 + I2) * c**2 + m)


#: Q, the amplitude of the part that is not constant.
SWING = D * (D + I3) * (I1 - I2) / 2


def around(x_: sp.Expr, y_: sp.Expr, t_: sp.Expr) -> sp.Expr:
    """Re((1 - it)(x + iy)²)."""
    return x_**2 - y_**2 + 2 * t_ * x_ * y_


@claim(
    "steady-circles",
    r"u \parallel e_3,\ \gamma \not\parallel e_3,\ I_1 \ne I_2,\ D > 0,\ m\theta = p\pi,\ p \text{ odd},\ \gcd(m, p) = 1 \ \Rightarrow\ "
    r"\det D\Phi^{2m} = \Bigl(\frac{1 + z^{2m} + 2(-z)^m\cos m\psi}{1 + z^{2m} - 2(-z)^m\cos m\psi}\Bigr)^2,\ 0 < |z| < 1",
    uses=("steady", "small-branch", "step-determinant"),
)
def steady_circles(p: Proof) -> None:
    """Circles of periodic states on which volumes are not preserved, for every ball with D > 0: in closed form."""
    p.assume("|𝒦| below the bound of small-branch, |u| < 1")
    p.say(
        "Where u = te₃, each step turns the ball by θ = 2 arctan t about e₃ (steady), whatever γ is.  Of γ = (x, y, c) only",
        "x + iy = re^{iφ} changes, by e^{-iθ}: a circle of states on one level M, all back after 2m steps where mθ = pπ.",
    )
    axis, vertical = sp.Matrix([0, 0, t]), sp.Matrix([x, y, c])
    turned = turn(axis)
    p.lemma(Equation("after a step k is that of the same u", list((1 + t**2) ** 2 * half_momentum(axis, turned * vertical)),
                     list((1 + t**2) ** 2 * turned * half_momentum(axis, vertical)), STEADY))  # fmt: skip

    def steady(text: str, swing: sp.Expr) -> Equation:
        return Equation(text, [(1 + t**2) * determinant(slope(axis, vertical))],
                        [(1 - t**2) * (steady_level(t) + swing * around(x, y, t))], STEADY)  # fmt: skip

    p.printed(steady("(1 + t²) det 𝒜 = (1 - t²) f, f = P + Q Re((1 - it)(x + iy)²)", SWING))
    p.say(
        "with Q = ½D(D + I₃)(I₁ - I₂), and P a function of t² and c.  So f = P + Qr² cos(2φ - θ/2)/cos(θ/2), > 0 on the"
    )
    p.say("circle, as det 𝒜 > 0.  The step back has -t, and (x + iy)e^{-iθ}, e^{-iθ} = (1 - it)/(1 + it):")
    x1, y1, _ = turned * vertical
    cosine, sine = (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)
    half = cosine * around(x, y, t) + sine * (2 * x * y - t * (x**2 - y**2))
    p.printed(equation("Re((1 + it)(x + iy)²e^{-2iθ}) = Re(e^{-iθ}(1 - it)(x + iy)²)", around(x1, y1, -t), half))
    p.say(
        "so det DΦ at φ is f(φ - ½θ)/f(φ): the place half a step ahead.  f/P is (1 + z² + 2z cos ψ)/(1 + z²), ψ = 2φ - θ/2,",
        "0 < |z| < 1.  In m steps ψ takes m places that are 2π/m apart, as p and m may be taken coprime; with ω^m = 1",
        "Π(1 + z² + 2z cos(ψ + 2πj/m)) = |Π(1 + z e^{iψ}ω^j)|² = |1 - (-z)^m e^{imψ}|² = 1 + z^{2m} - 2(-z)^m cos mψ,",
        "and half a step ahead mψ is less by mθ = pπ: its cosine has the other sign.  So the determinant of m steps (and of",
        "2m, its square) is other than 1 but where cos mψ = 0.  A continuous positive density ϱ of an invariant measure,",
        "on M or on the phase space, would have ϱ(Φ^{2m}x) det DΦ^{2m} = ϱ(x), with Φ^{2m}x = x: there is none near such a",
        "circle on M.  In the phase space there is none near any steady circle with γ ∦ e₃, as such angles θ are dense.",
        "(For p even the determinant is 1: there the places half a step ahead are places of the orbit.)",
    )
    _example(p)
    p.control(steady("the same without Q", sp.S.Zero))
    p.control(equation("det DΦ = 1", around(x1, y1, -t), around(x, y, t)))


def _example(p: Proof) -> None:
    p.say(
        "Example, in Q(√2): J = (1, 2, 4), D = 1, θ = 45°, γ = (3, 4, 5)√2/10.  The product of det S by its definition:"
    )
    axis, vertical = sp.Matrix([0, 0, EXAMPLE[t]]), sp.Matrix([x, y, c])
    momentum = 2 * half_momentum(axis, START).subs(EXAMPLE)
    T, E = normal(turn(axis)), normal(turning(axis))
    states = [START]
    for _ in range(4):
        states.append(normal(T * states[-1]))
    made = [e.subs(EXAMPLE) for e in (*slope(axis, vertical), *by_turns(axis, vertical))]
    places = [placed((gamma, state)) for state in states[:4]]
    known = [normal(sp.Matrix([e.xreplace(at) for e in made])) for at in places]
    steps = [(sp.Matrix(3, 3, e[:9]), sp.Matrix(3, 3, e[9:])) for e in known]
    slopes = [normal(A.adjugate() * _inverse(normal(sp.Matrix([A.det()]))[0]) * G) for A, G in steps]
    changes = [normal(T - E * Y_) for Y_ in slopes]
    parts = [normal(sp.Matrix([determinant(S_)]))[0] for S_ in changes]
    product = normal(sp.Matrix([sp.prod(parts)]))[0]
    least, size, largest, slope_ = sp.symbols("i1 k i3 rho")
    facts = (
        at_root("|𝒦|² = 25/4 and ⟨𝒦, γ⟩ = 3/2", [momentum.dot(momentum), momentum.dot(START)], [sp.Rational(25, 4), sp.Rational(3, 2)]),
        Comparison("5/2 is below the bound of small-branch: ϱ < 3/4 as 5/6 < 24/25 = sin(2 arctan ¾), and ¾(½(6 - 3) + 5/2) = 3",
                   [size / least < 2 * slope_ / (1 + slope_**2), slope_ * ((largest - least) / 2 + size) <= least],
                   {size: "5/2", least: 3, largest: 6, slope_: "3/4"}),
        at_root("Ωᵀ and E", [*turn(axis), *turning(axis)], [*T, *E]),
        at_root("each state is Ωᵀ times the one before", _all(T * state for state in states[:4]), _all(states[1:])),
        at_root("after 4 steps γ has turned by π about e₃", states[4], sp.diag(-1, -1, 1) * START),
        at_root("𝒜 and 𝒢 at each step", [e.xreplace(at) for at in places for e in made], _all(known)),
        at_root("𝒜Y = 𝒢", _all(A * Y_ for (A, _), Y_ in zip(steps, slopes, strict=True)), _all(G for _, G in steps)),
        at_root("S = T - EY", _all(changes), _all(T - E * Y_ for Y_ in slopes)),
        at_root("the determinants of S, and their product", [*map(determinant, changes), sp.Mul(*parts, evaluate=False)], [*parts, product]),
        not_one("the product", product),
        at_root("it is Πf(φ - (j + ½)θ)/f(φ - jθ)", [by_formula(EXAMPLE)], [product]),
    )  # fmt: skip
    for fact in facts:
        p.lemma(fact)
    named = EXAMPLE | placed((gamma, START)) | {ROOT: sp.sqrt(2)}
    p.witness("J = (1, 2, 4), D = 1, θ = 45°", {str(name): str(value) for name, value in named.items()}, *facts[:2])
    p.show("\\det D\\Phi^4", product)
    p.control(at_root("the determinant of 4 steps is 1", [product], [1]))


def at_root(text: str, left: Sequence[sp.Expr], right: Sequence[sp.Expr | int]) -> Equation:
    """The equation left = right for r² = 2."""
    return in_field(text, [*left], [*right], SQUARE)


def not_one(text: str, value: sp.Expr) -> Equation:
    """The statement that a number of Q(√2) is not 1."""
    return at_root(f"{text} is not 1: the difference has an inverse", [(value - 1) * _inverse(value - 1)], [1])


def _inverse(of: sp.Expr) -> sp.Expr:
    """1/(a + br) for r² = 2."""
    return sp.invert(of, SQUARE, ROOT)


def normal(of: sp.Matrix) -> sp.Matrix:
    """The matrix with entries in the form a + br, r² = 2."""

    def reduced(entry: sp.Expr) -> sp.Expr:
        above, below = sp.fraction(sp.together(entry))
        return sp.rem(sp.expand(above * _inverse(sp.expand(below))), SQUARE, ROOT)

    return sp.Matrix(of).applyfunc(reduced)


def _all(matrices: Iterable[sp.Matrix]) -> list[sp.Expr]:
    """The entries of matrices."""
    return [entry for matrix in matrices for entry in matrix]


def by_formula(ball: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """Π f(φ - (j + ½)θ)/f(φ - jθ) for 4 steps from `START`, θ = 45°: (x + iy)² turned by multiples of e^{-iθ}."""
    at_start = ball | placed((gamma, START))
    P, Q = (sp.sympify(v).subs(at_start) for v in (steady_level(t), SWING))
    real = [v.subs(at_start) for v in (around(x, y, t), 2 * x * y - t * (x**2 - y**2))]
    value = sp.S.One
    for j in range(8):
        value = value / (P + Q * real[0]) if j % 2 == 0 else value * (P + Q * real[0])
        real = [*normal(ROOT / 2 * sp.Matrix([real[0] + real[1], real[1] - real[0]]))]
    return value


@claim(
    "periodic-orbits",
    r"\Phi^q(x) = x,\ W = D\Phi^q|_M,\ \varrho_R(\mathcal O) = \mathcal O \text{ for a } "
    r"\varrho_R(\mathcal K, \gamma) = -R(\mathcal K, \gamma) \ \Rightarrow\ \det W = 1,\ \det(1 - W) = 0",
    uses=("step-determinant", "reversible", "small-branch"),
)
def periodic_orbits(p: Proof) -> None:
    """The measures and integrals that one periodic orbit excludes, on its level, on all levels and for all balls near by."""
    p.say(
        "ϱ(Φ^q x) det DΦ^q = ϱ(x) at Φ^q(x) = x, ϱ(x) > 0, gives det W = 1; so it is for M and for the phase space.",
        "F∘Φ^q = F, F of class C¹ near the orbit: dF W = dF on T_xM, so dF = 0 there if 1 is no eigenvalue of W.  As then",
        "Φ^q(x) - x has a regular derivative on M, the implicit function theorem gives such an orbit, with det W ≠ 1 and",
        "det(1 - W) ≠ 0, for all |𝒦|², ⟨𝒦, γ⟩, J and D near by: an open set of the phase space is met.  In it a C¹ integral F",
        "has dF = f d|𝒦|² + g d⟨𝒦, γ⟩ along a surface of such points, so no third integral is independent of these there.",
        "If all eigenvalues of W are inside the unit circle, x attracts a neighbourhood on M: every continuous integral is",
        "constant on M there, and every finite invariant measure on that neighbourhood is carried by the orbit.",
        "A reversor ϱ_R(𝒦, γ) = -R(𝒦, γ), R = 1 or the rotation by π about a principal axis, keeps M.  If it maps the orbit",
        "to itself, W is similar to W⁻¹: det W = 1 (it is positive), and, as M has an odd dimension, 1 is an eigenvalue:",
    )
    entries = sp.symbols("W1:4(1:4)")
    map_of_three = sp.Matrix(3, 3, entries)
    whole, inverse = map_of_three.det(), map_of_three.adjugate().trace()  # W⁻¹ = adj W for det W = 1

    def unit(text: str, *relations: sp.Expr) -> Equation:
        return Equation(text, (sp.eye(3) - map_of_three).det(), 0, Quotient(entries, [whole - 1, *relations]))

    p.printed(
        unit("χ(1) = det(1 - W) = 0 where det W = 1 and tr W⁻¹ = tr W", sp.expand(inverse - map_of_three.trace()))
    )
    p.say(
        "So only orbits that no reversor keeps say something; on M they are the generic ones, and they come in pairs with"
    )
    p.say("reciprocal determinants.  `chapsym certify periodic-orbit` finds and encloses them.")
    p.control(unit("the same with another trace of W⁻¹"))


if __name__ == "__main__":
    main(__file__)
