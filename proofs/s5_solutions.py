"""Section 5: how many rotations have a given momentum, counted exactly, and the one that is small."""

from collections.abc import Iterable

import sympy as sp

from chapsym.derive import solutions, three
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import RING, D, K, gamma, q, q0
from chapsym.prove import Equation, Fact, Proof, claim, main

#: The ball and the vertical of the examples, and 𝒦 with the number of real solutions, each counted below.
BALL, VERTICAL = (1, 2, 4), ("6/7", "2/7", "3/7")
WITHOUT_ROLLING = {0: (0, 0, 4), 1: (0, 0, 3), 2: (0, 0, 2), 3: (0, 0, 1), 4: ("1/2", "1/2", "1/2")}
ROLLING = {
    0: (2, 4, 6),
    2: (0, 0, 4),
    3: (2, 0, 0),
    4: (1, 1, 1),
    5: (0, 0, 1),
    6: (0, 1, 0),
    8: (0, -2, 0),
}
STRONG = 1000

REAL = "Euler parameters that differ by a sign are one solution; q₀ ≥ 0, so that rotations by π count"
FINITE = "the solutions are finitely many, and J1, J2, J3 differ"


def examples(contact: int, momenta: Iterable[tuple]) -> dict[tuple, solutions.Count]:
    """The exact counts for some momenta."""
    return {momentum: solutions.count(solutions.at(BALL, contact, VERTICAL, momentum)) for momentum in momenta}


def show(p: Proof, contact: int, counts: dict[tuple, solutions.Count]) -> None:
    """A line for each example."""
    for momentum, found in counts.items():
        shown = ", ".join(map(str, momentum))
        p.say(
            f"    D = {contact}, 𝒦 = ({shown}): {found.real} real solutions of {found.distinct} complex ones (Sturm, Hermite)"
        )


def all_counts() -> tuple[dict[tuple, solutions.Count], dict[tuple, solutions.Count]]:
    """The examples without and with rolling."""
    return examples(0, WITHOUT_ROLLING.values()), examples(STRONG, ROLLING.values())


def isotropic_points() -> tuple[Quotient, list[sp.Expr]]:
    """The ring and coordinates of the common points of the quadrics at D = 0 with q₀² + |q|² = 0."""
    lam = sp.symbols("L1:4")
    squares = [lam[j] * lam[k] * (lam[k] - lam[j]) for j, k in ((1, 2), (2, 0), (0, 1))]
    relations = [sp.expand(x**2 - c) for x, c in zip(q, squares, strict=True)]
    return Quotient((*q, *lam, *K), relations), [-q[0] * q[1] * q[2] / (lam[0] * lam[1] * lam[2]), *q]


@claim(
    "5.3-at-most-4",
    r"\text{for real } \mathcal K, \gamma \text{ the equations (5.2) have at most 4 real solutions } \mathbf q",
    uses=["5.2"],
)
def upper_bound(p: Proof) -> None:
    """At most 8 real solutions, and 8 occur; at most 4 only when D = 0."""
    p.assume(REAL)
    p.assume(FINITE)
    p.say("𝒦(q, γ) - 𝒦(q₀² + |q|²) = 0 are three quadrics in P³: at most 8 points if finitely many (Bézout).")
    quadrics = solutions.quadrics()
    scale = sp.Symbol("s")
    ring = Quotient((scale, *three.K, *RING.symbols))
    grown = [e.subs({x: scale * x for x in solutions.POINT}, simultaneous=True) for e in quadrics]
    free, rolling = all_counts()
    p.say(f"J = {BALL}, γ = (6/7, 2/7, 3/7); the eliminant is counted over Q:")
    show(p, 0, free)
    show(p, STRONG, rolling)
    most = max(c.real for c in rolling.values())
    p.printed(Fact("no example has more than 4", most <= 4, "real roots of the eliminant over Q, and Hermite's form"))
    points, isotropic = isotropic_points()
    spin = sp.Matrix(isotropic[1:])
    lam = sp.diag(*points.symbols[3:6])
    flat = 2 * (isotropic[0] * lam * spin + spin.cross(lam * spin))
    p.say("At D = 0 four of the 8 points are on q₀² + |q|² = 0 whatever 𝒦 is, hence not real:")
    p.say("q_i² = Λ_jΛ_k(Λ_k - Λ_j), q₀ = -q₁q₂q₃/(Λ₁Λ₂Λ₃); different Λ's give four of them up to sign.")
    p.corrected(
        r"\text{at most 8 real solutions, and at most 4 if } D = 0",
        Equation("the three equations are homogeneous of degree 2", grown, [scale**2 * e for e in quadrics], ring),
        Equation("D = 0: 2(q₀Λq + q×Λq) = 0 at those points", list(flat), [sp.S.Zero] * 3, points),
        Equation("and q₀² + |q|² = 0", [isotropic[0] ** 2 + spin.dot(spin)], [sp.S.Zero], points),
        Fact("all examples obey these bounds", most <= 8 and max(c.real for c in free.values()) <= 4),
    )
    worst = ROLLING[8]
    state = {"J": "(1, 2, 4)", "D": str(STRONG), "γ": "(6/7, 2/7, 3/7)", "𝒦": str(worst).replace("'", "")}
    p.refute(state, "the number of real solutions", rolling[worst].real, "at most 4")
    for wanted, found in ((WITHOUT_ROLLING, free), (ROLLING, rolling)):
        p.lemma(
            Fact(f"every number of {sorted(wanted)} occurs", sorted(c.real for c in found.values()) == sorted(wanted))
        )
    p.say("An odd number has a double solution in it, a fold, as 8 and 4 are even; 7 occurs at another vertical:")
    other = solutions.count(solutions.at(BALL, 100, (0, "3/5", "4/5"), (-2, 0, 0)))
    p.lemma(Fact("D = 100, γ = (0, 3/5, 4/5), 𝒦 = (-2, 0, 0): 7 real solutions, one double", other[:3] == (7, 7, 8)))
    p.witness("8 solutions", state, Fact("8 real solutions", rolling[worst].real == 8))
    p.witness(
        "D = 0",
        {**state, "D": "0"},
        Fact("at most 4", solutions.count(solutions.at(BALL, 0, VERTICAL, worst)).real <= 4),
    )
    p.control(Fact("no example has more than 6", most <= 6))
    p.control(
        Equation(
            "the isotropic points with +q₀",
            list(2 * (-isotropic[0] * lam * spin + spin.cross(lam * spin))),
            [sp.S.Zero] * 3,
            points,
        )
    )


