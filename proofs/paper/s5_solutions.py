"""Section 5: how many rotations have a given momentum, counted exactly, and the one that is small."""

from collections.abc import Sequence

import sympy as sp
from sympy.core.relational import Relational

from chapsym.derive import solutions, three
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import RING, D, K, gamma, placed, q, q0
from chapsym.prove import (
    COMPLEX,
    COMPLEX_MULTIPLE,
    REAL,
    REAL_MULTIPLE,
    Comparison,
    Count,
    Equation,
    Fact,
    Proof,
    claim,
    main,
)

Vector = Sequence[int | str]

#: The ball and the vertical of the examples, and 𝒦 for each number of real solutions.
BALL, VERTICAL = (1, 2, 4), ("6/7", "2/7", "3/7")
WITHOUT_ROLLING: dict[int, Vector] = {0: (1, 1, 4), 1: (0, 0, 3), 2: (1, 1, 1), 3: (0, 0, 1), 4: ("1/2", "1/2", "1/2")}
ROLLING: dict[int, Vector] = {
    **{0: (2, 4, 6), 2: (1, 2, 1), 3: (2, 0, 0), 4: (1, 1, 1), 5: (0, 0, 1), 6: (0, 1, 1)},
    8: ("-1/4", "-3/2", "1/2"),
}
STRONG = 1000

SIGN = "Euler parameters that differ by a sign are one solution; q₀ ≥ 0, so that rotations by π count"
FINITE = "the solutions are finitely many, complex ones with them"
UNEQUAL = [sp.Ne(a, b) for a, b in ((three.J1, three.J2), (three.J2, three.J3), (three.J3, three.J1))]
NUMBER = "the number of real q with 𝒦 = K"
COUNTED = {"N": (REAL, "the number of real q with 𝒦(q, γ) = 𝒦, Euler parameters that differ by a sign as one")}


def count(
    text: str,
    contact: int,
    momentum: Vector,
    *relations: Relational,
    ball: Vector = BALL,
    vertical: Vector = VERTICAL,
    nonzero: Sequence[sp.Expr] = (),
) -> Count:
    """A statement on the number of solutions of (5.2), with the derived 𝒦(q, γ), for a ball, γ and 𝒦."""
    point = placed((three.MASSES, ball), ([D], [contact]), (gamma, vertical), (K, momentum))
    return Count(text, solutions.equations(), solutions.POINT, point, relations, RING, nonzero)


def example(contact: int, number: int) -> Count:
    """An example with this number of real solutions, of 8 with multiplicity; for even numbers none has q₀ = 0."""
    momentum = (ROLLING if contact else WITHOUT_ROLLING)[number]
    text = f"D = {contact}, 𝒦 = ({', '.join(map(str, momentum))}): {number}"
    odd = number % 2  # a fold: one solution is double
    relations = (sp.Eq(REAL, number), sp.Eq(COMPLEX, 8 - odd), sp.Eq(COMPLEX_MULTIPLE, 8))
    return count(text, contact, momentum, *relations, nonzero=[] if odd else [q0])


def homogeneous(text: str) -> Equation:
    """The statement that the equations are homogeneous of degree 2, with real coefficients."""
    scale = sp.Symbol("s")
    grown = [e.xreplace({x: scale * x for x in solutions.POINT}) for e in solutions.quadrics()]
    ring = Quotient((scale, *three.K, *RING.symbols))
    return Equation(text, grown, [scale**2 * e for e in solutions.quadrics()], ring)


def isotropic_points() -> tuple[Quotient, list[sp.Expr]]:
    """The ring and coordinates of the common points of the quadrics at D = 0 with q₀² + |q|² = 0."""
    lam = sp.symbols("L1:4")
    squares = [lam[j] * lam[k] * (lam[k] - lam[j]) for j, k in ((1, 2), (2, 0), (0, 1))]
    relations = [sp.expand(x**2 - c) for x, c in zip(q, squares, strict=True)]
    return Quotient((*q, *lam, *K), relations), [-q[0] * q[1] * q[2] / (lam[0] * lam[1] * lam[2]), *q]


