"""Values of the symbols of these claims that satisfy the relations between them: see `chapsym.prove.witness`."""

from functools import cache

import sympy as sp

from chapsym.derive.quaternions import left, right
from chapsym.derive.words import matrix_symbols
from chapsym.prove import Examples

#: The commuting symbols: a rotation, a unit vertical, a physical ball (J ≥ 0, tr J ≤ D = mρ²; for Λ and h = 1 there is
#: one, too, with D from 21/5 to 5), the elliptic functions of one of its curves, and free symbols.
SCALARS = {
    **{"q0": "4/5", "q1": "2/5", "q2": "1/5", "q3": "2/5", "g1": "2/7", "g2": "3/7", "g3": "6/7"},
    **{"J1": "1", "J2": "5", "J3": "2", "D": "14", "m": "7/2", "rho": "2", "sigma": "484/25", "h": "5/2"},
    **{"K1": "1", "K2": "-1/2", "K3": "3/4", "w1": "1", "w2": "-1", "w3": "2", "v1": "1", "v2": "2", "v3": "-1"},
    **{"a1": "2", "a2": "1/3", "a3": "-1", "L1": "8", "L2": "7", "L3": "6", "l": "25/168", "k2": "9/16", "V": "1/42"},
    **{"u1": "1/2", "u2": "-1/3", "u3": "1/5", "k1": "1/2", "k3": "-2/3", "d1": "1/7", "d2": "1", "d3": "-2/5"},
    **{f"m{i}{j}": f"{3 * i - 2 * j + (i == j)}/2" for i in (1, 2, 3) for j in (1, 2, 3)},
    **{"W11": "2", "W22": "1/2", "W33": "1", "W12": "1", "W13": "-1", "W23": "3", "W21": "0", "W31": "0", "W32": "0"},
    **{"p0": "2", "p1": "1", "p2": "-1", "p3": "1/2"},
    **{"I1": "6", "I2": "5", "I3": "3", "t": "3/2", "v": "1/4", "H": "2"},
    **{"moment": "6", "stretch": "2", "n1": "1/3", "n2": "-2/3", "n3": "2/3", "speed": "3", "across": "5"},
    **{"sh": "4/5", "ch": "3/5", "dh": "4/5", "root": "15/16", "epsilon": "1/3", "e": "9/16"},
    **{"z": "2", "P0": "1/2", "P1": "1/3", "A1": "1/5", "A2": "-2", "M1": "3", "M2": "-5"},
    # A curve with rational amplitudes, and an argument on it.
    **{"l1": "50/37", "l2": "98/85", "l3": "1", "lv": "25/26", "kk": "1/6", "size1": "5/13", "size2": "7/13"},
    **{"size3": "12/13", "sn1": "24/25", "cn1": "7/25", "dn1": "23/25"},
    **{"b": "1/3", "alpha": "1/2", "beta": "2/3", "mu": "3/5", "x": "1/7"},
    **{"y": "4/9", "w": "1/2", "Dscr": "5/6", "G": "2", "lam": "1/3", "C1": "1/2", "C2": "2/3", "C3": "3/4"},
}

#: Substitutes, for relations that the values above do not satisfy.
OTHERS = {"r": "3/5", "w1": "1/2", "w2": "0", "w3": "0"}

#: The values of degenerate cases.  A case is tested if it contradicts none of the relations.
CASES: dict[str, dict[str, str]] = {
    "equal I": {"I1": "4", "I2": "4", "I3": "4"},
    "equal J": {"J1": "2", "J2": "2", "J3": "2"},
    "D = 0": {"D": "0"},
    "u = 0": {"u1": "0", "u2": "0", "u3": "0"},
    "q = 0": {"q0": "1", "q1": "0", "q2": "0", "q3": "0"},
    "ω = 0": {"w1": "0", "w2": "0", "w3": "0"},
}


