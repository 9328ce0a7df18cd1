"""Volumes that exact motions keep: what is known of systems, and densities against the divergence in numbers."""

import dataclasses
from itertools import pairwise

import mpmath as mp
import pytest
import sympy as sp
from systems import a, example, va, vx, vy, vz, x, y, z

from chapsym.mechanics import BadSystem, Quaternion, System, conserved, flag, volume

KEPT = ["ball", "contact", "falling_disc", "particle", "snakeboard", "transmission", "veselova", "vertical_disc"]


def sleigh(ahead, potential=0, forces=None, constraint=0):
    """A sleigh with its centre of mass ahead of the blade."""
    centre = vx - ahead * sp.sin(a) * va, vy + ahead * sp.cos(a) * va
    energy = (centre[0] ** 2 + centre[1] ** 2 + va**2) / 2 - potential
    return System("sleigh", (x, y, a), energy, [sp.sin(a) * vx - sp.cos(a) * vy + constraint], forces=forces or {})


def divergence(system, found, density):
    """Of the motion at a state, with the rate of the logarithm of the density: 0 where that is kept; in 30 digits.

    The coordinates of the places are all but the one that a holonomic constraint determines.
    """
    numbers = {s: sp.Rational(str(v)) for s, v in system.parameters.items()}
    matrix, right = system.equations
    q, v, by = system.coordinates, system.velocities, found.by
    own = [i for i in range(len(q)) if not system.holonomic or i < len(q) - 1]
    given = [*(q[i] for i in own), *by]
    of = [sp.lambdify((q, v), e.xreplace(numbers), "mpmath") for e in (matrix, right, system.rows)]
    slopes = [sp.diff(c, q[-1]) for c in system.holonomic]
    weigh = sp.lambdify([q], sp.log(sp.Abs(density / sp.prod(slopes))).xreplace(numbers), "mpmath")

    def full(point):
        place = dict(zip(given, point, strict=True))
        if system.holonomic:  # a unit quaternion
            place[q[-1]] = mp.sqrt(1 - sum(place[s] ** 2 for s in q[-4:-1]))
        at = [place[s] for s in q]
        rows = of[2](at, [0] * len(q))
        bound = [i for i in range(len(q)) if v[i] not in by]
        known = mp.matrix(
            [sum(rows[r, i] * place[v[i]] for i in range(len(q)) if v[i] in by) for r in range(rows.rows)]
        )
        solved = mp.lu_solve(mp.matrix([[rows[r, i] for i in bound] for r in range(rows.rows)]), -known)
        place |= {v[i]: s for i, s in zip(bound, solved, strict=True)}
        return at, [place[s] for s in v]

    def rates(point):
        at, moving = full(point)
        solved = mp.lu_solve(of[0](at, moving), of[1](at, moving))
        return [*(moving[i] for i in own), *(solved[v.index(s)] for s in by)]

    point = [mp.mpf(i + 2) / (3 * i + 11) for i in range(len(given))]
    small = mp.mpf(10) ** -12

    def moved(i, by):
        return [s + by * (i == j) for j, s in enumerate(point)]

    spread = sum((rates(moved(i, small))[i] - rates(moved(i, -small))[i]) / (2 * small) for i in range(len(point)))
    speed = rates(point)
    ends = [weigh(full([s + by * r for s, r in zip(point, speed, strict=True)])[0]) for by in (small, -small)]
    return spread, (ends[0] - ends[1]) / (2 * small)


@pytest.mark.parametrize("name", KEPT)
def test_the_density_balances_the_divergence(name):
    system = example(name)
    found = volume(system)
    assert str(found) == "keeps a smooth volume"
    density = found.density
    with mp.workdps(30):
        spread, along = divergence(system, found, density)
        assert abs(spread + along) < mp.mpf(10) ** -15
        assert name == "vertical_disc" or abs(spread) > 0.001  # which the density has to balance


def test_the_density_of_the_ball_is_chaplygins():
    """√(1 - D⟨γ, (I + D)⁻¹γ⟩) of what the paper has, up to a factor and to the coordinates of the attitude."""
    system = example("ball")
    found = volume(system)
    q = system.coordinates[2:]
    up = Quaternion("q").rotation.T * sp.Matrix([0, 0, 1])
    moments = [sp.Rational(1), sp.Rational(3, 2), sp.Rational(2)]
    chaplygin = sp.sqrt(1 - sum(g**2 / (i + 1) for g, i in zip(up, moments, strict=True)))
    points = [[sp.Rational(n, 9) for n in p] for p in ((2, 4, 5, 6), (4, 6, 2, 5), (5, 2, 6, 4))]
    ratios = [(found.density * q[1] / chaplygin).subs(dict(zip(q, p, strict=True))) for p in points]
    assert all(sp.simplify(s - t) == 0 for s, t in pairwise(ratios))


