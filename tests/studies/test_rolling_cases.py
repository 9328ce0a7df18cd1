"""The cases of benchmarks/rolling that do more than roll: the closed form, and integrations by another method."""

import json
import runpy
import subprocess
import sys
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from budget import slow
from commands import answer
from flint import arb, arb_poly, ctx
from motion_reference import matrix
from scipy.integrate import solve_ivp
from vectors import cross

from benchmarks.rolling import make, off_centre, sliding
from benchmarks.rolling.engines.common import DATA
from chapsym import generated
from chapsym.dynamics.errors import TooWide
from chapsym.dynamics.loops.vectors import dot as dot_of
from chapsym.mechanics import agree, dot, loaded
from chapsym.scene import SceneError
from chapsym.scene.read import robots
from chapsym.studies.judge import carried, read_case

EXAMPLES = DATA.parent / "examples"
UP = np.array([0.0, 0.0, 1.0])


def turning(q, omega):
    """q' of ω in space."""
    return np.concatenate([[-omega @ q[1:]], q[0] * omega + cross(omega, q[1:])]) / 2


def integrated(times, slope, state, until=None):
    fine, span = {"rtol": 1e-13, "atol": 1e-15, "max_step": 0.03}, (times[0], times[-1])
    return solve_ivp(slope, span, state, "DOP853", times, events=until, **fine)


def rolled(case, rotor):
    """The path and the attitude by the momentum about the point of contact, which space keeps; ω by a linear system."""

    def omega(q):
        R = matrix(q)
        whole = R @ np.diag(case.inertia) @ R.T + case.mass * case.radius**2 * (np.eye(3) - np.outer(UP, UP))
        return np.linalg.solve(whole, kept - R @ rotor)

    R = matrix(case.attitude[0])
    kept = R @ (case.inertia * (R.T @ case.omega[0]) + rotor)
    kept = kept + case.mass * case.radius**2 * case.omega[0] * [1, 1, 0]

    def slope(_, y):
        w = omega(y[:4])
        return np.concatenate([turning(y[:4], w), case.radius * np.array([w[1], -w[0]])])

    y = integrated(case.time, slope, [*case.attitude[0], *case.path[0]]).y.T
    return y[:, :4], y[:, 4:]


def slid(case, friction):
    """By Newton's and Euler's equations with Coulomb's friction along the slip until it is 1 µm/s; then it rolls."""

    def slip(y):
        return y[6:9] + cross(y[9:], -case.radius * UP)

    def slope(_, y):
        along = slip(y)
        force = -friction * case.mass * case.gravity * along / np.linalg.norm(along)
        torque = cross(-case.radius * UP, force)
        return np.concatenate([turning(y[:4], y[9:]), y[6:8], force / case.mass, torque / case.inertia[0]])

    def left(_, y):
        return np.linalg.norm(slip(y)) - 1e-6

    left.terminal = True
    start = [*case.attitude[0], *case.path[0], *case.moving[0], *case.omega[0]]
    found = integrated(case.time, slope, start, left)
    end, (last,) = found.t_events[0][0], found.y_events[0]
    after = case.time > end
    rest = replace(
        case, time=np.array([end, *case.time[after]]), attitude=last[None, :4], path=last[None, 4:6],
        omega=last[None, 9:],
    )  # fmt: skip
    q, path = rolled(rest, case.rotor)
    before = found.y.T[: (~after).sum()]
    return np.concatenate([before[:, :4], q[1:]]), np.concatenate([before[:, 4:6], path[1:]]), end


def rolls_from(name):
    return float(json.loads((make.DATA / f"{name}.json").read_text("utf-8")).get("rolls_from", [0])[0])


def early(case):
    """Its first third, in which another motion is seen, too."""
    n = len(case.time) // 3
    return replace(case, **{name: getattr(case, name)[:n] for name in ("time", "path", "attitude", "omega")})


def apart(case, found):
    """The greatest differences of attitudes and paths."""
    q = found[0] * np.sign((found[0] * case.attitude).sum(axis=1))[:, None]
    return abs(q - case.attitude).max(), abs(found[1] - case.path).max()


@pytest.mark.thorough  # as are those below: of the data, which their hashes pin
@pytest.mark.parametrize("name", ["free-top", "rotor"])
def test_another_integration_finds_the_same(name):
    case = read_case(make.DATA / f"{name}.json")
    assert max(apart(case, rolled(case, case.rotor))) < 1e-9
    other = case.rotor * 1.01
    if name == "free-top":
        case = replace(case, inertia=case.inertia * [1.001, 1, 1])
    assert max(apart(early(case), rolled(early(case), other))) > 1e-3


