"""No verdict on an engine where the file is written in another convention; a ball of one's own from the first row."""

import csv
import re
from contextlib import nullcontext
from itertools import product

import numpy as np
import pytest
from budget import slow
from commands import answer, chapsym, refused

from benchmarks.rolling.make import CASES, DATA
from chapsym.studies.comparable import case_of_body, case_of_scene
from chapsym.studies.judge import read_case
from chapsym.studies.judge_tables import MORE, NEEDED, TUM, read_table

FILE = DATA / "robot.json"
BODY = FILE.with_suffix(".urdf")
Q, P, V, W = NEEDED[4:], NEEDED[1:4], ("vx", "vy", "vz"), ("wx", "wy", "wz")


@pytest.fixture(scope="module")
def rows():
    """The certified motion, of a second."""
    lines = [line for line in FILE.with_suffix(".csv").read_text("utf-8").splitlines() if not line.startswith("#")]
    table = list(csv.DictReader(lines))[:5]
    return {name: np.array([float(row[name]) for row in table]) for name in table[0]}


@pytest.fixture
def said(monkeypatch):
    """What the command says of how far it is with the certified motion."""
    words = []
    monkeypatch.setattr("chapsym.cli.judge.telling", lambda: nullcontext(words.append))
    return words


def write(folder, rows, head=None, mark=","):
    path = folder / "run.csv"
    lines = [mark.join(map(repr, map(float, row))) for row in zip(*rows.values(), strict=True)]
    path.write_text("\n".join([*([mark.join(rows)] if head is None else head), *lines]) + "\n", encoding="utf-8")
    return path


def with_parts(rows, names, values):
    return rows | dict(zip(names, values, strict=True))


def of_body(rows, names=W):
    w, u, vector = rows["qw"], np.stack([rows[x] for x in Q[1:]]), np.stack([rows[x] for x in names])
    back = 2 * (u * vector).sum(0) * u + (2 * w**2 - 1) * vector - 2 * w * np.cross(u, vector, axis=0)
    return with_parts(rows, names, back)


def y_up(rows):
    for names in (P, V, W):
        x, y, z = (rows[name] for name in names)
        rows = with_parts(rows, names, (x, z, -y))
    return rows


def of_unity(rows):
    for names, sign in ((P, 1), (V, 1), (W, -1), (Q[1:], -1)):
        x, y, z = (sign * rows[name] for name in names)
        rows = with_parts(rows, names, (-y, z, x))
    return rows


def z_down(rows):
    """The axes of space alone: after the turn, 180 degrees about x."""
    for names in (P, V, W):
        x, y, z = (rows[name] for name in names)
        rows = with_parts(rows, names, (x, -y, -z))
    w, x, y, z = (rows[name] for name in Q)
    return with_parts(rows, Q, (-x, w, -z, y))


#: What each file does otherwise, and what is said of it.
OTHERWISE = {
    "last": (lambda r: with_parts(r, Q, [r[x] for x in (*Q[1:], "qw")]), "the scalar last, in the column qz"),
    "taken for last": (lambda r: with_parts(r, Q, [r[x] for x in ("qz", *Q[:3])]), "the scalar in the column qx"),
    "conjugate": (lambda r: with_parts(r, Q[1:], [-r[x] for x in Q[1:]]), "turns space to body"),
    "of the body": (of_body, "its angular velocity is in the axes of the body"),
    "degrees": (lambda r: with_parts(r, W, [np.degrees(r[x]) for x in W]), "is in degrees per second"),
    "mm": (lambda r: with_parts(r, P, [1000 * r[x] for x in P]), "its lengths are in mm: divide them by 1000"),
    "y up": (y_up, "its y is up, and not z"),
    "z down": (z_down, "its z is down: write (x, -y, -z) for (x, y, z), of the quaternion, too"),
    "Unity's": (of_unity, "its axes are Unity's, of the body, too: write (z, -x, y) for (x, y, z), (-z, x, -y) for"),
    "twist": (lambda r: of_body(of_body(r), V), "its velocities are in the axes of the body, as in ROS's Odometry"),
}


