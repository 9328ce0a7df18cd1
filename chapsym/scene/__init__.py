"""A scene file: what to roll, from where, for how long, and where to write it."""

from .accurate import run_accurately
from .files import save
from .scene import Scene, SceneError, checked, load, load_for, run

__all__ = ["Scene", "SceneError", "checked", "load", "load_for", "run", "run_accurately", "save"]
