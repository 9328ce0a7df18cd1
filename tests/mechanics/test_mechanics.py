"""Systems, their brackets, the methods, and equations that somebody typed."""

import dataclasses
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
import sympy as sp
from budget import slow
from scipy.integrate import solve_ivp
from sympy.physics import mechanics as kane
from systems import ANYWHERE, FREE, SYMMETRIC, SYSTEMS, a, example, k, particle, va, vx, vy, vz, x, y, z

import chapsym
from chapsym.generated import momentum
from chapsym.mechanics import METHODS, Quaternion, Turned, brackets, certified, density, flag, measured, motion
from chapsym.mechanics.density import volume
from chapsym.mechanics.equations import agree, conserved, of_kane
from chapsym.mechanics.judged import verdicts
from chapsym.mechanics.lab import keeps
from chapsym.mechanics.motion import NotSolved, Runner, moved
from chapsym.mechanics.system import BadSystem, Discrete, System, after, dot, loaded, rate


@cache
def of_forty(name, method):
    """A method measured on an example, with 40 steps."""
    system = example(name)
    return measured(system, method, 40, float(Fraction(system.step)) / (4 if name == "falling_disc" else 1))


@pytest.mark.parametrize(
    ("name", "growth", "dimension"),
    [
        ("ball", (3, 5), 5), ("contact", (2, 3), 3), ("particle", (2, 3), 3), ("sleigh", (2, 3), 3),
        ("snakeboard", (3, 4, 5), 5), ("suslov", (2, 3), 3), ("transmission", (2, 3), 3), ("veselova", (2, 3), 3),
        ("vertical_disc", (2, 3, 4), 4), *slow(("falling_disc", (3, 4, 5), 5), ("rattleback", (3, 5), 5)),
    ],
)  # fmt: skip
def test_the_examples_are_short_and_their_flags_are_known(name, growth, dimension):
    """(2, 3), (3, 5) of a sphere and (2, 3, 4) of a disc are in A. M. Bloch's book; the rest is by differences."""
    file = SYSTEMS / f"{name}.py"
    assert len(file.read_text(encoding="utf-8").splitlines()) <= 40
    found = flag(example(name))
    assert (found.growth, found.dimension, found.functions) == (growth, dimension, 0)


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"constraints": [sp.sin(a) * vx - 2 * sp.sin(a / 2) * sp.cos(a / 2) * vy]}, "sin and cos of coordinates"),
        ({"constraints": [vz - (sp.sin(2) - 2 * sp.sin(1) * sp.cos(1)) * y * vx]}, "sin and cos of coordinates"),
        ({"constraints": [vz - (sp.sqrt(x * y) - sp.sqrt(x) * sp.sqrt(y)) * y * vx]}, "whose product is not rational"),
        ({"constraints": [vz - sp.sqrt((1 + x**2) ** 2) * vx]}, "product is not rational: sqrt"),
        ({"constraints": [vz - sp.sqrt(1 + sp.sqrt(2 + x**2)) * vx]}, "roots in roots"),
        ({"constraints": [vz - sp.pi * y * vx]}, "are not for π"),
        ({"constraints": [vz - sp.sin(a) * vx], "holonomic": [a - y]}, "binds the angle a outside of sin and cos"),
        ({"constraints": [vx - 1, vx - 2]}, "the constraints contradict each other: no motion obeys them"),
        ({"constraints": [x**2 + y**2 - 1]}, "the constraints contradict each other"),
        ({"constraints": [vx / (sp.sin(a) ** 2 + sp.cos(a) ** 2 - 1)]}, "divides by"),
        ({"constraints": [vz - sp.exp(x) * vx]}, "is not sin, cos, a square root or"),
        ({"constraints": [vz - x**501 * vx]}, r"has .*x\*\*501.*, which is not .*, or has more than 500 factors"),
        ({"constraints": [vz - x**251 * y**250 * vx]}, "or has more than 500 factors"),
    ],
)
def test_what_the_algebra_does_not_know_is_refused_and_not_judged(settings, said):
    with pytest.raises(BadSystem, match=said):
        flag(System("unknown", (x, y, z, a), 0, **settings))


