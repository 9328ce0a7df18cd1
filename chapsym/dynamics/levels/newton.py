"""Newton's iteration in Arb's numbers, and the interval Newton test of its balls, with the bits of the context."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from flint import arb, arb_mat, ctx

import chapsym.generated as generated

from ..loops.branch import inverse, product

#: Refinement must stay this near to the float64 root, else another branch may have been met.
NEAR = 1e-6
MOST_REFINEMENTS = 60
MOST_INFLATIONS = 12


def refined(q: tuple, K: tuple, g: tuple, J: tuple, D: tuple) -> tuple | None:
    """The one root near a rotation, by midpoints: Newton squares a correction, up to what the conditioning costs."""
    q = tuple(x.mid() for x in unit(q))
    settled = arb(2) ** (-ctx.prec // 2 - 2)
    for _ in range(MOST_REFINEMENTS):
        r = generated.residual(*q, *K, *g, *J, *D)
        w = tuple((-x).mid() for x in product(inverse(q, g, J, *D)[1], r))  # q becomes q ∘ (1, w)
        change = max(abs(x) for x in w)
        if not change < NEAR:
            return None
        q = tuple(x.mid() for x in unit(generated.compose(*(*q, arb(1), *w))))
        if change <= max(abs(x) for x in q[1:]) * settled:
            return q
    return None


def unit(v: Iterable[Any]) -> tuple[Any, ...]:
    """A vector divided by its length."""
    balls = list(v)
    length = sum(x * x for x in balls).sqrt()
    return tuple(x / length for x in balls)


def enclosed(q: tuple, K: tuple, g: tuple, J: tuple, D: tuple) -> tuple | None:
    """Unit Euler parameters as balls that contain the one root near the float64 root, by the interval Newton test."""
    point = refined(q, K, g, J, D)
    if point is None:
        return None
    q = point
    # F(w) = 𝒦(q ∘ (1, w)) - |q|²(1 + |w|²)𝒦 vanishes exactly at the root; q is a point that is nearly unit.
    norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    value = generated.residual(*q, *(norm * x for x in K), *g, *J, *D)
    tangent = generated.tangent_jacobian(*q, *g, *J, *D)
    hessian = generated.tangent_hessian(*q, *g, *J, *D)
    image = isolated(value, lambda box: _slope(tangent, hessian, tuple(norm * x for x in K), box))
    return None if image is None else unit(generated.compose(*(*q, arb(1), *image)))


def isolated(value: Sequence[Any], slope: Callable[[Sequence[Any]], Sequence[Any]]) -> list[Any] | None:
    """The zero of a map F of which F(0) = `value`, in balls; None if it is not proved.

    slope: of a box round 0, what contains F' in it, row by row.  The interval Newton test: where the image of a box is
    inside it, the box contains one zero, and the image contains that.  The box is widened until it does.
    """
    size, least = len(value), arb(2) ** -ctx.prec
    target = arb_mat(size, 1, value)
    try:
        largest = max(x.abs_upper() for x in _divided(target, slope([arb(0)] * size)))
        radius = 4 * largest if largest > 0 else least  # where the value is exactly 0 the box needs a size of its own
        for _ in range(MOST_INFLATIONS):
            box = [arb(0, radius)] * size
            image = [-x for x in _divided(target, slope(box))]
            if all(b.contains_interior(x) for b, x in zip(box, image, strict=True)):
                return image
            radius = radius * 4
    except ZeroDivisionError:  # the matrix may be singular
        pass
    return None


def _divided(target: arb_mat, matrix: Sequence[Any]) -> list[Any]:
    """The solution of a linear system for every matrix in balls; raises ZeroDivisionError where one may be singular."""
    return arb_mat(target.nrows(), target.nrows(), matrix).solve(target).entries()


def _slope(tangent: tuple, hessian: tuple, K: tuple, box: Sequence[Any]) -> list:
    """F'(w) for every w in the box, row by row: T + H w - 2|q|²𝒦 wᵀ."""
    place = {(0, 0): 0, (1, 1): 1, (2, 2): 2, (1, 2): 3, (0, 2): 4, (0, 1): 5}
    rows = []
    for i in range(3):
        for j in range(3):
            bent = sum(hessian[3 * place[min(j, k), max(j, k)] + i] * box[k] for k in range(3))
            rows.append(tangent[3 * i + j] + bent - 2 * K[i] * box[j])
    return rows
