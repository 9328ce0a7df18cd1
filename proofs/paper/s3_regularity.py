"""Section 3, Remark 2: the regularity matrix, for any system and for the ball near the diagonal."""

import sympy as sp

from chapsym.derive import continuous, principle, three
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, RING, D, gamma, placed, q, q0
from chapsym.prove import REAL, Comparison, Count, Equation, Fact, Proof, claim, equations, main

m, rho = sp.symbols("m rho")
BALL_RING = Quotient((m, rho, *RING.symbols), [*RING.relations, D - m * rho**2])
equation = equations(BALL_RING)
TURN = sp.eye(3)  # R_k = 1: the principle is invariant under rotations
AXES = [e.hat() for e in sp.eye(3).columnspace()]


def det(matrix: sp.Matrix) -> sp.Expr:
    """The determinant, by an algorithm without divisions."""
    return matrix.det(method="berkowitz")


def mixed_derivative(factor: sp.Expr, rotation: sp.Matrix) -> sp.Matrix:
    """D1 D2 of factor·Tr(R_k J R_{k+1}ᵀ) + (m/2)|Δr|² in (ξ, δr), for δR_k = R_kξ, δR_{k+1} = R_{k+1}η."""
    turning = sp.Matrix(3, 3, lambda i, j: factor * (AXES[i] * three.J * AXES[j].T * rotation.T).trace())
    return sp.diag(turning, -m * sp.eye(3))


def forms() -> sp.Matrix:
    """The forms of (4.2) as columns: δr + ρ ξγ in (ξ, δr)."""
    return sp.Matrix.vstack(*[sp.Matrix([list(rho * axis * gamma)]) for axis in AXES], sp.eye(3))


def constraint_derivative(rotation: sp.Matrix) -> sp.Matrix:
    """D2 of (4.9), Δr + (ρ/2)(Ω̄ - Ω̄ᵀ)γ, in (η, δr_{k+1})."""
    changes = [rho / 2 * (rotation * axis - (rotation * axis).T) * gamma for axis in AXES]
    return sp.Matrix.hstack(*changes, sp.eye(3))


def regularity_matrix(factor: sp.Expr, rotation: sp.Matrix) -> sp.Matrix:
    """The matrix of Remark 2 for the ball, 9 × 9."""
    upper = sp.Matrix.hstack(mixed_derivative(factor, rotation), forms())
    lower = sp.Matrix.hstack(constraint_derivative(rotation), sp.zeros(3, 3))
    return sp.Matrix.vstack(upper, lower)


def eliminated(factor: sp.Expr, rotation: sp.Matrix) -> sp.Matrix:
    """The matrix in (ξ, η) after elimination of the blocks ±1 and -m of r and of the multipliers."""
    matrix = regularity_matrix(factor, rotation)
    corner, side = matrix[3:, 3:], matrix[:3, 3:]
    return (matrix[:3, :3] - side * corner.inv() * matrix[3:, :3]).applyfunc(sp.expand)


def determinant(factor: sp.Expr, rotation: sp.Matrix) -> sp.Expr:
    """The determinant of the regularity matrix."""
    corner = regularity_matrix(factor, rotation)[3:, 3:]
    return det(corner) * det(eliminated(factor, rotation))