@pytest.mark.parametrize(
    ("settings", "growth", "functions"),
    [
        ({"constraints": [vx - y]}, (3, 4), 0),  # of x, y, z and time
        ({"constraints": [vx - 1]}, (3,), 1),
        ({"constraints": [vz - k * y * vx], "parameters": {k: 0}}, (2,), 1),
        ({"constraints": [vz - k * y * vx], "parameters": {k: "1e-30"}}, (2, 3), 0),
        ({"constraints": [vz - y * vx, 3 * vz - 3 * y * vx]}, (2, 3), 0),
        ({"constraints": [vz - sp.sqrt(2) * y * vx]}, (2, 3), 0),
        ({"constraints": [vz - 0.5 * y * vx]}, (2, 3), 0),
        ({"constraints": [vz - 0.300000001 * y * vx - sp.Rational(3, 10) * x * vy]}, (2, 3), 0),
        ({"constraints": [vz - 0.3 * y * vx - sp.Rational(3, 10) * x * vy]}, (2,), 1),
        ({"holonomic": [x**2 + y**2 - 1, 2 * x**2 + 2 * y**2 - 2]}, (2,), 0),
        ({"constraints": [vz - sp.tan(y) * vx]}, (2, 3), 0),
        ({"constraints": [vz - sp.sin(2 * y) * vx + 2 * sp.sin(y) * sp.cos(y) * vx]}, (2,), 1),
        ({"coordinates": (x, y), "constraints": [x * vx + y * vy]}, (1,), 1),
        ({"constraints": [y * z * vx + x * z * vy + x * y * vz]}, (2,), 1),
        ({"coordinates": (x, y, a), "constraints": [sp.cos(a) * vx + sp.sin(a) * vy]}, (2, 3), 0),
        ({"coordinates": (x, y, a), "constraints": [sp.cos(a) * vx - x * sp.sin(a) * va]}, (2,), 1),  # d(x cos a)
        ({"coordinates": (x, y, z, a), "constraints": [vx + y * vz, va - z * vz]}, (2, 3), 1),  # a - z²/2 stays
        ({}, (3,), 0),
        ({"coordinates": (x, y), "constraints": [vx / sp.sqrt(1 + x**2) + vy]}, (1,), 1),
        ({"constraints": [vz - sp.sqrt(1 + y**2) * vx]}, (2, 3), 0),
    ],
)
def test_constraints_of_the_system_with_its_numbers_are_integrable_or_not(settings, growth, functions):
    found = flag(System("one", **{"coordinates": (x, y, z), "lagrangian": 0} | settings))
    assert (found.growth, found.functions) == (growth, functions)
    assert found.integrable is (len(growth) == 1)
    words = "completely" if functions == 0 else "nonholonomic"
    assert str(found).startswith(words if len(growth) > 1 else "integrable" if functions else "no constraint")


@pytest.mark.parametrize(
    ("lagrangian", "typed", "equal"),
    [
        (va**2 / 2 + sp.cos(a), -sp.sin(a), True),
        (va**2 / 2 + sp.cos(a) - a**2 / 2, -sp.sin(a) - a, True),
        (va**2 / 2 + sp.cos(a) - a**2 / 2, -sp.sin(a) + a, False),
        (va**2 / 2 - sp.sqrt(1 + a**2), -a / sp.sqrt(1 + a**2), True),
        (va**2 / 2 - sp.sqrt(1 + a**2), a / sp.sqrt(1 + a**2), False),
        (va**2 / 2 - 1.57 * a**2, -3.14 * a, True),
        (va**2 / 2 - 1.57 * a**2, -3.1400000001 * a, False),
        (k * va**2 / 2 - a**2 / 2, -a / 2, True),  # k is 2
    ],
)
def test_equations_are_compared_for_the_system_with_its_numbers(lagrangian, typed, equal):
    found = agree(System("one", (a,), lagrangian, parameters={k: 2}), {a: typed})
    assert found.equal is equal
    if not equal:
        assert all(sp.sympify(value).is_real for value in (*found.point.values(), found.value))
        assert found.point["a"] != "0"  # an angle that is there bare is shown, too
        assert all(sp.sympify(value) > 0 for name, value in found.point.items() if name.startswith("sqrt"))


