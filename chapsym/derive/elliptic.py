"""The invariant curve of the reduced map in Jacobi's functions (Section 5, 5.6 to 5.13).

sn, cn, dn of one or two arguments are symbols modulo their relations; the addition formulas are the
only transcendental input.  Λ1 > Λ2 > Λ3 and 1/Λ2 < l < 1/Λ3, as the paper assumes.
"""

from typing import NamedTuple

import sympy as sp

from .quotient import Quotient

L1, L2, L3, l, k2 = sp.symbols("L1 L2 L3 l k2")
LAMBDA = (L1, L2, L3)


class Jacobi(NamedTuple):
    """sn, cn, dn of one argument."""

    sn: sp.Expr
    cn: sp.Expr
    dn: sp.Expr

    def relations(self) -> list[sp.Expr]:
        """cn² = 1 - sn², dn² = 1 - k² sn²."""
        return [self.cn**2 + self.sn**2 - 1, self.dn**2 + k2 * self.sn**2 - 1]


#: The argument u; the mean ū and the half increment δu of two consecutive ones.
U = Jacobi(*sp.symbols("s c d"))
MEAN = Jacobi(*sp.symbols("sm cm dm"))
HALF = Jacobi(*sp.symbols("sh ch dh"))


def squared_amplitudes() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """C1², C2², C3² solved from |γ|² = 1, ⟨γ,Λ⁻¹γ⟩ = l with γ = (C1 cn, C2 sn, C3 dn), for every u.

    Two equations, each at two values of sn² (0 and 1), for the three squares and k².
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


def squared_modulus() -> sp.Expr:
    """k² of the curve: what makes the coefficient of sn² in |γ|² vanish."""
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


def ring(*arguments: Jacobi, amplitudes: tuple[sp.Symbol, ...] = ()) -> Quotient:
    """Q[sn, cn, dn, ..., k², Λ, l] modulo the relations of the arguments."""
    symbols = [symbol for argument in arguments for symbol in argument]
    relations = [relation for argument in arguments for relation in argument.relations()]
    return Quotient((*symbols, k2, *LAMBDA, l, *amplitudes), relations)


def level() -> sp.Expr:
    """l as a function of k²: the modulus solved for it.  With it k² is free and nothing else is tied."""
    return sp.factor(sp.solve(sp.numer(sp.together(squared_modulus() - k2)), l)[0])


def denominator() -> sp.Expr:
    """𝒟 = 1 - k² sn²ū sn²δu."""
    return 1 - k2 * MEAN.sn**2 * HALF.sn**2


def quarter_form(power: int) -> sp.Expr:
    """¼⟨γ+γ~, Λ^-power(γ+γ~)⟩ with γ = γ(ū - δu), γ~ = γ(ū + δu): Π1 and Π2 for power 1 and 2."""
    before, after = (added(MEAN, HALF, sign) for sign in (-1, 1))
    sums = [x + y for x, y in ((before.cn, after.cn), (before.sn, after.sn), (before.dn, after.dn))]
    squares = squared_amplitudes()
    return sum(c * s**2 / (4 * lam**power) for c, s, lam in zip(squares, sums, LAMBDA, strict=True))