def test_what_keeps_none():
    """The sleigh tends to a steady motion, as Suslov's body does below; of one that has weight less is proved."""
    found = volume(example("sleigh"))
    assert str(found) == "keeps no smooth volume"
    assert found.point
    pulled = volume(sleigh(1, potential=x))
    assert str(pulled) == "keeps no volume whose density depends on the place alone"
    assert volume(sleigh(1, forces={a: sp.Integer(1)})).at_all is False
    assert volume(sleigh(0, potential=x)).kept


def test_a_suslov_body_about_a_principal_axis_keeps_one():
    """Without products of inertia of the axis that may not turn; with one, none."""
    system = example("suslov")
    products = [s for s in system.parameters if s.name in ("I13", "I23")]
    free = dataclasses.replace(system, parameters={**system.parameters, **dict.fromkeys(products, 0)})
    assert volume(free).kept
    found = volume(dataclasses.replace(free, parameters={**free.parameters, products[0]: "1/10"}))
    assert (str(found), bool(found.point)) == ("keeps no smooth volume", True)


def test_what_is_not_judged_is_said():
    for system, why in (
        (sleigh(0, forces={x: -vx}), "forces that do not depend on velocities"),
        (sleigh(0, constraint=1), "linear in the velocities"),
        (System("light", (x, y), vx**2 / 2, [vx]), "singular"),
    ):
        with pytest.raises(BadSystem, match=why):
            volume(system)


def test_a_system_that_cannot_move_keeps_all():
    assert volume(System("stuck", (x,), vx**2 / 2, [vx])).kept


def test_a_volume_does_not_depend_on_scale_or_on_how_numbers_are_written():
    free = (vx**2 + vy**2 + vz**2) / 2
    for factor in ("1/1000000000000", 10**200):
        found = volume(System("scaled", (x, y, z), free, [(vz - y * vx) * sp.Rational(factor)]))
        assert sp.simplify(found.density**2 / (1 + y**2) * y**2).is_number
    slow = volume(System("slow", (x, y, z), free, [vz - y * vx / 10**6]))
    assert sp.simplify(slow.density**2 / (10**12 + y**2) * y**2).is_number
    tenths = System("tenths", (x, y, z), free - 0.1 * x**3, [0.3 * x**2 * vx + vy], [0.1 * x**3 + y])
    assert flag(tenths).growth == (2,)  # the second is the rate of the first: 0.1·3 is 0.3
    assert conserved(System("pushed", (x, y), (vx**2 + vy**2) / 2 - 0.1 * x**3, forces={x: 0.3 * x**2}), vx).kept


def test_brackets_of_brackets_of_brackets_are_looked_at():
    """A car with a trailer, whose masses are over the axles."""
    ahead, behind = vx, vy
    constraints, energy = [sp.sin(a) * vx - sp.cos(a) * vy], (vx**2 + vy**2 + va**2) / 2
    ahead, behind = vx + sp.sin(z) * vz, vy - sp.cos(z) * vz
    constraints.append(sp.expand(sp.sin(z) * ahead - sp.cos(z) * behind))
    energy += sp.expand(ahead**2 + behind**2 + vz**2) / 2
    assert str(volume(System("trailer", (x, y, a, z), energy, constraints))) == "keeps no smooth volume"


def test_surfaces_of_several_components_are_refused():
    free = (vx**2 + vy**2 + va**2) / 2
    for holonomic, energy, why in (
        ([x * (x - 1)], free, "a holonomic constraint is a product"),
        ([sp.sin(a) - sp.sin(y)], free + a * y, "binds the angle a, which is not only in sin and cos"),
    ):
        with pytest.raises(BadSystem, match=why):
            volume(System("several", (x, y, a), energy, [], holonomic))


def test_the_density_is_of_the_velocities_that_are_named():
    """Where the determinants of the mass matrix and of the constraints are one function, x, both count."""
    system = System("curve", (x, y), x * vx**2 / 2, [x * vx - vy], start={x: 1})
    found = volume(system)
    with mp.workdps(30):
        spread, along = divergence(system, found, found.density)
        assert abs(spread + along) < mp.mpf(10) ** -15
