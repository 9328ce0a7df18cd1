"""Scene files: the balls, their starts, the duration, and the output."""

from .read.errors import SceneError
from .read.scene import Scene, checked, load, load_for

__all__ = ["Scene", "SceneError", "checked", "load", "load_for"]
