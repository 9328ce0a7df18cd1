"""The ball of a URDF, an SDF or an MJCF: one tensor of three formats, its numbers as written, and what is refused."""

import json
from fractions import Fraction

import numpy as np
import pytest
from commands import chapsym, refused

from chapsym.scene import SceneError, load
from chapsym.scene.members.exactly import exact_motion
from chapsym.scene.members.members import ball_of, expand
from chapsym.scene.read.robots import LEFT_OUT, table

URDF = """<?xml version="1.0"?>
<robot name="r"><link name="floor"/><link name="ball">
 <inertial>
  <origin xyz="0 0 0" rpy="0 0 0"/>
  <mass value="1.9"/>
  <inertia ixx="0.0046" ixy="0.0001" ixz="-2e-4" iyy="0.0061" iyz="3E-4" izz="0.0083"/>
 </inertial>
 <collision><geometry><sphere radius="0.105"/></geometry></collision>
</link></robot>"""
SDF = """<sdf version="1.9"><world name="w"><model name="m"><link name="ball">
 <inertial><pose>0 0 0 0 0 0</pose><mass>1.9</mass>
  <inertia><ixx>0.0046</ixx><ixy>0.0001</ixy><ixz>-2e-4</ixz><iyy>0.0061</iyy><iyz>3E-4</iyz><izz>0.0083</izz></inertia>
 </inertial>
 <collision name="c"><geometry><sphere><radius> 0.105 </radius></sphere></geometry></collision>
</link></model></world></sdf>"""
MJCF = """<mujoco><worldbody><geom type="plane" size="1 1 1"/><body name="ball" pos="0 0 1">
 <inertial pos="0 0 0" mass="1.9" fullinertia="0.0046 0.0061 0.0083 0.0001 -2e-4 3E-4"/>
 <geom size="0.105"/><freejoint/>
</body></worldbody></mujoco>"""
#: In all three ixy is an entry of the tensor, -∫xy dm.
ROWS = [["0.0046", "0.0001", "-2e-4"], ["0.0001", "0.0061", "3E-4"], ["-2e-4", "3E-4", "0.0083"]]


@pytest.fixture
def put(tmp_path):
    def written(text, suffix=".urdf"):
        path = tmp_path / f"ball{suffix}"
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.mark.parametrize(("text", "suffix"), [(URDF, ".urdf"), (SDF, ".sdf"), (MJCF, ".xml")])
def test_three_formats_say_one_ball_in_the_texts_of_the_file(put, text, suffix):
    assert table(put(text, suffix)) == {"name": "ball", "inertia": ROWS, "mass": "1.9", "radius": "0.105"}


def test_a_scene_of_it_has_its_numbers_exactly(put, tmp_path):
    scene = tmp_path / "ball.toml"
    assert "wrote" in chapsym("scene", "new", scene, "--from", put(URDF), "--no-schema").stdout
    start, _ = exact_motion(load(scene))
    assert (start.D, start.radius) == (Fraction("1.9") * Fraction("0.105") ** 2, Fraction("0.105"))
    expected = np.linalg.eigvalsh(np.array(ROWS, dtype=float))
    np.testing.assert_allclose(sorted(expand(load(scene)).ball.inertia[0]), expected, rtol=1e-14)
    assert "has a ball and no start: give --omega W1,W2,W3 and --time S" in refused("run", put(URDF), "-o", "x.csv")


def sdf(attributes, text):
    return SDF.replace("<pose>0 0 0 0 0 0", f"<pose {attributes}>{text}")


def mjcf(turn, compiler=""):
    return MJCF.replace('mass="1.9"', f'mass="1.9" {turn}').replace("<worldbody>", f"<compiler {compiler}/><worldbody>")


