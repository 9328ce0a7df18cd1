"""Makes the data set anew from its cases: python -m benchmarks.rolling.make [NAME ...], about twenty minutes for all.

cases/NAME.toml is the scene, of a ball with equations of its own a module; data/NAME.json has its frames as [middle,
radius], and what is needed to set up an engine; data/NAME.csv the same in the units and names of engines;
data/NAME.urdf and data/NAME.xml (MJCF) a ball that rolls by itself, as engines load it.  data/SHA256SUMS has the
digests of all files.
"""

import csv
import hashlib
import io
import json
import sys
from fractions import Fraction
from pathlib import Path

import mpmath

from chapsym import files, generated
from chapsym.dynamics.enclosed_motion import follow
from chapsym.scene import load
from chapsym.scene.members.exactly import case_of, exact_motion

from . import off_centre, sliding

HERE = Path(__file__).parent
CASES, DATA = HERE / "cases", HERE / "data"
#: The cases that have equations of their own.
OWN = {"off-centre": off_centre.made, "sliding": sliding.made}
DIGITS = 30
#: Digits of the numbers in the CSV files: more than float64 has.
SHOWN = 20
#: A smaller number is 0 but for rounding.
NOTHING = mpmath.mpf("1e-30")
#: The ball as engines load it: the mass, the radius, and ixx, ixy, ...: entries of the tensor in the axes of the body.
URDF = """<robot name="{name}">
  <link name="{name}">
    <inertial>{origin}
      <mass value="{mass}"/>
      <inertia ixx="{ixx}" ixy="{ixy}" ixz="{ixz}" iyy="{iyy}" iyz="{iyz}" izz="{izz}"/>
    </inertial>
    <collision>
      <geometry><sphere radius="{radius}"/></geometry>
    </collision>
  </link>
</robot>
"""
MJCF = """<mujoco model="{name}">
  <worldbody>
    <body name="{name}">
      <freejoint/>
      <inertial pos="{place}" mass="{mass}" fullinertia="{ixx} {iyy} {izz} {ixy} {ixz} {iyz}"/>
      <geom type="sphere" size="{radius}"/>
    </body>
  </worldbody>
</mujoco>
"""
BODIES = {"urdf": URDF, "xml": MJCF}
COLUMNS = "time x y z qw qx qy qz vx vy vz wx wy wz"


def made(scene: Path) -> files.Data:
    """The case of a scene: body, frames with proved radii, and how they were proved."""
    given = load(scene)
    start, times = exact_motion(given)
    found = follow(start, times, DIGITS, limit=3600.0)
    if found.stopped:
        raise RuntimeError(f"{scene.name}: {found.stopped}")
    return case_of(scene.stem, given.title, start) | found.write()


def text(case: files.Data) -> str:
    """As JSON, a frame a line."""
    head = {name: value for name, value in case.items() if name != "frames"}
    frames = ",\n".join(json.dumps(frame, separators=(",", ":")) for frame in case["frames"])
    return json.dumps(head, ensure_ascii=False)[:-1] + f', "frames": [\n{frames}\n]}}\n'


def table(case: files.Data) -> str:
    """The frames as CSV, in space: the centre, the attitude from body to space, the velocity and ω."""
    mpmath.mp.dps = DIGITS + 10
    given = Fraction(case["ball"].get("radius", 0))
    radius = mpmath.mpf(given.numerator) / given.denominator
    stream = io.StringIO()
    print("# m, s, rad; z is up; q turns the axes of the body into those of space", file=stream)
    rows = csv.writer(stream, lineterminator="\n")
    rows.writerow(COLUMNS.split())
    for frame in case["frames"]:
        parts = (frame.get(part, [(0, 0)] * 2) for part in ("contact", "attitude", "omega"))
        (x, y), q, spin = ([mpmath.mpf(middle) for middle, _ in part] for part in parts)
        w = generated.rotate(*q, *spin)
        velocity = [radius * w[1], -radius * w[0], mpmath.mpf(0)]
        if "velocity" in frame:  # it slides
            velocity = [mpmath.mpf(middle) for middle, _ in frame["velocity"]]
        numbers = [x, y, radius, *q, *velocity, *w]
        rows.writerow([frame["time"], *(mpmath.nstr(v if abs(v) > NOTHING else 0, SHOWN) for v in numbers)])
    return stream.getvalue()


def body(case: files.Data, form: str) -> str:
    """The ball of a case, its axes the principal ones, in a form of BODIES."""
    ball = case["ball"]
    tensor = dict.fromkeys(("ixy", "ixz", "iyz"), "0") | dict(zip(("ixx", "iyy", "izz"), ball["inertia"], strict=True))
    place = " ".join(ball.get("centre_of_mass", "000"))
    origin = f'\n      <origin xyz="{place}"/>' if "centre_of_mass" in ball else ""
    return BODIES[form].format(name=case["case"], place=place, origin=origin, **ball | tensor)


def main(names: list[str]) -> None:
    DATA.mkdir(exist_ok=True)
    for name in sorted({*OWN, *(scene.stem for scene in CASES.glob("*.toml"))}):
        if names and name not in names:
            continue
        print(name, file=sys.stderr)
        case = OWN[name](DIGITS) if name in OWN else made(CASES / f"{name}.toml")
        files.write_text(DATA / f"{name}.json", text(case))
        files.write_text(DATA / f"{name}.csv", table(case))
        if "radius" in case["ball"] and "rotor" not in case["ball"] and "friction" not in case:
            for form in BODIES:
                files.write_text(DATA / f"{name}.{form}", body(case, form))
    sums = [f"{hashlib.sha256(p.read_bytes()).hexdigest()}  {p.name}\n" for p in sorted(DATA.glob("*.*"))]
    files.write_text(DATA / "SHA256SUMS", "".join(sums))


if __name__ == "__main__":
    main(sys.argv[1:])