@pytest.mark.parametrize("method", ["dla", "gni", "spark", "rk4", *slow("dla-left", "leapfrog", "midpoint")])
def test_numbers_that_are_no_integers_and_any_names_are_taken(method):
    """Halves, floats, and symbols that are called as those of the generated text, or as words of C."""
    x, y, k, m = sp.symbols("d0 u_1 s0 real")
    energy = m * (dot(x) ** 2 + dot(y) ** 2) / 2 - (x - sp.Rational(1, 2)) ** 2 / 2 - 0.25 * sp.cos(y / 3 + 0.5)
    system = System(
        "named", (x, y), energy, [dot(y) - x * dot(x) / 3 - sp.Rational(1, 5) * k],
        parameters={k: 1, m: "3/2"}, start={x: "1/2", dot(x): 1}, forces={x: -y},
    )  # fmt: skip
    found = moved(system, method, 20, 0.05).final[:2]
    assert np.abs(found - reference(system, 1.0)).max() < (0.05 if method == "dla-left" else 2e-3)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    ("settings", "options", "said"),
    [
        ({"start": {x: np.ma.masked}}, {}, "the start of x is masked, which is no number"),
        ({"parameters": {k: np.complex128(1j)}}, {}, "the parameter k is .*, which is no number"),
        ({"start": {x: "one"}}, {}, "the start of x is 'one', which is no number"),
        ({"start": {x: "1e999999999"}}, {}, "the start of x is '1e999999999', which is no number"),
        ({"parameters": {sp.Wild("q"): 1}}, {}, "q_ must be a symbol of real numbers"),
        ({"step": "0.1s"}, {}, "the length of a step is '0.1s', which is no number"),
        ({"constraints": [vz - y * vx], "start": {vx: 1, vz: 2}}, {}, "are 2 off the constraints; leave out those"),
        ({"holonomic": [x - 1]}, {}, "the start is 1 off the holonomic constraints"),
        ({"start": {vx: 1e308, vy: 1e308}}, {"method": "rk4"}, "not defined on the motion|leaves the range"),
        ({"constraints": [vz - vx / x]}, {}, "a constraint is not defined at the start"),
        ({"constraints": [vz - 10**400 * vx]}, {}, "a constraint is not defined at the start"),
        ({"lagrangian": FREE + vx / x}, {}, "has no solution near the last one"),
        ({"forces": {x: 10**400}}, {}, "a number is beyond float64"),
        ({"forces": {x: sp.Derivative(sp.sin(x), x)}}, {}, "is not sin, cos"),
        ({"integrals": {"one": sp.factorial(x)}}, {}, "a quantity is not defined on the motion"),
        ({"integrals": {"one": sp.sqrt(x - 1)}}, {"precision": chapsym.Digits(20)}, "a quantity is not defined"),
        ({"parameters": {sp.Symbol("q", commutative=False): 1}}, {}, "q must be a symbol of real numbers"),
        ({"parameters": {sp.Symbol("x", real=True): 1}}, {}, "x is two of"),
    ],
)
def test_systems_that_cannot_be_run_are_one_sentence(settings, options, said):
    settings = {"lagrangian": FREE, "start": {}, **settings}
    with pytest.raises((BadSystem, NotSolved), match=said):
        moved(System("odd", (x, y, z), **settings), steps=2, **options)


@pytest.mark.filterwarnings("error")
def test_a_start_that_is_no_state_is_refused():
    odd_ones = np.full(6, 1j), np.full(6, np.inf), np.ma.masked_all(6), ["1"] * 6, [None] * 6, [10**400] * 6
    for odd in (*odd_ones, [np.ma.masked] * 6, [sp.Symbol("s")] * 6):
        for level in ("double", chapsym.Enclosure(64)):
            with pytest.raises(BadSystem, match="the start must be 6 numbers, as `final` has them"):
                Runner(particle(), precision=level).march(1, start=odd)


def test_a_coordinate_may_be_called_as_a_number_or_a_function():
    for name in ("pi", "cos"):
        q = sp.Symbol(name)
        motion = moved(System("named", (q,), dot(q) ** 2 / 2 - sp.pi * sp.cos(q), start={q: 1}), "gni", 1)
        assert motion.energy[0] == pytest.approx(np.pi * np.cos(1))


