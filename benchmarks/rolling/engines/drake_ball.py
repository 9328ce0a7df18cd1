"""Drake: python -m benchmarks.rolling.engines.drake_ball CASE STEP OUTPUT.csv [--best]

A free sphere with the moments of the case on a half space, in a discrete MultibodyPlant with friction 0.5 and else the
settings as they come; with --best Drake's contact SAP with a stiffness of 1e9 N/m, near-rigid from 1e-4 on, and
friction 10.
"""

import numpy as np
from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction, DiscreteContactApproximation
from pydrake.multibody.tree import SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from chapsym.studies.judge import Case, rolling

from .common import Rows, command


def run(case: Case, step: float, best: bool) -> Rows:
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, step)
    moments = UnitInertia(*(case.inertia / case.mass))
    ball = plant.AddRigidBody("ball", SpatialInertia(case.mass, np.zeros(3), moments))
    material = ProximityProperties()
    if best:
        AddContactMaterial(point_stiffness=1e9, friction=CoulombFriction(10.0, 10.0), properties=material)
        plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
        plant.set_sap_near_rigid_threshold(1e-4)
    else:
        AddContactMaterial(friction=CoulombFriction(0.5, 0.5), properties=material)
    plant.RegisterCollisionGeometry(ball, RigidTransform(), Sphere(case.radius), "sphere", material)
    plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "floor", material)
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    start = [*case.attitude[0], *case.path[0], case.radius, *case.omega[0], *rolling(case.radius, case.omega[0])]
    plant.SetPositionsAndVelocities(context, start)
    for time in case.time:
        simulator.AdvanceTo(time)
        q = plant.GetPositions(context)
        q[:4] /= np.linalg.norm(q[:4])  # in discrete steps the length of Drake's quaternion grows
        v = plant.GetVelocities(context)
        yield [time, *q[4:], *q[:4], *v[3:], *v[:3]]


if __name__ == "__main__":
    command(run, __doc__)
