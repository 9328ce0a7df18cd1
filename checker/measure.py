"""Certificates of kind no-invariant-measure: the reduced map of the ball is not conjugate to a rotation on a circle.

For 𝒦 = hγ the step (step.py) is a map G_h of the sphere |γ| = 1 into itself.

The circle.  With s = ½h(1 + |u|²) + D⟨γ, u⟩ and w = Λu equation (1) reads sγ = w + u × w (as u × Iu = u × Λu), so by
(2) sγ̃ = w - u × w.  Hence both s²⟨γ, Λ⁻¹γ⟩ and s²⟨γ̃, Λ⁻¹γ̃⟩ are ⟨w, Λ⁻¹w⟩ ± 2⟨u × w, u⟩ + ⟨u × w, Λ⁻¹(u × w)⟩; the
middle is 0, and s ≠ 0, as w = 0 only for h = 0: ⟨γ, Λ⁻¹γ⟩ is an integral.  If 1/Λ_c is the least or greatest 1/Λ and
the level l lies strictly between it and the next, the level consists of two circles, γ_c > 0 and γ_c < 0, and its
projection to the plane of the other two axes, a and b, is an ellipse about 0.  G_h depends smoothly on h and is the
identity for h = 0, so it takes the circle γ_c > 0 to itself.  G_-h is its inverse: (h, u, w, s) ↦ -(h, u, w, s)
exchanges the two equations for γ and γ̃.  Beyond the bound of check_small_branch the file has a `branch` of the roots
over the circle; branch.py proves that its map is a homeomorphism of the circle that commutes with R (see below) and
preserves the orientation, and that the steps of the orbits are on it.  Its roots are simple, so the branch extends to
nearby circles.

The lift.  Let φ be the angle in the plane (a, b), and g a lift of G_h to the line, φ ↦ g(φ).  The rotation R by π about
the axis c commutes with G_h, so g(φ + π) = g(φ) + π (applied twice it adds 2π), and any two values of g(φ) - φ differ
by less than π.  Thus if at each of several points a step turns by an angle in (0, π), all in the same direction, these
are the angles of a single lift g.

The two orbits.  Let θ be the angle of the q steps of g, a continuous function of the start.  The sign of sin(θ - pπ) is
proved to be + for one orbit and - for the other; the numbers of completed half-turns, counted by the sign of the sine
after each step, are p and p - 1.  So θ > pπ for the first and θ < pπ for the second: R^p G^q has a fixed point, and is
not the identity.  All points between two neighbouring fixed points move to one of the two, so no finite invariant
measure of R^p G^q is positive on this arc; the same holds for (R^p G^q)² = G^2q, and so for G.  A continuous positive
invariant density of G on the sphere, or near the circle, would give such a measure on each circle.
"""

from fractions import Fraction
from itertools import pairwise

from .branch import MOST_ARCS, Branch
from .circle import Circle
from .document import DIGITS, STEPS, Data, check_rounded, count, decimal, decimals, exact, sized
from .form import HEAD, anything, check_shape
from .interval import Interval, Rejected
from .linear import Vector
from .step import check_small_branch, gibbs_vector, turned

STEP = {"u": (exact,) * 3, "gamma": (exact,) * 3}
ORBIT = {"start": anything, "steps": [STEP], "displacement": exact}
FORM = HEAD | {
    "ball": {"J": (exact,) * 3, "D": exact, "height": exact, "level": exact}, "radius": exact,
    "axes": (range(1, 4),) * 3, "steps": STEPS, "half_turns": STEPS, "digits": DIGITS, "orbits": (ORBIT, ORBIT),
    "branch?": {"arcs": range(2, MOST_ARCS + 1), "u": (exact,) * 3},
}  # fmt: skip
#: t = tan ½φ at the points with γ_a = 0 and with γ_b = 0, the other component positive.
ZEROS = {"a": Fraction(1), "b": Fraction(0)}


