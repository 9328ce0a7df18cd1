"""How far the true rotation is from a point that is followed: a parallelepiped that turns and shears with the map.

𝒦 and γ of a step are those of the start, turned back by the rotation since then.  The true one is p∘(1, ξ), p an
exact point and ξ = Br, r in a box.  A step takes ξ to Mξ + w, M a matrix in balls: the mean-value form, with
M for all states that there may be.  So B becomes the orthogonal factor of MB (Lohner), and the box grows by what the
motion itself and the roundings of p do: linearly, where the motion is regular, and not by a factor each step.
"""

from collections.abc import Sequence
from math import sqrt
from typing import Any

from flint import arb, arb_mat

from ..errors import TooWide
from .proved_root import upper

Vector = Sequence[Any]

#: The form is for small ξ.
LARGEST = 0.125


class Spread:
    """ξ = Br of balls; every method is to be called with the precision of matrices."""

    def __init__(self) -> None:
        self.restart(arb(0))

    def restart(self, radius: Any) -> None:
        """All ξ with |ξ| ≤ radius."""
        self.axes, self.size = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1]), small(radius)
        self.box = arb_mat(3, 1, [arb(0, radius)] * 3)

    def moved(self, M: Any, more: Any) -> None:
        """All Mξ + w with |w| ≤ more."""
        edges = M * self.axes
        try:
            axes = orthogonal(edges, self.box)
            inverse = axes.inv()
        except ZeroDivisionError:
            raise TooWide from None
        box = inverse * edges * self.box
        rows = inverse.entries()
        radii = (x.abs_upper() + more * upper(rows[3 * i : 3 * i + 3]) for i, x in enumerate(box.entries()))
        self.axes, self.box = axes, arb_mat(3, 1, [arb(0, r.abs_upper()) for r in radii])
        self.size = small(upper((axes * self.box).entries()))


def small(size: Any) -> Any:
    """A bound of |ξ|; raises TooWide where the form is not for it."""
    if not size < LARGEST:
        raise TooWide
    return size


def orthogonal(matrix: Any, box: Any) -> Any:
    """Exact, and orthogonal to rounding: the axes of a parallelepiped, from its longest edge on."""
    e = [float(x) for x in matrix.entries()]
    radii = [x.rad() for x in box.entries()]
    largest = max(radii)
    columns = []
    for i in range(3):
        r = float(radii[i] / largest) if largest > 0 else 1.0
        x, y, z = e[i], e[i + 3], e[i + 6]
        columns.append((r * r * (x * x + y * y + z * z), x, y, z))
    columns.sort(reverse=True)
    _, a1, a2, a3 = columns[0]
    _, b1, b2, b3 = columns[1]
    s = 1 / sqrt(a1 * a1 + a2 * a2 + a3 * a3)
    a1, a2, a3 = s * a1, s * a2, s * a3
    s = a1 * b1 + a2 * b2 + a3 * b3
    b1, b2, b3 = b1 - s * a1, b2 - s * a2, b3 - s * a3
    s = 1 / sqrt(b1 * b1 + b2 * b2 + b3 * b3)
    b1, b2, b3 = s * b1, s * b2, s * b3
    c1, c2, c3 = a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1
    return arb_mat(3, 3, [a1, b1, c1, a2, b2, c2, a3, b3, c3])


def cross_matrix(v: Vector) -> Any:
    """[v]ₓ, so that [v]ₓ x = v × x."""
    x, y, z = v
    return arb_mat(3, 3, [0, -z, y, z, 0, -x, -y, x, 0])


def carried(u: Vector, inverse: Any, k: Vector, g: Vector, D: Any, size: Any) -> tuple[Any, Any]:
    """M and a bound of |w| for a step: ξ becomes Mξ + w, |ξ| ≤ size.

    u: the Gibbs vector of the point; inverse: A⁻¹ for every middle between it and another state's; k, γ: for all
    states.  By lemma `state-error` the Gibbs vector at ξ is ũ + δ with Aδ = -Sξ, S by what ξ changes in k and γ,
    v - ṽ = 2[ṽ + ṽ × ξ]ₓξ/(1 + |ξ|²); and (1, -ũ)(1, ξ)(1, ũ + δ) is a multiple of (1, ξ').  What stands beside
    the 2 is within 2|ξ||v| of ṽ, as the v of all states are.
    """
    u1, u2, u3 = u
    g1, g2, g3 = g
    square = u1 * u1 + u2 * u2 + u3 * u3
    norm = 1 + square
    inner = g1 * u1 + g2 * u2 + g3 * u3
    turned = arb_mat(3, 3, [inner + g1 * u1, g1 * u2, g1 * u3, g2 * u1, inner + g2 * u2, g2 * u3, g3 * u1, g3 * u2,
                            inner + g3 * u3])  # fmt: skip
    # Δ = -A⁻¹S; the factors 2 of [2γ]ₓ and [2k]ₓ come last.
    change = inverse * (turned * (cross_matrix(g) * D) + cross_matrix([norm * x for x in k])) * 2
    cross = cross_matrix(u)
    s = 1 - square
    d11, d22, d33 = 2 * u1 * u1 + s, 2 * u2 * u2 + s, 2 * u3 * u3 + s
    o12, o13, o23 = 2 * u1 * u2, 2 * u1 * u3, 2 * u2 * u3
    own = arb_mat(3, 3, [d11, o12, o13, o12, d22, o23, o13, o23, d33])
    matrix = own - cross * 2 + change - cross * change
    far = size * upper(change.entries())
    root = norm.sqrt()
    scalar = norm + arb(0, ((root + root * size) * far).abs_upper())
    return matrix * (1 / scalar), (root * size * far / scalar).abs_upper()
