"""What proves a root in Arb's balls: a point near it, and a slope with which G is monotone there.

⟨x, G(v + x) - G(v)⟩ ≥ m|x|² in a ball of Gibbs vectors: so the root is within |G(u)|/m of any u, for all 𝒦 and γ in
their balls.  m is that of lemma `small-branch`, for all γ, or beyond its bound that of lemma `straight-path`, for
every step.  As ∂G/∂u is affine in u, the root is u - A⁻¹G(u) with A = ∂G/∂u at the middle between the two.
"""

from collections.abc import Sequence
from functools import cache, reduce
from typing import Any

from flint import arb, arb_mat, ctx

from chapsym.generated import gibbs_newton

from ..errors import TooWide
from ..loops import path
from ..loops.twins import twin

Numbers = tuple[Any, ...]

#: The precision of the matrices beyond what a determinant can lose: what they multiply is as small as the radii.
MATRIX_BITS = 64
#: The box in which `straight-path` is looked at has this many times |G(u)|/I_min: enough if m is not much below I_min.
WIDER = 1024


def upper(v: Sequence[Any]) -> Any:
    """An upper bound of the length of a vector, as an exact number."""
    bounds = [x.abs_upper() for x in v]
    return sum(x * x for x in bounds).sqrt().abs_upper()


def inverse_slope(u: Numbers, off: Any, state: Numbers) -> Any:
    """(∂G/∂u)⁻¹ in a box of half the edge `off` round u, for all k, γ, I and D of a state."""
    box = tuple(x + arb(0, off) for x in u)
    det, _, _, _, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton(*(*box, *state))
    if not det > 0:
        raise TooWide
    return arb_mat(3, 3, [c11, c21, c31, c12, c22, c32, c13, c23, c33]) * (1 / det)


def newton_enclosure(u: Numbers, r: Numbers, slope: Any, state: Numbers, matrix_bits: int) -> Numbers:
    """The root of G within |r|/m of a point u, r = G(u), where G is monotone with m = `slope`.

    state: k, γ, I and D, in balls.  The root is u - A⁻¹r with A = ∂G/∂u at the middle between the two.  Raises TooWide
    where det A may be 0.
    """
    with ctx.workprec(matrix_bits):
        d = inverse_slope(u, (upper(r) / slope).abs_upper(), state) * arb_mat(3, 1, r)
    return tuple(x - y for x, y in zip(u, d.entries(), strict=True))


@cache
def joined() -> Any:
    """`path.joined` in balls: what its comparisons say is certain."""
    with ctx.workprec(MATRIX_BITS):
        return twin(path, lambda x: arb(repr(x)), max=highest, min=lowest, sqrt=arb.sqrt)["joined"]


def on_path(u: Numbers, length: Any, *state: Any) -> Any:
    """m where G is monotone with it in a box round u that contains a root, and this is the branch's; else None.

    length: a bound of |G(u)|; state: k, γ, I and D.  With |G(u)| ≤ m · (half an edge) the root is in the box.
    """
    off = (WIDER * length / lowest(*state[6:9])).abs_upper()
    slope = stretch(tuple(x + arb(0, off) for x in u), *state)
    return slope if slope is not None and length <= (slope * off).abs_lower() else None


def stretch(box: Numbers, *state: Any) -> Any:
    """m by lemma `straight-path`, for every point of a box treated as if it were the root; None where it fails."""
    k, g, I, D = state[:3], state[3:6], state[6:9], state[9]
    least = lowest(*I)
    square, half = sum(x * x for x in box), sum(x * x for x in k).sqrt()
    proved, slope = joined()(box, square, k, half, g, I, D, (highest(*I) - least) / 2)
    return slope.abs_lower() if proved > 0 and least > 0 else None


def highest(*v: Any) -> Any:
    """The largest of balls, as a ball."""
    return reduce(arb.max, v)


def lowest(*v: Any) -> Any:
    """The smallest of balls, as a ball."""
    return reduce(arb.min, v)


def certified(size: Any, inertia: Numbers) -> tuple[Any, Any] | None:
    """(radius, m) by lemma `small-branch` for |𝒦| ≤ size, both exact; None where |𝒦| is beyond its bound.

    There is one root with |u| < 1, it has |u| ≤ radius and is that of the small-rotation branch, and in this ball
    ⟨x, (∂G/∂u)x⟩ ≥ m|x|².
    """
    least = lowest(*inertia)
    size = size.abs_upper()
    if not size < least:
        return None
    slope = (highest(*inertia) - least) / 2 + size
    inner = size / (least + (least * least - size * size).sqrt())
    if not inner * slope < least:
        return None
    # The root is within `inner`; a point near it may be a little outside.
    radius = inner.abs_upper() + (least / slope - inner).abs_lower() / 8
    radius = (radius if radius < 1 else arb(1)).abs_upper()
    m = (least - radius * slope).abs_lower()
    return (radius, m) if least - radius * slope > 0 else None
