"""Kernels from decided statements: as Python and C, with the certificates that carry them."""

from .carriers import Carrier, left, right
from .kernels import Group, Kernel
from .programs import Program

__all__ = ["Carrier", "Group", "Kernel", "Program", "left", "right"]
