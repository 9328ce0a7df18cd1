"""MuJoCo: the ball of a URDF or MJCF file, as MuJoCo's own loader reads it, on a plane.

The options are as they come; the best are a stiff contact, elliptic friction cones, more friction than can be used, and
the integrator RK4.
"""

from pathlib import Path

import mujoco
import numpy as np

from .common import Rows, Start


def loaded(body: Path, step: float, best: bool) -> mujoco.MjModel:
    spec = mujoco.MjSpec.from_file(str(body))
    spec.compiler.fusestatic = False  # a link of a URDF without a joint would become part of the world
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
    ball = spec.bodies[1]
    if not ball.joints:
        ball.add_freejoint()
    spec.option.timestep = step
    if best:
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
        spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
        spec.option.impratio, spec.option.iterations, spec.option.tolerance = 100, 200, 1e-14
        for geom in spec.geoms:
            geom.solref = [max(2 * step, 2e-4), 1]
            geom.solimp[:3] = [0.99, 0.999, 1e-5]
            geom.friction = [10, 0, 0]
    return spec.compile()


def run(body: Path, start: Start, step: float, best: bool) -> Rows:
    model = loaded(body, step, best)
    data = mujoco.MjData(model)
    data.qpos[:] = [*start.centre, *start.attitude]
    back, spin = np.zeros(4), np.zeros(3)
    mujoco.mju_negQuat(back, start.attitude)
    mujoco.mju_rotVecQuat(spin, start.omega, back)
    data.qvel[:] = [*start.velocity, *spin]  # MuJoCo has ω in the axes of the body
    count = start.steps_between(step)
    for time in start.time:
        for _ in range(count if time else 0):
            mujoco.mj_step(model, data)
        space = np.zeros(3)
        mujoco.mju_rotVecQuat(space, data.qvel[3:], data.qpos[3:])
        yield [time, *data.qpos, *data.qvel[:3], *space]
