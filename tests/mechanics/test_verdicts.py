"""Exact verdicts on methods: what is known of them, controls that lose a verdict, and steps in floats."""

import dataclasses
from functools import cache

import numpy as np
import pytest
import sympy as sp
from budget import slow
from systems import ANYWHERE, SYMMETRIC, a, example, va, vx, vy, x, y

from chapsym.mechanics import METHODS, BadSystem, Discrete, Runner, System, after, dot, verdicts
from chapsym.mechanics.judged import BEYOND, LOOKED, LOOKED_FURTHER, Judged, quantities_of
from chapsym.mechanics.methods import Scheme
from chapsym.mechanics.series import Exact
from chapsym.mechanics.system import STEP
from chapsym.numbers.precisions import flint_terms


@cache
def judged(name, method):
    return verdicts(example(name), METHODS[method].scheme(example(name)))


def proved(found):
    return [name for name, one in found.items() if one.verdict == "proved"]


@pytest.mark.parametrize(
    ("name", "method"),
    [
        *((name, method) for name in ("particle", "contact") for method in ANYWHERE),
        ("sleigh", "dla"), ("snakeboard", "midpoint"), ("transmission", "rk4"), ("vertical_disc", "dla-left"),
        *slow(
            ("ball", "leapfrog"), ("veselova", "gni"), ("falling_disc", "spark"), ("suslov", "dla"),
            ("rattleback", "dla-left"), ("rattleback", "rk4"),
            *((name, method) for name in ("sleigh", "vertical_disc", "snakeboard", "transmission")
              for method in ANYWHERE),
        ),
    ],
)  # fmt: skip
def test_the_orders_are_proved_and_what_is_reversible(name, method):
    """Of the contact oscillator as Modin and Verdier say: methods on momenta do not return, though self-adjoint."""
    found = judged(name, method)
    order = {"rk4": "4", "dla-left": "1"}.get(method, "2")
    assert (found["order"].verdict, found["order"].said) == ("proved", order)
    assert found["self-adjoint"].verdict == ("proved" if method in SYMMETRIC else "false")
    returns = method in (["midpoint"] if name == "contact" else SYMMETRIC)
    assert found["reversible"].verdict == ("proved" if returns else "false")
    assert all((one.point != {}) is (one.verdict == "false") for one in found.values())


@pytest.mark.parametrize("method", ANYWHERE)
@pytest.mark.parametrize("row", [0, -1])
def test_a_method_with_a_changed_coefficient_loses_its_verdicts(method, row):
    """Something of the size of the step, or of its square, in an equation of momenta, or in the last one."""
    system = example("particle")
    right = METHODS[method].scheme(system)
    x0, y0, *_ = system.coordinates
    of_rates = method in ("midpoint", "rk4")
    for power in (1, 2):
        residual = list(right.residual)
        residual[row] += STEP ** (power - of_rates) * (x0 + 2 * y0) / 7
        found = verdicts(system, dataclasses.replace(right, residual=residual))
        along = row == -1 and not of_rates  # velocities that are off along the reaction cost an order less
        least = power if along else power - 1
        order = found["order"]
        assert order.verdict != "proved" or int(order.said) <= min(least, 2)
        assert "at least" not in order.said or int(order.said[9]) <= least
        even = (method, power, row) == ("gni", 2, -1)  # at the place of the reaction, which a step back has, too
        assert (found["self-adjoint"].verdict == "proved") is even


@pytest.mark.parametrize("method", ANYWHERE)
def test_systems_without_constraints_and_with_friction_are_judged(method):
    double = System("double", (x, a), vx**2 / 2 + va**2 + vx * va * sp.cos(x - a) + sp.cos(x))
    damped = System("damped", (x,), vx**2 / 2 - x**2 / 2, forces={x: -vx})
    order = {"rk4": "4", "dla-left": "1"}.get(method, "2")
    for system in (double, damped) if method in ("dla", "dla-left", "midpoint") else (damped,):
        found = verdicts(system, METHODS[method].scheme(system))
        assert (found["order"].verdict, found["order"].said) == ("proved", order)
        assert found["self-adjoint"].verdict == ("proved" if method in SYMMETRIC else "false")
        assert found["reversible"].verdict == ("proved" if system is double and method in SYMMETRIC else "false")


def test_names_of_coordinates_are_none_of_a_proof():
    """A pendulum whose angle is called as a letter is, and a coordinate as an acceleration in another text."""
    for name in ("l0", "acceleration0", "u0", "p0_next"):
        angle, other = sp.symbols((name, "l1"))
        system = System("named", (angle, other), dot(angle) ** 2 / 2 + dot(other) ** 2 / 2 + other * sp.cos(angle))
        right = METHODS["dla"].scheme(system)
        assert verdicts(system, right)["order"].said == "2"
        turned = [e.xreplace({sp.cos(angle + STEP * right.unknowns[0] / 2): angle}) for e in right.residual]
        assert turned != list(right.residual)
        assert not proved(verdicts(system, dataclasses.replace(right, residual=turned)))