@cache
def scalars() -> dict[str, sp.Rational]:
    """The numbers of the table, and those that follow from them."""
    table = {name: sp.Rational(value) for name, value in SCALARS.items()}
    k2, sn, cn, dn = (table[name] for name in ("k2", "sh", "ch", "dh"))
    twice = _elliptic_sum(k2, (sn, cn, dn), (sn, cn, dn))
    table |= dict(zip(("sm", "cm", "dm"), twice, strict=True))
    table |= dict(zip(("s", "c", "d"), _elliptic_sum(k2, twice, (sn, cn, dn)), strict=True))
    other = tuple(table[name] for name in ("sn1", "cn1", "dn1"))
    table |= dict(zip(("sn2", "cn2", "dn2"), _elliptic_sum(table["kk"], other, other), strict=True))
    table["p"], table["q"] = 1 / sn**2 - (1 + k2) / 3, -2 * cn * dn / sn**3  # Weierstrass ℘ and its derivative
    return table


def _elliptic_sum(k2: sp.Rational, x: tuple, y: tuple) -> tuple[sp.Rational, ...]:
    """sn, cn, dn of a sum, from those of its terms, by the addition formulas."""
    (s1, c1, d1), (s2, c2, d2) = x, y
    sums = (s1 * c2 * d2 + s2 * c1 * d1, c1 * c2 - s1 * s2 * d1 * d2, d1 * d2 - k2 * s1 * s2 * c1 * c2)
    return tuple(value / (1 - k2 * s1**2 * s2**2) for value in sums)


@cache
def _letters() -> dict[str, sp.Matrix]:
    """4 × 4 matrices for the letters of the words; rotations are Cayley transforms of skew matrices."""
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
    table["X"] = table["X^T"] = sp.eye(4) - 2 * table["Gamma"]  # for any matrix X: symmetric, and a rotation
    table["Y"] = table["Y^T"] = sp.diag(2, 1, 0, 3) + table["Gamma"]
    turn, spin, extra = ([scalars()[f"{x}{i}"] for i in (1, 2, 3)] for x in "qwa")
    table |= {"Q": left(scalars()["q0"], turn), "Q_bar": right(scalars()["q0"], [-x for x in turn])}
    table |= {"W": left(0, spin), "W_bar": right(0, spin), "A": left(0, extra), "Q_a": left(1, extra)}
    table["eps"] = sp.eye(4) / 3
    table["Lambda"] = sp.Matrix(4, 4, lambda i, j: i + j + i * j)
    return table


def _skew(*above: int) -> sp.Matrix:
    """The skew 4 × 4 matrix with the given entries above the diagonal, row by row."""
    matrix = sp.zeros(4, 4)
    for (i, j), value in zip([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)], above, strict=True):
        matrix[i, j], matrix[j, i] = value, -value
    return matrix


def _cayley(*above: int) -> sp.Matrix:
    generator = _skew(*above)
    return (sp.eye(4) - generator).inv() * (sp.eye(4) + generator)


def _cases() -> dict[str, dict[sp.Symbol, object]]:
    """The changed values of each degenerate case, by symbol."""
    one, zero = sp.eye(4), sp.zeros(4, 4)
    letters = {
        "equal J": {"J": 2 * one},
        "q = 0": dict.fromkeys(("Omega", "Omega^T"), one),
        "ω = 0": {"omega": zero, "omega_s": zero},
    }
    return {
        case: {sp.Symbol(name): sp.Rational(value) for name, value in changed.items()}
        | {matrix_symbols(name)[0]: value for name, value in letters.get(case, {}).items()}
        for case, changed in CASES.items()
    }


EXAMPLES = Examples(
    {sp.Symbol(name): value for name, value in scalars().items()},
    {matrix_symbols(name)[0]: value for name, value in _letters().items()},
    _cases(),
    {sp.Symbol(name): sp.Rational(value) for name, value in OTHERS.items()},
)
