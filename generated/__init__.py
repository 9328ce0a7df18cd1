"""Kernels written by `chapsym codegen` from the proved expressions: do not edit."""

from .angular_velocity import angular_velocity
from .centre_step import centre_step
from .compose import compose
from .contact_momentum import contact_momentum
from .curve_increment import curve_increment
from .energy import energy
from .energy_rate import energy_rate
from .gibbs_mixed import gibbs_mixed
from .gibbs_newton import gibbs_newton
from .gibbs_newton_heavy import gibbs_newton_heavy
from .gibbs_residual import gibbs_residual
from .gibbs_second import gibbs_second
from .gibbs_symmetric import gibbs_symmetric
from .invariants import invariants
from .isotropic_spin import isotropic_spin
from .modified_load import modified_load
from .modified_rotation import modified_rotation
from .momentum import momentum
from .momentum_jacobian import momentum_jacobian
from .precession_parts import precession_parts
from .residual import residual
from .rotate import rotate
from .rotation import rotation
from .tangent_hessian import tangent_hessian
from .tangent_jacobian import tangent_jacobian
from .torque import torque
from .transport import transport
from .turn import turn
from .vertical_level import vertical_level
from .vertical_rotation import vertical_rotation
from .vertical_square import vertical_square

# name: (function, (argument group, length) ..., shape of the result)
TABLE = {
    "angular_velocity": (angular_velocity, (('momentum', 3), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3,)),
    "centre_step": (centre_step, (('rotation', 4), ('gamma', 3)), (3,)),
    "compose": (compose, (('first', 4), ('second', 4)), (4,)),
    "contact_momentum": (contact_momentum, (('omega', 3), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3,)),
    "curve_increment": (curve_increment, (('ordered', 3), ('inverse_square', 1)), (5,)),
    "energy": (energy, (('momentum', 3), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), ()),
    "energy_rate": (energy_rate, (('omega', 3), ('rate', 3), ('gamma', 3), ('D', 1)), ()),
    "gibbs_mixed": (gibbs_mixed, (('correction', 3), ('next_correction', 3), ('half_momentum', 3), ('cofactors', 9), ('inertia', 3)), (3,)),
    "gibbs_newton": (gibbs_newton, (('gibbs', 3), ('half_momentum', 3), ('gamma', 3), ('inertia', 3), ('D', 1)), (13,)),
    "gibbs_newton_heavy": (gibbs_newton_heavy, (('gibbs', 3), ('half_momentum', 3), ('gamma', 3), ('inertia', 3), ('D', 1)), (13,)),
    "gibbs_residual": (gibbs_residual, (('gibbs', 3), ('half_momentum', 3), ('gamma', 3), ('inertia', 3), ('D', 1)), (3,)),
    "gibbs_second": (gibbs_second, (('correction', 3), ('half_momentum', 3), ('cofactors', 9), ('inertia', 3)), (3,)),
    "gibbs_symmetric": (gibbs_symmetric, (('gibbs', 3), ('half_momentum', 3), ('gamma', 3), ('inertia', 3), ('D', 1)), (3,)),
    "invariants": (invariants, (('momentum', 3), ('gamma', 3)), (3,)),
    "isotropic_spin": (isotropic_spin, (('half_momentum', 3), ('gamma', 3), ('moment', 1), ('D', 1)), (3,)),
    "modified_load": (modified_load, (('omega', 3), ('rate', 3), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3,)),
    "modified_rotation": (modified_rotation, (('omega', 3), ('rate', 3), ('share', 3)), (3,)),
    "momentum": (momentum, (('rotation', 4), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3,)),
    "momentum_jacobian": (momentum_jacobian, (('rotation', 4), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3, 3)),
    "precession_parts": (precession_parts, (('ordered', 3), ('inverse_square', 1)), (4,)),
    "residual": (residual, (('rotation', 4), ('momentum', 3), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3,)),
    "rotate": (rotate, (('rotation', 4), ('vector', 3)), (3,)),
    "rotation": (rotation, (('rotation', 4),), (3, 3)),
    "tangent_hessian": (tangent_hessian, (('rotation', 4), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (6, 3)),
    "tangent_jacobian": (tangent_jacobian, (('rotation', 4), ('gamma', 3), ('mass_tensor', 3), ('D', 1)), (3, 3)),
    "torque": (torque, (('omega', 3), ('mass_tensor', 3)), (3,)),
    "transport": (transport, (('rotation', 4), ('vector', 3)), (3,)),
    "turn": (turn, (('quaternion', 4), ('vector', 3)), (3,)),
    "vertical_level": (vertical_level, (('scalars', 2), ('level', 1), ('Lambda', 3)), (2,)),
    "vertical_rotation": (vertical_rotation, (('sigma', 2), ('gamma', 3), ('Lambda', 3)), (4,)),
    "vertical_square": (vertical_square, (('gamma', 3), ('Lambda', 3)), ()),
}
