"""Rigorous bounds, computed in float64, for the distance of a double-double run from the exact orbit of the map.

The run has Gibbs vectors ũ in pairs.  Any vector ũ defines an exact rotation, so they define an orbit R̃ of rotations,
from which k̃ and γ̃ in pairs differ by the sum of the rounding errors of their turns.  The exact orbit is R̃ times a
small rotation with the Gibbs vector ξ (notation of lemma `state-error`): k = Ω(ξ)ᵀk̃, γ = Ω(ξ)ᵀγ̃.
The root u at k, γ is on the branch.  If G is monotone with m (`small-branch`; beyond its bound `straight-path`), then
|u - ũ| ≤ |G(ũ; k, γ)|/m for any ũ.  G in pairs is accurate to rounding of its terms, so w = u - ũ is

    w = 2A⁻¹S(ξ) + (G(ũ; k̃, γ̃) + terms quadratic in ξ and w)/m,  S(ξ) = D(⟨γ̃,ũ⟩γ̃×ξ + ⟨ũ,γ̃×ξ⟩γ̃) + (1 + |ũ|²)k̃×ξ,

and ξ after the step is Ω(ũ)ᵀξ + (w - ũ × w)/(1 + |ũ|²) up to 8|w|(|ξ| + |w|).  The set of ξ is a parallelepiped plus a
ball (Lohner): Σ zⱼcⱼ + e, |zⱼ| ≤ bⱼ, |e| ≤ r.  Its edges are moved by the derivative in float64; rounding errors and
the residual of the linear system are added to r.  The edges are made orthogonal again periodically.

Each bound is a sum of products of positive floats with fewer than 2⁸ operations: `WIDER` covers their rounding errors.
The error of a kernel in pairs is counted on its text (`tests/dynamics/test_proved.py`): at most 160·2⁻¹⁰⁶ times the sum
of its terms in absolute value, which is at most 8 times the numbers below: `EVALUATED` covers both.
"""

from math import frexp, inf, ldexp, sqrt
from typing import NamedTuple

from chapsym.generated import gibbs_newton, gibbs_residual, turn
from chapsym.numbers.loose import Loose, square_root
from chapsym.numbers.pairs import two_sum

from .branch import moments
from .gibbs import BEYOND, bound
from .path import joined
from .tangent import column
from .text import Matrix, Vector, out_of_line
from .vectors import (
    adjoint,
    cross,
    dot,
    four,
    largest,
    length,
    minus,
    plus,
    put,
    scaled,
    shifted,
    square,
    square_of_four,
    three,
)

#: The rows of a set of ξ: three edges c, their bounds b, r; the rounding errors of k̃ relative to |k|, of γ̃, of the
#: attitude and of the contact point in radii; and the number of proved rotations.
EDGES, BOUNDS, BALL, K_OFF, G_OFF, A_OFF, X_OFF, PROVED = 0, 9, 12, 13, 14, 15, 16, 17
ROWS = 18
#: Factors that cover the rounding errors of a bound, of a sum of products in float64, of a kernel in pairs, of a pair.
WIDER, ROUNDED, EVALUATED, PAIR = 1.0 + 2.0**-40, 2.0**-46, 2.0**-95, 2.0**-98
#: More than the underflow in these.
TINY = 2.0**-1000
#: The largest |ξ| and |w| that are followed.
LARGEST = 2.0**-20
#: Beyond the bound of `small-branch` each m(s) of `straight-path` is at least this part of Λmax, and |ξ| and |w| are
#: below `NEAR`: these and rounding then change its inequality far less than the margin of 2 % in `path`.
STEEP, NEAR = 2.0**-8, 2.0**-36
#: The number of rotations between two tests of the edges; every rotation if the derivative may stretch by 1 + `QUICK`.
WINDOW, QUICK = 8, 0.5
#: If m is below this fraction of Λmax, as for heavy balls, the bound of a step uses the solution of the linear system.
FLAT = 0.125


def extent(box):
    """A bound for |ξ|."""
    total = box[BALL]
    for j in range(3):
        total += box[BOUNDS + j] * length(three(box, EDGES + 3 * j))
    return WIDER * total


def exact(v):
    """A vector of floats as exact numbers."""
    return Loose(v[0]), Loose(v[1]), Loose(v[2])


def unit_pairs(v):
    """A vector of floats divided by its length, as pairs."""
    x = exact(v)
    size = square_root(dot(x, x))
    return x[0] / size, x[1] / size, x[2] / size