#: Those that are looked for before the motion of a ball of one's own is certified take no time.
LATE = ("taken for last", "conjugate", "z down", "Unity's")


@pytest.mark.parametrize(
    ("name", "own"),
    [*product(OTHERWISE, [False]), *((x, True) for x in OTHERWISE if x not in LATE), *slow(*product(LATE, [True]))],
)
def test_another_convention_is_named_and_there_is_no_verdict(rows, tmp_path, name, own):
    change, said = OTHERWISE[name]
    file = write(tmp_path, change(rows))
    case = BODY if own else short(tmp_path, rows)
    words = refused("judge", file, "--body" if own else "--against", case)
    assert f"{file} cannot be judged as it is written: " in words
    assert said in words
    assert ";" not in words, "one thing only is otherwise"


@pytest.mark.parametrize("name", ["twist", *slow("of the body")])
def test_velocities_of_the_body_show_later_where_the_first_attitude_is_no_turn(scene, tmp_path, name):
    """MuJoCo's qvel, of a free joint that begins with the quaternion 1 0 0 0."""
    change, said = OTHERWISE[name]
    scene.write_text(scene.read_text("utf-8").replace("[0.8, 0.0, 0.6, 0.0]", "[1.0, 0.0, 0.0, 0.0]"), "utf-8")
    case = case_of_scene(scene)
    centre = np.column_stack([case.path, np.full(len(case.time), case.radius)])
    parts = np.column_stack([case.time, centre, case.attitude, case.moving, case.omega]).T
    rows = dict(zip((*NEEDED, *MORE), parts, strict=True))
    assert answer("judge", write(tmp_path, rows), "--against", scene)["results"][0]["departure"]["momentum"]
    for option, of in (("--against", scene), ("--body", scene)):
        assert said in refused("judge", write(tmp_path, change(rows)), option, of)


@pytest.mark.parametrize("scale", [1e3, 1e9])
def test_times_in_another_unit_are_seen_by_the_way_of_the_ball(rows, tmp_path, scale):
    """Else a motion of a million seconds is certified."""
    dense = {name: column[:2] for name, column in rows.items()}
    dense["time"] = dense["time"] * 1e-3 * scale
    way = 1e-3 * 0.25 * np.stack([rows[x][0] for x in V])
    dense |= {x: dense[x][0] + np.array([0.0, step]) for x, step in zip(P, way, strict=True)}
    words = refused("judge", write(tmp_path, dense), "--body", BODY)
    assert f"its times are {scale:.0f} times what the way between its rows and its angular velocity say" in words


def test_a_ball_in_mm_and_g_is_not_said_to_be_times(rows, tmp_path):
    body = tmp_path / "mm.toml"
    body.write_text("[ball]\ninertia = [4600e3, 6100e3, 8300e3]\nmass = 1900\nradius = 105\n", encoding="utf-8")
    words = refused("judge", write(tmp_path, rows), "--body", body)
    assert "mm.toml: the ball has the radius 105 m, and its centre is 0.105 m high in " in words


@pytest.mark.parametrize(
    ("order", "said"),
    [
        ([0, 1, 1, 2], "row 3 is at 0.25 s, after one at 0.25 s: the times must ascend"),
        ([0, 1, 3, 2], "row 4 is at 0.5 s, after one at 0.75 s: the times must ascend"),
        ([0], "a motion has two rows or more"),
    ],
)
def test_the_row_whose_time_does_not_ascend_is_named(rows, tmp_path, order, said):
    file = write(tmp_path, {name: column[order] for name, column in rows.items()})
    assert said in refused("judge", file, "--body", BODY)


def test_a_ball_at_rest_has_no_energy_in_per_cent(rows, tmp_path):
    """A file that has the ball alone needs no start."""
    body = tmp_path / "ball.toml"
    body.write_text("[ball]\ninertia = [0.0046, 0.0061, 0.0083]\nmass = 1.9\nradius = 0.105\n", encoding="utf-8")
    still = {name: np.zeros(3) if name in (*V, *W) else np.full(3, column[0]) for name, column in rows.items()}
    still["time"] = rows["time"][:3]
    found = answer("judge", write(tmp_path, still), "--body", body)["results"][0]["departure"]
    assert found.keys() == {"path", "attitude", "height", "slip"}
    assert all(part["greatest"] == 0 for part in found.values())