RPY = ("xyz", [0.3, -0.2, 1.1])
#: A turn about (1, 2, -2) by 0.75.
AXIS = ("rotvec", [0.25, 0.5, -0.5])
TURNS = {
    "rpy": (URDF.replace('rpy="0 0 0"', 'rpy="0.3 -0.2 1.1"'), RPY),
    "URDF's quat_xyzw": (URDF.replace('rpy="0 0 0"', 'rpy="9 9 9" quat_xyzw="1 -1 3 2"'), ("quat", [1, -1, 3, 2])),
    "pose": (sdf("", "0 0 0 0.3 -0.2 1.1"), RPY),
    "its own link": (sdf('relative_to="ball" rotation_format="euler_rpy" degrees="false"', "0 0 0 0.3 -0.2 1.1"), RPY),
    "degrees": (sdf('degrees="true"', "0 0 0 30 -20 110"), ("xyz", np.radians([30, -20, 110]))),
    "quat_xyzw": (sdf('rotation_format="quat_xyzw"', "0 0 0 1 -1 3 2"), ("quat", [1, -1, 3, 2])),
    "quat": (mjcf('quat="2 1 -1 3"'), ("quat", [1, -1, 3, 2])),
    "euler": (mjcf('euler="30 -20 110"'), ("XYZ", np.radians([30, -20, 110]))),
    "radian": (mjcf('euler="0.3 -0.2 1.1"', 'angle="radian"'), ("XYZ", [0.3, -0.2, 1.1])),
    "eulerseq": (mjcf('euler="0.3 -0.2 1.1"', 'angle="radian" eulerseq="XYZ"'), RPY),
    "another": (mjcf('euler="0.3 -0.2 1.1"', 'angle="radian" eulerseq="zyx"'), ("ZYX", [0.3, -0.2, 1.1])),
    "axisangle": (mjcf('axisangle="1 2 -2 0.75"', 'angle="radian"'), AXIS),
}


@pytest.mark.parametrize("name", TURNS)
def test_a_turned_inertial_frame_turns_the_tensor(put, name):
    """scipy's small letters are turns about fixed axes, its capitals about those of the body; MuJoCo's, the reverse."""
    from scipy.spatial.transform import Rotation

    text, (kind, numbers) = TURNS[name]
    suffix = {"<mu": ".xml", "<sd": ".sdf"}.get(text[:3], ".urdf")
    found = np.array([[float(Fraction(x)) for x in row] for row in table(put(text, suffix))["inertia"]])
    made = {"quat": Rotation.from_quat, "rotvec": Rotation.from_rotvec}.get(kind)
    turn = made(numbers) if made else Rotation.from_euler(kind, numbers)
    r = turn.as_matrix()
    np.testing.assert_allclose(found, r @ np.array(ROWS, dtype=float) @ r.T, atol=1e-17)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (sdf('relative_to="arm"', "0 0 0 0 0 0"), "line 2: <pose>: relative_to = 'arm' is not read"),
        (sdf('rotation_format="matrix"', "0 0 0"), "line 2: <pose>: rotation_format must be euler_rpy or quat_xyzw"),
        (sdf('degrees="yes"', "0 0 0 0 0 0"), "line 2: <pose>: degrees must be false or true, not 'yes'"),
        (sdf('rotation_format="quat_xyzw"', "0 0 0 0 0 0"), "line 2: <pose> must have 7 numbers"),
        (SDF.replace("<inertial>", '<inertial auto="true">'), "line 2: <inertial>: auto is not read"),
        (mjcf('euler="1 2 3"', 'eulerseq="xyw"'), "line 1: <compiler>: eulerseq must be three of x, y, z, X, Y, Z"),
        (mjcf('euler="1 2 3"', 'angle="grad"'), "line 1: <compiler>: angle must be degree or radian, not 'grad'"),
        (mjcf('euler="1 2 3" quat="1 0 0 0"'), "line 2: <inertial> is turned twice: by quat and euler"),
        (mjcf('zaxis="1 2 3"'), "line 2: <inertial> is turned by zaxis, which is not read: write quat or euler"),
        (mjcf("", 'settotalmass="3"'), "line 1: <compiler>: settotalmass = '3' makes others of the numbers"),
        (mjcf("", 'balanceinertia="true"'), "line 1: <compiler>: balanceinertia = 'true' makes others of"),
    ],
)
def test_an_attribute_that_is_not_read_is_named(put, text, said):
    with pytest.raises(SceneError) as caught:
        table(put(text, ".xml" if text.startswith("<mujoco") else ".sdf"))
    assert said in str(caught.value)


INSIDE = '<collision><origin xyz="0 0.05 0"/><geometry><sphere radius="{}"/></geometry></collision></link>'
#: A geom alone is a ball, too.
GEOM = '<mujoco><worldbody><body><geom type="sphere" size="0.1"/></body></worldbody></mujoco>'
FREE = '<body><joint type="free" {}/>'
DEFAULT = f'<default><joint armature="2"/></default><worldbody>{FREE.format("")}'


def held(joint, parent):
    """Another link, and what joins it to the ball."""
    joint = f"<joint name='j' type='{joint}'><parent link='{parent}'/><child link='ball'/></joint>"
    return f"<link name='arm'/>{joint}</robot>"