def long(v):
    """A bound for |v|, valid also if the squares underflow."""
    most = largest(v)
    return length(v) if most > 2.0**-500 else 2.0 * most


def floats(v):
    """The numbers of a vector of pairs, each rounded."""
    return v[0].normalised().high, v[1].normalised().high, v[2].normalised().high


def slope_of(k, I, D):
    """(m, radius²) by `small-branch`: for |u|² ≤ radius², G is monotone with m, and has the root of the branch.

    (0, BEYOND) if |𝒦| is beyond its bound.
    """
    radius, _ = bound(k, I, D)
    least, most = min(*I), max(*I)
    slope = least - sqrt(max(radius, 0.0)) * (0.5 * (most - least) + 2.0 * length(k)) * WIDER
    return 0.0 if radius < 0.0 else slope, radius


def slope_at(u, k, g, I, D):
    """m beyond the bound of `small-branch`: 0.49 m(1) at u if the straight path proves the root, else 0."""
    half = sqrt(square(k))
    reached, least = joined(u, square(u), k, half, g, I, D, 0.5 * (max(*I) - min(*I)))
    flattest = min(least, min(*I)) - 0.25 * (half * length(u) - dot(k, u))
    return 0.49 * least if reached > 0.0 and flattest > STEEP * (max(*I) + D) else 0.0


def left(d, r, u, k, g, I, D):
    """|Ad - r| for A = ∂G/∂u at u, |γ| = 1."""
    x = cross(d, (I[0] * u[0], I[1] * u[1], I[2] * u[2]))
    y = cross(u, (I[0] * d[0], I[1] * d[1], I[2] * d[2]))
    B = (I[0] * d[0], I[1] * d[1], I[2] * d[2]), scaled(D, minus(d, scaled(dot(g, d), g)))
    Ad = minus(plus(plus(B[0], B[1]), plus(x, y)), scaled(2.0 * dot(u, d), k))
    return length(minus(Ad, r))


class Root(NamedTuple):
    """The root is within w of ũ; m is the slope; |G(ũ; k̃, γ̃)| ≤ rest, |2S(ξ)| ≤ shift |ξ|; curved: terms in ξ²."""

    w: float
    m: float
    rest: float
    shift: float
    curved: float


def root_near(u, k, g, I, D, slope, radius, xi, k_off, g_off):
    """A bound for the distance of the root from u, for k and γ within |ξ| ≤ xi of pairs with errors k_off and g_off.

    slope: m by `small-branch` in |u|² ≤ radius; radius is `BEYOND` beyond its bound.  w is infinite if nothing is
    proved.
    """
    v, kf, gf, If = floats(u), floats(k), floats(g), floats(I)
    spread, half, size, most = 0.5 * (max(*If) - min(*If)), long(kf) * WIDER, long(v), max(*If) + D
    m = (slope_at(v, kf, gf, If, D) if radius == BEYOND else slope) / WIDER
    whole = 1.0 + size * size
    at_root = long(floats(gibbs_residual(*u, *k, *g, *I, Loose(D))))
    rest = at_root + EVALUATED * (1.0 + size) * (most * size + half) + TINY
    rest = rest + (2.0 * D * size * g_off + whole * half * k_off)
    shift = 4.0 * D * size + 2.0 * whole * half
    curved = (11.0 * D * size + 3.0 * whole * half) * xi * xi
    w = WIDER * ((rest + shift * xi + curved) / m) if m > 0.0 else inf
    inside = w <= LARGEST and xi <= LARGEST
    if radius == BEYOND:  # the root is in the ball around ũ in which half of m(1) remains
        inside = w <= NEAR and xi <= NEAR and 2.0 * (spread + 2.0 * half) * w <= m
    else:
        inside = inside and size * size <= radius
    return Root(w if inside else inf, m, rest, shift, curved)