def test_what_is_too_long_to_be_decided_is_said(monkeypatch):
    constraints, odd = [vz - k * vy * sp.cos(x), va + (k * y + 1) * vx], {"one": sp.Integral(x, x)}
    pulled = System("pulled", (x, y, z, a), FREE + va**2 / 2 + k * vx * vy, constraints, parameters={k: "1e300"})
    with pytest.raises(BadSystem, match="not decided whether a volume is kept"):  # factors of such numbers take minutes
        volume(pulled)
    one = System("one", (x, y, z), FREE, [vz - y * vx], integrals=odd)
    assert verdicts(one, METHODS["dla"].scheme(one))["keeps one"].said.endswith("has no exact series")
    monkeypatch.setattr(brackets, "MOST_PARTS", 3)
    with pytest.raises(BadSystem, match="too long to be decided"):
        flag(particle())
    with pytest.raises(BadSystem, match="more digits than Python writes"):
        volume(System("long", (x,), vx**2 / 2, parameters={k: 10**5000}))
    with pytest.raises(BadSystem, match="exact verdicts are for numbers of 330 digits at most"):
        flag(System("far", (x, y, z), FREE, [vz - k * vy * sp.cos(x)], parameters={k: "1e5000"}))
    monkeypatch.setattr(density, "MOST_PARTS", 3)
    with pytest.raises(BadSystem, match="how its velocities diverge is too long to be decided"):
        volume(particle())
    divided = System("divided", (x, y), (vx**2 + vy**2) / 2, holonomic=[y * sp.sqrt(1 + x**2)])
    assert verdicts(divided, METHODS["dla"].scheme(divided))["order"].verdict == "measured"
    bound = System("bound", (x, y), (vx**2 + vy**2) / 2, holonomic=[x * sp.sin(y + 1) + sp.Rational(1, 2)])
    assert verdicts(bound, METHODS["dla-left"].scheme(bound))["order"].said == "no exact state is found"


def test_only_constraints_that_are_there_are_proved():
    start = {x: "3/5", z: "-4/5", vy: 1}
    sphere = System("sphere", (x, y, z), FREE - z, holonomic=[x**2 + y**2 + z**2 - 1], start=start)
    cell = measured(sphere, "rk4", 200)
    assert not cell.kept
    assert cell.places > 1e-6
    assert measured(sphere, "dla", 200).places < 1e-2
    still = System("still", (x, y), (vx**2 + vy**2) / 2, start={x: "1e-9"})
    assert measured(still, "dla", 10).order is None


def test_a_flag_says_where_it_holds():
    """The Martinet distribution, whose flag is longer where y = 0: nothing is said there."""
    found = flag(System("Martinet", (x, y, z), 0, [vz - y**2 * vx / 2]))
    assert found.growth == (2, 3)
    assert found.condition.has(y)
    assert sp.sympify(found.point["y"]) != 0


@pytest.mark.parametrize(
    ("name", "method"),
    [
        *((name, method) for name in ("particle", "contact") for method in ANYWHERE),
        *slow(*(("ball", method) for method in ("own", *ANYWHERE)), ("falling_disc", "dla-left")),
    ],
)
def test_the_methods_have_their_orders_keep_the_constraints_and_return(name, method):
    """The particle's energy is even in the velocities; that of the contact oscillator has ∂L/∂v beyond them."""
    cell = of_forty(name, method)
    expected = {"rk4": 4, "dla-left": 2 if name == "ball" else 1}.get(method, 2)
    assert cell.order == pytest.approx(expected, abs=0.15)
    assert cell.kept is (method not in ("midpoint", "rk4", "own"))
    assert cell.constraint < (1e-12 if cell.kept else 1e-3)
    if name in ("particle", "contact"):
        assert (cell.returns < 1e-12) is (method == "midpoint" or (name == "particle" and method in SYMMETRIC))
        assert cell.returns < 1e-12 or cell.returns > 1e-6 or method in SYMMETRIC