@pytest.mark.parametrize(
    ("text", "old", "new", "said"),
    [
        (GEOM, "<geom", '<geom class="ball"', "line 1: <geom>: its class 'ball' has no <default>"),
        (GEOM, "</body>", '<frame><geom type="box" size="1 1 1"/></frame></body>', "line 1: <frame> is not read"),
        (GEOM, "</body>", '<geom type="box" size="1 1 1"/></body>', "line 1: <geom>: a ball that rolls touches with i"),
        (GEOM, "</body>", '<geom type="mesh" contype="0" conaffinity="0"/></body>', "has 2 geoms and no <inertial>"),
        (GEOM, "<body>", '<body name="arm"><freejoint/></body><body><joint/>', "<joint> without a name holds the bal"),
        (GEOM, "<worldbody>", '<include file="a.xml"/><worldbody>', "line 1: <include> is not read"),
        (GEOM, "<body>", '<body><joint name="h"/>', "line 1: <joint> h holds the ball"),
        (GEOM, '"0.1"', '"0.1" shellinertia="yes"', "<geom>: shellinertia must be false or true, not 'yes'"),
        (GEOM, "</body>", '<body name="rotor"/></body>', "line 1: <body> rotor holds the ball"),
        (GEOM, "<body>", FREE.format('armature="0.1"'), "line 1: <joint>: armature = '0.1' is added to the inertia of"),
        (GEOM, "<worldbody><body>", DEFAULT, "line 1: <joint>: armature = '2' is added to the inertia of the ball"),
        (GEOM, "<body>", 8 * '<body><geom size="0.1"/></body>' + "<body>", 8 * "without a name, " + "…"),
        (SDF, "</link>", "<collision><geometry><box/></geometry></collision></link>", "and this is another shape: tak"),
        (URDF, "</link></robot>", "\n" + INSIDE.format("0.056") + "</robot>", "line 10: <collision>: a ball that roll"),
        (URDF, "<mass ", "<xacro:mass xmlns:xacro='x' ", "line 5: <xacro:mass> is to be filled in: give the file that"),
        (URDF, 'xyz="0 0 0"', 'xyz="0 0.001 0"', "line 3: the centre of mass of <inertial> is 1 mm off the centre of"),
        (URDF, '<mass value="1.9"/>', "", "line 3: <inertial> has no mass"),
        (URDF, 'ixz="-2e-4"', "", "line 6: <inertia> has no ixz"),
        (URDF, '"0.0046"', '"${ixx}"', "line 6: <inertia>: '${ixx}' is to be filled in: give the file that xacro"),
        (URDF, "</robot>", held("revolute", "floor"), "line 9: <joint> j of floor and ball holds the ball, but chapsy"),
        (URDF, "</robot>", held("fixed", "arm").replace("/>", "><inertial/></link>", 1), "<joint> j of arm and ball h"),
        (URDF, "<robot ", "<!DOCTYPE r [<!ENTITY a 'b'>]><robot ", "line 2: a DOCTYPE is not read"),
        (URDF, "</robot>", "", "line 9: this is not XML: no element found"),
        (URDF, '<sphere radius="0.105"/>', "<box/>", ": the ball is the <link> with a sphere to roll on, and this"),
        (URDF, "</robot>", f"<link name='b'>{INSIDE.format(0.1)}</robot>", "this file has 2 with one (ball, b)"),
        (URDF, "</inertial>", '\n<mass value="2"/></inertial>', "line 8: <inertial> has two <mass>, the first on line"),
        (URDF, "<inertia ", "<inertia/><inertia ", "line 6: <inertial> has two <inertia>"),
        (URDF, "<collision>", "<inertial/><collision>", "line 8: <link> has two <inertial>, the first on line 3"),
        (URDF, "<origin", "<origin/><origin", "line 4: <inertial> has two <origin>"),
        (URDF, "<sphere", '<sphere radius="1"/><sphere', "line 8: <geometry> has two <sphere>"),
        (URDF, "robot", "html", "line 2: <html> is not <robot> (URDF), <sdf> or <mujoco> (MJCF)"),
    ],
)
def test_what_is_no_ball_is_refused_with_its_line(put, text, old, new, said):
    """Three balls of one link, and a cube on eight, were read as the first of them."""
    suffix = {GEOM: ".xml", SDF: ".sdf"}.get(text, ".urdf")
    assert table(put(text, suffix))["radius"]
    with pytest.raises(SceneError) as caught:
        table(put(text.replace(old, new), suffix))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_mujoco_makes_the_inertia_of_the_geom_where_its_compiler_says_so(put):
    text = mjcf("", 'inertiafromgeom="true"').replace('size="0.105"', 'size="0.105" mass="0.5"')
    assert table(put(text, ".xml")) == {"name": "ball", "preset": "homogeneous", "mass": "0.5", "radius": "0.105"}