@claim(
    "remark-2",
    r"(q_{k-1},q_k)\mapsto(q_k,q_{k+1}) \text{ is well defined if } "
    r"\begin{pmatrix}D_1D_2L_d & A^1\cdots A^s\\ D_2\mathcal F_j & 0\end{pmatrix} \text{ is invertible near the diagonal}",
    ["3.5", "4.1", "4.9"],
)
def regularity(p: Proof) -> None:
    """The regularity matrix says that a successor is unique nearby, not that there is one; the ball is regular at rest."""
    p.infers("The theorem on implicit functions gives one successor near one that exists.")
    p.slips("reading")
    p.assume("L_d is 𝕃")
    p.assume("for the ball J_i + J_j > 0, D ≥ 0 (2.13)", *three.MOMENTS)
    p.say("The equations D1𝕃 + D2𝕃 - Σ λ_j A^j = 0, F_j = 0 have the derivative (D1D2𝕃, -A; D2F, 0) in (q_{k+1}, λ):")
    size, count = 3, 2
    second = sp.Matrix(size, size, sp.symbols("h1:10"))
    columns, rows = sp.Matrix(size, count, sp.symbols("A1:7")), sp.Matrix(count, size, sp.symbols("f1:7"))
    zero = sp.zeros(count, count)
    printed = sp.Matrix.vstack(sp.Matrix.hstack(second, columns), sp.Matrix.hstack(rows, zero))
    derivative = sp.Matrix.vstack(sp.Matrix.hstack(second, -columns), sp.Matrix.hstack(rows, zero))
    free = Quotient((*second, *columns, *rows))
    jacobian_is_printed = Equation(
        "det of the derivative = (-1)^s det of the matrix (n = 3, s = 2)",
        det(derivative),
        (-1) ** count * det(printed),
        free,
    )
    p.say(
        "Where a successor exists and the matrix is invertible, it is a function of (q_{k-1}, q_k) nearby, by the theorem on",
        "implicit functions.  That there is one does not follow: 𝕃 = ½ln(1 + u²) + 2x, u = y - x, without constraints, has",
        "D1D2𝕃 = -(1 - u²)/(1 + u²)² ≠ 0 for |u| < 1, and asks for w(u_k) = w(u_{k-1}) + 2 with w = u/(1 + u²), |w| ≤ ½.",
    )
    step, bound = sp.symbols("u w")
    slope, line = step / (1 + step**2), Quotient((step, bound))
    second_derivative = -sp.diff(slope, step)
    p.lemma(Equation("D1D2𝕃 = -(1-u²)/(1+u²)²", second_derivative, -(1 - step**2) / (1 + step**2) ** 2, line))
    p.lemma(
        Equation("½ - w = (1-u)²/(2(1+u²)) ≥ 0", sp.Rational(1, 2) - slope, (1 - step) ** 2 / (2 * (1 + step**2)), line)
    )
    square = 2 * (step - sp.Rational(1, 4)) ** 2 + sp.Rational(15, 8)
    p.lemma(Equation("2(1 + u²) - u = 2(u - ¼)² + 15/8 > 0", 2 * (1 + step**2) - step, square, line))
    before, scale = sp.symbols("b v")
    asked = sp.numer(sp.together(slope.subs(step, step / scale) - slope.subs(step, before) - 2))
    p.printed(
        Count(
            "Q = R, s = 0, 𝕃 = ½ln(1 + u²) + 2x, u = y - x, u_{k-1} = b: the number of real u_k = u/v",
            [asked], (scale, step), {before: 0}, [REAL >= 1], Quotient((before,)),
        )
    )  # fmt: skip
    p.under("there is a successor nearby, as Ω = 1 is one for the ball at rest", jacobian_is_printed)
    true, wrong = principle.kinetic_factor(), sp.Rational(1, 2)
    inertia = three.lam() - D * sp.eye(3)
    lifted = D * (sp.eye(3) - gamma * gamma.T)
    p.say("The ball, n = 3, on the diagonal (Ω = 1), with 𝕃 as corrected (c = -1) and as printed (c = ½):")
    at_rest = determinant(true, TURN)
    p.lemma(equation("c = -1: det = det(I + D(1 - γγᵀ))", at_rest, det(inertia + lifted)))
    p.lemma(equation("which is det Λ · F > 0", at_rest, det(three.lam()) * continuous.rolling_factor()))
    at_rest_as_printed = determinant(wrong, TURN)
    p.lemma(equation("c = ½: det = -det(½I - D(1 - γγᵀ))", at_rest_as_printed, -det(inertia / 2 - lifted)))
    homogeneous = {J1: 1, J2: 1, J3: 1, m: 1, rho: 1, D: 1, **placed((gamma, (0, 0, 1)))}
    singular, regular = (x.subs(homogeneous) for x in (at_rest_as_printed, at_rest))
    text = f"J = (1,1,1), m = ρ = 1, γ = e3: det = {singular} as printed, {regular} as corrected"
    p.lemma(Comparison(text, [sp.Eq(at_rest_as_printed, 0), at_rest > 0], homogeneous))
    p.say(
        "So with the printed Lagrangian the criterion fails at rest for some balls; with the true one it holds for every ball."
    )
    rotation = sp.Matrix(three.rotation())
    jacobian = sp.Matrix(three.tangent_jacobian()) / 2
    p.say("Away from the diagonal the determinant is that of ∂𝒦/∂Ω: regular exactly where 𝒦(q, γ) has no fold:")
    left = list(eliminated(true, rotation))
    p.lemma(equation("c = -1: the matrix with r and λ eliminated is -∂𝒦/∂Ω", left, -jacobian))
    turns = {"(3, 1, 1, -1)": (3, 1, 1, -1), "(1, 1, 1, -1)": (1, 1, 1, -1)}
    at = homogeneous | placed(((J1, J2, J3), (3, 2, 1)), (gamma, sp.Matrix([2, 3, 6]) / 7))
    signs = [det(_at_turn(jacobian, at, turn)) for turn in turns.values()]
    p.show("det ∂𝒦/∂Ω at Ω ~ (3,1,1,-1) and (1,1,1,-1), J = (3,2,1), D = 1, γ = (2,3,6)/7", signs)
    p.say(
        "It changes sign between these two turns (of degree 6 in the parameters, which are given up to their length):"
    )
    for (name, turn), sign in zip(turns.items(), signs, strict=True):
        relation = three.determinant(jacobian) > 0 if sign > 0 else three.determinant(jacobian) < 0
        p.lemma(Comparison(f"the sign at {name} is that of {sign}", [relation], at | placed(((q0, *q), turn))))
    p.witness("generic", {"J": "(1,1,1)", "m": "1", "ρ": "1", "γ": "e3", "Ω": "1"}, Fact("det > 0", regular > 0))
    p.control(equation("c = ½: det = det(I + D(1 - γγᵀ))", at_rest_as_printed, det(inertia + lifted)))
    p.control(Equation("det of the derivative = -det of the matrix, for s = 2", det(derivative), -det(printed), free))


def _at_turn(matrix: sp.Matrix, ball: dict, turn: tuple[int, ...]) -> sp.Matrix:
    """A matrix of forms of degree 2 in the Euler parameters, at a rotation given by parameters of any length."""
    values = ball | placed(((q0, *q), turn))
    return matrix.xreplace({x: sp.sympify(value) for x, value in values.items()}) / sum(c**2 for c in turn)


if __name__ == "__main__":
    main(__file__)