def test_signs_and_ends_that_are_changed_are_seen():
    system = example("particle")
    dla, spark, gni = (METHODS[name].scheme(system) for name in ("dla", "spark", "gni"))
    u = dla.unknowns[:3]
    row = u[2] - (y + STEP * u[1] / 3) * u[0]  # the constraint after a third of the step
    found = verdicts(system, dataclasses.replace(dla, residual=[*dla.residual[:-1], row]))
    assert not proved(found)
    assert found["order"].said == "at most 1"
    for scheme in (spark, gni):
        turned = [e.xreplace({STEP: 2 * STEP}) if i == 0 else e for i, e in enumerate(scheme.residual)]
        assert not proved(verdicts(system, dataclasses.replace(scheme, residual=turned)))
    after = [*dla.after[:-1], dla.after[-1] + STEP * x]
    assert "order" not in proved(verdicts(system, dataclasses.replace(dla, after=after)))


@pytest.mark.parametrize(("i", "j", "order"), [(3, 0, 0), (2, 2, 1), (0, 0, 1), (1, 0, 1)])
def test_a_tableau_with_another_number_has_the_order_of_its_conditions(i, j, order):
    system = example("contact")
    right = METHODS["rk4"].scheme(system)
    stages = [list(row) for row in right.stages]
    stages[i][j] -= sp.Rational(1, 100)
    found = verdicts(system, dataclasses.replace(right, stages=stages))["order"]
    assert (found.verdict, found.said) == ("proved", str(order)) if order else found.verdict == "false"


def test_momenta_are_kept_by_the_equations_and_not_by_changed_ones():
    system = example("vertical_disc")
    exact, momentum = Exact(system), quantities_of(system, {})["the momentum of heading"]
    for method in ("dla", "dla-left", "spark", "rk4"):
        found = judged("vertical_disc", method)
        assert found["keeps the momentum of heading"].verdict == "proved"
        assert found["keeps the energy"].verdict == "false"
        right = METHODS[method].scheme(system)
        row = 12 if method == "spark" else 2  # of the velocity at the end
        residual = [e + STEP**3 * system.coordinates[1] if i == row else e for i, e in enumerate(right.residual)]
        looked = LOOKED_FURTHER if right.stages else LOOKED
        with flint_terms(looked + BEYOND):
            changed = Judged(exact, dataclasses.replace(right, residual=residual), looked)
            assert changed.decided(changed.keeps, momentum).verdict.verdict == "false"


def test_a_quadratic_momentum_is_proved_by_factors():
    """The midpoint rule keeps the energy of an oscillator, and that of a wrong frequency it does not."""
    energy, other = (vx**2 + x**2) / 2, (vx**2 + 2 * x**2) / 2
    system = System("spring", (x, y), (vx**2 + vy**2 - x**2) / 2, integrals={"E": energy, "other": other})
    found = verdicts(system, METHODS["midpoint"].scheme(system))
    assert [found[name].verdict for name in ("keeps E", "keeps the momentum of y", "keeps other")] == [
        "proved", "proved", "measured",
    ]  # fmt: skip
    assert found["keeps other"].said == "the exact motion does not keep it"
    assert verdicts(system, METHODS["rk4"].scheme(system))["keeps E"].verdict == "false"


#: Of angles that are not linear, which are not turned: the state that is shown is that of the series.
WAVY = System("wavy", (x, y), (vx**2 + vy**2) / 2 - sp.cos(x**2 + y**2) - sp.sin(x))


@pytest.mark.parametrize(("name", "method"), [("contact", "gni"), ("particle", "rk4"), ("wavy", "dla-left")])
def test_steps_in_floats_miss_by_what_the_series_say(name, method):
    """The exact states of false verdicts, in the kernels that the lab runs, extrapolated from two lengths."""
    system = WAVY if name == "wavy" else example(name)
    found = verdicts(system, METHODS[method].scheme(system))
    for what in ("keeps the energy", "reversible"):
        of, by, power = found[what].said.rsplit(" ", 2)
        k = int(power[2:])
        h = {2: 1e-4, 3: 1e-2}.get(k, 4e-2)
        coarse, fine = (missed(system, method, found[what].point, of, step) / step**k for step in (h, h / 2))
        assert 2 * fine - coarse == pytest.approx(float(sp.Rational(by)), rel=0.03)