@pytest.mark.parametrize(
    ("said", "mass", "preset"),
    [
        ('mass="0.5"', 0.5, "homogeneous"),
        ("", 4 / 3 * np.pi, "homogeneous"),  # by its density, 1000 kg/m³ unless it says another
        ('density="250"', np.pi / 3, "homogeneous"),
        ('mass="0.5" shellinertia="true"', 0.5, "shell"),
        ('density="25" shellinertia="true"', np.pi, "shell"),  # of the surface
    ],
)
def test_a_geom_alone_is_homogeneous_or_hollow_as_mujoco_makes_it(put, said, mass, preset):
    """A hollow one was read as a homogeneous ball, with 3/5 of its inertia; here the balls have a radius of .1 m."""
    found = table(put(GEOM.replace('"0.1"', f'"0.1" {said}'), ".xml"))
    assert abs(float(found.pop("mass")) - mass) < 1e-15
    assert found == {"preset": preset, "radius": "0.1"}


#: What is at the head of a world of MJCF, and at that of a model of SDF.
HEAD, MODEL = "<mujoco>", '<model name="m">'
TILTED = '<pose>0 0 0 0.1 0 0</pose><link name="l">{}<collision name="c"><geometry><plane>{}</plane>'
FLOOR = f'<model name="f">{TILTED}</geometry></collision></link></model>{MODEL}'
JOINT = '<joint type="free" damping="0.1"/>'
WORLDS = {
    "a slope": ('size="1 1 1"', 'size="1 1 1" euler="0 10 0"', "line 1: <geom>: this plane is tilted by 10 degrees"),
    "a wall": ('size="1 1 1"', 'size="1 1 1" zaxis="1 0 0"', "line 1: <geom>: this plane is tilted by 90 degrees"),
    "a ceiling": ('size="1 1 1"', 'size="1 1 1" xyaxes="0 1 0 1 0 0"', "this plane is tilted by 180 degrees"),
    "a slope in a body": ("<geom type", '<body quat="2 1 0 0"><geom type="plane"/></body><a type', "by 53.1 degrees"),
    "air": (HEAD, HEAD + '<option density="1.2"/>', "line 1: <option>: density = '1.2' acts on the ball, which"),
    "honey": (HEAD, HEAD + '<option viscosity="1"/>', "<option>: viscosity = '1' acts on the ball"),
    "no weight": (HEAD, HEAD + '<option gravity="0 0 0"/>', "<option>: gravity = '0 0 0' is not down, along -z"),
    "y up": (HEAD, HEAD + '<option gravity="0 -9.81 0"/>', "<option>: gravity = '0 -9.81 0' is not down, along -z"),
    "a flag": (HEAD, HEAD + '<option><flag gravity="disable"/></option>', "<flag>: gravity = '0 0 0' is not down"),
    "a balloon": ('pos="0 0 1"', 'gravcomp="1"', "<body>: gravcomp = '1' acts on the ball"),
    "damping": ("<freejoint/>", JOINT, "line 3: <joint>: damping = '0.1' acts on the ball"),
    "up": (MODEL, f"<gravity>0 0 9.8</gravity>{MODEL}", "line 1: <gravity>: gravity = '0 0 9.8' is not down"),
    "physics": (MODEL, f"<physics><gravity>1 0 -9.8</gravity></physics>{MODEL}", "gravity = '1 0 -9.8' is not down"),
    "off": (" <inertial><pose>", "<gravity>false</gravity><inertial><pose>", "<gravity>: gravity = '0 0 0' is not"),
    "decay": (
        " <inertial><pose>", "<velocity_decay><angular>.1</angular></velocity_decay><inertial><pose>",
        "<angular>: velocity_decay = '.1' acts on the ball",
    ),
    "wind": (
        MODEL, f"<wind><linear_velocity>2 0 0</linear_velocity></wind>{MODEL}<enable_wind>true</enable_wind>",
        "line 1: <linear_velocity>: wind = '2 0 0' acts on the ball",
    ),
    "a tilted model": (MODEL, FLOOR.format("", ""), "line 1: <collision>: this plane is tilted by 5.73 degrees"),
    "a tilted normal": (MODEL, FLOOR.format("<pose>0 0 0 -0.1 0 0</pose>", "<normal>3 0 4</normal>"), "by 36.9 deg"),
}  # fmt: skip