def reference(system, end):
    """The place at a time, by SciPy's Runge-Kutta method of order 8 on the equations with the multipliers."""
    matrix, right = system.equations
    q, v = list(system.coordinates), list(system.velocities)
    numbers = dict(zip(system.parameters, map(sp.Float, system.numbers), strict=True))
    of = sp.lambdify((q, v), [matrix.xreplace(numbers), right.xreplace(numbers)], "numpy")

    def rates(_, state):
        table, side = of(state[: len(q)], state[len(q) :])
        solved = np.linalg.solve(np.array(table, float), np.array(side, float).ravel())
        return np.concatenate([state[len(q) :], solved[: len(q)]])

    done = solve_ivp(rates, (0, end), np.concatenate(system.beginning), method="DOP853", rtol=1e-12, atol=1e-12)
    return done.y[: len(q), -1]


@pytest.mark.parametrize("method", ANYWHERE)
def test_the_time_of_a_place_is_when_it_is_there(method):
    """The particle's y = 0.3 + t/2."""
    motion = Runner(particle(), method, compiled=False).march(np.int64(20), 0.1, every=np.int8(2))
    assert len(motion.time) == 10
    assert np.abs(motion.place[:, 1] - 0.3 - motion.time / 2).max() < 1e-12


def test_a_run_in_parts_is_the_run(monkeypatch):
    whole = Runner(particle()).march(20, every=5)
    monkeypatch.setattr(motion, "PART", 7)
    parts = Runner(particle()).march(20, every=5)
    assert parts.time.tolist() == whole.time.tolist()
    assert (parts.place == whole.place).all()


@pytest.mark.parametrize("fails", [False, True])
def test_where_no_compiler_is_or_it_fails_python_takes_the_steps_and_says_so(monkeypatch, caplog, tmp_path, fails):
    if fails:
        (tmp_path / "cc").write_text("#!/bin/sh\nexit 3\n", encoding="utf-8")
        (tmp_path / "cc").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":" if fails else None)
    motion._say_once.cache_clear()
    for _ in range(2):
        assert np.abs(Runner(particle(), "dla").march(5).final[1] - 0.3 - 0.25) < 1e-12
    assert caplog.text.count("plain Python takes the steps") == 1
    assert ("ended with status 3" if fails else "'cc'") in caplog.text
    assert [Runner(particle(), compiled=given).compiled for given in (None, True, False)] == [True, True, False]


def test_a_system_of_one_coordinate_without_parameters_runs_in_c():
    pendulum = System("pendulum", (a,), va**2 / 2 + sp.cos(a), start={a: 1})
    for method in ("dla", "spark", "rk4"):
        assert np.abs(moved(pendulum, method, 100, 0.01).final[:1] - reference(pendulum, 1.0)).max() < 1e-2


def test_energy_is_kept_where_forces_do_no_work():
    assert not particle(forces={x: -vx}).keeps_energy
    assert particle(forces={x: -vy, y: vx}).keeps_energy
    assert not particle(constraints=[vz - y * vx - 1], start={}).keeps_energy
    pushed = moved(particle(forces={x: -vx}), "rk4", 100, 0.01)
    assert pushed.energy[-1] < 0.8 * pushed.energy[0]


@pytest.mark.parametrize("name", ["particle", "sleigh", "contact", "transmission", "vertical_disc", *slow("suslov")])
def test_the_energy_is_decided_to_be_kept(name):
    system = example(name)
    assert system.keeps_energy
    assert conserved(system, system.energy).kept
    changed = conserved(system, system.energy + system.velocities[0])
    assert not changed.kept
    assert sp.sympify(changed.rate) != 0


