"""MuJoCo: python -m benchmarks.rolling.engines.mujoco_ball CASE STEP OUTPUT.csv [--best]

A free sphere with the moments of the case on a plane, with the options as they come; with --best a stiff contact,
elliptic friction cones, more friction than can be used, and the integrator RK4.
"""

import argparse
from pathlib import Path

import mujoco
import numpy as np

from .common import case_of, steps_between, velocity_of, write

MODEL = """
<mujoco>
  <option timestep="{step!r}" gravity="0 0 -9.81" {option}/>
  <worldbody>
    <geom type="plane" size="0 0 1" {contact}/>
    <body pos="0 0 {radius!r}">
      <freejoint/>
      <inertial pos="0 0 0" mass="{mass!r}" diaginertia="{moments}"/>
      <geom type="sphere" size="{radius!r}" {contact}/>
    </body>
  </worldbody>
</mujoco>
"""
BEST = ('integrator="RK4" cone="elliptic" impratio="100" iterations="200" tolerance="1e-14"',
        'solref="{stiff!r} 1" solimp="0.99 0.999 1e-5" friction="10 0 0"')  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("step", type=float)
    parser.add_argument("output", type=Path)
    parser.add_argument("--best", action="store_true")
    given = parser.parse_args()
    case = case_of(given.case)
    option, contact = BEST if given.best else ("", "")
    model = mujoco.MjModel.from_xml_string(MODEL.format(
        step=given.step, option=option, contact=contact.format(stiff=max(2 * given.step, 2e-4)), radius=case.radius,
        mass=case.mass, moments=" ".join(map(repr, map(float, case.inertia))),
    ))  # fmt: skip
    data = mujoco.MjData(model)
    data.qpos[:] = [*case.path[0], case.radius, *case.attitude[0]]
    back = np.zeros(4)
    mujoco.mju_negQuat(back, case.attitude[0])
    body = np.zeros(3)
    mujoco.mju_rotVecQuat(body, case.omega[0], back)
    data.qvel[:] = [*velocity_of(case), *body]  # MuJoCo has ω in the axes of the body
    rows, count = [], steps_between(case, given.step)
    for time in case.time:
        if time:
            for _ in range(count):
                mujoco.mj_step(model, data)
        space = np.zeros(3)
        mujoco.mju_rotVecQuat(space, data.qvel[3:], data.qpos[3:])
        rows.append([time, *data.qpos, *data.qvel[:3], *space])
    write(given.output, given.step, rows)


if __name__ == "__main__":
    main()