def statement(data: Data) -> str:
    """The theorem, with the numbers of the file."""
    ball, axes = data["ball"], data["axes"]
    branch = ""
    if "branch" in data:
        branch = f" for the roots that continue u = ({', '.join(data['branch']['u'])}) at γ_{axes[1]} = 0 < γ_{axes[0]}"
    return (
        f"For every ball with J = ({', '.join(ball['J'])}), D = {ball['D']} and momentum {ball['height']} γ{branch}: "
        f"on the circle ⟨γ, Λ⁻¹γ⟩ = {ball['level']}, γ_{axes[2]} > 0, every number within {data['radius']}, some "
        f"points are back after {data['steps']} steps and {data['half_turns']} half turn"
        f"{'s' * (data['half_turns'] != 1)}, others are not, and so the map leaves no finite measure invariant that is "
        f"positive on every arc."
    )


def check_form(data: Data) -> None:
    """Raises Rejected unless the file has all its numbers, in their form."""
    check_shape(data, FORM)
    if sorted(data["axes"]) != [1, 2, 3]:
        raise Rejected("axes must be 1, 2, 3 in some order")
    if "branch" in data:
        decimals(data["branch"]["u"], data["digits"], "u of branch")
    for given in data["orbits"]:
        tangent(given["start"])


def branch_of(circle: Circle, data: Data) -> Branch | None:
    """The branch of the file, proved over the circle; None if the bound proves the small branch."""
    if "branch" in data:
        return Branch.proved(circle, data["branch"], data["digits"])
    check_small_branch(circle.ball, circle.height.sign * circle.height)
    return None


def orbit(circle: Circle, branch: Branch | None, start: Vector, steps: list[Data], digits: int) -> list[Vector]:
    """γ after 0, 1, … steps; raises Rejected unless the Gibbs vectors and γ of the file are these, rounded."""
    gammas = [start]
    for number, given in enumerate(steps, 1):
        where = f"step {number}"
        near = decimals(given["u"], digits, f"u of {where}")
        u = gibbs_vector(circle.ball, circle.state(gammas[-1]), [circle.number(x).point() for x in near])
        if branch is not None:
            branch.check_on(gammas[-1], u, where)
        gammas.append(turned(u, gammas[-1]))
        check_rounded(u, near, digits, f"u of {where}")
        check_rounded(gammas[-1], decimals(given["gamma"], digits, f"gamma of {where}"), digits, f"gamma of {where}")
    return gammas


def tangent(start: object) -> Fraction:
    """t = tan ½φ of a start: "a" for γ_a = 0, "b" for γ_b = 0, or a rational number."""
    if isinstance(start, str) and start in ZEROS:
        return ZEROS[start]
    t = exact(start, "the start of an orbit must be a or b, or it")
    if not -1 < t < 1 or t == 0:
        raise Rejected("the start of an orbit must be a, b or a number between -1 and 1, not 0, which is b")
    return t


def half_turns(sines: list[Interval]) -> int:
    """The number of multiples of π that an angle passes; it grows by less than π a step; `sines`: after each step."""
    signs = [1, *(x.sign for x in sines)]
    if 0 in signs:
        raise Rejected("it is not decided on which side of the line of the start an orbit is")
    return sum(before != after for before, after in pairwise(signs))


def check(data: Data) -> dict[str, str]:
    """Raises Rejected unless the two orbits prove the statement; returns the displacements and the number of steps."""
    digits, q = data["digits"], data["steps"]
    turns = count(data["half_turns"], 1, q, "half_turns")
    for given in data["orbits"]:
        sized(given["steps"], q, "the steps of an orbit")
    if len(data["ball"]["level"].partition(".")[2]) > digits:
        raise Rejected("the level has more decimals than the numbers that depend on it")
    circle = Circle(data)
    branch, found = branch_of(circle, data), set()
    for given in data["orbits"]:
        start = circle.start(tangent(given["start"]))
        gammas = orbit(circle, branch, start, given["steps"], digits)
        direction = circle.direction(gammas)
        sines = [direction * circle.sine(start, w) for w in gammas[1:]]
        displacement = sines[-1] * (-1) ** turns
        check_rounded([displacement], [decimal(given["displacement"], digits, "displacement")], digits, "displacement")
        if half_turns(sines) not in (turns, turns - 1):  # the sign of the displacement selects one
            raise Rejected(f"the {q} steps of an orbit do not turn by about {turns} half turns")
        found.add((direction, displacement.sign))
    if found not in ({(1, 1), (1, -1)}, {(-1, 1), (-1, -1)}):
        raise Rejected("the two orbits do not turn in one direction with displacements of opposite signs")
    return {"displacements": " and ".join(x["displacement"] for x in data["orbits"]), "steps": str(q)}
