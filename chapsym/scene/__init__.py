"""A scene file: what to roll, from where, for how long, and where to write it."""

from .read.scene import Scene, SceneError, checked, load, load_for, run
from .result.files import save
from .running.accurate import run_accurately

__all__ = ["Scene", "SceneError", "checked", "load", "load_for", "run", "run_accurately", "save"]
