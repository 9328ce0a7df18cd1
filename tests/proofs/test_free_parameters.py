"""The second routes: they take nothing from the first, and each side notices a slip of its own."""

import ast
from fractions import Fraction
from pathlib import Path

import flint
import mpmath
import numpy as np
import pytest

from chapsym import sources
from chapsym.derive import ball, three, vertical
from chapsym.derive.ball import D, Gamma, Omega, OmegaT
from chapsym.proofs import second_routes
from chapsym.proofs.paper import s5_increment
from chapsym.prove import load
from chapsym.prove.runner import judge, prove_one

CLAIMS = ("prop-1", "remark-3", "5.2", "prop-3", "prop-4", "5.15")


@pytest.mark.parametrize("id", CLAIMS)
def test_the_claim_has_a_second_route_and_controls_of_it(records, id):
    evidence = records[id]["evidence"]
    assert evidence["routes"]
    assert all(route["holds"] for route in evidence["routes"])
    assert any("in free parameters" in control["statement"] for control in evidence["controls"])
    methods = {c["method"] for c in evidence["checks"] if c["statement"].startswith("second route: ")}
    assert methods == {"python-flint polynomials, rational parameterisation"}


def test_the_second_routes_import_no_derivation_and_make_a_record_stale():
    tree = ast.parse(Path(second_routes.__file__).read_text(encoding="utf-8"))
    names = [a.name for node in ast.walk(tree) if isinstance(node, ast.Import) for a in node.names]
    names += [str(node.module) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    assert not [name for name in names if "derive" in name or "sympy" in name or "proofs" in name]
    assert "chapsym.proofs.second_routes" in sources.closure("chapsym.proofs.paper.s5_vertical")


def wrong_momentum(honest):
    return lambda: honest() - 2 * D * (Gamma * Omega - OmegaT * Gamma)


FIRST_ROUTE = {
    "prop-1": (ball, "carried", lambda honest: lambda expr: 2 * honest(expr)),
    "remark-3": (ball, "momentum", wrong_momentum),
    "5.2": (three, "momentum", lambda honest: lambda: -honest()),
    "prop-3": (vertical, "gamma_next", lambda honest: lambda: honest()[[1, 0, 2], :]),
    "prop-4": (vertical, "gamma_next", lambda honest: lambda: honest()[[1, 0, 2], :]),
    "5.15": (s5_increment, "W", lambda honest: 2 * honest),
}


@pytest.mark.usefixtures("uncertified")
@pytest.mark.parametrize("id", CLAIMS)
def test_a_slip_in_the_first_route_does_not_reach_the_second(monkeypatch, id):
    claims = load()
    place, name, slip = FIRST_ROUTE[id]
    monkeypatch.setattr(place, name, slip(getattr(place, name)))
    if id == "prop-4":
        monkeypatch.setattr(vertical, "total", lambda: vertical.gamma_now() + vertical.gamma_next())
    record = judge(claims[id]).record()
    assert record["verdict"] == "open"
    assert record["evidence"]["routes"]
    assert all(route["holds"] for route in record["evidence"]["routes"])


def naive(honest):
    return lambda before, after, vertical, rho, naive=False: honest(before, after, vertical, rho, not naive)


def wrong_last(honest):
    return lambda turn, J, vertical, D, last=1: honest(turn, J, vertical, D, -last)


def negated(honest):
    return lambda *arguments, **options: -honest(*arguments, **options)


def doubled(honest):
    return lambda *arguments, **options: 2 * honest(*arguments, **options)


def plus(honest):
    """sn²(x/2) = (1 + cn)/(1 + dn), by exchanging ũ + u and ũ - u."""
    return lambda self, sign: honest(self, -sign)


#: A slip, and claims whose second route takes that function; those after the first are judged by `--thorough`.
SECOND_ROUTE = {
    "the last sign of (4.13)": (second_routes, "momentum", wrong_last, ("prop-3", "remark-3", "5.15")),
    "a factor in (4.13)": (second_routes, "momentum_by_centre", doubled, ("5.2", "prop-1")),
    "the constraint": (second_routes, "centre_step", naive, ("prop-1",)),
    "the sign of the action": (second_routes, "action", negated, ("prop-1",)),
    "no rotation": (second_routes, "cayley", doubled, ("remark-3", "prop-4")),
    "off the sphere": (second_routes, "sphere", doubled, ("5.2", "5.15")),
    "no hat": (second_routes, "hat", negated, ("5.2",)),
    "the half argument": (second_routes.Increment, "half_square", plus, ("5.15",)),
    "the relation": (
        second_routes.Parts,
        "relation",
        lambda h: lambda self, D, sign=1: h(self, 2 * D, sign),
        ("5.15",),
    ),
    "σ": (second_routes.VerticalStep, "sigma", doubled, ("prop-4",)),
}


@pytest.mark.usefixtures("uncertified")
@pytest.mark.parametrize("slip", SECOND_ROUTE)
def test_a_slip_in_the_second_route_leaves_the_claim_open(monkeypatch, slip, thorough):
    place, name, mutate, ids = SECOND_ROUTE[slip]
    monkeypatch.setattr(place, name, mutate(getattr(place, name)))
    for id in ids if thorough else ids[:1]:
        record = prove_one(id)
        assert record["verdict"] == "open", id
        assert any(word in problem for problem in record["evidence"]["problems"] for word in ("second route", "raised"))


def at(ratio, **point):
    """A rational function where its parameters have rational values, as a Fraction."""
    names = ratio.numerator.context().names()
    exact = [flint.fmpq(x.numerator, x.denominator) for x in (Fraction(point[name]) for name in names)]
    quotient = ratio.numerator(*exact) / ratio.denominator(*exact)
    return Fraction(int(quotient.p), int(quotient.q))


def test_the_ball_that_is_solved_for_is_that_of_a_known_state():
    """J = (1,2,4), D = 1 and q = (4,2,1,2)/5, the state below 90° of prop-4: γ = left/σ, h = 164/35."""
    gamma = [Fraction(2 * x, 28 * 5) for x in (7 * 8 - 4, 6 * 4 + 12, 4 * 8 - 2)]
    assert sum(x**2 for x in gamma) == 1
    point = {"u1": "1/2", "u2": "1/4", "u3": "1/2", "D": 1, "h": "164/35"}
    point |= {"a": gamma[0] / (1 + gamma[2]), "b": gamma[1] / (1 + gamma[2])}
    step = second_routes.vertical_step()
    assert [at(x, **point) for x in step.gamma] == gamma
    assert [at(x, **point) for x in step.J] == [1, 2, 4]
    assert at(step.sigma(), **point) == Fraction(28, 5)
    assert at(step.cosine, **point) == 2 * Fraction(4, 5) ** 2 - 1


def test_the_parts_of_the_increment_are_jacobis_functions():
    """The rational formulas in γ, γ~ against mpmath's sn, cn, dn of ū and δu."""
    with mpmath.workdps(40):
        L1, L2, L3, l = mpmath.mpf(6), mpmath.mpf(5), mpmath.mpf(2), mpmath.mpf("0.3")
        squares = L1 * (1 - L3 * l) / (L1 - L3), L2 * (1 - L3 * l) / (L2 - L3), L3 * (L1 * l - 1) / (L1 - L3)
        C1, C2, C3 = map(mpmath.sqrt, squares)
        k2 = (L1 - L2) * (1 - L3 * l) / ((L2 - L3) * (L1 * l - 1))

        def jacobi(u):
            return [mpmath.ellipfun(name, u, m=k2) for name in ("sn", "cn", "dn")]

        def gamma(u):
            sn, cn, dn = jacobi(u)
            return np.array([C1 * cn, C2 * sn, C3 * dn])

        for before, after in [("0.3", "1.7"), ("-2.1", "0.4"), ("3.0", "2.2")]:
            u, v = mpmath.mpf(before), mpmath.mpf(after)
            pair = second_routes.Increment(gamma(u), gamma(v), np.array([L1, L2, L3]), mpmath.mpf(3))
            (sh, ch, dh), (sm, _, _) = jacobi((v - u) / 2), jacobi((v + u) / 2)
            V = -C2 * C3 / C1 * (L2 - L3) / (L2 * L3)
            parts = pair.parts
            wanted = {
                "y": sh**2,
                "scale": 1 - k2 * sm**2 * sh**2,
                "vw": V * sh * ch * dh,
                "level": l - (1 - L3 * l) / (L2 - L3) * sh**2,
            }
            for name, number in wanted.items():
                assert mpmath.almosteq(getattr(parts, name), number, mpmath.mpf(10) ** -35), name
            assert mpmath.almosteq(pair.modulus, k2, mpmath.mpf(10) ** -35)
            assert mpmath.almosteq(pair.half_square(+1), sm**2, mpmath.mpf(10) ** -35)