@claim(
    "5.3-at-least-2",
    r"\text{for real } \mathcal K, \gamma \text{ the equations (5.2) have at least 2 real solutions } \mathbf q",
    uses=["5.2", "5.3-at-most-4"],
)
def lower_bound(p: Proof) -> None:
    """There may be none, even on an orbit; when there is one, there are two, with multiplicity."""
    p.assume(REAL)
    p.assume(FINITE)
    p.say("|𝒦| = 2|q₀Bq + q×Λq| ≤ 2Λmax |q|(|q₀| + |q|) ≤ (1 + √2)Λmax: a larger momentum has no rotation.")
    free, rolling = all_counts()
    least = min(c.real for c in (*free.values(), *rolling.values()))
    p.printed(
        Fact("every example has at least 2", least >= 2, "real roots of the eliminant over Q, and Hermite's form")
    )
    p.say(
        "The 8 points (at D = 0: the other 4) with multiplicity are the roots of an eliminant with real coefficients,"
    )
    p.say("and the non-real ones come in pairs: the number of real ones is even, so one solution is never alone.")
    even = all(solutions.multiplicity(c) % 2 == 0 for c in (*free.values(), *rolling.values()))
    p.under(
        r"\mathcal K = \mathcal K(\Omega,\gamma) for some rotation, solutions counted with multiplicity",
        Fact("the eliminants have the degree 8", all(c.degree == 8 for c in (*free.values(), *rolling.values()))),
        Fact("their numbers of real roots with multiplicity are even", even),
    )
    state = {"J": "(1, 2, 4)", "D": "0", "γ": "(6/7, 2/7, 3/7)", "𝒦": "(0, 0, 4)"}
    p.refute(state, "the number of real solutions", free[WITHOUT_ROLLING[0]].real, "at least 2")
    p.say("It happens on orbits with D > 0: one step after a state that has a rotation, there may be none.")
    momentum, vertical = solutions.after((3, 2, 1), 1, ("-4/9", "-7/9", "4/9"), (3, -1, 3, 0))
    p.show("𝒦 after the step", momentum)
    p.show("γ after the step", vertical)
    stopped = solutions.count(solutions.at((3, 2, 1), 1, vertical, momentum)).real
    orbit = {"J": "(3, 2, 1)", "D": "1", "γ": "(-4/9, -7/9, 4/9)", "Ω": "Euler parameters ~ (3, -1, 3, 0)"}
    p.refute(orbit, "the number of real solutions after one step", stopped, "at least 2")
    p.say("At 𝒦 = 0 the solutions are 1 and the rotations by π about the axes: 4, of which one has q₀ > 0.")
    rest = solutions.count(solutions.at(BALL, STRONG, VERTICAL, (0, 0, 0)))
    p.lemma(Fact("4 real solutions at 𝒦 = 0", rest.real == 4))
    p.lemma(
        Fact(
            "the one solution of 𝒦 = (0, 0, 3), D = 0, is double", solutions.multiplicity(free[WITHOUT_ROLLING[1]]) == 2
        )
    )
    p.witness("2 solutions", state | {"𝒦": "(0, 0, 2)"}, Fact("two solutions", free[WITHOUT_ROLLING[2]].real == 2))
    p.control(Fact("every example has at least 1", least >= 1))
    p.control(Fact("the number of different real solutions is even", all(c.real % 2 == 0 for c in free.values())))