@pytest.mark.parametrize("name", WORLDS)
def test_what_acts_on_the_ball_beyond_a_level_plane_and_gravity_is_named(put, caplog, name):
    old, new, said = WORLDS[name]
    text, suffix = (MJCF, ".xml") if old in MJCF else (SDF, ".sdf")
    assert table(put(text.replace(old, new, 1), suffix))["inertia"] == ROWS
    (warning,) = caplog.messages
    assert said in warning
    assert warning.endswith(LEFT_OUT)


def test_the_command_says_what_is_left_out(put, tmp_path):
    slope = put(MJCF.replace("1 1 1", '1 1 1" euler="0 10 0'), ".xml")
    done = chapsym("scene", "new", tmp_path / "ball.toml", "--from", slope, "--no-schema")
    assert done.stderr == f"chapsym: {slope}, line 1: <geom>: this plane is tilted by 10 degrees, {LEFT_OUT}\n"
    assert done.returncode == 0


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('size="1 1 1"', 'size="1 1 1" zaxis="0 0 2"'),
        ('size="1 1 1"', 'size="1 1 1" euler="0 10 0" contype="0" conaffinity="0"'),
        ("<geom type", '<geom type="plane" size="1 1 1" euler="0 90 0"/><geom type'),
        (HEAD, HEAD + '<option gravity="0 0 -1.62" wind="1 0 0" density="0"/>'),
        (MODEL, FLOOR.format("<pose>0 0 0 -0.1 0 0</pose>", "<normal>0 0 1</normal>")),
        (MODEL, FLOOR.replace("<pose>0 0 0 0.1 0 0", "<pose relative_to='f'>0 0 0 0.1 0 0").format("", "")),
        (MODEL, FLOOR.replace("<pose>0 0 0 0.1 0 0", "<pose>").format("", "")),
        (MODEL, f"<gravity>0 0 -1.6</gravity><wind><linear_velocity>2 0 0</linear_velocity></wind>{MODEL}"),
        ("<freejoint/>", '<joint type="free" armature="0"/>'),
        ("</link></robot>", INSIDE.format("0.055") + "</robot>"),
        ("</robot>", "<xacro:include xmlns:xacro='x' filename='a'/></robot>"),
        *(("</robot>", held(joint, "floor")) for joint in ("fixed", "floating")),
    ],
)
def test_of_what_reaches_no_ball_nothing_is_said(put, caplog, old, new):
    """Walls, the moon, wind that does not blow on it, a smaller sphere inside, a link without mass."""
    text, suffix = next((t, s) for t, s in ((MJCF, ".xml"), (SDF, ".sdf"), (URDF, ".urdf")) if old in t)
    assert table(put(text.replace(old, new, 1), suffix))["inertia"] == ROWS
    assert not caplog.messages


@pytest.mark.parametrize(
    ("geom", "around", "mass"),
    [
        ('class="b"', "", 0.5), ('class="b" mass="2"', "", 2), ("", 'childclass="b"', 0.5),
        ('class="c"', "", 0.5), ('size="0.1"', "", 4 / 3 * np.pi * 0.003),
    ],
)  # fmt: skip
def test_a_geom_has_what_the_default_of_its_class_says(put, geom, around, mass):
    """Inherited from the class around the class, and by a body's childclass, as in MuJoCo's own models."""
    text = f"""<mujoco><default><geom density="3"/><default class="b"><geom size="0.1" mass="0.5"/>
     <default class="c"><geom type="sphere" rgba="1 0 0 1"/></default></default>
     <default class="seen"><geom type="box" mass="0" contype="0" conaffinity="0"/></default></default>
     <worldbody><body {around}><body><geom {geom}/><geom class="seen" size="1 1 1"/></body></body></worldbody>
    </mujoco>"""
    found = table(put(text, ".xml"))
    assert abs(float(found.pop("mass")) - mass) < 1e-15
    assert found == {"preset": "homogeneous", "radius": "0.1"}


