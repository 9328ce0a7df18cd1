"""PyBullet: python -m benchmarks.rolling.engines.pybullet_ball CASE STEP OUTPUT.csv [--best]

A free sphere with the moments of the case on a plane, with the settings as they come, of which the damping of 0.04 is
one; with --best no damping, more friction than can be used, and 500 iterations of the solver to a residual of 1e-14.
"""

import pybullet

from chapsym.studies.judge import Case, rolling

from .common import Rows, command, steps_between


def run(case: Case, step: float, best: bool) -> Rows:
    client = pybullet.connect(pybullet.DIRECT)
    try:
        pybullet.setGravity(0, 0, -9.81, client)
        pybullet.setTimeStep(step, client)
        plane = pybullet.createMultiBody(0, pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=client))
        sphere = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=case.radius, physicsClientId=client)
        w, *xyz = case.attitude[0]
        ball = pybullet.createMultiBody(
            case.mass, sphere, -1, [*case.path[0], case.radius], [*xyz, w], physicsClientId=client
        )
        pybullet.changeDynamics(ball, -1, localInertiaDiagonal=list(case.inertia), physicsClientId=client)
        if best:
            pybullet.changeDynamics(ball, -1, linearDamping=0, angularDamping=0, physicsClientId=client)
            pybullet.setPhysicsEngineParameter(
                numSolverIterations=500, solverResidualThreshold=1e-14, physicsClientId=client
            )
            for body in (plane, ball):
                pybullet.changeDynamics(body, -1, lateralFriction=10, physicsClientId=client)
        pybullet.resetBaseVelocity(ball, list(rolling(case.radius, case.omega[0])), list(case.omega[0]), client)
        count = steps_between(case, step)
        for time in case.time:
            for _ in range(count if time else 0):
                pybullet.stepSimulation(client)
            place, (*xyz, w) = pybullet.getBasePositionAndOrientation(ball, client)
            velocity, omega = pybullet.getBaseVelocity(ball, client)
            yield [time, *place, w, *xyz, *velocity, *omega]
    finally:
        pybullet.disconnect(client)


if __name__ == "__main__":
    command(run, __doc__)
