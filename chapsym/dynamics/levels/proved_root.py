"""Proofs of a root in Arb's balls: by a point near it and a slope with which G is monotone, or by an interval test.

⟨x, G(v + x) - G(v)⟩ ≥ m|x|² in a ball of Gibbs vectors, so the root is within |G(u)|/m of any u, for all 𝒦 and γ in
their balls.  Lemma `small-branch` gives m for all γ; beyond its bound, lemma `straight-path` gives m for each step.  As
∂G/∂u is affine in u, the root is u - A⁻¹G(u) with A = ∂G/∂u at the midpoint of the two.

If neither holds, the interval Newton test proves that a box has one root: `enclosed` in Euler parameters, and
`isolated` for any equations.  Newton's iteration finds the point, with the bits of the context.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import cache, reduce

from flint import arb, arb_mat, ctx

from chapsym.generated import compose, gibbs_newton, residual, tangent_hessian, tangent_jacobian
from chapsym.numbers.precisions import flint_bits

from ..errors import TooWide
from ..loops import path
from ..loops.branch import inverse, product
from ..loops.twins import twin

#: Components in Arb's balls, or points among them.
Vector = tuple[arb, ...]

#: The precision of the matrices beyond the loss in a determinant: they multiply numbers as small as the radii.
MATRIX_BITS = 64
#: The size of the box of the test of `straight-path`, in |G(u)|/I_min: enough if m is not much below I_min.
WIDER = 1024
#: The largest distance of the refined root from the float64 root; beyond, it may be on another branch.
NEAR = 1e-6
MOST_REFINEMENTS = 60
MOST_INFLATIONS = 12


def upper(v: Iterable[arb]) -> arb:
    """An upper bound of the length of a vector, as an exact number."""
    bounds = [x.abs_upper() for x in v]
    return sum((x * x for x in bounds), arb(0)).sqrt().abs_upper()


def inverse_slope(u: Vector, off: arb, state: Vector) -> arb_mat:
    """(∂G/∂u)⁻¹ in a box with half edge `off` round u, for all k, γ, I and D of a state."""
    box = tuple(x + arb(0, off) for x in u)
    det, _, _, _, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton(*(*box, *state))
    if not det > 0:
        raise TooWide
    return arb_mat(3, 3, [c11, c21, c31, c12, c22, c32, c13, c23, c33]) * (1 / det)


def newton_enclosure(u: Vector, r: Vector, slope: arb, state: Vector, matrix_bits: int) -> Vector:
    """The root of G within |r|/m of a point u, r = G(u), where G is monotone with m = `slope`.

    state: k, γ, I and D, in balls.  The root is u - A⁻¹r with A = ∂G/∂u at the midpoint of the two.  Raises TooWide if
    det A may be 0.
    """
    with flint_bits(matrix_bits):
        d = inverse_slope(u, (upper(r) / slope).abs_upper(), state) * arb_mat(3, 1, r)
    return tuple(x - y for x, y in zip(u, d.entries(), strict=True))


@cache
def joined() -> Callable[..., tuple[arb, arb]]:
    """`path.joined` in balls, with certain comparisons."""
    with flint_bits(MATRIX_BITS):
        return twin(path, lambda x: arb(repr(x)), max=highest, min=lowest, sqrt=arb.sqrt)["joined"]


def on_path(u: Vector, length: arb, *state: arb) -> arb | None:
    """A monotonicity constant m of G in a box round u that contains the root of the branch; None without a proof.

    length: a bound of |G(u)|; state: k, γ, I and D.  With |G(u)| ≤ m · (half an edge) the root is in the box.
    """
    off = (WIDER * length / lowest(*state[6:9])).abs_upper()
    slope = stretch(tuple(x + arb(0, off) for x in u), *state)
    return slope if slope is not None and length <= (slope * off).abs_lower() else None


def stretch(box: Vector, *state: arb) -> arb | None:
    """m by lemma `straight-path`, for every point of a box treated as if it were the root; None if it fails."""
    k, g, I, D = state[:3], state[3:6], state[6:9], state[9]
    least = lowest(*I)
    square, half = (sum((x * x for x in v), arb(0)) for v in (box, k))
    proved, slope = joined()(box, square, k, half.sqrt(), g, I, D, (highest(*I) - least) / 2)
    return slope.abs_lower() if proved > 0 and least > 0 else None


def highest(*v: arb) -> arb:
    """The largest of balls, as a ball."""
    return reduce(arb.max, v)


def lowest(*v: arb) -> arb:
    """The smallest of balls, as a ball."""
    return reduce(arb.min, v)


def certified(size: arb, inertia: Vector) -> tuple[arb, arb] | None:
    """(radius, m) by lemma `small-branch` for |𝒦| ≤ size, both exact; None if |𝒦| is beyond its bound.

    There is one root with |u| < 1; it has |u| ≤ radius and is on the small-rotation branch, and in this ball
    ⟨x, (∂G/∂u)x⟩ ≥ m|x|².
    """
    least = lowest(*inertia)
    if not (size := size.abs_upper()) < least:
        return None
    slope = (highest(*inertia) - least) / 2 + size
    inner = size / (least + (least * least - size * size).sqrt())
    if not inner * slope < least:
        return None
    # The root is within `inner`; a point near it may be slightly outside.
    radius = inner.abs_upper() + (least / slope - inner).abs_lower() / 8
    radius = (radius if radius < 1 else arb(1)).abs_upper()
    m = (least - radius * slope).abs_lower()
    return (radius, m) if least - radius * slope > 0 else None


def refined(q: Vector, K: Vector, g: Vector, J: Vector, D: Vector) -> Vector | None:
    """The root near a rotation, by midpoints: Newton's iteration squares a correction, but for the conditioning."""
    q = tuple(x.mid() for x in unit(q))
    settled = arb(2) ** (-ctx.prec // 2 - 2)
    for _ in range(MOST_REFINEMENTS):
        r = residual(*q, *K, *g, *J, *D)
        w = tuple((-x).mid() for x in product(inverse(q, g, J, *D)[1], r))  # q becomes q ∘ (1, w)
        if not (change := max(abs(x) for x in w)) < NEAR:
            return None
        q = tuple(x.mid() for x in unit(compose(*(*q, arb(1), *w))))
        if change <= max(abs(x) for x in q[1:]) * settled:
            return q
    return None


def unit(v: Iterable[arb]) -> Vector:
    """A vector divided by its length."""
    balls = list(v)
    length = sum((x * x for x in balls), arb(0)).sqrt()
    return tuple(x / length for x in balls)


def enclosed(q: Vector, K: Vector, g: Vector, J: Vector, D: Vector) -> Vector | None:
    """Balls that contain the unit Euler parameters of the root near the float64 root, by the interval Newton test."""
    if (point := refined(q, K, g, J, D)) is None:
        return None
    q = point
    # F(w) = 𝒦(q ∘ (1, w)) - |q|²(1 + |w|²)𝒦 vanishes exactly at the root; q is a point that is nearly unit.
    norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    value = residual(*q, *(norm * x for x in K), *g, *J, *D)
    tangent = tangent_jacobian(*q, *g, *J, *D)
    hessian = tangent_hessian(*q, *g, *J, *D)
    image = isolated(value, lambda box: _slope(tangent, hessian, tuple(norm * x for x in K), box))
    return None if image is None else unit(compose(*(*q, arb(1), *image)))


def isolated(value: Sequence[arb], slope: Callable[[Sequence[arb]], Sequence[arb]]) -> list[arb] | None:
    """The zero of a map F with F(0) = `value`, in balls; None if it is not proved.

    slope: from a box round 0, an enclosure of F' on it, row by row.  The interval Newton test: if the image of a box is
    inside the box, the box contains one zero, which is in the image.  The box is widened until this holds.
    """
    size, least = len(value), arb(2) ** -ctx.prec
    target = arb_mat(size, 1, value)
    try:
        largest = max(x.abs_upper() for x in _divided(target, slope([arb(0)] * size)))
        radius = 4 * largest if largest > 0 else least  # if the value is exactly 0, the box needs a size of its own
        for _ in range(MOST_INFLATIONS):
            box = [arb(0, radius)] * size
            image = [-x for x in _divided(target, slope(box))]
            if all(b.contains_interior(x) for b, x in zip(box, image, strict=True)):
                return image
            radius = radius * 4
    except ZeroDivisionError:  # the matrix may be singular
        pass
    return None


def _divided(target: arb_mat, matrix: Sequence[arb]) -> list[arb]:
    """The solution of a linear system for every matrix in balls; raises ZeroDivisionError if one may be singular."""
    return arb_mat(target.nrows(), target.nrows(), matrix).solve(target).entries()


def _slope(tangent: Vector, hessian: Vector, K: Vector, box: Sequence[arb]) -> list[arb]:
    """F'(w) for every w in the box, row by row: T + H w - 2|q|²𝒦 wᵀ."""
    place = {(0, 0): 0, (1, 1): 1, (2, 2): 2, (1, 2): 3, (0, 2): 4, (0, 1): 5}
    rows = []
    for i in range(3):
        for j in range(3):
            bent = sum(hessian[3 * place[min(j, k), max(j, k)] + i] * box[k] for k in range(3))
            rows.append(tangent[3 * i + j] + bent - 2 * K[i] * box[j])
    return rows
