"""Kernels written by `chapsym codegen` from the proved expressions: do not edit."""

from .after import after
from .energy import energy
from .residual import residual
from .residual_jacobian import residual_jacobian
from .turn import turn

# name: (function, (argument group, length) ..., shape of the result)
TABLE = {
    "after": (after, (('gibbs', 2), ('mass_tensor', 5)), (2,)),
    "energy": (energy, (('momentum', 2), ('mass_tensor', 5)), ()),
    "residual": (residual, (('gibbs', 2), ('momentum', 2), ('mass_tensor', 5)), (2,)),
    "residual_jacobian": (residual_jacobian, (('gibbs', 2), ('momentum', 2), ('mass_tensor', 5)), (4,)),
    "turn": (turn, (('gibbs', 2),), (3, 3)),
}