def test_quantities_are_kept_or_not_at_an_exact_state():
    """(1 + y²) x'² of the free particle; the energy in a turning frame; what is affine, and what is pushed."""
    assert conserved(particle(), (1 + y**2) * vx**2).kept
    assert conserved(particle(), vy).kept
    pushed = conserved(particle(forces={y: -vy}), vy)
    state = {sp.Symbol(name): sp.Rational(value) for name, value in pushed.point.items()}
    assert sp.Rational(pushed.rate) == -vy.xreplace(state) != 0
    assert "not kept: its rate is" in str(pushed)
    turning = System("turntable", (x, y), (vx**2 + vy**2) / 2, [vx + y])  # x' = -y: y is free
    assert conserved(turning, vy).kept
    assert not conserved(turning, (vx**2 + vy**2) / 2).kept
    carried = System("carried", (x,), vx**2 / 2, [vx - 3])
    assert str(conserved(carried, x)) == "not kept: its rate is 3 at x_dot = 3"
    assert conserved(System("free", (x, y), (vx**2 + vy**2) / 2), x * vy - y * vx).kept
    with pytest.raises(BadSystem, match="the mass matrix is singular, so that the motion is not determined"):
        conserved(System("light", (x, y), vx**2 / 2), vx)
    with pytest.raises(BadSystem, match="there is w, which is no coordinate"):
        conserved(particle(), sp.Symbol("w"))


def test_with_half_the_step_the_drift_of_a_method_falls():
    system, counts = example("particle"), []
    drift = measured(system, "rk4", 5000, halve=True, progress=lambda *count: counts.append(count))
    assert drift.drift / drift.halved > 20
    assert counts[:: len(counts) - 1] in ([(5000, 15000), (15000, 15000)], [(1, 15000), (15000, 15000)])  # in C or not


def test_kanes_speeds_may_be_others_than_the_rates_of_the_coordinates():
    """A skate's forward speed and its turning: they and what turns them depend on the heading."""
    heading = sp.Symbol("heading")
    energy = (vx**2 + vy**2 + dot(heading) ** 2) / 2 + x / 2
    skate = System("skate", (x, y, heading), energy, [vx * sp.sin(heading) - vy * sp.cos(heading)])
    q, u = kane.dynamicsymbols("x y heading"), kane.dynamicsymbols("forward aside turning")
    N, O = kane.ReferenceFrame("N"), kane.Point("O")
    O.set_vel(N, 0)
    B = N.orientnew("B", "Axis", (q[2], N.z))
    B.set_ang_vel(N, u[2] * N.z)
    centre = O.locatenew("C", q[0] * N.x + q[1] * N.y)
    centre.set_vel(N, u[0] * B.x + u[1] * B.y)
    rates = [centre.pos_from(O).dt(N).dot(B.x) - u[0], centre.pos_from(O).dt(N).dot(B.y) - u[1], q[2].diff() - u[2]]
    body = kane.RigidBody("body", centre, B, 1, (kane.inertia(B, 0, 0, 1), centre))
    method = kane.KanesMethod(N, q, [u[0], u[2]], rates, u_dependent=[u[1]], velocity_constraints=[u[1]])
    method.kanes_equations([body], [(centre, N.x / 2)])
    assert agree(skate, of_kane(method)).equal


def test_what_is_said_of_the_next_state_is_not_said_of_unknowns():
    """An equation for the unknowns of one step says nothing of those of the next."""
    system = particle()
    scheme = METHODS["spark"].scheme(system)
    assert keeps(system, scheme)
    unknown = scheme.unknowns[0]
    row = (vz - y * vx).xreplace(dict(zip((x, y, z, vx, vy, vz), (*scheme.place, *scheme.velocity), strict=True)))
    moved_on = [row.xreplace({vx: unknown}).xreplace(dict(zip(scheme.state, scheme.after, strict=True)))]
    other = dataclasses.replace(scheme, velocity=[unknown, *scheme.velocity[1:]], residual=moved_on)
    assert not keeps(system, other)


def test_equations_that_break_one_thing_are_refuted_at_an_exact_state():
    system = particle()
    right = -y * vx * vy / (1 + y**2)
    assert agree(system, {x: right, y: 0, z: y * right + vx * vy}).equal
    assert str(agree(system, {x: right, y: 0, z: y * right + vx * vy})).startswith("equal")
    broken = agree(system, {x: right, y: 0, z: y * right})
    assert (broken.equal, broken.what) == (False, "constraint 1")
    state = {sp.Symbol(k): sp.Rational(v) for k, v in broken.point.items()}
    assert (vz - y * vx).xreplace(state) == 0
    assert abs((vx * vy).xreplace(state)) == abs(sp.Rational(broken.value)) != 0
    broken = agree(system, {x: 2 * right, y: 0, z: 2 * y * right + vx * vy})
    assert broken.what.startswith("the principle")
    assert "should be 0 at" in str(broken)


