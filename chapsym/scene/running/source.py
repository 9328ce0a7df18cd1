"""From a scene, or its text, to the plan of its run: what a worker of a cluster is sent is the text."""

from dataclasses import replace

from ..members.expand import expand
from ..plan.plan import Plan, planned
from ..read.scene import Scene, from_source


def plan_of(scene: Scene) -> Plan:
    """The plan of a scene, with its text and title; raises BadInput where no model yields what it asks for."""
    plan = planned(expand(scene), scene.task())
    drawn = scene.sweep.samples is not None
    return replace(plan, scene=scene.source, title=scene.title, seed=scene.sweep.seed if drawn else None)


def plan_from(text: str) -> Plan:
    """The plan of a scene from its text, `Plan.scene`: TOML, or JSON of a dict."""
    return replace(plan_of(from_source(text)), scene=text)
