"""Exact witnesses: points at which the hypotheses of a statement hold, and what it says there.

One table gives every symbol of the derivations a rational value, or a rational 4 × 4 matrix, chosen so
that the relations between them hold.  A statement that was proved is evaluated there: this shows
that its hypotheses can hold, and checks the decision by arithmetic that shares nothing with it.  The
same is done in the degenerate cases that a statement allows (equal J, no rolling, no rotation).
"""

from collections.abc import Collection, Mapping, Sequence
from functools import cache
from typing import Any

import sympy as sp

from chapsym.derive.quaternions import left, right
from chapsym.derive.quotient import Quotient
from chapsym.derive.words import Traces, WordAlgebra, evaluate

from .statements import Comparison, Equation

#: The commuting symbols: a turn, a unit vertical, a ball of matter (J ≥ 0, tr J ≤ D = mρ²; for Λ and h = 1 there is
#: one, too, with D from 21/5 to 5), the elliptic functions of a curve of it, and free ones.
SCALARS = {
    **{"q0": "4/5", "q1": "2/5", "q2": "1/5", "q3": "2/5", "g1": "2/7", "g2": "3/7", "g3": "6/7"},
    **{"J1": "1", "J2": "5", "J3": "2", "D": "14", "m": "7/2", "rho": "2", "sigma": "484/25", "h": "5/2"},
    **{"K1": "1", "K2": "-1/2", "K3": "3/4", "w1": "1", "w2": "-1", "w3": "2", "v1": "1", "v2": "2", "v3": "-1"},
    **{"a1": "2", "a2": "1/3", "a3": "-1", "L1": "8", "L2": "7", "L3": "6", "l": "25/168", "k2": "9/16", "V": "1/42"},
    **{"u1": "1/2", "u2": "-1/3", "u3": "1/5", "k1": "1/2", "k3": "-2/3", "d1": "1/7", "d2": "1", "d3": "-2/5"},
    **{f"m{i}{j}": f"{3 * i - 2 * j + (i == j)}/2" for i in (1, 2, 3) for j in (1, 2, 3)},
    **{"p0": "2", "p1": "1", "p2": "-1", "p3": "1/2"},
    **{"I1": "6", "I2": "5", "I3": "3", "t": "3/2", "v": "1/4", "H": "2"},
    **{"moment": "6", "stretch": "2", "n1": "1/3", "n2": "-2/3", "n3": "2/3", "speed": "3", "across": "5"},
    **{"sh": "4/5", "ch": "3/5", "dh": "4/5", "root": "15/16", "epsilon": "1/3", "e": "9/16"},
    **{"z": "2", "P0": "1/2", "P1": "1/3", "A1": "1/5", "A2": "-2", "M1": "3", "M2": "-5"},
    **{"b": "1/3", "alpha": "1/2", "beta": "2/3", "mu": "3/5", "x": "1/7"},
    **{"y": "4/9", "w": "1/2", "Dscr": "5/6", "G": "2", "lam": "1/3", "C1": "1/2", "C2": "2/3", "C3": "3/4"},
}

#: What makes a case degenerate.  A case is looked at where it contradicts none of the relations.
CASES: dict[str, dict[str, str]] = {
    "generic": {},
    "equal I": {"I1": "4", "I2": "4", "I3": "4"},
    "equal J": {"J1": "2", "J2": "2", "J3": "2"},
    "D = 0": {"D": "0"},
    "u = 0": {"u1": "0", "u2": "0", "u3": "0"},
    "q = 0": {"q0": "1", "q1": "0", "q2": "0", "q3": "0"},
    "ω = 0": {"w1": "0", "w2": "0", "w3": "0"},
}


def look(equations: Sequence[Equation], assumed: Sequence[Comparison] = ()) -> tuple[list[dict[str, Any]], list[str]]:
    """Evaluates the equations at every case; returns the witnesses found and the statements that fail there.

    A statement with a zero denominator in a case, or off a hypothesis, is not made there, and does not count.
    """
    found: dict[str, dict[str, Any]] = {}
    wrong = []
    for equation in equations:
        for case in CASES:
            point = _point(equation, case)
            if point is None or not allowed(point, assumed) or (truth := true_at(equation, point)) is None:
                continue
            if not truth:
                wrong.append(f"{equation.text} ({case})")
            seen = found.setdefault(case, {"name": case, "point": {}, "statements": 0})
            seen["point"] |= shown(equation, point)
            seen["statements"] += 1
    return list(found.values()), wrong


def allowed(point: Mapping[sp.Symbol, Any], assumed: Sequence[Comparison]) -> bool:
    """Whether the hypotheses hold of which the point has the symbols."""
    return all(h.true_at(point) for h in assumed if h.symbols <= point.keys())