@claim("5.3-small", r"\text{only one of the real solutions } \mathbf q \text{ is small}", uses=["5.2"])
def small_solution(p: Proof) -> None:
    """At most one solution is small: tan(θ/2) < 2 Imin/(9 Λmax), Imin the least of J2+J3, J1+J3, J1+J2."""
    p.assume("Imin > 0; small means |u| < 2Imin/(9Λmax), where u = q/q₀ and |u| = tan(θ/2)")
    u, v = sp.Matrix(sp.symbols("u1:4")), sp.Matrix(sp.symbols("v1:4"))
    ring = Quotient((*u, *v, *K, *RING.symbols), [three.UNIT_VERTICAL])
    inertia, lam = sp.Matrix(three.contact_inertia()), three.lam()

    def balance(x: sp.Matrix) -> sp.Matrix:
        """(5.2) divided by q₀², with 1/q₀² = 1 + |u|²."""
        return 2 * (inertia * x + x.cross(lam * x)) - K * (1 + x.dot(x))

    mean, apart = (u + v) / 2, u - v
    p.say("(5.2) is 2(Bu + u×Λu) = 𝒦(1 + |u|²), B = Λ - Dγγᵀ. For two solutions u, v with s = (u+v)/2, d = u - v:")
    in_parameters = balance(u).subs(dict(zip(u, q / q0, strict=True)), simultaneous=True)
    state = Quotient((*K, *RING.symbols), RING.relations)
    p.lemma(Equation("that is (5.2)", list(in_parameters * q0**2), list(sp.Matrix(three.momentum()) - K), state))
    linear = inertia * apart + mean.cross(lam * apart) + apart.cross(lam * mean) - K * mean.dot(apart)
    p.printed(
        Equation(
            "the difference is 2(Bd + s×Λd + d×Λs - 𝒦⟨s,d⟩)", list(balance(u) - balance(v)), list(2 * linear), ring
        )
    )
    central = lam - D * sp.eye(3)
    form = apart.dot(inertia * apart) - apart.dot(central * apart)
    p.lemma(Equation("⟨d,Bd⟩ = ⟨d,Id⟩ + D|γ×d|²", [form], [D * gamma.cross(apart).dot(gamma.cross(apart))], ring))
    p.say("So |Bd| ≥ Imin|d|, while |s×Λd + d×Λs| ≤ 2Λmax|s||d| and |𝒦| ≤ (5/2)Λmax: Imin|d| ≤ (9/2)Λmax|s||d|.")
    p.say(
        "With |u|, |v| < 2Imin/(9Λmax) so is |s|, and d = 0: two small solutions are one. The ball's own Ω is there when small."
    )
    bound = sp.Rational(2 * 3, 9 * (6 + 3))
    tiny = sp.Matrix([1, -1, 1]) / 40
    values = dict(zip((*u, *K), (*tiny, 0, 0, 0), strict=True))
    values |= dict(
        zip(
            (three.J1, three.J2, three.J3, D, *gamma),
            (1, 2, 4, 3, *map(sp.Rational, ("2/7", "3/7", "6/7"))),
            strict=True,
        )
    )
    reached = balance(u).subs(values) / (1 + tiny.dot(tiny))
    p.witness(
        "generic",
        {"J": "(1, 2, 4)", "D": "3", "γ": "(2/7, 3/7, 6/7)", "u": "(1, -1, 1)/40", "𝒦": str(list(reached))},
        Fact("|u| is below the bound", tiny.dot(tiny) < bound**2),
        Fact("u solves (5.2)", balance(u).subs({**values, **dict(zip(K, reached, strict=True))}).is_zero_matrix),
    )
    p.control(
        Equation(
            "the same with d×Λs dropped",
            list(balance(u) - balance(v)),
            list(2 * (linear - apart.cross(lam * mean))),
            ring,
        )
    )
    p.control(Equation("⟨d,Bd⟩ = ⟨d,Id⟩", [form], [sp.S.Zero], ring))


if __name__ == "__main__":
    main(__file__)