def missed(system, method, point, of, h):
    """What the energy changes by from one step to the next, or what a component misses after a step forth and back."""
    symbols, n = (*system.coordinates, *system.velocities), len(system.coordinates)
    given = {name: float(sp.Rational(value)) for name, value in point.items()}
    angles = {x: np.arctan2(given[f"sin({x})"], given[f"cos({x})"]) for x in symbols if f"sin({x})" in given}
    state = np.array([angles[x] if x in angles else given[str(x)] for x in symbols])
    start = dict(zip(symbols, map(float, state), strict=True))
    runner = Runner(dataclasses.replace(system, start=start), method, False)
    if of == "it changes in a step by":
        return np.diff(runner.march(2, h).energy)[0]
    there = runner.march(1, h).final
    back = runner.march(1, h, start=runner.turned(there, h)).final
    if runner.scheme.reflects:
        back = runner.turned(back, h)
        reached = [*back[:n], *runner.march(1, h, start=back).velocity[0]]
    else:
        q, v = runner.velocities(back)
        reached = [*q, *-projected(system, q, v)]
    i = list(map(str, symbols)).index(of.split()[-2])
    return reached[i] - state[i]


def projected(system, q, v):
    """Of velocities those that obey the constraints, with a momentum that is the same but for the reaction."""
    numbers = dict(zip(system.parameters, system.numbers, strict=True))
    place = dict(zip(system.coordinates, q, strict=True)) | numbers
    mass = np.array(system.mass.xreplace(place), float)
    rows = np.array(system.rows.xreplace(place), float)
    inverse = np.linalg.inv(mass)
    return v - inverse @ rows.T @ np.linalg.solve(rows @ inverse @ rows.T, rows @ v)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"lagrangian": (vx**2 + vy**2) / 2 - sp.cos(y / 3 + sp.S.Half)}, "a part of a coordinate"),
        ({"lagrangian": (vx**2 + vy**2) / 2 - y * sp.cos(y + sp.S.Half)}, "no rational series"),
        ({"lagrangian": vx**2 / 2}, "singular"),
        ({"lagrangian": (vx**2 + vy**2) / 2 - sp.sqrt(2 + x**2)}, "no rational series"),
        ({"lagrangian": (vx**2 + vy**2) / 2 - x**300 * (1 + y) ** 40, "holonomic": [x**2 + y**2 + 1]}, "no exact"),
    ],
)
def test_what_is_not_decided_stays_measured_and_says_why(settings, said):
    system = System("one", (x, y), constraints=[vy - x * vx], **settings)
    found = verdicts(system, METHODS["dla"].scheme(system))
    assert {one.verdict for one in found.values()} == {"measured"}
    assert any(said in one.said for one in found.values())


def osc(equations, unknowns, after):
    """A method of one's own on an oscillator."""
    x, h = sp.Symbol("x"), STEP
    system = System("oscillator", (x,), dot(x) ** 2 / 2 - x**2 / 2)
    scheme = Scheme((x, dot(x)), unknowns, equations(x, dot(x), h), after(x, dot(x), h), [x], [dot(x)], [x, dot(x)],
                    [0] * len(unknowns))  # fmt: skip
    return verdicts(system, scheme)["order"]


def test_what_is_right_at_the_exact_state_alone_is_no_order():
    """Equations times h, and unknowns of the order h, that are those of the motion at x = 4/3 only."""
    a, d, wrong = sp.Symbol("a 0"), sp.Symbol("d 0"), sp.Rational(4, 3)
    middle = lambda x, v, h: x + h * (v + h * a / 2) / 2  # noqa: E731
    late = osc(
        lambda x, v, h: [h * (a + middle(x, v, h) - (middle(x, v, h) - wrong) ** 2)], (a,),
        lambda x, v, h: [x + h * (v + h * a / 2), v + h * a],
    )  # fmt: skip
    small = osc(
        lambda x, v, h: [a + x, d - h * (x - wrong)], (a, d), lambda x, v, h: [x + h * v, v + h * a + d]
    )  # fmt: skip
    right = osc(
        lambda x, v, h: [a + middle(x, v, h)], (a,), lambda x, v, h: [x + h * (v + h * a / 2), v + h * a]
    )  # fmt: skip
    assert [one.verdict for one in (late, small, right)] == ["measured", "measured", "proved"]


def test_no_integral_hides_the_energy_and_a_changed_parameter_counts():
    x, y, a = sp.symbols("x y a")
    energy = (dot(x) ** 2 + dot(y) ** 2) / 2 - x**2
    for name in ("the energy", "the momentum of y", "the volume"):
        hidden = System("hidden", (x, y), energy, integrals={name: dot(y)})
        with pytest.raises(BadSystem, match="give the integral another name"):
            verdicts(hidden, METHODS["rk4"].scheme(hidden))
    system = System("s", (x,), dot(x) ** 2 / 2 - a * x**2, parameters={a: 0}, integrals={"q": dot(x)})
    assert verdicts(system, METHODS["rk4"].scheme(system))["keeps q"].verdict == "proved"
    system.parameters[a] = 1
    assert verdicts(system, METHODS["rk4"].scheme(system))["keeps q"].verdict != "proved"


