"""A branch of the roots of (1) in step.py over a whole circle, where |h| may be beyond the bound of the small branch.

The circle is that of measure.py: γ = r(cos φ, sin φ) in the plane (a, b), γ_c > 0.  The file gives the number of arcs
into which half of the circle, t = tan ½φ from -1 to 1, is cut.  Over every arc Newton's test proves that a box holds
exactly one root u for each γ of the arc.  At the common end of two arcs the two roots are equal, as one root lies in
both boxes.  So these roots are a continuous function u(γ).  The rotation R by π about the axis c takes roots at γ to
roots at Rγ: it extends u to the rest of the circle, and the roots are compared where the halves meet.  Then
Z = {(γ, u(γ))} is a component of the set of all pairs (γ, root): Z is compact, and no other pair is near it.

Let γ̃ = Ωᵀγ.  It lies on the circle: ⟨γ̃, Λ⁻¹γ̃⟩ = ⟨γ, Λ⁻¹γ⟩ holds for every root, and γ̃_c > 0, proved at one point,
holds at all points, as the level has no points with γ_c = 0.  The map G: γ ↦ γ̃ of the circle is a homeomorphism: Let S
be the reflection γ_b ↦ -γ_b.  From sγ = w + u × w, sγ̃ = w - u × w, w = Λu, follow s·Sγ̃ = Sw + Su × Sw and
s·Sγ = Sw - Su × Sw with the same s, so Su is a root at Sγ̃.  So ι: (γ, u) ↦ (Sγ̃, Su) takes pairs to pairs, ι∘ι = 1,
and ι(Z) is connected; one point of it is proved to lie in Z, so ι(Z) = Z, and SG is its own inverse.  G commutes with
R.  It preserves the orientation of the circle: the image of an arc is an arc between the images of its ends, of less
than half a turn, as it does not meet its image under R; and for one arc the sine is proved to be positive.  These are
the properties of the map on the circle that measure.py uses.
"""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from .circle import Circle, direction
from .document import Data, check_rounded, decimals
from .interval import Interval, Rejected
from .linear import Matrix, Vector, cross, image, isolated, minus, solve, times, transposed, units
from .step import Pair, gibbs_vector, jacobian, residual, source, turned

MOST_ARCS = 8_192
#: The margin of a box on each side, as a multiple of the distance between the roots at the ends of its arc.
WIDER = 3


@dataclass(frozen=True)
class Branch:
    """The branch: for each arc, from t = -1 to 1, a box that contains its roots."""

    circle: Circle
    boxes: list[Vector]

    @classmethod
    def proved(cls, circle: Circle, data: Data, digits: int) -> "Branch":
        """The branch of a file; raises Rejected unless it is proved to exist, uniquely, over the whole circle."""
        half, odd = divmod(data["arcs"], 2)
        if odd:
            raise Rejected("arcs must be even, so that the branch starts at the end of two")
        given = decimals(data["u"], digits, "u of branch")
        ends = [Fraction(i, half) for i in range(-half, half + 1)]
        gammas = [circle.start(t) for t in ends]
        start = _root(circle, gammas[half], [circle.number(x).point() for x in given])
        check_rounded(start, given, digits, "u of branch")
        _check_meant(circle, circle.state(gammas[half]), given, digits)
        roots = {half: start}
        for way in (1, -1):
            last = near = start
            for i in range(half + way, half + way * (half + 1), way):
                roots[i] = _root(circle, gammas[i], near)
                near, last = minus(times(2, roots[i]), last), roots[i]
        arcs = zip(pairwise(ends), pairwise(roots[i] for i in range(2 * half + 1)), strict=True)
        branch = cls(circle, [_box(circle, first, last, pair) for (first, last), pair in arcs])
        if not _inside(branch.half_turned(roots[0]), branch.boxes[-1]):
            raise Rejected("the branch is not proved to close after half a turn")
        images = [turned(roots[i], gammas[i]) for i in (half, half + 1)]
        if not (images[0][circle.c] > 0 and circle.sine(*images) > 0):
            raise Rejected("the branch is not proved to take the circle to itself in its direction")
        branch.check_on(branch.reflected(images[0]), branch.reflected(start), "the step back")
        return branch

    def half_turned(self, v: Vector) -> Vector:
        """Rv: the rotation by π about the axis c."""
        return [x if i == self.circle.c else -x for i, x in enumerate(v)]

    def reflected(self, v: Vector) -> Vector:
        """Sv: the component b with the opposite sign."""
        return [-x if i == self.circle.b else x for i, x in enumerate(v)]

    def check_on(self, gamma: Vector, u: Vector, where: str) -> None:
        """Raises Rejected unless u, a root at this γ of the circle, is proved to be on the branch."""
        circle, half = self.circle, len(self.boxes) // 2
        if gamma[circle.a].hi < 0:
            gamma, u = self.half_turned(gamma), self.half_turned(u)
        x, y = gamma[circle.a], gamma[circle.b]
        t = y / ((x * x + y * y).sqrt() + x)
        for i in range(((t.lo * half) >> t.bits) + half, ((t.hi * half) >> t.bits) + half + 1):
            turns, arc = divmod(i, 2 * half)  # beyond t = 1 the arcs repeat from t = -1, rotated by half a turn
            if turns not in (-1, 0, 1) or not _inside(self.half_turned(u) if turns else u, self.boxes[arc]):
                raise Rejected(f"{where} is not proved to be on the branch")