def short(folder, rows):
    """The case, of the times of the rows."""
    import json

    data = json.loads(FILE.read_text("utf-8"))
    data["frames"] = data["frames"][: len(rows["time"])]
    path = folder / "robot.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    return path


def test_a_path_that_begins_elsewhere_and_a_start_that_is_another_are_said(rows, tmp_path):
    case = short(tmp_path, rows)
    assert "its centre is (5, 0, 0) m from there: subtract this" in refused(
        "judge", write(tmp_path, rows | {"x": rows["x"] + 5}), "--against", case
    )
    words = refused("judge", write(tmp_path, rows | {"wx": rows["wx"] * 1.01}), "--against", case)
    assert "its first row is not the start of robot (omega 0.209 rad/s): no verdict on the engine" in words
    rounded = {name: np.round(column, 3) for name, column in rows.items()}
    found = answer("judge", write(tmp_path, rounded), "--against", case)["results"][0]["departure"]
    assert found["path"]["greatest"] < 1e-3


def test_a_ball_of_ones_own_has_the_motion_that_the_case_has(rows, tmp_path, said):
    later = rows | {"time": rows["time"] + 1708447572.25}
    made, case = case_of_body(BODY, read_table(write(tmp_path, later))), read_case(FILE)
    n = len(rows["time"])
    np.testing.assert_array_equal(made.time, case.time[:n])
    for name in ("path", "omega"):
        np.testing.assert_allclose(getattr(made, name), getattr(case, name)[:n], atol=1e-10)
    found = answer("judge", write(tmp_path, rows), "--body", BODY)
    assert found["case"] == "robot"
    assert said[-1].endswith("%")
    assert found["results"][0]["departure"]["attitude"]["departs"] is None
    leaving = later | {"x": rows["x"] + 4e-3 * (rows["time"] - rows["time"][0])}
    assert re.search(
        r"path .* beyond 0.001 m from 0\.\d+ s after the first row on",
        chapsym("judge", write(tmp_path, leaving), "--body", BODY).stdout,
    )
    slow = with_parts(rows, (*V, *W), [rows[x] * (0.5 if x in W else 1.0) for x in (*V, *W)])
    assert "its first row is not the start of a ball that rolls (velocity " in refused(
        "judge", write(tmp_path, slow), "--body", BODY
    )
    assert "(0, 0, 0.2) m from there: subtract this, or begin where a ball in the air has come down)" in refused(
        "judge", write(tmp_path, rows | {"z": rows["z"] + 0.2}), "--body", BODY
    )
    assert "give either --against" in refused("judge", write(tmp_path, rows))


TOML = """[ball]
mass = 1.9
inertia = [
  0.0046, 0.0061, 0.0083]
radius = 0.105
"""
BALLS = {f"a{kind}": FILE.with_suffix(kind).read_text("utf-8") for kind in (".urdf", ".xml")}
BALLS |= {"a.toml": TOML, "a list.toml": TOML.replace("[ball]", "[[ball]]")}


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("a.urdf", "0.0083", "0.083", "line 5: <inertia>: no body has the inertia"),
        ("a.urdf", "1.9", "-1.9", "line 4: <mass>: mass and radius must be positive"),
        ("a.urdf", "0.105", "0", "line 8: <sphere>: mass and radius must be positive"),
        ("a.xml", "0.0083", "0.083", "line 5: <inertial>: no body has the inertia"),
        ("a.xml", "0.105", "-1", "line 6: <geom>: mass and radius must be positive"),
        ("a.toml", "0.0083", "0.083", "line 3: ball.inertia: no body has the inertia"),
        ("a list.toml", "1.9", "0", "line 2: ball.mass: mass and radius must be positive"),
    ],
)
def test_a_ball_that_physics_refuses_is_refused_where_the_user_wrote_it(rows, tmp_path, name, old, new, said):
    file, scene = tmp_path / name, tmp_path / "new.toml"
    file.write_text(BALLS[name].replace(old, new), encoding="utf-8")
    assert f"{file}, {said}" in refused("judge", write(tmp_path, rows), "--body", file)
    if file.suffix != ".toml":
        assert f"{file}, {said}" in refused("scene", "new", scene, "--from", file)
        assert not scene.exists()