@claim(
    "5.3-at-most-4",
    r"\text{for real } \mathcal K \text{ and } \gamma:\ N\le4,\ N \text{ the number of the real solutions } \mathbf q "
    r"\text{ of the equations (5.2)}",
    uses=["5.2"],
)
def upper_bound(p: Proof) -> None:
    """At most 8 real solutions if they are finitely many and the J differ, and 8 occur; then at most 4 when D = 0."""
    p.infers(
        "Bézout: three quadrics have at most 8 common points, if finitely many; at D = 0 four of them are not real."
    )
    p.slips("serious")
    p.assume(SIGN)
    p.assume(FINITE)
    p.assume("J1, J2, J3 differ", *UNEQUAL)
    p.say("𝒦(q, γ) - 𝒦(q₀² + |q|²) = 0 are three quadrics in P³: at most 8 points if finitely many (Bézout).")
    p.reads(COUNTED)
    p.printed(count(NUMBER, STRONG, ROLLING[8], REAL <= 4))
    points, isotropic = isotropic_points()
    spin = sp.Matrix(isotropic[1:])
    lam = sp.diag(*points.symbols[3:6])
    flat = 2 * (isotropic[0] * lam * spin + spin.cross(lam * spin))
    p.say("At D = 0 four of the 8 points are on q₀² + |q|² = 0 whatever 𝒦 is, hence not real:")
    p.say("q_i² = Λ_jΛ_k(Λ_k - Λ_j), q₀ = -q₁q₂q₃/(Λ₁Λ₂Λ₃); different Λ's give four of them up to sign.")
    p.corrected(
        r"\text{if the three } J_i \text{ differ and the solutions are finitely many, complex ones with them: "
        r"at most 8 real solutions, and at most 4 where } D \text{ is 0}",
        homogeneous("the three equations are homogeneous of degree 2"),
        Equation("D = 0: 2(q₀Λq + q×Λq) = 0 at those points", flat, [sp.S.Zero] * 3, points),
        Equation("and q₀² + |q|² = 0", isotropic[0] ** 2 + spin.dot(spin), 0, points),
        example(STRONG, 8),
        example(0, 4),
    )
    p.say("Where J1 = J2 there is no bound: at 𝒦 = 0 every rotation by π about an axis across the third is a solution.")
    across = Quotient(RING.symbols, [q0, q[2]])
    third = [sp.S.Zero, sp.S.Zero, 2 * (three.J1 - three.J2) * q[0] * q[1]]
    momentum = list(three.momentum())
    p.lemma(Equation("q₀ = q3 = 0: 𝒦(q, γ) = (0, 0, 2(J1 - J2)q1q2), whatever γ and D", momentum, third, across))
    p.control(Equation("the same without 𝒦_3", momentum, [sp.S.Zero] * 3, across))
    p.say("Every number from 0 to 4 occurs without rolling, and with it 0, 2, 3, 4, 5, 6, 8, all for one ball and γ.")
    p.say("No solution of the even examples is a rotation by π: all of them have q₀ > 0.")
    p.lemma(*(example(0, number) for number in (0, 1, 2, 3)))
    p.lemma(*(example(STRONG, number) for number in (0, 2, 3, 4, 5, 6)))
    p.control(count("no solution of 𝒦 = 0 is a rotation by π", STRONG, (0, 0, 0), sp.Eq(REAL, 4), nonzero=[q0]))
    p.say("An odd number has a double solution in it, a fold, as 8 and 4 are even; 7 occurs at another vertical:")
    seven = (sp.Eq(REAL, 7), sp.Eq(REAL_MULTIPLE, 8), sp.Eq(COMPLEX, 7))
    p.lemma(count("D = 100, 𝒦 = (-2, 0, 0): 7, one double", 100, (-2, 0, 0), *seven, vertical=(0, "3/5", "4/5")))
    p.lemma(count("D = 0, and the 𝒦 of the 8: at most 4", 0, ROLLING[8], REAL <= 4))
    p.control(count("the example with 8 has at most 6", STRONG, ROLLING[8], REAL <= 6))
    wrong = 2 * (-isotropic[0] * lam * spin + spin.cross(lam * spin))
    p.control(Equation("the isotropic points with +q₀", wrong, [sp.S.Zero] * 3, points))


