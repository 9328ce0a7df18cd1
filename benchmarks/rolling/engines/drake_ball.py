"""Drake: the ball of a URDF, SDF or MJCF file, as Drake's own parser reads it, on a half space.

A discrete MultibodyPlant, a floor with friction 0.5, and else the settings as they come; the best are Drake's contact
SAP with a stiffness of 1e9 N/m, near-rigid from 1e-4 on, and friction 10.
"""

from pathlib import Path

import numpy as np
from pydrake.geometry import AddContactMaterial, HalfSpace, ProximityProperties, RoleAssign
from pydrake.math import RigidTransform
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction, DiscreteContactApproximation
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

from .common import Rows, Start


def run(body: Path, start: Start, step: float, best: bool) -> Rows:
    builder = DiagramBuilder()
    plant, graph = AddMultibodyPlantSceneGraph(builder, step)
    (model,) = Parser(plant).AddModels(str(body))
    ball = plant.get_body(plant.GetBodyIndices(model)[0])
    material = ProximityProperties()
    if best:
        AddContactMaterial(point_stiffness=1e9, friction=CoulombFriction(10.0, 10.0), properties=material)
        plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
        plant.set_sap_near_rigid_threshold(1e-4)
        for shape in plant.GetCollisionGeometriesForBody(ball):
            graph.AssignRole(plant.get_source_id(), shape, material, RoleAssign.kReplace)
    else:
        AddContactMaterial(friction=CoulombFriction(0.5, 0.5), properties=material)
    plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "floor", material)
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.SetPositionsAndVelocities(context, [*start.attitude, *start.centre, *start.omega, *start.velocity])
    for time in start.time:
        if time:  # at 0 that would take the first step
            simulator.AdvanceTo(time)
        q = plant.GetPositions(context)
        q[:4] /= np.linalg.norm(q[:4])  # in discrete steps the length of Drake's quaternion grows
        v = plant.GetVelocities(context)
        yield [time, *q[4:], *q[:4], *v[3:], *v[:3]]