def test_the_ball_with_the_rule_of_the_paper_takes_the_steps_of_the_map():
    """From the Lagrangian and the constraint of Fedorov's paper, typed in: to 1e-13 what `chapsym.trajectory` has."""
    system = example("ball")
    assert conserved(system, system.integrals["⟨K,γ⟩"]).kept
    motion = Runner(system, "own").march(60)
    kept = {name: np.ptp(values) for name, values in motion.integrals.items()}
    assert max(kept["|𝒦|²"], kept["⟨𝒦,γ⟩"]) < 1e-12 < 1e-11 < min(kept["|K|²"], kept["⟨K,γ⟩"])
    quaternions = (motion.place - 0.025 * motion.velocity)[:, 2:]
    first, second = quaternions[:2]
    turn = [first @ second, *(first[0] * second[1:] - second[0] * first[1:] - np.cross(first[1:], second[1:]))]
    gamma = np.array([vertical(one) for one in quaternions])
    J, D = [1.25, 0.75, 0.25], 1.0
    run = chapsym.trajectory(chapsym.Ball(J, D), momentum(*turn, *gamma[0], *J, D), gamma[0], 59)
    assert np.abs(run.gamma - gamma).max() < 1e-13
    assert np.abs(gamma - vertical([1, 0, 0, 0])).max() > 0.1


def vertical(quaternion):
    """Upwards in the axes of the body."""
    w, v = quaternion[0], np.array(quaternion[1:])
    up = np.array([0, 0, 1.0])
    return up - 2 * w * np.cross(v, up) + 2 * np.cross(v, np.cross(v, up))


def test_attitudes_have_their_angular_velocities():
    """Of skew matrices RᵀR'."""
    p, q, r = sp.symbols("p q r")
    turned = Turned(("z", p), ("y", q), ("x", r))
    skew = turned.rotation.T * rate(turned.rotation, (p, q, r))
    assert turned.spin_in_space == turned.rotation * turned.spin
    at = {p: 0.3, q: -0.7, r: 1.9, dot(p): 0.2, dot(q): 1.1, dot(r): -0.4}
    found = sp.Matrix([skew[2, 1], skew[0, 2], skew[1, 0]]) - turned.spin
    assert np.abs(np.array(found.xreplace(at), float)).max() < 1e-14
    body = Quaternion("q")
    skew = body.rotation.T * rate(body.rotation, body.coordinates)
    found = sp.Matrix([skew[2, 1], skew[0, 2], skew[1, 0]]) - body.spin
    space = body.rotation * body.spin - body.spin_in_space
    unit = {dot(body.coordinates[0]): sp.solve(body.swelling, dot(body.coordinates[0]))[0]}
    at = dict(zip(body.coordinates, map(sp.Rational, ("1/5", "2/5", "2/5", "4/5")), strict=True))
    assert [sp.expand(e.xreplace(unit).xreplace(at)) for e in (*found, *space)] == [0] * 6


def test_a_step_without_a_solution_says_which():
    """The disc falls flat, where its angles end."""
    with pytest.raises(NotSolved, match=r"dla-left: step \d+ of 1000 has no solution near the last one"):
        moved(example("falling_disc"), "dla-left", 1000)
    loose = System("loose", (x, y, z), FREE, [vz - y * vx, 3 * vz - 3 * y * vx], start={vx: 1})
    with pytest.raises(NotSolved, match="as its equations are singular: constraints depend on each other, or the mass"):
        moved(loose, "dla", 1000)


HUGE = 10**6000


def wrong(**settings):
    return System("wrong", **{"coordinates": (x, y, z), "lagrangian": FREE} | settings)