@pytest.mark.thorough
def test_another_integration_slides_and_rolls_alike():
    case = read_case(make.DATA / "sliding.json")
    found = slid(case, case.friction)
    assert max(apart(case, found)) < 1e-4  # a slip of 1 µm/s is left, of 35 rad/s that the ball turns
    assert found[2] == pytest.approx(rolls_from("sliding"), abs=1e-6)
    assert max(apart(case, slid(case, 1.0005 * case.friction))) > 0.01


@pytest.mark.parametrize("name", ["free-top", "rotor", "sliding"])
def test_what_the_motion_keeps_is_kept_and_nothing_else(name):
    case = read_case(make.DATA / f"{name}.json")
    energy, momentum = carried(case, case.attitude, case.moving, case.omega)
    assert np.ptp(momentum, axis=0).max() < 1e-13 * np.linalg.norm(momentum[0])
    rolls = case.time >= rolls_from(name)
    assert np.ptp(energy[rolls]) < 1e-13 * energy[0]
    assert (np.diff(energy[~rolls]) < 0).all()
    if case.rotor.any():
        without = carried(replace(case, rotor=0 * case.rotor), case.attitude, case.moving, case.omega)[1]
        assert np.ptp(without, axis=0).max() > 0.1 * np.linalg.norm(without[0])


def test_the_closed_form_is_the_motion_exactly():
    t, m, r, mu, g, v, w, k = sp.symbols("t m r mu g v w k", positive=True)
    c = sp.Rational(3, 5)
    slide = sliding.Slide("", m, r, mu, g, (c, sp.Rational(4, 5)), v, w, part=k)
    d = sp.Matrix([*slide.direction, 0])
    up = sp.Matrix([0, 0, 1])
    n = up.cross(d)
    for state, friction in ((slide.slides(t), mu), (slide.rolls(t), 0), (slide.slides(t), 2 * mu)):
        force = -friction * m * g * d
        newton = m * sp.diff(state.velocity, t) * d - force
        euler = k * m * r**2 * sp.diff(state.rate, t) * n - (-r * up).cross(force)
        paths = [sp.diff(state.way, t) - state.velocity, sp.diff(state.angle, t) - state.rate]
        solved = all(sp.expand(x) == 0 for x in (*newton, *euler, *paths))
        assert solved == (friction != 2 * mu)
    slip = lambda state: (state.velocity * d + (state.rate * n).cross(-r * up)).dot(d)  # noqa: E731
    assert sp.simplify(slip(slide.slides(t)) - (v - r * w) * (1 - t / slide.end)) == 0  # of one sign until the end
    assert sp.simplify(slip(slide.rolls(t))) == 0
    for before, after in zip(slide.slides(slide.end), slide.rolls(slide.end), strict=True):
        assert sp.simplify(before - after) == 0
    start = slide.slides(sp.S.Zero)
    assert start == (0, v, 0, w)


def accelerations(system, body):
    """Those of the coordinates by the equations of `off_centre`, in the system's own letters."""
    w, up = sp.Matrix(sp.symbols("w1:4")), sp.Matrix(sp.symbols("g1:4"))
    carried = sp.Matrix(body.momentum(up, w))
    turned = carried.jacobian(up) * up.cross(w)
    inertia = carried.jacobian(w)
    rate = inertia.adjugate() * (sp.Matrix(body.torque(up, carried, w)) - turned) / inertia.det()
    x, y, *q = system.coordinates
    R = sp.Matrix(3, 3, generated.rotation(*q))
    spin = sp.Matrix(generated.compose(q[0], *(-z for z in q[1:]), *map(dot, q))[1:]) * 2
    rate = rate.xreplace(dict(zip((*w, *up), (*spin, *R[2, :]), strict=True)))
    second = sp.Matrix(generated.compose(*map(dot, q), 0, *spin)) + sp.Matrix(generated.compose(*q, 0, *rate))
    in_space = R * rate
    return dict(zip(q, second / 2, strict=True)) | {x: body.radius * in_space[1], y: -body.radius * in_space[0]}


@pytest.mark.thorough
def test_the_equations_off_the_centre_are_those_of_the_principle():
    system, given = loaded(EXAMPLES / "off_centre_ball.py"), off_centre.START.body
    read = lambda x: sp.Rational(*x.as_integer_ratio())  # noqa: E731
    body = off_centre.Body(*(sp.Matrix([*map(read, x)]) if isinstance(x, tuple) else read(x) for x in given))
    numbers = {body.mass, body.radius, body.gravity, *body.inertia, *body.offset}
    assert {sp.Rational(x) for x in system.parameters.values()} == numbers
    assert agree(system, accelerations(system, body)).equal
    for w, up in (((2, 3, 5), (2, -3, 6)), ((-1, 4, 7), (9, 2, 6))):  # exactly
        assert given.omega(up, given.momentum(up, w)) == [*w]

    class Without(off_centre.Body):
        """The equations without the motion of the point of contact."""

        def torque(self, up, K, w):
            return [x + self.mass * self.gravity * y for x, y in zip(K.cross(w), up.cross(self.offset), strict=True)]

    assert not agree(system, accelerations(system, Without(*body))).equal


