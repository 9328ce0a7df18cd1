"""Kernels written by `chapsym codegen` from the proved expressions: do not edit."""

from .accelerations import accelerations
from .spin_rates import spin_rates
from .step_lack import step_lack
from .step_slope import step_slope
from .velocity import velocity

# name: (function, (argument group, length) ..., shape of the result)
TABLE = {
    "accelerations": (accelerations, (('lean', 1), ('rates', 3), ('radius', 1), ('gravity', 1)), (3,)),
    "spin_rates": (spin_rates, (('lean', 1), ('spin', 3), ('radius', 1), ('gravity', 1)), (3,)),
    "step_lack": (step_lack, (('middle', 4), ('start', 4), ('radius', 1), ('gravity', 1), ('step', 1)), (4,)),
    "step_slope": (step_slope, (('middle', 4), ('start', 4), ('radius', 1), ('gravity', 1), ('step', 1)), (16,)),
    "velocity": (velocity, (('spin', 3), ('radius', 1)), (2,)),
}