def typed(acceleration):
    return agree(System("one", (a,), va**2 / 2 + sp.cos(a)), acceleration)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: wrong(coordinates=()), "coordinates must be symbols"),
        (lambda: wrong(coordinates=(x, x, z)), "x is two of coordinate, velocity, parameter and length of a step"),
        (lambda: wrong(lagrangian=FREE + a), "the Lagrangian has a, which is no coordinate, velocity or parameter"),
        (lambda: wrong(lagrangian=FREE + vx**3), "is not of degree two in the velocities"),
        (lambda: wrong(constraints=[vx * vy]), "a constraint is not affine in the velocities"),
        (lambda: wrong(constraints=[va]), "a constraint has a_dot"),
        (lambda: wrong(holonomic=[vx]), "a holonomic constraint has x_dot"),
        (lambda: wrong(forces={a: 1}), "a force is along a, which is no coordinate"),
        (lambda: wrong(start={a: 1}), "the start has a, which is no coordinate or velocity"),
        (lambda: wrong(start={"x": 1}), "start must be given as {symbol: value}"),
        (lambda: wrong(integrals={x: vx}), "integrals must be given as {name: quantity}"),
        (lambda: typed({a: -2 * sp.sin(a / 2) * sp.cos(a / 2)}), "sin and cos of coordinates, which a/2 is not"),
        (lambda: typed({a: None}), "acceleration of a is None, which is no real expression"),
        (lambda: typed({a: sp.Symbol("w")}), "there is w, which is no coordinate, velocity or parameter"),
        (lambda: typed({a: sp.sin(va)}), "which a_dot is not"),
        (lambda: typed({}), "there is no acceleration of a"),
        (lambda: of_kane(None), "this is no KanesMethod whose kanes_equations have been formed"),
        (lambda: particle(discrete=Discrete(vx)), "has x_dot, which is nothing at a step's two ends"),
        (lambda: particle(discrete=Discrete(after(x))), "the discretization has 0 constraints, and the system 1"),
        (lambda: particle(discrete=Discrete(after(x), [after(x)]), forces={x: -x}), "of one's own has no forces"),
        (lambda: moved(particle(), "own"), "has no discretization of its own: give it discrete"),
        (lambda: System(None, (x,), vx**2), "name must be a text, not None"),
        (lambda: System("one", (x,), sp.Lambda(x, x)), "has Lambda"),
        (lambda: System("one", (x,), vx**2, holonomic=[0]), "the holonomic constraint 0 has no coordinate"),
        (lambda: moved(particle(), []), r"\[\] is no method; those are dla, "),
        (lambda: moved(particle(), steps=HUGE), r"steps must be a whole number from 1 to 2\^62"),
        (lambda: moved(particle(), steps=2**61), "do not fit into memory"),
        (lambda: moved(particle(), steps=0), "steps must be a whole number from 1 on, not 0"),
        (lambda: moved(particle(), every=0), "every must be a whole number"),
        (lambda: moved(particle(), every=2**62), "every must be a whole number"),
        (lambda: moved(particle(), length=HUGE), "the length of a step is an object of the type int"),
        (lambda: moved(particle(), length=0.0), "particle: the length of a step must be positive, not 0.0"),
        (lambda: measured(particle(), "dla", []), r"steps must be a whole number from 1 on, not \[\]"),
        (lambda: agree(particle(), None), "accelerations must be given as"),
        (lambda: agree(None, {}), "system must be a System, not None"),
        (lambda: conserved("particle", x), "system must be a System"),
        (lambda: flag(None), "system must be a System"),
        (lambda: volume(None), "system must be a System"),
        (lambda: verdicts(particle(), "dla"), "scheme must be the scheme of a method"),
        (lambda: list(certified(particle(), ["euler"])), "'euler' is no method"),
        (lambda: loaded(3), "path must name a Python file, not 3"),
        (lambda: dot("x"), "a coordinate must be a symbol"),
        (lambda: Turned(("w", x)), "a turn is an axis x, y or z and an angle"),
        (lambda: Quaternion("a:c"), "name must be a word"),
        (lambda: System("one", np.array(None), vx**2), "coordinates must be a sequence"),
        (lambda: list(certified(particle(), 3)), "methods must be a sequence"),
        (lambda: conserved(particle(), "a\nb"), r"quantity is .a\\nb., which is no real expression"),
        (lambda: verdicts(particle(), METHODS["dla"].scheme(System("one", (x,), vx**2))), "has other coordinates"),
    ],
)
def test_what_is_no_system_and_no_argument_is_one_sentence(call, said):
    with pytest.raises(BadSystem, match=said):
        call()
