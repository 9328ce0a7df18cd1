"""What a closed orbit of the continuous ball proves of the energy: the integrals over it of X₃(H) and div_μ X₃.

The certificate gives a ball (J, D), a start (𝒦, γ) of which one component of the momentum is known up to a radius, a
time and a symmetry S = diag(±1, ±1, ±1), det S = 1.  Balls that contain the solutions prove, with y = S·(solution):

1. From every such start, y returns once within the window of times to the section, where one component has its value
   at the start; transversally, so the return moves continuously with the start.
2. At the two ends of the starts another component, `along`, has returned below and above its value at the start: for
   some start between, both components are back.
3. |γ|, |K|, ⟨K,γ⟩ and the energy are the same after the return.  With the two components they determine the state in a
   box about it: in the box the 6 × 6 matrix of their derivatives, each row at points of its own, is not singular.
   So this start has returned: S·(solution at T) = start, and the orbit is closed after T or 2T.
4. The integrals over [0, T] of X₃(H) and of div_μ X₃, from any of the starts, are in balls without 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat, ctx

from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.balls import exact
from chapsym.generated import angular_velocity, energy, energy_rate, modified_load, modified_rotation, torque

from .balls import cross, dot
from .duals import derivative
from .taylor import LONGEST, Flow, NotEnclosed, Piece

State = list[Any]

#: The components of the state.
NAMES = ("K1", "K2", "K3", "gamma1", "gamma2", "gamma3")


@dataclass(frozen=True)
class Orbit:
    """A closed orbit of the continuous ball, up to a radius.

    J, D: the ball, exact.  momentum, gamma: the start, K = 𝒦/ε, |γ| = 1.  varied: the component of the momentum, 0
    to 2, that is known up to `radius`.  signs: the diagonal of S.  time, window: T, and how far from it the return may
    be.  section, along: the components of the state, 0 to 5, by which the return is judged.
    """

    J: tuple[Fraction, ...]
    D: Fraction
    momentum: tuple[Fraction, ...]
    gamma: tuple[Fraction, ...]
    varied: int
    radius: Fraction
    signs: tuple[int, ...]
    time: Fraction
    window: Fraction
    section: int
    along: int

    def __post_init__(self) -> None:
        if sum(x * x for x in self.gamma) != 1:
            raise BadInput(f"gamma must be a unit vector of rationals, such as 2/7,3/7,6/7, not {listed(self.gamma)}")
        if min(self.J) < 0 or sorted(self.J)[1] <= 0 or self.D < 0:
            raise BadInput(f"J = {listed(self.J)}, D = {self.D} is no ball")
        if self.varied not in range(3) or min(self.radius, self.window, self.time) < 0:
            raise BadInput(
                "a component of the momentum is varied; the radius, the window and the time are not negative"
            )
        if tuple(self.signs) not in SYMMETRIES:
            raise BadInput(f"the signs must be one of {', '.join(map(listed, SYMMETRIES))}, not {listed(self.signs)}")

    def start(self, shift: Any) -> State:
        """The state at the start, the varied component moved by `shift` radii."""
        state = [exact(x) for x in (*self.momentum, *self.gamma)]
        state[self.varied] += exact(self.radius) * shift
        return state

    @property
    def size(self) -> Fraction:
        """The size of the momentum."""
        return max(map(abs, self.momentum))


SYMMETRIES = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))


@dataclass(frozen=True)
class Enclosures:
    """What is proved: balls for the misses at the two ends, and for the integrals over [0, T] from any start."""

    misses: tuple[Any, Any]
    energy: Any
    density: Any


def flow_of(J: Sequence[Fraction], D: Fraction, order: int, size: Fraction) -> Flow:
    """The continuous ball in (K, γ), |K| about `size`, and the densities X₃(H) and div_μ X₃."""
    tensor, contact = [exact(x) for x in J], exact(D)
    whole = [1 / (sum(tensor, contact) - x) for x in tensor]  # 1/Λ

    def field(state: Sequence[Any]) -> State:
        K, g = state[:3], state[3:]
        w = angular_velocity(*(*K, *g, *tensor, contact))
        return [*cross(K, w), *cross(g, w)]

    def turning(state: Sequence[Any]) -> tuple[Any, ...]:
        """12ω₃."""
        K, g = state[:3], state[3:]
        w = angular_velocity(*(*K, *g, *tensor, contact))
        rate = angular_velocity(*(*torque(*w, *tensor), *g, *tensor, contact))
        load = modified_load(*(*w, *rate, *g, *tensor, contact))
        return modified_rotation(*w, *rate, *angular_velocity(*(*load, *g, *tensor, contact)))

    def densities(state: Sequence[Any]) -> State:
        K, g = state[:3], state[3:]
        w = angular_velocity(*(*K, *g, *tensor, contact))
        rate = angular_velocity(*(*torque(*w, *tensor), *g, *tensor, contact))
        turns = turning(state)
        weighted = [x * y for x, y in zip(g, whole, strict=True)]
        lift = contact * dot(weighted, cross(g, turns)) / (1 - contact * dot(weighted, g))
        for j in range(3):
            e = [int(i == j) for i in range(3)]
            lift = lift + derivative(turning, state, [*cross(K, e), *cross(g, e)])[j]
        return [energy_rate(*(*w, *rate, *g, contact)) / 4, lift / 12]

    return Flow(field, densities, order, [*[exact(size)] * 3, *[arb(1)] * 3])


def enclose(orbit: Orbit, bits: int, order: int) -> Enclosures:
    """Proves 1 to 4 in balls of so many bits, with series of so many terms.

    Raises NotEnclosed where the balls are too wide, or what is to be proved is not true.
    """
    with ctx.workprec(bits):
        flow = flow_of(orbit.J, orbit.D, order, orbit.size)
        bare = flow._replace(densities=lambda state: [])
        misses = [_return(orbit, bare, arb(end)) for end in (-1, 1)]
        below, above = (found[orbit.along] - start[orbit.along] for start, found in misses)
        if not below * above < 0:
            raise NotEnclosed("the return does not cross the start between the two ends, as far as the balls tell")
        start, found = _return(orbit, flow, arb(0, 1))
        _distinguish(orbit, start, found)
        if not (found[6] != 0 and found[7] != 0):
            raise NotEnclosed("an integral may be 0")
        return Enclosures((below, above), found[6], found[7])


def _return(orbit: Orbit, flow: Flow, shift: Any) -> tuple[State, State]:
    """The start, and the state S·(solution) with the integrals when it is back on the section, once in the window."""
    start = orbit.start(shift)
    end = flow.run(start, orbit.time)
    piece, *_ = flow.piece(end[:6], LONGEST, orbit.window)
    since = crossing(flow, piece, orbit, start)
    found = piece.at(since)
    mirrored = [s * x for s, x in zip((*orbit.signs, *orbit.signs), found[:6], strict=True)]
    return start, [*mirrored, *(x + y for x, y in zip(end[6:], found[6:], strict=True))]


def crossing(flow: Flow, piece: Piece, orbit: Orbit, start: State) -> Any:
    """The time in the window at which the component is back, by interval Newton steps: the first proves it."""
    sign, window = orbit.signs[orbit.section % 3], arb(0, exact(orbit.window))
    proved = False
    for _ in range(3):
        middle = arb(window.mid())
        missed = piece.at(middle)[orbit.section] * sign - start[orbit.section]
        newton = middle - missed / (flow.field(piece.at(window)[:6])[orbit.section] * sign)
        if not window.contains_interior(newton):
            break
        window, proved = newton, True
    if not proved:
        raise NotEnclosed(
            "the return to the section is not in the window, or not transversal, as far as the balls tell"
        )
    return window


def _distinguish(orbit: Orbit, start: State, found: State) -> None:
    """Proves that the integrals and the two components tell any two states of a box apart."""
    box = [x.union(y) for x, y in zip(start, found[:6], strict=True)]
    columns = told_apart(box, [exact(x) for x in orbit.J], exact(orbit.D), orbit.section, orbit.along)
    if not arb_mat(columns).det() != 0:
        raise NotEnclosed("the integrals and the two components do not tell states apart: choose other components")


def listed(values: Sequence[Any]) -> str:
    """(a, b, c)."""
    return f"({', '.join(map(str, values))})"


def told_apart(box: State, tensor: State, contact: Any, section: int, along: int) -> list[State]:
    """The derivatives of |γ|², |K|², ⟨K,γ⟩, the energy and two components on a box, column by column."""

    def told(state: Sequence[Any]) -> list[Any]:
        K, g = state[:3], state[3:]
        return [dot(g, g), dot(K, K), dot(K, g), energy(*(*state, *tensor, contact)), state[section], state[along]]

    return [derivative(told, box, [int(i == j) for i in range(6)]) for j in range(6)]
