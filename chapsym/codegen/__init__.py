"""Kernels from decided statements, as Python and C, with the certificates of these statements."""

from .carriers import Carrier, left, right
from .kernels import Group, Kernel

__all__ = ["Carrier", "Group", "Kernel", "left", "right"]
