"""The invariant curve of the reduced map in Jacobi's elliptic functions (Section 5, 5.6 to 5.13).

sn, cn, dn of one or two arguments are symbols modulo their relations; their derivatives and their values at 0 are
the only transcendental input (claim 5.13 derives the addition formulas from these).  Λ1 > Λ2 > Λ3 and
1/Λ2 < l < 1/Λ3, as the paper assumes.
"""

from functools import cache
from typing import NamedTuple

import sympy as sp

from .quotient import Quotient

L1, L2, L3, l, k2 = sp.symbols("L1 L2 L3 l k2")
LAMBDA = (L1, L2, L3)

#: The assumptions of the paper: 1/Λ1 < 1/Λ2 < l < 1/Λ3.
ORDER = (L1 > L2, L2 > L3, L3 > 0, L2 * l > 1, L3 * l < 1)
MODULUS = (k2 > 0, k2 < 1)


class Jacobi(NamedTuple):
    """sn, cn, dn of one argument."""

    sn: sp.Expr
    cn: sp.Expr
    dn: sp.Expr

    def relations(self) -> list[sp.Expr]:
        """cn² = 1 - sn², dn² = 1 - k² sn²."""
        return [self.cn**2 + self.sn**2 - 1, self.dn**2 + k2 * self.sn**2 - 1]


#: The argument u; the mean ū and the half increment δu of two consecutive arguments.
U = Jacobi(*sp.symbols("s c d"))
MEAN = Jacobi(*sp.symbols("sm cm dm"))
HALF = Jacobi(*sp.symbols("sh ch dh"))


@cache
def squared_amplitudes() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """C1², C2², C3² solved from |γ|² = 1, ⟨γ,Λ⁻¹γ⟩ = l with γ = (C1 cn, C2 sn, C3 dn), for every u.

    The two equations, each at sn² = 0 and 1, determine the three squares and k².
    """
    a, b, c, m = sp.symbols("a b c m")
    equations = []
    for square in (0, 1):
        terms = (a * (1 - square), b * square, c * (1 - m * square))
        equations += [sum(terms) - 1, sum(t / lam for t, lam in zip(terms, LAMBDA, strict=True)) - l]
    # Linear in a, b, c and the product c·m.
    product = sp.Symbol("cm_")
    linear = [sp.expand(e).subs(c * m, product) for e in equations]
    solution = sp.solve(linear, [a, b, c, product], dict=True)[0]
    return tuple(sp.factor(solution[x]) for x in (a, b, c))


@cache
def squared_modulus() -> sp.Expr:
    """k² of the curve: the value for which the coefficient of sn² in |γ|² vanishes."""
    first, second, third = squared_amplitudes()
    return sp.factor((second - first) / third)


def added(x: Jacobi, y: Jacobi, sign: int) -> Jacobi:
    """sn, cn, dn of x ± y by the addition formulas; sn is odd, cn and dn are even."""
    other = Jacobi(sign * y.sn, y.cn, y.dn)
    denominator = 1 - k2 * x.sn**2 * other.sn**2
    return Jacobi(
        (x.sn * other.cn * other.dn + other.sn * x.cn * x.dn) / denominator,
        (x.cn * other.cn - x.sn * other.sn * x.dn * other.dn) / denominator,
        (x.dn * other.dn - k2 * x.sn * other.sn * x.cn * other.cn) / denominator,
    )


def derivative(expr: sp.Expr, x: Jacobi) -> sp.Expr:
    """The derivative d/dx, from sn' = cn dn, cn' = -sn dn, dn' = -k² sn cn."""
    rates = (x.cn * x.dn, -x.sn * x.dn, -k2 * x.sn * x.cn)
    return sum(sp.diff(expr, f) * rate for f, rate in zip(x, rates, strict=True))


def ring(*arguments: Jacobi, amplitudes: tuple[sp.Symbol, ...] = ()) -> Quotient:
    """Q[sn, cn, dn, ..., k², Λ, l] modulo the relations of the arguments."""
    symbols = [symbol for argument in arguments for symbol in argument]
    relations = [relation for argument in arguments for relation in argument.relations()]
    return Quotient((*symbols, k2, *LAMBDA, l, *amplitudes), relations)


@cache
def level() -> sp.Expr:
    """l as a function of k², from `squared_modulus`: with this l, k² and Λ are independent variables."""
    return sp.factor(sp.solve(sp.numer(sp.together(squared_modulus() - k2)), l)[0])


def denominator() -> sp.Expr:
    """𝒟 = 1 - k² sn²ū sn²δu."""
    return 1 - k2 * MEAN.sn**2 * HALF.sn**2


@cache
def quarter_form(power: int) -> sp.Expr:
    """¼⟨γ+γ~, Λ^-power(γ+γ~)⟩ with γ = γ(ū - δu), γ~ = γ(ū + δu): Π1 and Π2 for power 1 and 2."""
    before, after = (added(MEAN, HALF, sign) for sign in (-1, 1))
    sums = [x + y for x, y in ((before.cn, after.cn), (before.sn, after.sn), (before.dn, after.dn))]
    squares = squared_amplitudes()
    return sum(c * s**2 / (4 * lam**power) for c, s, lam in zip(squares, sums, LAMBDA, strict=True))


def increment_parts() -> list[sp.Expr]:
    """k², the coefficients G₀ = V², G₁, G₂ of G = Π₂𝒟 + ... (5.14-G as corrected) in sn²δu, and μ, in terms of Λ, l.

    With them (5.15) as corrected reads hG𝒟 = 2Vw(𝒟 - D(l - μ sn²δu)), w = sn cn dn of δu.
    """
    modulus, y = squared_modulus(), sp.Symbol("y")
    first, second, third = (c / lam**2 for c, lam in zip(squared_amplitudes(), LAMBDA, strict=True))
    cosine, delta = 1 - y, 1 - modulus * y
    whole = sp.Poly(sp.cancel((first * cosine - second * cosine * delta) / modulus + third * delta), y)
    if whole.degree() != 2:
        raise ArithmeticError("G is not of degree 2 in sn² of the half increment")
    mean = squared_amplitudes()[1] / L2
    return [modulus, *(sp.factor(whole.coeff_monomial(y**i)) for i in range(3)), sp.factor(mean)]


def precession_parts() -> list[sp.Expr]:
    """P₀, P₁, N₀, N₁ in |b|² = P₀ + P₁ sn²u and ⟨b,Λ⁻¹b⟩ = N₀ + N₁ sn²u on the curve, b = γ × Λ⁻¹γ, in terms of Λ, l.

    Lemma `top-precession`: |b|² = ⟨γ,Λ⁻²γ⟩ - l² and det(Λ)⟨b,Λ⁻¹b⟩ = ⟨γ,Λγ⟩l - 1.
    """
    modulus, squares = squared_modulus(), squared_amplitudes()

    def parts(weights: list[sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        a, b, c = (x * square for x, square in zip(weights, squares, strict=True))
        return a + c, b - a - modulus * c

    inverse, direct = parts([1 / lam**2 for lam in LAMBDA]), parts(list(LAMBDA))
    whole = sp.prod(LAMBDA)
    found = [inverse[0] - l**2, inverse[1], (direct[0] * l - 1) / whole, direct[1] * l / whole]
    return [sp.factor(sp.cancel(x)) for x in found]