def carried(box, u, k, g, I, D, slope, radius):
    """Updates the set of ξ by the step with the Gibbs vector u, from k, γ and I in pairs; all ξ if it is not proved."""
    v, kf, gf, If = floats(u), floats(k), floats(g), floats(I)
    xi = extent(box)
    root = root_near(u, k, g, I, D, slope, radius, xi, box[K_OFF] + PAIR, box[G_OFF])
    w, m, shift = root.w, root.m, root.shift
    spread, half, size, most = 0.5 * (max(*If) - min(*If)), length(kf), length(v), max(*If) + D
    off = 2.0 * (D * box[G_OFF] + half * size * box[K_OFF])
    steeper = (spread + half) * w + 5.0 * (half * size + D) * xi + ROUNDED * (most + half) * (1.0 + size) + off
    if w == inf or not steeper < 0.5 * m:
        box[BALL] = inf
        return
    found = gibbs_newton(*v, *kf, *gf, *If, D)
    moved, lost = 0.0, 0.0
    for j in range(3):
        c, b = three(box, EDGES + 3 * j), box[BOUNDS + j]
        y, d, r = column(c, v, kf, gf, D, found[0], found[4:13])
        put(box, EDGES + 3 * j, y)
        rounded = ROUNDED * (1.0 + size) * ((most + half) * length(d) + shift * length(c))
        solved = 2.0 * (left(d, r, v, kf, gf, If, D) + rounded) / m
        moved, lost = moved + b * (2.0 * length(d) + solved), lost + b * (solved + ROUNDED * (length(c) + length(d)))
    w = min(w, WIDER * (((root.rest + root.curved + shift * box[BALL]) / m + moved) / (1.0 - steeper / m)))
    more = (root.rest + root.curved + steeper * w) / m + 8.0 * w * (xi + w) + ROUNDED * (1.0 + size) * (xi + w)
    box[BALL] = WIDER * ((1.0 + shift / m) * box[BALL] + (more + lost))
    box[K_OFF] = WIDER * (box[K_OFF] + EVALUATED * size + PAIR)
    box[G_OFF] = WIDER * (box[G_OFF] + EVALUATED * size + PAIR)
    box[A_OFF] = WIDER * (box[A_OFF] + EVALUATED)
    box[X_OFF] = WIDER * (box[X_OFF] + 3.0 * w + size * (10.0 * xi + 8.0 * (box[A_OFF] + box[G_OFF] + EVALUATED)))
    box[PROVED] += 1.0
    if int(box[PROVED]) % WINDOW == 0 or shift > QUICK * m:
        squared(box)


def bound_step(momentum, vertical, tensor, contact, q, momentum_after, vertical_after, row):
    """Writes bounds for the errors of 𝒦, γ and the rotation q of a step, for `bound_steps`."""
    _, size = frexp(max(*moments(three(tensor, 0))) + contact)
    k, g = shifted(three(momentum, 0), -size - 1), three(vertical, 0)
    J, D = shifted(three(tensor, 0), -size), ldexp(contact, -size)
    u = q[1] / q[0], q[2] / q[0], q[3] / q[0]
    I = Loose(*two_sum(J[1], J[2])), Loose(*two_sum(J[0], J[2])), Loose(*two_sum(J[0], J[1]))
    slope, radius = slope_of(k, floats(I), D)
    off = 0.51 * abs(dot(g, g) - 1.0) + 2.0**-52  # the distance of γ from γ/|γ|
    root = root_near(exact(u), exact(k), exact(g), I, D, slope, radius, 0.0, 0.0, off)
    near, heaviest = root.w, max(*floats(I)) + D
    if near < inf and root.m < FLAT * heaviest:
        near = min(near, nearer(u, k, g, I, D, slope, radius))
    unit_off = 0.51 * abs(square_of_four(four(q, 0)) - 1.0) + 2.0**-52
    kept = ldexp(largest(k), size + 1) == largest(three(momentum, 0)) and q[0] > LARGEST
    w = WIDER * near if kept else inf
    part = WIDER * (2.0 * w + 2.0 * w * w) + (EVALUATED * long(u) + PAIR)
    after = shifted(three(momentum_after, 0), -size - 1)
    row[0] = ldexp(WIDER * (long(turned_off(u, k, after)) + 2.0 * largest(k) * part + TINY), size + 1) + 2.0**-1073
    row[1] = WIDER * (long(turned_off(u, g, three(vertical_after, 0))) + 1.01 * part + off)
    row[2] = WIDER * (w + long(u) * 2.0**-52 + unit_off)