def alike(folder):
    """A ball with equal moments, and its closed motion: ω is constant in space."""
    file, time = folder / "alike.urdf", np.arange(5) / 100
    file.write_text(BALLS["a.urdf"].replace("0.0061", "0.0046").replace("0.0083", "0.0046"), encoding="utf-8")
    w, start = np.array([-0.72, -20.0, -31.04]), np.array([0.6, 0.0, 0.8, 0.0])
    half, along = np.linalg.norm(w) * time / 2, w / np.linalg.norm(w)
    turn = np.cos(half)[:, np.newaxis] * start[0], np.sin(half)[:, np.newaxis] * along
    scalar = turn[0][:, 0] - turn[1] @ start[1:]
    vector = np.cos(half)[:, np.newaxis] * start[1:] + start[0] * turn[1] + np.cross(turn[1], start[1:])
    v = 0.105 * np.array([w[1], -w[0], 0.0])
    still = np.ones((5, 1))
    parts = [time, *np.outer(v, time)[:2], 0.105 * still[:, 0], scalar, *vector.T, *(still * v).T, *(still * w).T]
    return file, dict(zip((*NEEDED, *MORE), parts, strict=True))


def test_a_quaternion_in_another_order_is_named_where_it_turns_nearly_alike(tmp_path):
    """Read in the other order it is 9 degrees off after half a radian."""
    file, rows = alike(tmp_path)
    assert answer("judge", write(tmp_path, rows), "--body", file)["results"][0]["departure"]["attitude"]["end"] < 1e-5
    moved = with_parts(rows, Q, [rows[name] for name in ("qx", "qy", "qz", "qw")])
    assert "its quaternion has the scalar last" in refused("judge", write(tmp_path, moved), "--body", file)


def test_a_table_without_an_attitude_is_judged_by_what_it_has(rows, scene, tmp_path):
    def found(table, *case):
        return answer("judge", write(tmp_path, table), *case)["results"][0]["departure"]

    def without(table):
        return {name: values for name, values in table.items() if name not in Q}

    sliding = with_parts(rows, ["vx"], [rows["vx"] + 0.25 * (rows["time"] > 0.5)])
    for case, parts in ((("--against", scene), {"path", "height", "slip"}), (("--body", BODY), {"height", "slip"})):
        judged = found(without(sliding), *case)
        assert set(judged) == parts
        assert judged["slip"]["greatest"] == pytest.approx(0.25)
    file, table = alike(tmp_path)
    judged = found(without(table), "--body", file)
    assert set(judged) == {"path", "energy", "momentum", "height", "slip"}
    assert max(part["greatest"] for part in judged.values()) < 1e-9
    assert "its y is up" in refused("judge", write(tmp_path, without(y_up(rows))), "--body", BODY)
    part = {name: values for name, values in rows.items() if name != "qy"}
    assert "has no column qy" in refused("judge", write(tmp_path, part), "--body", BODY)


def test_of_several_results_each_has_the_start_of_the_others(rows, tmp_path):
    """The ball starts as the file of the fewest rows does."""
    files, later = [], {name: values[1:] for name, values in rows.items()}
    for name, table, step in (("a", {x: values[:3] for x, values in rows.items()}, 4), ("b", rows, 2), ("c", rows, 1)):
        (tmp_path / name).mkdir()
        files.append(write(tmp_path / name, table, [f"# time_step = {step}e-3", ",".join(rows)]))
    answer("judge", *files, "--body", BODY)
    write(tmp_path / "c", later, ["# time_step = 1e-3", ",".join(rows)])
    assert f"{files[2]}: its first row is not the start of robot" in refused("judge", *files, "--body", BODY)