def weighed(case):
    """The path and the attitude by Newton's and Euler's equations in space, the plane's reaction eliminated."""

    def rate(q, w):
        R = matrix(q)
        inertia, c = R @ np.diag(case.inertia) @ R.T, R @ case.offset
        arm = case.radius * UP + c

        # Euler's equation about the centre of mass, by the rate of w times a matrix, and by the rest of the force.
        whole = inertia + case.mass * np.cross(arm, np.cross(np.eye(3), arm))
        force = case.mass * (cross(w, cross(w, c)) + case.gravity * UP)
        return -np.linalg.solve(whole, cross(w, inertia @ w) + cross(arm, force))

    def slope(_, y):
        q, w = y[:4], y[6:]
        return np.concatenate([turning(q, w), case.radius * np.array([w[1], -w[0]]), rate(q, w)])

    y = integrated(case.time, slope, [*case.attitude[0], *case.path[0], *case.omega[0]]).y.T
    return y[:, :4], y[:, 4:6]


@pytest.mark.thorough
def test_another_integration_rolls_alike_off_the_centre():
    case = read_case(make.DATA / "off-centre.json")
    assert max(apart(case, weighed(case))) < 1e-9
    assert max(apart(early(case), weighed(replace(early(case), offset=1.01 * case.offset)))) > 1e-3


def test_the_enclosed_energy_off_the_centre_stays():
    frames = json.loads((make.DATA / "off-centre.json").read_text("utf-8"))["frames"]
    with ctx.workprec(140):
        body = off_centre.START.path(140).body

        def energies(weight):
            for frame in frames:
                K, w, up = ([arb(*pair) for pair in frame[part]] for part in ("angular_momentum", "omega", "gamma"))
                yield dot_of(K, w) / 2 + weight * dot_of(body.offset, up)

        first, *later = energies(body.mass * body.gravity)
        assert all(x.overlaps(first) and x.rad() < 1e-30 for x in later)
        first, *later = energies(body.mass * body.gravity * (1 + arb("1e-25")))
        assert not any(x.overlaps(first) for x in later)


def at_the_first_frame(bits):
    with ctx.workprec(bits):
        path, end = off_centre.START.path(bits), Fraction(1, 4)
        while path.time < end:
            path.advance(end)
        return path.frame(end)


def widest(found):
    """The largest radius of a frame's parts, all of which contain those of the data."""
    truth = json.loads((make.DATA / "off-centre.json").read_text("utf-8"))["frames"][1]
    with ctx.workprec(140):
        assert all(x.contains(arb(*y)) for part, v in found.items() for x, y in zip(v, truth[part], strict=True))
    return max(float(x.rad()) for v in found.values() for x in v)


@pytest.mark.parametrize("wrong", [0, 6, None, *slow(2, 4, 8, 10, 12, 14)])
def test_the_lemma_holds_for_polynomials_that_are_wrong(wrong, monkeypatch):
    """Those of an axis, of K or of ω are off by 1e-12, or ω of K is: the balls have that size, and the truth."""
    series, omega = off_centre.Path._series, off_centre.Body.omega

    def bent(path, start, h, terms):
        with monkeypatch.context() as patch:
            if wrong is None:
                patch.setattr(off_centre.Body, "omega", lambda *args: [x * (1 + 1e-12) for x in omega(*args)])
            found = series(path, start, h, terms)
        if wrong is not None and terms != off_centre.LOOK_TERMS:
            found[wrong] += arb_poly([0, 0, 1e-12])
        return found

    monkeypatch.setattr(off_centre.Path, "_series", bent)
    assert 1e-13 < widest(at_the_first_frame(100)) < 1e-5


def test_the_first_frame_is_that_of_the_data_and_too_few_bits_prove_nothing():
    assert widest(at_the_first_frame(100)) < 1e-22
    with pytest.raises(TooWide):
        at_the_first_frame(24)


