"""A scene file: what to roll, from where, for how long, and where to write it."""

from .accurate import run_accurately
from .files import save
from .scene import Scene, SceneError, load, run

__all__ = ["Scene", "SceneError", "load", "run", "run_accurately", "save"]