@out_of_line
def nearer(u, k, g, I, D, slope, radius):
    """The bound of `root_near` for γ/|γ|, by solving the linear system: the factor 1/m is mostly too pessimistic."""
    v = unit_pairs(g)
    root = root_near(exact(u), exact(k), v, I, D, slope, radius, 0.0, 0.0, PAIR)
    if root.w == inf:
        return inf
    If, gf = floats(I), floats(v)
    found = gibbs_newton(*u, *k, *gf, *If, D)
    r = floats(gibbs_residual(*exact(u), *exact(k), *v, *I, Loose(D)))
    d = scaled(1.0 / found[0], adjoint(found[4:13], r))
    half, size, most = length(k), length(u), max(*If) + D
    lost = left(d, r, u, k, gf, If, D) + ROUNDED * (1.0 + size) * (most + half) * length(d)
    curved = (0.5 * (max(*If) - min(*If)) + half) * root.w * root.w
    return WIDER * (long(d) + (lost + curved + max(root.rest - length(r), 0.0) + ROUNDED * root.rest) / root.m)


def turned_off(u, v, after):
    """The vector v, turned by the step with the Gibbs vector u, minus `after`, in pairs."""
    y = turn(1, *exact(u), *exact(v))
    return floats(
        plus(y, (Loose(v[0]) - Loose(after[0]), Loose(v[1]) - Loose(after[1]), Loose(v[2]) - Loose(after[2])))
    )


def bound_steps(
    momenta: Matrix, verticals: Matrix, tensors: Matrix, contacts: Vector, q: Matrix, momenta_after: Matrix,
    verticals_after: Matrix, errors: Matrix,
):  # fmt: skip
    """Writes bounds for the errors of a step of each ball in 𝒦, γ and the rotation, (n, 3); inf if not proved.

    momenta, verticals: before the step, (n, 3); tensors: (n, 3); q: the rotations of the step, (n, 4).
    """
    for i in range(momenta.shape[0]):
        bound_step(
            momenta[i], verticals[i], tensors[i], contacts[i], q[i], momenta_after[i], verticals_after[i], errors[i]
        )


@out_of_line
def squared(box):
    """Makes the edges orthogonal, the longest first; the ball is absorbed into their bounds."""
    for j in range(3):
        put(box, EDGES + 3 * j, scaled(box[BOUNDS + j], three(box, EDGES + 3 * j)))
    for i, j in ((0, 1), (0, 2), (1, 2)):
        a, b = three(box, EDGES + 3 * i), three(box, EDGES + 3 * j)
        swap = square(a) < square(b)
        put(box, EDGES + 3 * i, b if swap else a)
        put(box, EDGES + 3 * j, a if swap else b)
    first, second, third = three(box, EDGES), three(box, EDGES + 3), three(box, EDGES + 6)
    x = unit(first, (1.0, 0.0, 0.0))
    y = across(second, x)
    y = across(y, x)
    z = cross(x, y)
    off = abs(dot(x, y)) + abs(dot(x, z)) + abs(dot(y, z)) + abs(square(x) - 1.0) + abs(square(y) - 1.0)
    good = off + abs(square(z) - 1.0) <= ROUNDED
    x = x if good else (1.0, 0.0, 0.0)
    y = y if good else (0.0, 1.0, 0.0)
    z = z if good else (0.0, 0.0, 1.0)
    rest = box[BALL] + 4.0 * ROUNDED * (length(first) + length(second) + length(third))
    for j, q in ((0, x), (1, y), (2, z)):
        put(box, EDGES + 3 * j, q)
        box[BOUNDS + j] = WIDER * (abs(dot(q, first)) + abs(dot(q, second)) + abs(dot(q, third)) + rest)
    box[BALL] = 0.0


def write_spread(row, box):
    """Writes bounds for the distances to the run: of 𝒦 relative to |𝒦|, γ, the attitude, the contact point in radii."""
    xi = extent(box)
    row[0] = WIDER * (2.0 * xi + 3.0 * xi * xi + box[K_OFF])
    row[1] = WIDER * (2.0 * xi + 3.0 * xi * xi + box[G_OFF])
    row[2], row[3] = WIDER * (xi + box[A_OFF]), box[X_OFF] if xi < inf else inf


def unit(v, instead):
    """v divided by its length, or another unit vector if v = 0."""
    size = length(v)
    whole = size > 0.0
    scale = 1.0 / size if whole else 1.0
    u = scaled(scale, v)
    return u if whole else instead


def across(v, x):
    """The direction of the part of v orthogonal to a unit vector x, or any orthogonal direction if that part is 0."""
    y = minus(v, scaled(dot(v, x), x))
    far = square(y) > 2.0**-60 * square(v)
    flat = abs(x[0]) < 0.7
    other = (1.0, 0.0, 0.0) if flat else (0.0, 1.0, 0.0)
    z = minus(other, scaled(dot(other, x), x))
    return unit(y if far else z, other)
