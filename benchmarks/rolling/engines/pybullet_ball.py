"""PyBullet: the ball of a URDF or MJCF file, as PyBullet's own loader reads it, on a plane.

The settings are as they come, of which the damping of 0.04 is one; the best are no damping, more friction than can be
used, and 500 iterations of the solver to a residual of 1e-14.  Of a URDF the inertia is that of the file: without that
flag, and of an MJCF always, PyBullet takes that of a homogeneous sphere.
"""

from pathlib import Path

import numpy as np
import pybullet

from .common import Rows, Start


def loaded(body: Path, client: int) -> int:
    if body.suffix != ".urdf":
        return int(pybullet.loadMJCF(str(body), physicsClientId=client)[0])
    flags = pybullet.URDF_USE_INERTIA_FROM_FILE
    return int(pybullet.loadURDF(str(body), flags=flags, physicsClientId=client))


def run(body: Path, start: Start, step: float, best: bool) -> Rows:
    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setGravity(0, 0, -9.81, client)
        pybullet.setTimeStep(step, client)
        plane = pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client))
        ball = loaded(body, client)
        # PyBullet's pose is of the principal axes, at the centre of mass.
        frame = pybullet.getDynamicsInfo(ball, -1, client)[3:5]
        back = pybullet.invertTransform(*frame)
        w, *xyz = start.attitude
        pose = pybullet.multiplyTransforms(list(start.centre), [*xyz, w], *frame)
        pybullet.resetBasePositionAndOrientation(ball, *pose, client)
        if best:
            pybullet.changeDynamics(ball, -1, linearDamping=0, angularDamping=0, physicsClientId=client)
            pybullet.setPhysicsEngineParameter(
                numSolverIterations=500, solverResidualThreshold=1e-14, physicsClientId=client
            )
            for one in (plane, ball):
                pybullet.changeDynamics(one, -1, lateralFriction=10, physicsClientId=client)
        moving = start.velocity + np.cross(start.omega, pose[0] - start.centre)
        pybullet.resetBaseVelocity(ball, list(moving), list(start.omega), client)
        count = start.steps_between(step)
        for time in start.time:
            for _ in range(count if time else 0):
                pybullet.stepSimulation(client)
            pose = pybullet.getBasePositionAndOrientation(ball, client)
            place, (*xyz, w) = pybullet.multiplyTransforms(*pose, *back)
            moving, omega = pybullet.getBaseVelocity(ball, client)
            velocity = moving + np.cross(omega, np.subtract(place, pose[0]))
            yield [time, *place, w, *xyz, *velocity, *omega]
    finally:
        pybullet.disconnect(client)