def _point(equation: Equation, case: str) -> dict[sp.Symbol, Any] | None:
    """The values of the symbols of the equation's algebra in a case; None where it does not apply."""
    algebra = equation.algebra
    if isinstance(algebra, Quotient):
        return _rational(algebra.symbols, algebra.relations, case)
    if isinstance(algebra, Traces):
        algebra = algebra.algebra
    if isinstance(algebra, WordAlgebra):
        symbols = {x for side in (*equation.left, *equation.right) for x in side.free_symbols}
        return matrices(symbols, algebra, case)
    return None


def _rational(
    symbols: Sequence[sp.Symbol], relations: Sequence[sp.Expr], case: str
) -> dict[sp.Symbol, sp.Rational] | None:
    changed = CASES[case]
    names = {symbol.name for symbol in symbols}
    if not names <= scalars().keys() or (changed and not names & changed.keys()):
        return None
    point = {symbol: sp.Rational(changed.get(symbol.name, scalars()[symbol.name])) for symbol in symbols}
    return point if all(relation.xreplace(point) == 0 for relation in relations) else None


def matrices(symbols: set[sp.Symbol], algebra: WordAlgebra, case: str = "generic") -> dict[sp.Symbol, Any] | None:
    """Matrices for the letters, numbers for the parameters; the rules and transposes must be true of them."""
    degenerate = _degenerate_matrices(case)
    given = {x.name: value for x, value in algebra.example.items()}
    symbols = symbols | set(algebra.transposes) | {x for pair in algebra.rules for x in pair}
    letters, free = {x for x in symbols if not x.is_commutative}, {x for x in symbols if x.is_commutative}
    names = {x.name for x in symbols}
    matrices, numbers = _letters() | given, scalars() | given
    if not {x.name for x in letters} <= matrices.keys() or not {x.name for x in free} <= numbers.keys():
        return None
    if case != "generic" and not names & (degenerate.keys() | CASES[case].keys()):
        return None
    point: dict[sp.Symbol, Any] = {x: degenerate.get(x.name, matrices[x.name]) for x in letters}
    point |= {x: sp.Rational(CASES[case].get(x.name, numbers[x.name])) for x in free}
    sound = all(_same(evaluate(image, point), point[x].T) for x, image in algebra.transposes.items())
    sound = sound and all(
        _same(point[a] * point[b], v if v.is_number else evaluate(v, point)) for (a, b), v in algebra.rules.items()
    )
    return point if sound else None


def true_at(equation: Equation, point: dict[sp.Symbol, Any]) -> bool | None:
    """Whether both sides agree at a point; None where a denominator vanishes."""
    if isinstance(equation.algebra, Quotient):
        left, right = ([e.xreplace(point) for e in side] for side in (equation.left, equation.right))
        if any(value.has(sp.nan, sp.zoo, sp.oo) for value in (*left, *right)):
            return None
        return all(a == b for a, b in zip(left, right, strict=True))
    if isinstance(equation.algebra, Traces):
        left, right = equation.at(lambda e: evaluate(e, point))
        return left == right
    pairs = zip(equation.left, equation.right, strict=True)
    return all(_same(evaluate(a, point), evaluate(b, point)) for a, b in pairs)


def _same(a: Any, b: Any) -> bool:
    """Equality of matrices; a number stands for its multiple of the identity (0 for any zero matrix)."""
    if isinstance(a, sp.MatrixBase) and isinstance(b, sp.MatrixBase):
        return bool(a.shape == b.shape and a == b) or (
            1 in a.shape and 1 in b.shape and a.is_zero_matrix and b.is_zero_matrix
        )
    if isinstance(b, sp.MatrixBase):
        a, b = b, a
    if isinstance(a, sp.MatrixBase):
        return bool(a.is_zero_matrix if b == 0 else a.is_square and a == b * sp.eye(a.rows))
    return bool(a == b)


def values_of(symbols: Collection[sp.Symbol]) -> dict[sp.Symbol, Any]:
    """The values that the table has for some symbols: numbers, and matrices for letters."""
    return {x: scalars()[x.name] if x.is_commutative else _letters()[x.name] for x in symbols}


@cache
def scalars() -> dict[str, sp.Rational]:
    """The numbers of the table, with those that follow from others."""
    table = {name: sp.Rational(value) for name, value in SCALARS.items()}
    k2, sn, cn, dn = (table[name] for name in ("k2", "sh", "ch", "dh"))
    twice = _elliptic_sum(k2, (sn, cn, dn), (sn, cn, dn))
    table |= dict(zip(("sm", "cm", "dm"), twice, strict=True))
    table |= dict(zip(("s", "c", "d"), _elliptic_sum(k2, twice, (sn, cn, dn)), strict=True))
    table["p"], table["q"] = 1 / sn**2 - (1 + k2) / 3, -2 * cn * dn / sn**3  # Weierstrass' function and derivative
    return table


