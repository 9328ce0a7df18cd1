"""A scene file: what to roll, from where, for how long, and where to write it."""

from .read.errors import SceneError
from .read.scene import Scene, checked, load, load_for

__all__ = ["Scene", "SceneError", "checked", "load", "load_for"]