def test_a_ball_that_slides_at_first_is_not_said_to_be_in_mm(tmp_path):
    """Unity turns by 7 rad/s at most; a column of 0.0 and a height of 0.105 have no rounding that would hide it."""
    rows = {name: np.zeros(3) for name in (*NEEDED, *MORE)} | {"z": np.full(3, 0.105)}
    rows |= {"time": np.arange(3) / 100, "x": np.arange(3) * 0.03, "vx": np.full(3, 3.0), "wy": np.full(3, 7.0)}
    rows |= {"qw": np.cos(np.arange(3) * 0.035), "qy": np.sin(np.arange(3) * 0.035)}
    words = refused("judge", write(tmp_path, rows), "--body", BODY)
    assert "its first row is not the start of a ball that rolls (velocity 2.27 m/s): no verdict on the engine" in words


@pytest.fixture
def scene(tmp_path):
    """The case, of the times of the rows."""
    text = (CASES / "robot.toml").read_text("utf-8")
    path = tmp_path / "mine.toml"
    path.write_text(text.replace("time = 10", "time = 1").replace("frames = 40", "frames = 4"), encoding="utf-8")
    return path


def test_a_scene_is_a_case(rows, scene, tmp_path, said):
    found = answer("judge", write(tmp_path, rows), "--against", scene)["results"][0]["departure"]
    assert found["path"]["greatest"] < 1e-12
    assert found["momentum"]["greatest"] < 1e-10
    assert said[-1].endswith("%")


def test_tables_of_trackers_and_other_engines_are_read(rows, tmp_path):
    tum = write(tmp_path, {name: rows[name] for name in TUM}, head=["# a tracker"], mark=" ")
    np.testing.assert_array_equal(read_table(tum).columns["qw"], rows["qw"])
    names = ["Time [s]", "position.x", "posY", "pos_z", "orientation.w", "quat_x", "qy", "rotation z"]
    names += ["linear_velocity.x", "v_y", "velZ", "angular_velocity_x", "omega_y", "wz (rad/s)"]
    head = ["a title", ";".join(names)]
    table = read_table(write(tmp_path, rows, head=head, mark=";"))
    assert set(table.columns) == set(rows)
    np.testing.assert_array_equal(table.columns["vz"], rows["vz"])


@pytest.mark.parametrize("mark", ["_{}", " [{}]", "({})"])
def test_a_unit_in_the_name_of_a_column_is_taken(rows, tmp_path, mark):
    units = {"x": "mm", "y": "cm", "z": "m", "vx": "mm/s", "vy": "cm_s", "vz": "m s^-1", "wx": "deg/s", "wy": "dps"}
    part = {"mm": 1e3, "cm": 1e2, "de": 180 / np.pi, "dp": 180 / np.pi}
    given = {name: rows[name] * part.get(units.get(name, "")[:2], 1) for name in rows}
    head = [name + mark.format(units[name]) if name in units else name for name in rows]
    found = read_table(write(tmp_path, given, head=[",".join(head)]))
    for name in rows:
        np.testing.assert_allclose(found.columns[name], rows[name], rtol=1e-15)
    assert found.digit["centre"] < 1e-15


def test_angles_are_no_attitude(rows, tmp_path):
    names = dict(zip(rows, ["time", "x", "y", "z", "roll", "Pitch (deg)", "yaw"], strict=False))
    file = write(tmp_path, {new: rows[old] for old, new in names.items()})
    words = refused("judge", file, "--against", FILE)
    assert "the columns roll, Pitch (deg), yaw, angles whose order has many conventions: write the attitude as" in words