@pytest.mark.parametrize(("mass", "radius", "moment"), [("0.62", "0.1194", "0.005893"), ("0.43", "0.1098", "0.003457")])
def test_a_hollow_ball_whose_numbers_are_rounded_is_a_ball(put, tmp_path, mass, radius, moment):
    """A public basketball has two thirds of mass radius² to four digits, and a part of 7e-5 more than there is."""
    text = MJCF.replace("1.9", mass).replace("0.105", radius)
    text = text.replace("fullinertia=", f'diaginertia="{moment} {moment} {moment}" a=')
    scene = tmp_path / "ball.toml"
    chapsym("scene", "new", scene, "--from", put(text, ".xml"), "--no-schema")
    np.testing.assert_allclose(expand(load(scene)).ball.inertia[0], float(moment), rtol=1e-15)
    more = text.replace(moment, str(1.02 * float(moment)))
    words = refused("scene", "new", scene, "--from", put(more, ".xml"), "--force")
    assert "line 2: <inertial>: some of its mass is outside of the ball" in words


@pytest.mark.parametrize("form", [".6g", ".4g", ".6f"])
def test_a_flat_body_is_one_whose_entries_are_rounded_each_to_its_digits(put, form):
    """Entries of six digits each, as engines write them, have several places."""
    random = np.random.default_rng(1)
    for _ in range(10):
        axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
        flat = axes @ np.diag([*random.uniform(0.0005, 0.005, 2), 0.0]) @ axes.T
        tensor = np.trace(flat) * np.eye(3) - flat
        entries = " ".join(f'i{"xyz"[i]}{"xyz"[j]}="{tensor[i, j]:{form}}"' for i in range(3) for j in range(i, 3))
        file = put(
            f'<robot name="r"><link name="b"><inertial><mass value="1.9"/><inertia {entries}/></inertial>'
            '<collision><geometry><sphere radius="0.105"/></geometry></collision></link></robot>'
        )
        _, members = ball_of(file)
        assert (members.ball.mass_tensor >= 0).all()


@pytest.mark.parametrize("suffix", [".xacro", ".world"])
def test_the_suffixes_of_ros_and_gazebo_are_read(put, suffix):
    from chapsym.scene.read.scene import ball_table

    assert ball_table(put(SDF if suffix == ".world" else URDF, suffix))["inertia"] == ROWS


@pytest.mark.parametrize(
    ("inertia", "said"),
    [([0.0] * 3, "its moments of inertia are 0"), ([4.6e-7, 6.1e-7, 8.3e-7], "its moments of inertia are 1/1")],
)
def test_moments_that_are_none_or_in_other_units_are_refused(put, tmp_path, inertia, said):
    text = MJCF.replace("fullinertia=", f'diaginertia="{" ".join(map(json.dumps, inertia))}" a=')
    scene = tmp_path / "ball.toml"
    assert f"line 2: <inertial>: {said}" in refused("scene", "new", scene, "--from", put(text, ".xml"))
    assert not scene.exists()


@pytest.mark.parametrize("text", [URDF, SDF, MJCF])
def test_a_robots_file_runs_with_a_start(text, put, tmp_path):
    """As the scene of its ball does, with the axes of the body along those of space."""
    file, scene = put(text), tmp_path / "ball.toml"
    chapsym("run", file, "--omega", "3,-2,1/2", "--time", "1", "-o", tmp_path / "a.csv")
    assert chapsym("scene", "new", scene, "--from", file).returncode == 0
    table = scene.read_text("utf-8").split("[start]")[0]
    run = '[run]\ntime = 1\nframes = 1000\noutputs = ["contact", "attitude", "omega"]\n'
    scene.write_text(table + '[start]\nomega = [3, -2, "1/2"]\nrpy = [0, 0, 0]\n' + run, "utf-8")
    chapsym("run", scene, "-o", tmp_path / "b.csv")
    one, other = ((tmp_path / name).read_text("utf-8").splitlines()[2:] for name in ("a.csv", "b.csv"))
    assert len(one) == 1000
    assert one == other


def test_a_start_of_a_robots_file_is_whole_and_a_scene_has_its_own(put):
    start = "run", put(URDF), "-o", "x.csv", "--omega"
    assert "start.omega.3 is missing" in refused(*start, "3,-2", "--time", "1")
    assert "run.time must be greater than 0" in refused(*start, "3,-2,1", "--time", "0")
    assert "has a start and a time of its own" in refused("run", "docs/first.toml", "--time", "1", "-o", "x.csv")
