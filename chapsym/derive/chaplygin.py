"""Chaplygin's variables of the continuous ball, the roots of N(μ) = Σ pᵢ²(Λᵢ - d)(1 - μΛⱼ)(1 - μΛₖ): their algebra."""

import sympy as sp

from .elliptic import L1, L2, L3
from .three import gamma

p = gamma
q = sp.Matrix(sp.symbols("q1:4"))
c, d, mu, nu = sp.symbols("c d mu nu")
LAMBDA = sp.diag(L1, L2, L3)
#: Λ - d: the moments of the reduced ball.
LIGHTER = LAMBDA - d * sp.eye(3)


def product(root: sp.Expr = mu) -> sp.Expr:
    """P(μ) = Π(1 - μΛᵢ)."""
    return (1 - root * L1) * (1 - root * L2) * (1 - root * L3)


def direction(root: sp.Expr = mu) -> sp.Matrix:
    """V(μ) = P(μ)(1 - μΛ)⁻¹(Λ - d)p, a vector of polynomials."""
    rest = ((L2, L3), (L1, L3), (L1, L2))
    weighted = LIGHTER * p
    return sp.Matrix([x * (1 - root * a) * (1 - root * b) for x, (a, b) in zip(weighted, rest, strict=True)])


def quadratic(root: sp.Expr = mu) -> sp.Expr:
    """N(μ) = ⟨p,V(μ)⟩."""
    return p.dot(direction(root))


def leading() -> sp.Expr:
    """g₂, the coefficient of μ² in N."""
    return sp.expand(quadratic()).coeff(mu, 2)


def momentum(x: sp.Matrix) -> sp.Matrix:
    """(Λ - dppᵀ)x, the momentum of the reduced ball."""
    return LAMBDA * x - d * p * p.dot(x)


def inverse_products() -> tuple[sp.Expr, sp.Expr]:
    """a = ⟨p,Λ⁻¹p⟩ and b = ⟨p,Λ⁻¹q⟩."""
    inverse = LAMBDA.inv()
    return p.dot(inverse * p), p.dot(inverse * q)
