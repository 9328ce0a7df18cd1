"""Drake: python -m benchmarks.rolling.engines.drake_ball CASE STEP OUTPUT.csv [--best]

A free sphere with the moments of the case on a half space, in a discrete MultibodyPlant with the settings as they come
and friction 0.5; with --best friction 10, a penetration of 1e-6 m and a stiction tolerance of 1e-6 m/s.
"""

import numpy as np
from pydrake.geometry import HalfSpace, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction
from pydrake.multibody.tree import SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from chapsym.studies.judge import Case

from .common import Rows, command, velocity_of


def run(case: Case, step: float, best: bool) -> Rows:
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, step)
    moments = UnitInertia(*(case.inertia / case.mass))
    ball = plant.AddRigidBody("ball", SpatialInertia(case.mass, np.zeros(3), moments))
    friction = CoulombFriction(*((10.0, 10.0) if best else (0.5, 0.5)))
    plant.RegisterCollisionGeometry(ball, RigidTransform(), Sphere(case.radius), "sphere", friction)
    plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "floor", friction)
    plant.Finalize()
    if best:
        plant.set_penetration_allowance(1e-6)
        plant.set_stiction_tolerance(1e-6)
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    start = [*case.attitude[0], *case.path[0], case.radius, *case.omega[0], *velocity_of(case)]
    plant.SetPositionsAndVelocities(context, start)
    for time in case.time:
        simulator.AdvanceTo(time)
        q = plant.GetPositions(context)
        q[:4] /= np.linalg.norm(q[:4])  # in discrete steps the length of Drake's quaternion grows
        v = plant.GetVelocities(context)
        yield [time, *q[4:], *q[:4], *v[3:], *v[:3]]


if __name__ == "__main__":
    command(run, __doc__)
