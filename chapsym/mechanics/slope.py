"""Derivatives of equations by unknowns, in steps: of what they share, each is computed once."""

from collections.abc import Sequence

import sympy as sp

from .algebra import Letters

#: Named values, in order.
Steps = list[tuple[list[sp.Symbol], list[sp.Expr]]]


def shared(expressions: Sequence[sp.Expr]) -> tuple[dict[sp.Symbol, sp.Expr], list[sp.Expr]]:
    """What some expressions have in common, by the names s0, s1, ..., and the expressions by these names."""
    terms, rest = sp.cse(list(expressions), symbols=sp.numbered_symbols("s"), order="none")
    return dict(terms), rest


def differentiated(
    residual: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], letters: Letters
) -> tuple[Steps, list[sp.Expr], Steps, list[sp.Expr]]:
    """The steps and the results of equations, and those of their derivatives, row by row; d0, d1, ... are of these."""
    terms, rest = shared(residual)
    meanings, rates, done = letters.meanings, dict[tuple[sp.Symbol, sp.Symbol], sp.Expr](), dict(terms)

    def derivative(expr: sp.Expr, x: sp.Symbol) -> sp.Expr:
        names = expr.free_symbols
        found = sp.diff(expr, x) if x in names else sp.S.Zero
        for name in sorted(names & (terms.keys() | meanings.keys()), key=str):
            if (rate := rate_of(name, x)) != 0:
                found += sp.diff(expr, name) * rate
        return found

    def rate_of(name: sp.Symbol, x: sp.Symbol) -> sp.Expr:
        if (name, x) not in rates:
            of = derivative(terms[name], x) if name in terms else letters.rate(name, meanings[name], x)
            if not of.is_Atom and not (-of).is_Atom:
                symbol = sp.Symbol(f"d{len(rates)}")
                done[symbol] = of
                of = symbol
            rates[name, x] = of
        return rates[name, x]

    slope = [derivative(e, x) for e in rest for x in unknowns]
    return _steps(terms, rest), rest, _steps(done, slope), slope


def _steps(terms: dict[sp.Symbol, sp.Expr], results: Sequence[sp.Expr]) -> Steps:
    """Those terms that the results need, in order."""
    wanted = set().union(*(e.free_symbols for e in results))
    kept: Steps = []
    for name in reversed(terms):
        if name in wanted:
            kept.append(([name], [terms[name]]))
            wanted |= terms[name].free_symbols
    return kept[::-1]