@claim(
    "5.3-at-least-2",
    r"\text{for real } \mathcal K \text{ and } \gamma:\ N\ge2,\ N \text{ the number of the real solutions } \mathbf q "
    r"\text{ of the equations (5.2)}",
    uses=["5.2", "5.3-at-most-4"],
)
def lower_bound(p: Proof) -> None:
    """There may be none, even on an orbit; when there is one, there are two, with multiplicity."""
    p.infers(
        "Bézout: three quadrics have 8 common points with multiplicity, if finitely many; those that are not real come in pairs."
    )
    p.slips("serious")
    p.assume(SIGN)
    p.assume(FINITE)
    p.assume("J1, J2, J3 differ", *UNEQUAL)
    p.say("|𝒦| = 2|q₀Bq + q×Λq| ≤ 2Λmax |q|(|q₀| + |q|) ≤ (1 + √2)Λmax: a larger momentum has no rotation.")
    p.say("A ball of matter inside its surface has D = mρ² ≥ J1 + J2 + J3.  Such a ball, too, has such momenta:")
    large = (40, 0, 0)
    largest = three.lam()[0, 0]
    at = placed(((*three.MASSES, D), (*BALL, 7)), (K, large))
    p.lemma(
        Comparison(
            "|𝒦| = 40 is above 5/2 Λmax = 65/2 there",
            [K.dot(K) > sp.Rational(25, 4) * largest**2, *(largest >= x for x in three.lam().diagonal())],
            at,
        )
    )
    p.reads(COUNTED)
    p.printed(count(NUMBER, 7, large, REAL >= 2))
    p.say("It happens on orbits with D > 0: one step after a state that has a rotation, there may be none.")
    p.say("J = (1, 2, 3), D = 7, γ = (1, 2, 2)/3, Euler parameters ~ (4, 2, 4, -1):")
    ball, before, turn = (1, 2, 3), ("1/3", "2/3", "2/3"), (4, 2, 4, -1)
    momentum, vertical = solutions.after(ball, 7, before, turn)
    state = placed(((*three.MASSES, D), (*ball, 7)), (gamma, before), (solutions.POINT, turn))
    turned = three.rotation().T
    carried = [sp.Eq(a, b * solutions.NORM**2) for a, b in zip(turned * three.momentum(), momentum, strict=True)]
    carried += [sp.Eq(a, b * solutions.NORM) for a, b in zip(turned * gamma, vertical, strict=True)]
    p.lemma(Comparison("Ωᵀ𝒦 and Ωᵀγ are the 𝒦 and γ of the next step", carried, state))
    p.show("𝒦 after the step", momentum)
    p.show("γ after the step", vertical)
    p.printed(
        count(
            f"{NUMBER}, one step after γ = (1, 2, 2)/3 and Euler parameters ~ (4, 2, 4, -1)",
            7,
            momentum,
            REAL >= 2,
            ball=ball,
            vertical=vertical,
        )
    )
    p.say("Bézout: the quadrics have 8 common points with multiplicity (at D = 0 four of them are not rotations).")
    p.say("Their coefficients are real, so the non-real points come in conjugate pairs: one solution is never alone.")
    single = WITHOUT_ROLLING[1]
    double = (sp.Eq(REAL, 1), sp.Eq(REAL_MULTIPLE, 2))
    p.under(
        "𝒦 = 𝒦(Ω, γ) for some rotation Ω, and solutions counted with multiplicity",
        homogeneous("three quadrics with real coefficients"),
        count("the one solution of 𝒦 = (0, 0, 3), D = 0, is double", 0, single, *double),
        count("2 solutions of 𝒦 = (1, 1, 1), D = 0", 0, WITHOUT_ROLLING[2], sp.Eq(REAL, 2)),
    )
    p.say("At 𝒦 = 0 the solutions are 1 and the rotations by π about the axes; only one has the paper's q₀ > 0.")
    p.lemma(count("4 real solutions at 𝒦 = 0", STRONG, (0, 0, 0), sp.Eq(REAL, 4)))
    p.control(count("at least 1 at 𝒦 = (40, 0, 0), D = 7", 7, large, REAL >= 1))
    p.control(count("the one solution of 𝒦 = (0, 0, 3), D = 0, is simple", 0, single, sp.Eq(REAL_MULTIPLE, 1)))