ODOMETRY = "%time,field.header.seq,field.header.stamp,field.header.frame_id," + ",".join(
    f"field.{part}.{c}" for part, axes in (("pose.pose.position", "xyz"), ("pose.pose.orientation", "xyzw"),
                                           ("twist.twist.linear", "xyz"), ("twist.twist.angular", "xyz")) for c in axes
)  # fmt: skip
LOGS = {
    "rostopic": (ODOMETRY, ",", (*TUM[1:], *V, *W), "{i}000000000,{i},{i}000000000,odom,{row}"),
    "TUM's head": ("# timestamp tx ty tz qx qy qz qw", " ", TUM[1:], "{i} {row}"),
    "torques": ("time,x,y,z,qx,qy,qz,qw,tx,ty,tz,contact_pos_x", ",", TUM[1:], "{i},{row},7,7,7,7"),
    "decimal commas": ("t;x;y;z;qx;qy;qz;qw", ";", TUM[1:], "{i},0;{row}"),
    "quotes": ('"frame_time","x","y","z","qx","qy","qz","qw"', ",", TUM[1:], '"{i}",{row}'),
    "texts": (
        "\t".join(["Vehicle", "time [ms]", *(f"POS_{c}" for c in "XYZ"), *(f"Q_{c}" for c in "XYZW"), "Image"]),
        "\t", TUM[1:], "b,1\t{i}000\t{row}\ta;b",
    ),
    "PX4": (
        ",".join(["timestamp_us", *(f"o.position[{i}]" for i in range(3)), *(f"o.q[{i}]" for i in range(4))]),
        ",", NEEDED[1:], "{i}000000,{row}",
    ),
    "Isaac Lab": (
        ",".join(["sim_time", *(f"root_pos_w_{c}" for c in "xyz"), *(f"root_quat_w_{c}" for c in "wxyz")]),
        ",", NEEDED[1:], "{i},{row}",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", LOGS)
def test_public_logs_are_read_with_their_texts_commas_and_units(name, rows, tmp_path):
    """Each as a file that was found writes it (docs/reference/measured/public_files.md)."""
    head, mark, names, line = LOGS[name]
    lines = [head]
    for i, row in enumerate(zip(*(rows[name] for name in names), strict=True)):
        cells = mark.join(repr(float(x)) for x in row)
        lines.append(line.format(i=i, row=cells.replace(".", ",") if mark == ";" else cells))
    file = tmp_path / "log.csv"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    found = read_table(file).from_zero()
    np.testing.assert_array_equal(found.columns["time"], np.arange(len(rows["time"])))
    for name in names:
        np.testing.assert_array_equal(found.columns[name], rows[name])


@pytest.mark.parametrize(
    ("head", "columns", "scale"),
    [
        ("time," + ",".join([*(f"qpos[{i}]" for i in range(7)), *(f"qvel_{i}" for i in range(6))]), None, 1),
        ("t,x,y,z,e0,e1,e2,e3,x_dt,y_dt,z_dt,wx,wy,wz", None, 1),
        (
            "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z [],"
            "v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1]",
            [*["time", "x", "y", "z"], *Q, *V], 1e9,
        ),
        (
            "%time," + ",".join(f"field.pose.pose.position.{c}" for c in "xyz") + ","
            + ",".join(f"field.pose.pose.orientation.{c}" for c in "xyzw"),
            TUM, 1e9,
        ),
        ("header.stamp,posX,posY,posZ,oriX,oriY,oriZ,oriW", TUM, 1),
    ],
)  # fmt: skip
def test_names_of_mujoco_chrono_euroc_ros_and_pybullet_are_read(head, columns, scale, rows, tmp_path):
    """Times in nanoseconds are whole numbers of 19 digits, and are read as they are written."""
    columns = columns or list(rows)
    given = {name: rows[name] * (scale if name == "time" else 1) for name in columns}
    file = write(tmp_path, given, head=[head])
    if scale != 1:
        first, *lines = file.read_text("utf-8").splitlines()
        cells = [line.split(",", 1) for line in lines]
        whole = [f"{1708447572000000000 + int(float(time))},{rest}" for time, rest in cells]
        file.write_text("\n".join([first, *whole]) + "\n", encoding="utf-8")
    found = read_table(file).from_zero()
    for name in columns:
        np.testing.assert_array_equal(found.columns[name], rows[name])