def _elliptic_sum(k2: sp.Rational, x: tuple, y: tuple) -> tuple[sp.Rational, ...]:
    """sn, cn, dn of a sum, from those of its terms."""
    (s1, c1, d1), (s2, c2, d2) = x, y
    sums = (s1 * c2 * d2 + s2 * c1 * d1, c1 * c2 - s1 * s2 * d1 * d2, d1 * d2 - k2 * s1 * s2 * c1 * c2)
    return tuple(value / (1 - k2 * s1**2 * s2**2) for value in sums)


@cache
def _letters() -> dict[str, sp.Matrix]:
    """Matrices of size 4 for the letters of the words: turns are Cayley transforms of skew matrices."""
    skew = {
        "omega": _skew(1, -2, 1, 3, 0, 2),
        "alpha": _skew(0, 1, 2, -1, 1, 1),
        "eta": _skew(2, 1, 0, 1, -1, 3),
        "xi": _skew(1, 1, -1, 2, 0, 1),
        "K": _skew(1, 0, 2, -1, 3, 1),
        "omega_s": _skew(1, 0, -1, 2, 1, 1),
        "A_step": _skew(1, 2, 0, -1, 1, 2),
    }
    turns = {
        "R_-": _cayley(1, 0, 1, 0, 0, 1),
        "R": _cayley(0, 1, 0, 1, 1, 0),
        "R_+": _cayley(1, 1, 0, 0, 1, 0),
        "Omega": _cayley(1, 0, 0, 1, 0, 1),
        "S": _cayley(1, 1, 1, 0, 0, 0),
    }
    columns = {
        **{"gamma": (1, 1, 1, 1), "r_-": (0, 2, 4, 2), "r": (2, 2, 0, 4), "r_+": (4, 0, 2, 2)},
        **{"dr": (2, -2, 4, 0), "f": (2, 4, -2, 6), "v": (2, 0, 4, 2), "a": (4, 2, -2, 0), "F": (0, 2, 2, 4)},
    }
    table = {**skew, **turns, **{name: sp.Matrix(entries) / 2 for name, entries in columns.items()}}
    table["dR"] = sp.Matrix(4, 4, range(16))
    table |= {f"{name}^T": table[name].T for name in (*turns, *columns, "dR")}
    table["gamma_k"] = table["gamma"]
    table["J"], table["Gamma"] = sp.diag(1, 2, 4, 5), table["gamma"] * table["gamma"].T
    table["X"] = table["X^T"] = sp.eye(4) - 2 * table["Gamma"]  # any matrix, a symmetric one, a rotation
    table["Y"] = table["Y^T"] = sp.diag(2, 1, 0, 3) + table["Gamma"]
    turn, spin, extra = ([scalars()[f"{x}{i}"] for i in (1, 2, 3)] for x in "qwa")
    table |= {"Q": left(scalars()["q0"], turn), "Q_bar": right(scalars()["q0"], [-x for x in turn])}
    table |= {"W": left(0, spin), "W_bar": right(0, spin), "A": left(0, extra), "Q_a": left(1, extra)}
    table["eps"] = sp.eye(4) / 3
    table["Lambda"] = sp.Matrix(4, 4, lambda i, j: i + j + i * j)
    return table


def _degenerate_matrices(case: str) -> dict[str, sp.Matrix]:
    one, zero = sp.eye(4), sp.zeros(4, 4)
    return {
        "equal J": {"J": 2 * one},
        "q = 0": dict.fromkeys(("Omega", "Omega^T"), one),
        "ω = 0": {"omega": zero, "omega_s": zero},
    }.get(case, {})


def _skew(*above: int) -> sp.Matrix:
    """The skew 4 × 4 matrix with the given entries above the diagonal, row by row."""
    matrix = sp.zeros(4, 4)
    for (i, j), value in zip([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)], above, strict=True):
        matrix[i, j], matrix[j, i] = value, -value
    return matrix


def _cayley(*above: int) -> sp.Matrix:
    generator = _skew(*above)
    return (sp.eye(4) - generator).inv() * (sp.eye(4) + generator)


def shown(equation: Equation, point: dict[sp.Symbol, Any]) -> dict[str, str]:
    """The values of the symbols that occur in the equation, by name."""
    used = set().union(*(e.free_symbols for e in (*equation.left, *equation.right)))
    values = {str(symbol): value for symbol, value in point.items() if symbol in used}
    return {
        name: str(value.tolist() if isinstance(value, sp.MatrixBase) else value)
        for name, value in sorted(values.items())
    }
