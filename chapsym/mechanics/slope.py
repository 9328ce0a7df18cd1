"""Derivatives of equations by unknowns, in steps: shared parts are computed once."""

from collections.abc import Mapping, Sequence

import sympy as sp

from .algebra import Letters

#: Named values, in order.
Terms = dict[sp.Symbol, sp.Expr]


def shared(expressions: Sequence[sp.Expr]) -> tuple[Terms, list[sp.Expr]]:
    """The common parts of some expressions, by the names s0, s1, ..., and the expressions by these names."""
    terms, rest = sp.cse(list(expressions), symbols=sp.numbered_symbols("s"), order="none")
    return dict(terms), rest


def differentiated(
    terms: Terms, results: Sequence[sp.Expr], unknowns: Sequence[sp.Symbol], letters: Letters
) -> tuple[Terms, list[sp.Expr]]:
    """The derivatives of results that have terms in common, row by row, with d0, d1, ... for the rates of these."""
    meanings, rates, done = letters.meanings, dict[tuple[sp.Symbol, sp.Symbol], sp.Expr](), dict(terms)

    def rate(name: sp.Symbol, x: sp.Symbol) -> sp.Expr:
        if name not in terms and name not in meanings:
            return sp.S.Zero
        if (name, x) not in rates:
            of = letters.derivative(terms[name], x, rate) if name in terms else letters.rate(name, x)
            if not of.is_Atom and not (-of).is_Atom:
                symbol = sp.Symbol(f"d{len(rates)}")
                done[symbol] = of
                of = symbol
            rates[name, x] = of
        return rates[name, x]

    slope = [letters.derivative(e, x, rate) for e in results for x in unknowns]
    return done, slope


def needed(terms: Mapping[sp.Symbol, sp.Expr], results: Sequence[sp.Expr]) -> Terms:
    """The terms that the results need, and those that these need, in order."""
    wanted = set().union(*(e.free_symbols for e in results))
    for name in reversed([*terms]):
        if name in wanted:
            wanted |= terms[name].free_symbols
    return {name: e for name, e in terms.items() if name in wanted}