@claim("5.3-small", r"\text{only one of the real solutions } \mathbf q \text{ is small}", uses=["5.2"])
def small_solution(p: Proof) -> None:
    """One solution is small, tan(θ/2) ≤ r = 2Imin/(9Λmax), when |𝒦| ≤ Imin²/(4Λmax); never more than one."""
    p.infers("Estimates of norms, which use the three identities, and the theorem on contractions (Banach).")
    p.assume(
        "small means |u| ≤ r = 2Imin/(9Λmax), u = q/q₀, |u| = tan(θ/2); Imin > 0 is the least of J2+J3, J1+J3, J1+J2"
    )
    u, v = sp.Matrix(sp.symbols("u1:4")), sp.Matrix(sp.symbols("v1:4"))
    ring = Quotient((*u, *v, *K, *RING.symbols), [three.UNIT_VERTICAL])
    inertia, lam = sp.Matrix(three.contact_inertia()), three.lam()

    def balance(x: sp.Matrix) -> sp.Matrix:
        """(5.2) divided by q₀², with 1/q₀² = 1 + |u|²."""
        return 2 * (inertia * x + x.cross(lam * x)) - K * (1 + x.dot(x))

    mean, apart = (u + v) / 2, u - v
    p.say("(5.2) is 2(Bu + u×Λu) = 𝒦(1 + |u|²), B = Λ - Dγγᵀ. For two solutions u, v with s = (u+v)/2, d = u - v:")
    in_parameters = balance(u).xreplace(placed((u, q / q0)))
    state = Quotient((*K, *RING.symbols), RING.relations)
    p.lemma(Equation("that is (5.2)", in_parameters * q0**2, sp.Matrix(three.momentum()) - K, state))
    linear = inertia * apart + mean.cross(lam * apart) + apart.cross(lam * mean) - K * mean.dot(apart)
    p.printed(Equation("the difference is 2(Bd + s×Λd + d×Λs - 𝒦⟨s,d⟩)", balance(u) - balance(v), 2 * linear, ring))
    central = lam - D * sp.eye(3)
    form = apart.dot(inertia * apart) - apart.dot(central * apart)
    p.lemma(Equation("⟨d,Bd⟩ = ⟨d,Id⟩ + D|γ×d|²", form, D * gamma.cross(apart).dot(gamma.cross(apart)), ring))
    p.say(
        "So |Bd| ≥ Imin|d|, while |s×Λd + d×Λs| ≤ 2Λmax|s||d| and |𝒦| ≤ (5/2)Λmax: Imin|d| ≤ (9/2)Λmax|s||d|.",
        "Two different u, v with |u|, |v| ≤ r have |s| < r, a contradiction: two small solutions are one.",
        "There is one: u ↦ B⁻¹(½𝒦(1+|u|²) - u×Λu) maps |u| ≤ r into itself and contracts there, as |B⁻¹| ≤ 1/Imin and,",
        "with ρ = Imin/Λmax ≤ 1, |𝒦| ≤ ρ²Λmax/4, r = 2ρ/9, its values are below (ρ/8)(1+r²) + r²/ρ and its slope below",
        "(|𝒦|r + 2Λmax r)/Imin ≤ (2/9)(ρ²/4 + 2).  These are below r and 1, as the differences are sums of positive terms:",
    )
    ratio, radius = sp.Symbol("r"), sp.Rational(2, 9)
    line, r = Quotient((ratio,)), radius * ratio
    values, slope = ratio / 8 * (1 + r**2) + r**2 / ratio, radius * (ratio**2 / 4 + 2)
    p.printed(
        Equation(
            "r - (ρ/8)(1+r²) - r²/ρ = ρ(27 + 4(1-ρ²))/648", r - values, ratio * (27 + 4 * (1 - ratio**2)) / 648, line
        ),
        Equation("1 - (2/9)(ρ²/4 + 2) = (9 + (1-ρ²))/18", 1 - slope, (9 + (1 - ratio**2)) / 18, line),
    )
    bound = sp.Rational(2 * 3, 9 * (6 + 3))
    tiny = sp.Matrix([1, -1, 1]) / 40
    values = placed((u, tiny), (K, (0, 0, 0)), (gamma, sp.Matrix([2, 3, 6]) / 7))
    values |= placed(((three.J1, three.J2, three.J3, D), (1, 2, 4, 3)))
    reached = balance(u).subs(values) / (1 + tiny.dot(tiny))
    p.witness(
        "generic",
        {"J": "(1, 2, 4)", "D": "3", "γ": "(2/7, 3/7, 6/7)", "u": "(1, -1, 1)/40", "𝒦": str(list(reached))},
        Fact("|u| is below the bound", tiny.dot(tiny) < bound**2),
        Fact("u solves (5.2)", balance(u).subs(values | placed((K, reached))).is_zero_matrix),
    )
    p.control(
        Equation("the same with d×Λs dropped", balance(u) - balance(v), 2 * (linear - apart.cross(lam * mean)), ring),
        Equation("⟨d,Bd⟩ = ⟨d,Id⟩", form, 0, ring),
        Fact(
            "the ball r = 2/9 is mapped into itself when |𝒦| ≤ Λmax",
            sp.Rational(1, 2) * (1 + radius**2) + radius**2 < radius,
        ),
    )


if __name__ == "__main__":
    main(__file__)
