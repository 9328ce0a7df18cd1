"""The second routes: they take nothing from the first, and each side notices a slip of its own."""

import ast
from pathlib import Path

import pytest
from budget import slow

from chapsym import sources
from chapsym.derive import ball, three
from chapsym.derive.ball import D, Gamma, Omega, OmegaT
from chapsym.proofs import second_routes
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
}


@pytest.mark.usefixtures("uncertified")
@pytest.mark.parametrize("id", [*(id for id in FIRST_ROUTE if id != "prop-1"), *slow("prop-1")])
def test_a_slip_in_the_first_route_does_not_reach_the_second(monkeypatch, id):
    claims = load()
    place, name, slip = FIRST_ROUTE[id]
    monkeypatch.setattr(place, name, slip(getattr(place, name)))
    record = judge(claims[id]).record()
    assert record["verdict"] == "open"
    assert record["evidence"]["routes"]
    assert all(route["holds"] for route in record["evidence"]["routes"])


def naive(honest):
    return lambda before, after, vertical, rho, naive=False: honest(before, after, vertical, rho, not naive)


def doubled(honest):
    return lambda *arguments, **options: 2 * honest(*arguments, **options)


#: A slip, and claims whose second route takes that function; those after the first are judged by `--thorough`.
SECOND_ROUTE = {
    "the last sign of (4.13)": (
        second_routes,
        "momentum",
        lambda honest: lambda turn, J, vertical, D, last=1: honest(turn, J, vertical, D, -last),
        ("prop-3", "remark-3", "5.15"),
    ),
    "a factor in (4.13)": (second_routes, "momentum_by_centre", doubled, ("5.2", "prop-1")),
    "the constraint": (second_routes, "centre_step", naive, ("prop-1",)),
    "no rotation": (second_routes, "cayley", doubled, ("remark-3", "prop-4")),
}


@pytest.mark.usefixtures("uncertified")
@pytest.mark.parametrize(
    "slip", [*(slip for slip in SECOND_ROUTE if slip != "the constraint"), *slow("the constraint")]
)
def test_a_slip_in_the_second_route_leaves_the_claim_open(monkeypatch, slip, thorough):
    place, name, mutate, ids = SECOND_ROUTE[slip]
    monkeypatch.setattr(place, name, mutate(getattr(place, name)))
    for id in ids if thorough else ids[:1]:
        record = prove_one(id)
        assert record["verdict"] == "open", id
        assert any(word in problem for problem in record["evidence"]["problems"] for word in ("second route", "raised"))
