"""Attitudes, by successive angles about axes or by a unit quaternion, with their angular velocities."""

from functools import cached_property

import sympy as sp

from chapsym.derive import three
from chapsym.numbers import brief, is_a, plain_text

from .system import BadSystem, a_symbol, dot, several

_TURNS = {"x": sp.rot_ccw_axis1, "y": sp.rot_ccw_axis2, "z": sp.rot_ccw_axis3}


class Turned:
    """A body that is rotated successively about its own axes.

    Parameters
    ----------
    *turns : tuple of (str, sympy.Symbol)
        An axis "x", "y" or "z" of the body, and the angle, a coordinate; right-handed.

    Attributes
    ----------
    rotation : sympy.Matrix
        From the axes of the body to those of space.
    spin, spin_in_space : sympy.Matrix
        The angular velocity in the axes of the body, and in those of space.

    Examples
    --------
    >>> from sympy import symbols
    >>> heading, lean = symbols("heading lean")
    >>> Turned(("z", heading), ("x", lean)).spin.T
    Matrix([[lean_dot, heading_dot*sin(lean), heading_dot*cos(lean)]])
    """

    def __init__(self, *turns: tuple[str, sp.Symbol]) -> None:
        self.rotation, self.spin = sp.eye(3), sp.zeros(3, 1)
        for given in turns:
            turn = several(given, "a turn")
            if not (len(turn) == 2 and plain_text(turn[0]) in _TURNS):
                raise BadSystem(f"a turn is an axis x, y or z and an angle, as ('z', heading), not {brief(turn)}")
            axis, angle = str.__str__(turn[0]), a_symbol(turn[1])
            one = _TURNS[axis](angle)
            self.rotation = self.rotation * one
            self.spin = one.T * self.spin
            self.spin["xyz".index(axis)] += dot(angle)

    @property
    def spin_in_space(self) -> sp.Matrix:
        """The angular velocity in the axes of space."""
        return self.rotation * self.spin


class Quaternion:
    """A body whose attitude is a unit quaternion, scalar first: four coordinates, of which `norm` - 1 vanishes.

    Parameters
    ----------
    name : str
        The names of the coordinates are this name followed by 0 to 3.

    Attributes
    ----------
    coordinates : tuple of sympy.Symbol
    rotation : sympy.Matrix
        From the axes of the body to those of space.
    spin, spin_in_space : sympy.Matrix
        The angular velocity in the axes of the body, and in those of space.
    norm, swelling : sympy.Expr
        |q|², and half its rate, which is 0 in a motion: a multiple of the square of the latter in the Lagrangian makes
        the mass matrix regular.

    Examples
    --------
    >>> Quaternion("q").spin[2]
    2*q0*q3_dot - 2*q0_dot*q3 - 2*q1*q2_dot + 2*q1_dot*q2
    """

    def __init__(self, name: str) -> None:
        if not is_a(name, str) or not name.isidentifier():
            raise BadSystem(f"name must be a word, such as 'q', not {brief(name)}")
        self.coordinates = sp.symbols(f"{name}0:4")
        whole = sp.Matrix(self.coordinates)
        self._conjugate, self._rate = sp.diag(1, -1, -1, -1) * whole, whole.applyfunc(dot)
        self.norm = sum(x**2 for x in self.coordinates)
        self.swelling = sum(x * dot(x) for x in self.coordinates)

    @cached_property
    def spin(self) -> sp.Matrix:
        """The angular velocity in the axes of the body."""
        return self._spin(self._conjugate, self._rate)

    @cached_property
    def spin_in_space(self) -> sp.Matrix:
        """The angular velocity in the axes of space."""
        return self._spin(self._rate, self._conjugate)

    @staticmethod
    def _spin(a: sp.Matrix, b: sp.Matrix) -> sp.Matrix:
        return (2 * three.quaternion_product(a, b)[1:, :]).applyfunc(sp.expand)

    @cached_property
    def rotation(self) -> sp.Matrix:
        """The rotation from the axes of the body to those of space."""
        own = dict(zip((three.q0, *three.q), self.coordinates, strict=True))
        return sp.Matrix(three.rotation().xreplace(own))
