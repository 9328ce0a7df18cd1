"""Volumes that exact motions keep: what is known of systems, and densities against the divergence in numbers."""

import dataclasses

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from budget import slow
from systems import a, example, va, vx, vy, vz, x, y, z

from chapsym.mechanics import METHODS, BadSystem, Runner, System, conserved, flag, verdicts, volume

KEPT = ["ball", "contact", "particle", "snakeboard", "transmission", "vertical_disc", *slow("falling_disc", "veselova")]


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
        free = [i for i in range(len(q)) if v[i] in by]
        known = mp.matrix([sum(rows[r, i] * place[v[i]] for i in free) for r in range(rows.rows)])
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


def test_what_keeps_none_and_what_keeps_all():
    """The sleigh tends to a steady motion; of one that has weight less is proved."""
    found = volume(example("sleigh"))
    assert str(found) == "keeps no smooth volume"
    assert found.point
    pulled = volume(sleigh(1, potential=x))
    assert str(pulled) == "keeps no volume whose density depends on the place alone"
    assert volume(sleigh(1, forces={a: sp.Integer(1)})).at_all is False
    assert volume(sleigh(0, potential=x)).kept
    assert volume(System("stuck", (x,), vx**2 / 2, [vx])).kept


def test_a_suslov_body_about_a_principal_axis_keeps_one():
    """Without products of inertia of the axis that may not turn."""
    system = example("suslov")
    products = [s for s in system.parameters if s.name in ("I13", "I23")]
    assert volume(dataclasses.replace(system, parameters={**system.parameters, **dict.fromkeys(products, 0)})).kept


def test_what_is_not_judged_is_said():
    for system, why in (
        (sleigh(0, forces={x: -vx}), "forces that do not depend on velocities"),
        (sleigh(0, constraint=1), "linear in the velocities"),
        (System("light", (x, y), vx**2 / 2, [vx]), "singular"),
    ):
        with pytest.raises(BadSystem, match=why):
            volume(system)


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


def of_steps(system, method):
    """The verdict on the volume that the steps of a method keep, and its name."""
    found = verdicts(system, METHODS[method].scheme(system))
    return next((name, one) for name, one in found.items() if name.endswith("volume"))


@pytest.mark.parametrize(
    ("name", "method", "power"),
    [
        ("particle", "dla", 3), ("particle", "dla-left", 2), ("particle", "spark", 3), ("contact", "dla", 3),
        ("vertical_disc", "dla", 3),
        *slow(("transmission", "spark", 3), ("snakeboard", "dla", 3)),
        *slow(("falling_disc", "spark", 3), ("ball", "dla-left", 3), ("ball", "spark", 3)),
    ],
)  # fmt: skip
def test_a_step_loses_the_volume_with_the_power_of_its_order(name, method, power):
    """Where that is an error of the method at all; `dla-left` is of order 2 on the ball."""
    what, found = of_steps(example(name), method)
    assert (what, found.verdict) == ("keeps the volume", "false")
    assert found.said.startswith("its logarithm changes in a step by ")
    assert found.said.endswith(f" h^{power}")
    assert found.point


def test_what_keeps_the_volume_is_not_refuted_and_what_is_near_it_is():
    """Symplectic steps, and those on a disc that is upright; rk4 loses area with h^6."""
    spring = System("spring", (x,), (vx**2 - x**4) / 2)
    said = {method: of_steps(spring, method)[1].said for method in METHODS if method != "own"}
    assert said.pop("rk4") == "its logarithm changes in a step by -16523/729 h^6"
    assert set(said.values()) == {"no difference is found"}
    ring = System("ring", (x, y), (vx**2 + vy**2) / 2 - y, holonomic=[x**2 + y**2 - 1])
    assert of_steps(ring, "dla")[1].said == "no difference is found"
    assert of_steps(example("vertical_disc"), "spark")[1].said == "no difference is found"


@pytest.mark.thorough
def test_the_discrete_ball_with_equal_moments_keeps_the_volume():
    """As Fedorov's paper has it; that of the documentation, whose moments differ, loses it."""
    moments = dict.fromkeys((s for s in example("ball").parameters if s.name.startswith("J")), "3/4")
    even = dataclasses.replace(example("ball"), parameters={**example("ball").parameters, **moments})
    assert of_steps(even, "own")[1].said == "no difference is found"


@pytest.mark.parametrize(("method", "h"), [("dla-left", 0.02), ("dla", 0.03)])
def test_the_determinant_of_a_step_in_floats_is_what_the_series_says(method, h):
    system, (_, found) = example("particle"), of_steps(example("particle"), method)
    point = [float(sp.Rational(found.point[str(s)])) for s in (*system.coordinates, *system.velocities[1:])]
    runner, kept = Runner(system, method, False), volume(system)
    weigh = sp.lambdify(system.coordinates, sp.log(sp.Abs(kept.density)))
    assert kept.by == system.velocities[1:]

    def moved(at, length):
        """The particle has the mass 1, and z' = y x'."""
        start = np.array([*at[:3], at[4] / at[1], *at[3:]])
        q, p = np.split(runner.march(1, length, start=start).final, [3])
        row = np.array([-q[1], 0, 1])
        return np.array([*q, *(p - row * (row @ p) / (row @ row))[1:]])

    def changed(length):
        columns = [(moved(point + e, length) - moved(point - e, length)) / 2e-4 for e in 1e-4 * np.eye(5)]
        ends = weigh(*moved(point, length)[:3]) - weigh(*point[:3])
        return np.log(np.linalg.det(np.array(columns).T)) + ends

    by, power = found.said.removeprefix("its logarithm changes in a step by ").split(" h^")
    coarse, fine = (changed(length) / length ** int(power) for length in (h, h / 2))
    assert 2 * fine - coarse == pytest.approx(float(sp.Rational(by)), rel=0.05)


def test_where_the_motion_keeps_none_a_step_that_follows_it_keeps_none():
    for system, method in ((example("sleigh"), "dla"), (sleigh(1), "dla-left")):
        what, found = of_steps(system, method)
        assert (what, found.verdict, bool(found.point)) == ("keeps a smooth volume", "false", True)
    pulled = of_steps(sleigh(1, potential=x), "dla")[1]
    assert pulled.verdict == "measured"
    assert pulled.said == "the exact motion keeps no volume whose density depends on the place alone"
    assert of_steps(sleigh(0), "dla")[0] == "keeps the volume"
    scheme = METHODS["dla"].scheme(example("sleigh"))
    slow_one = dataclasses.replace(scheme, after=[*scheme.after[:-1], scheme.after[-1] * 2])
    assert verdicts(example("sleigh"), slow_one)["keeps a smooth volume"].verdict == "measured"


@pytest.mark.parametrize(
    ("method", "why"),
    [("gni", "a reaction"), ("leapfrog", "a reaction"), ("midpoint", "leave the constraints"), ("rk4", "leave the")],
)
def test_steps_of_other_states_have_no_verdict_and_say_why(method, why):
    found = of_steps(example("particle"), method)[1]
    assert found.verdict == "measured"
    assert why in found.said
