"""A scene file: what to roll, from where, for how long, and where to write it."""

from chapsym import extras

extras.need("scenes")

from .read.errors import SceneError  # noqa: E402
from .read.scene import Scene, checked, load, load_for  # noqa: E402

__all__ = ["Scene", "SceneError", "checked", "load", "load_for"]
