"""MuJoCo: python -m benchmarks.rolling.engines.mujoco_ball CASE STEP OUTPUT.csv [--best]

A free sphere with the moments of the case on a plane, with the options as they come; with --best a stiff contact,
elliptic friction cones, more friction than can be used, and the integrator RK4.
"""

import mujoco
import numpy as np

from chapsym.studies.judge import Case, rolling

from .common import Rows, command, steps_between

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


def run(case: Case, step: float, best: bool) -> Rows:
    option, contact = BEST if best else ("", "")
    model = mujoco.MjModel.from_xml_string(MODEL.format(
        step=step, option=option, contact=contact.format(stiff=max(2 * step, 2e-4)), radius=case.radius,
        mass=case.mass, moments=" ".join(map(repr, map(float, case.inertia))),
    ))  # fmt: skip
    data = mujoco.MjData(model)
    data.qpos[:] = [*case.path[0], case.radius, *case.attitude[0]]
    back = np.zeros(4)
    mujoco.mju_negQuat(back, case.attitude[0])
    body = np.zeros(3)
    mujoco.mju_rotVecQuat(body, case.omega[0], back)
    data.qvel[:] = [*rolling(case.radius, case.omega[0]), *body]  # MuJoCo has ω in the axes of the body
    count = steps_between(case, step)
    for time in case.time:
        for _ in range(count if time else 0):
            mujoco.mj_step(model, data)
        space = np.zeros(3)
        mujoco.mju_rotVecQuat(space, data.qvel[3:], data.qpos[3:])
        yield [time, *data.qpos, *data.qvel[:3], *space]


if __name__ == "__main__":
    command(run, __doc__)