@pytest.mark.parametrize(("name", "end", "frames"), [("free-top", 20, 80), ("rotor", 10, 40)])
def test_the_first_tenth_of_a_case_is_that_of_its_scene(tmp_path, name, end, frames):
    scene, text = tmp_path / f"{name}.toml", (make.CASES / f"{name}.toml").read_text("utf-8")
    text = text.replace(f"time = {end}.0", f"time = {end / 10}")
    scene.write_text(text.replace(f"frames = {frames}", f"frames = {frames // 10}"), "utf-8")
    found = answer("judge", make.DATA / f"{name}.csv", "--against", scene)
    assert max(part["greatest"] for part in found["results"][0]["departure"].values()) < 1e-9


@pytest.mark.parametrize("form", make.BODIES)
def test_the_file_of_a_ball_has_exactly_its_numbers(form):
    files = sorted(DATA.glob(f"*.{form}"))
    assert len(files) == 32
    off = DATA / f"off-centre.{form}"
    assert '"0.003 -0.002 0.004"' in off.read_text("utf-8")
    with pytest.raises(SceneError, match=r"centre of mass of <inertial> is 5\.39 mm off the centre"):
        robots.table(off)
    for file in set(files) - {off}:
        wanted, found = json.loads(file.with_suffix(".json").read_text("utf-8"))["ball"], robots.table(file)
        numbers = [Decimal(str(found[name])) for name in ("mass", "radius")]
        assert numbers == [Decimal(wanted[name]) for name in ("mass", "radius")], file
        tensor = [[Decimal(str(x)) for x in row] for row in found["inertia"]]
        assert tensor == np.diag([Decimal(x) for x in wanted["inertia"]]).tolist(), file


@pytest.fixture
def refused_by_engine(tmp_path, monkeypatch, capfd):
    """What the program says with which an engine rolls a ball, of what it does not take."""

    def said(*args):
        words = ["engines", *map(str, args), "-o", str(tmp_path / "never.csv")]
        monkeypatch.setattr(sys, "argv", words)
        with pytest.raises(SystemExit) as ended:
            runpy.run_module("benchmarks.rolling.engines", run_name="__main__")
        assert not (tmp_path / "never.csv").exists()
        return capfd.readouterr().err if ended.value.code == 2 else ended.value.code

    return said


def test_one_command_takes_a_ball_from_its_file_to_the_verdict(tmp_path, monkeypatch, capfd, refused_by_engine):
    """The engine is the control, a contact by penalty: it slips, and keeps the momentum."""
    words = "penalty", str(DATA / "robot.urdf"), "--time", "0.4", "-o", str(tmp_path / "robot.csv")
    monkeypatch.setattr(sys, "argv", ["engines", *words])
    with pytest.raises(SystemExit, match=r"^0$"):
        runpy.run_module("benchmarks.rolling.engines", run_name="__main__")
    found = {line.split()[0]: line for line in capfd.readouterr().out.splitlines()[1:]}
    assert "within 1 %" in found["momentum"]
    assert float(found["slip"].split()[3]) > 1e-3
    moved = tmp_path / "moved.urdf"
    text = (DATA / "robot.urdf").read_text("utf-8").replace("<geometry>", '<origin xyz="0 .1 0"/><geometry>')
    moved.write_text(text.replace("<mass", '<origin xyz="0 .1 0"/><mass'), encoding="utf-8")
    for wrong, said in (
        (tmp_path / "none.urdf", "none.urdf"),
        ("rotor", "no ball that rolls by itself"),
        (moved, "the origin of the body must be the centre of its sphere, and that is at (0, 0.1, 0) m"),
    ):
        assert said in refused_by_engine("penalty", wrong)


@pytest.mark.parametrize(("engine", "package"), [(x, x) for x in ("mujoco", "pybullet")] + [("drake", "pydrake")])
def test_an_engine_rolls_the_ball_off_its_centre_as_the_case_does(engine, package, tmp_path):
    pytest.importorskip(package)
    words = f"-m benchmarks.rolling.engines {engine} off-centre --best -o".split()
    command = [sys.executable, *words, str(tmp_path / "own.csv")]
    assert subprocess.run(command, cwd=DATA.parents[2], capture_output=True, check=False).returncode == 0
    found = answer("judge", tmp_path / "own.csv", "--against", DATA / "off-centre.json")["results"][0]["departure"]
    assert found["path"]["greatest"] < 2e-3
    assert found["energy"]["greatest"] < 0.1


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["penalty", "robot", "--step", "0"], "0 is no positive number of seconds"),
        (["penalty", "robot", "--time", "nan"], "nan is no positive number of seconds"),
        (["penalty", "robot", "--step", "0.003"], "the step must divide 0.25 s"),
        (["penalty", EXAMPLES / "turned.urdf"], "must have an inertia in its principal axes"),
    ],
)
def test_what_no_engine_can_take_is_refused_in_one_sentence(args, said, refused_by_engine):
    assert said in refused_by_engine(*args)