@pytest.mark.thorough
def test_the_map_of_the_paper_is_judged_as_what_was_typed():
    found = judged("ball", "own")
    assert proved(found) == ["order", "self-adjoint", "reversible"]
    assert found["order"].said == "2"
    assert found["keeps the volume"].said == "its logarithm changes in a step by 165240076/4463495229375 h^3"
    assert [found[f"keeps {name}"].verdict for name in ("|K|²", "⟨K,γ⟩")] == ["false", "false"]
    assert [found[f"keeps {name}"].said for name in ("|𝒦|²", "⟨𝒦,γ⟩")] == ["no difference is found"] * 2


def test_a_discretization_of_ones_own_is_judged():
    """Of a spring across which a momentum is kept: by the midpoint, and by the place before the step."""
    moving = ((after(x) - x) ** 2 + (after(y) - y) ** 2) / (2 * STEP)
    kept = {"drift": (after(y) - y) / STEP, "way": (after(x) - x) ** 2 / STEP}
    for place, order, even in (((x + after(x)) / 2, "2", "proved"), (x, "1", "false")):
        own = Discrete(moving - STEP * place**2 / 2, integrals=kept)
        spring = System("spring", (x, y), (vx**2 + vy**2 - x**2) / 2, discrete=own)
        found = verdicts(spring, METHODS["own"].scheme(spring))
        assert (found["order"].verdict, found["order"].said) == ("proved", order)
        assert found["self-adjoint"].verdict == even
        assert (found["keeps drift"].verdict, found["keeps way"].verdict) == ("proved", "false")
        assert found["keeps way"].said == "it changes in a step by -4 h^2"


@pytest.mark.thorough
def test_the_map_of_the_paper_is_proved_and_another_discrete_momentum_or_constraint_is_refuted():
    """Of order 2, self-adjoint, reversible; its own momentum about the contact point stays, that of the motion not."""
    ball = example("ball")
    own = ball.discrete
    radius = next(s for s in ball.parameters if s.name == "radius")
    halved = {name: e.xreplace({radius: radius / 2}) for name, e in own.integrals.items()}
    pairs = zip(own.constraints, ball.coordinates[:2], strict=True)
    forward = [e.xreplace({radius: radius * (1 + x)}) for e, x in pairs]

    def made(**changes):
        changed = dataclasses.replace(ball, discrete=dataclasses.replace(own, **changes))
        scheme = METHODS["own"].scheme(changed)
        return Judged(Exact(changed), scheme, LOOKED), scheme.integrals["|𝒦|²"]

    with flint_terms(LOOKED + BEYOND):
        right, kept = made()
        asked = (right.returns, -1), (right.order, True), (right.returns, 1), (right.keeps, kept)
        found = [right.decided(*one).verdict for one in (*asked, (right.keeps, ball.integrals["|K|²"]))]
        other, kept = made(integrals=halved)
        assert other.decided(other.keeps, kept).verdict.verdict == "false"
        other, _ = made(constraints=forward)
        for question in (other.order, False), (other.returns, -1):
            assert other.decided(*question).verdict.verdict == "false"
    assert [one.verdict for one in found] == ["proved", "proved", "proved", "measured", "false"]
    assert (found[1].said, found[3].said) == ("2", "no difference is found")
    kept = Runner(ball, "own", precision="double-double").march(20).integrals
    assert [max(kept[name]) - min(kept[name]) < 1e-30 for name in kept] == [False, False, True, True]
    assert [*kept] == ["|K|²", "⟨K,γ⟩", "|𝒦|²", "⟨𝒦,γ⟩"]


def test_a_quantity_of_a_discretization_is_checked():
    with pytest.raises(BadSystem, match="x_after has the name of a coordinate"):
        System("two", (x, sp.Symbol("x_after")), vx**2, discrete=Discrete(x * sp.Symbol("x_after")))
    ball = example("ball")
    for integrals, why in (
        ({"a": sp.Symbol("strange")}, "strange, which is nothing at a step's two ends"),
        ({"|K|²": sp.Integer(1)}, "is a quantity of the system"),
        ([1], "must be given as"),
    ):
        with pytest.raises(BadSystem, match=why):
            dataclasses.replace(ball, discrete=dataclasses.replace(ball.discrete, integrals=integrals))