def _root(circle: Circle, gamma: Vector, near: Vector) -> Vector:
    """The root at one γ near a given vector."""
    return gibbs_vector(circle.ball, circle.state(gamma), [x.point() for x in near])


def _check_meant(circle: Circle, state: Pair, given: list[Fraction], digits: int) -> None:
    """Raises Rejected unless exactly one root rounds to the numbers of the file."""
    half = Fraction(1, 2 * 10**digits)
    cell = [Interval.about(x, circle.level.bits, half).wider(1) for x in given]
    try:
        isolated(lambda u: residual(circle.ball, state, u), lambda u: jacobian(circle.ball, state, u), cell)
    except Rejected:
        raise Rejected("the u of branch may be that of two roots: it needs more digits") from None


def _box(circle: Circle, first: Fraction, last: Fraction, roots: tuple[Vector, Vector]) -> Vector:
    """A box that contains the roots at the ends of an arc, and exactly one root for each γ of the arc.

    Along the arc γ moves in the direction of γ × Λ⁻¹γ: γ = γ_m + sT, γ_m the middle and T a mean of these tangents.
    Then F(u) decreases by s times a mean of source(γ × Λ⁻¹γ), as the enclosure for all γ of the arc is convex.
    Newton's test is applied to YF, Y a matrix near the inverse of F′: it proves that YF has exactly one root, and Y is
    regular if YF′ is.
    """
    ends = [[circle.number(x) for x in direction(t)] for t in (first, last)]
    middle = circle.state(circle.start((first + last) / 2))
    whole = circle.state(circle.point(*(x.hull(y) for x, y in zip(*ends, strict=True))))
    tangent = cross(whole[1], [w * x for w, x in zip(circle.weights, whole[1], strict=True)])
    best = max(range(3), key=lambda i: tangent[i].least)
    s = (whole[1][best] - middle[1][best]) / tangent[best]
    between = [x.hull(y) for x, y in zip(*roots, strict=True)]
    box = [x.wider(WIDER * max(y.width for y in between)) for x in between]
    slope = [[x.point() for x in row] for row in jacobian(circle.ball, middle, [x.point() for x in box])]
    Y = [[x.point() for x in row] for row in solve(slope, units(3, s))]

    def pulled(u: Vector) -> Vector:
        moved = source(circle.ball, whole, u, circle.state(tangent))
        return minus(image(Y, residual(circle.ball, middle, u)), times(s, image(Y, moved)))

    def matrix(u: Vector) -> Matrix:
        return transposed([image(Y, column) for column in transposed(jacobian(circle.ball, whole, u))])

    try:
        isolated(pulled, matrix, box)
    except Rejected:
        raise Rejected(f"the branch is not proved to have one root at each point from t = {first} to {last}") from None
    return box


def _inside(u: Vector, box: Vector) -> bool:
    return all(x.inside(y) for x, y in zip(u, box, strict=True))
