"""Second, independent proofs of the claims on which the others depend, each from the definitions of the paper.

Every constraint is solved by rational functions of free parameters: so no ideal is needed, and every identity is one
between rational functions.  A rotation is the Cayley transform of a free skew matrix (all rotations but those by π), a
unit vector a point of the stereographic plane, and for a vertical momentum the equations are solved for the ball.
Nothing is imported from chapsym.derive.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from chapsym.prove import Identity
from chapsym.prove.polynomials import Ratio, parameters

Array = np.ndarray  # a vector or a matrix of Ratio


def identity(text: str, left: Any, right: Any) -> Identity:
    """The equality of numbers, vectors or matrices, entry by entry."""
    return Identity(text, list(np.ravel(left)), list(np.ravel(right)))


def mutated(text: str, statement: Identity) -> Identity:
    """A statement with another text, for a control."""
    return replace(statement, text=f"in free parameters, {text}")


def array(entries: Any) -> Array:
    """A vector or a matrix with exact entries."""
    return np.array(entries, dtype=object)


def unit(n: int) -> Array:
    """The unit matrix."""
    return np.eye(n, dtype=int).astype(object)


def skew(above: Sequence[Ratio | int], n: int) -> Array:
    """The skew matrix with the given entries above the diagonal, row by row."""
    matrix, places = unit(n) * 0, np.triu_indices(n, 1)
    matrix[places] = above[: len(places[0])]
    return matrix - matrix.T


def hat(v: Array | Sequence[Ratio | int]) -> Array:
    """The matrix of x ↦ v × x."""
    return skew([-v[2], v[1], -v[0]], 3)


def axial(matrix: Array) -> Array:
    """The vector (A₃₂, A₁₃, A₂₁) of a matrix A, as in Section 5."""
    return array([matrix[2, 1], matrix[0, 2], matrix[1, 0]])


def determinant(matrix: Array) -> Ratio:
    """The determinant, by expansion along the first row."""
    if len(matrix) == 1:
        return matrix[0, 0]
    return sum((-1) ** j * matrix[0, j] * determinant(minor(matrix, 0, j)) for j in range(len(matrix)))


def minor(matrix: Array, i: int, j: int) -> Array:
    """The matrix without row i and column j."""
    return np.delete(np.delete(matrix, i, 0), j, 1)


def inverse(matrix: Array) -> Array:
    """The inverse matrix, by Cramer's rule."""
    n, whole = len(matrix), determinant(matrix)
    return array([[(-1) ** (i + j) * determinant(minor(matrix, j, i)) / whole for j in range(n)] for i in range(n)])


def cayley(generator: Array) -> Array:
    """(1 - A)⁻¹(1 + A), a rotation if A is skew."""
    one = unit(len(generator))
    return inverse(one - generator) @ (one + generator)


def sphere(a: Ratio, b: Ratio) -> Array:
    """A unit vector in stereographic coordinates: any but (0, 0, -1)."""
    below = 1 + a**2 + b**2
    return array([2 * a / below, 2 * b / below, (1 - a**2 - b**2) / below])


# Section 4: the momentum about the contact point


def momentum(turn: Array, J: Array, vertical: Array, D: Ratio, last: int = 1) -> Array:
    """𝒦 by the first form of (4.13); `last` mutates the factor of its last term."""
    contact = np.outer(vertical, vertical)
    shifted = J + D / 2 * contact
    return turn @ shifted - shifted @ turn.T + last * D / 2 * (contact @ turn - turn.T @ contact)


def momentum_by_centre(turn: Array, J: Array, vertical: Array, D: Ratio) -> Array:
    """𝒦 by the second form of (4.13)."""
    contact = np.outer(vertical, vertical)
    rolling = turn @ contact - contact @ turn.T + (contact @ turn - turn.T @ contact)
    return turn @ J - J @ turn.T + D / 2 * rolling


def centre_step(before: Array, after: Array, vertical: Array, rho: Ratio, naive: bool = False) -> Array:
    """Δr by the discrete constraint (4.9), or by the naive constraint that the paper rejects."""
    turn = after @ before.T
    return -rho * (turn @ vertical - vertical) if naive else -rho / 2 * (turn - turn.T) @ vertical


def momentum_in_space(
    before: Array, after: Array, J: Array, vertical: Array, mass: Any, rho: Ratio, naive: bool = False
) -> Array:
    """m - ρ(pγᵀ - γpᵀ) of one step between two attitudes, with m by (4.3), p = mΔr and Δr by (4.9)."""
    impulse = mass * centre_step(before, after, vertical, rho, naive)
    rolling = np.outer(impulse, vertical) - np.outer(vertical, impulse)
    return after @ J @ before.T - before @ J @ after.T - rho * rolling


def action(R: list[Array], r: list[Array], J: Array, mass: Ratio) -> Array:
    """𝕃(k-1, k) and 𝕃(k, k+1) with 𝕃 by (4.1) as corrected."""
    return array(
        [
            mass * (y - x) @ (y - x) / 2 - np.trace(before @ J @ after.T)
            for (before, after), (x, y) in zip(pairwise(R), pairwise(r), strict=True)
        ]
    )


def principle(n: int) -> Identity:
    """The principle of Section 3 for every virtual rotation; the attitudes are any matrices, rotations or not."""
    names = [f"{kind}{i}{j}" for kind in "pqr" for i in range(n) for j in range(n)]
    names += [f"x{i}" for i in range(n * (n - 1) // 2)] + [f"{kind}{i}" for kind in "gJ" for i in range(n)]
    free = parameters(" ".join([*names, "mass", "rho", "e"]))
    R = [array(free[i * n * n : (i + 1) * n * n]).reshape(n, n) for i in range(3)]
    virtual, vertical, J = (
        skew(free[3 * n * n :], n),
        array(free[-3 - 2 * n : -3 - n]),
        np.diag(array(free[-3 - n : -3])),
    )
    mass, rho, e = free[-3:]
    steps = [centre_step(before, after, vertical, rho) for before, after in pairwise(R)]
    r = [0 * steps[0], steps[0], steps[0] + steps[1]]

    def displaced(size: Ratio) -> Array:
        """The action after a rotation ξ of R_k, with δr = -ρξγ by the constraint (4.2)."""
        there = [R[0], R[1] + size * virtual @ R[1], R[2]]
        return action(there, [r[0], r[1] - size * rho * virtual @ vertical, r[2]], J, mass)

    work = sum((displaced(e) - displaced(-e)) / (2 * e))
    earlier, later = (momentum_in_space(*pair, J, vertical, mass, rho) for pair in pairwise(R))
    text = f"n = {n}: the work along every virtual turn ξ is ½ tr(ξ·balance), the balance the change of m - ρmΔr∧γ"
    return identity(text, work, np.trace(virtual @ (later - earlier)) / 2)


def conservation(n: int, any_axes: bool, last: int = 1, naive: bool = False) -> list[Identity]:
    """Proposition 1 from the principle of Section 3; the space axes are arbitrary, or the body axes at time k."""
    count = n * (n - 1) // 2
    names = [f"{kind}{i}" for kind in "ap" for i in range(count)] + [f"{kind}{i}" for kind in "gJ" for i in range(n)]
    free = parameters(" ".join([*names, "mass", "rho"]))
    vertical, J = array(free[2 * count : 2 * count + n]), np.diag(array(free[2 * count + n : 2 * count + 2 * n]))
    turn, (mass, rho) = cayley(skew(free[:count], n)), free[-2:]
    now = cayley(skew(free[count : 2 * count], n)) if any_axes else unit(n)
    D = mass * rho**2

    def in_space(before: Array, after: Array) -> Array:
        return now.T @ momentum_in_space(before, after, J, vertical, mass, rho, naive) @ now

    earlier, gamma = now @ turn.T, now.T @ vertical
    before, after = (momentum(turn, J, attitude.T @ vertical, D, last) for attitude in (earlier, now))
    outer = [np.outer(attitude.T @ vertical, attitude.T @ vertical) for attitude in (earlier, now)]
    return [
        identity(f"n = {n}: R_kᵀ·(its part of the step k)·R_k = 𝒦_k", in_space(now, now @ turn), after),
        identity(f"n = {n}: R_kᵀ·(that of the step k-1)·R_k = Ωᵀ𝒦_(k-1)Ω", in_space(earlier, now), turn.T @ before @ turn),
        identity(f"n = {n}: the two forms of (4.13) agree", after, momentum_by_centre(turn, J, gamma, D)),
        identity(f"n = {n}: Γ_k = ΩᵀΓ_(k-1)Ω", outer[1], turn.T @ outer[0] @ turn),
    ]  # fmt: skip


def free_step(n: int) -> tuple[Array, Array, Array, Ratio]:
    """A rotation, a vertical of any length, a diagonal J, and D, all free."""
    count = n * (n - 1) // 2
    names = [f"a{i}" for i in range(count)] + [f"{kind}{i}" for kind in ("g", "J") for i in range(n)]
    *free, D = parameters(" ".join([*names, "D"]))
    return cayley(skew(free[:count], n)), array(free[count : count + n]), np.diag(array(free[count + n :])), D


def intertwining(n: int, sign: int = 1, swapped: bool = False) -> list[Identity]:
    """Remark 3; `sign` is that of Γ_k in the mean, and `swapped` exchanges the two momenta."""
    turn, vertical, J, D = free_step(n)
    before = momentum(turn, J, vertical, D)
    pair = [before, turn.T @ before @ turn]
    following = turn.T @ vertical
    mean = J + D / 2 * (np.outer(vertical, vertical) + sign * np.outer(following, following))
    relations = [turn @ mean - mean @ turn.T, mean @ turn - turn.T @ mean]
    return [
        identity(f"n = {n}: the relation for 𝒦_{time}", left, right)
        for time, left, right in zip(("(k-1)", "k"), pair[:: -1 if swapped else 1], relations, strict=True)
    ]


# Section 5: three dimensions


def vector_momentum(sign: int = 1, factor: int = 2, centre: int = 1) -> list[Identity]:
    """(5.2) from (4.13), with q₀² = 1/(1 + |u|²), q = q₀u and |γ| = 1; the arguments mutate what is printed."""
    u1, u2, u3, a, b, J1, J2, J3, D = parameters("u1 u2 u3 a b J1 J2 J3 D")
    turn, gamma, J, u = cayley(hat((u1, u2, u3))), sphere(a, b), np.diag([J1, J2, J3]), array((u1, u2, u3))
    square = 1 / (1 + u @ u)  # q₀²; forms of degree 2 in (q₀, q) are q₀² times their values at (1, u)
    printed_centre = 2 * array([
        (J2 + J3) * u1 + centre * (J2 - J3) * u2 * u3,
        (J1 + J3) * u2 + centre * (J3 - J1) * u1 * u3,
        (J1 + J2) * u3 + centre * (J1 - J2) * u1 * u2,
    ])  # fmt: skip
    printed = printed_centre + factor * D * (u - sign * (gamma @ u) * gamma)
    return [
        identity("Ω - Ωᵀ = 4q₀ q×: the Euler parameters of the turn", turn - turn.T, 4 * square * hat(u)),
        identity("tr Ω = 4q₀² - 1", np.trace(turn), 4 * square - 1),
        identity("M⃗ as printed", axial(turn @ J - J @ turn.T), square * printed_centre),
        identity("𝒦⃗ as printed, by the first form of (4.13)", axial(momentum(turn, J, gamma, D)), square * printed),
        identity("𝒦⃗ as printed, by the second form", axial(momentum_by_centre(turn, J, gamma, D)), square * printed),
    ]


@dataclass(frozen=True)
class VerticalStep:
    """A rotation with u = q/q₀, γ, D, h, and the ball with u = (ϰ/4)Λ⁻¹s, s = γ + γ~, γ~ = Ωᵀγ."""

    u: Array
    gamma: Array
    kappa: Ratio
    D: Ratio
    h: Any

    @cached_property
    def turn(self) -> Array:
        """Ω."""
        return cayley(hat(self.u))

    @cached_property
    def following(self) -> Array:
        """γ~."""
        return self.turn.T @ self.gamma

    @property
    def sum(self) -> Array:
        """s."""
        return self.gamma + self.following

    @property
    def inverse_of_sum(self) -> Array:
        """Λ⁻¹s."""
        return 4 * self.u / self.kappa

    @property
    def lam(self) -> Array:
        """Λ."""
        return self.sum / self.inverse_of_sum

    @property
    def J(self) -> Array:
        """J, from Λ = diag(J₂ + J₃ + D, ...)."""
        return (sum(self.lam) - self.D) / 2 - self.lam

    @property
    def cosine(self) -> Ratio:
        """cos θ of the rotation."""
        return (np.trace(self.turn) - 1) / 2

    def sigma(self, part: int = 4) -> Ratio:
        """σ of (5.11) as corrected; `part` is 8 as printed."""
        return self.h / (1 - self.D / part * (self.sum @ self.inverse_of_sum))

    @property
    def second(self) -> Ratio:
        """⟨s, Λ⁻²s⟩."""
        return self.inverse_of_sum @ self.inverse_of_sum

    def is_vertical(self) -> Identity:
        """𝒦 = hγ with 𝒦 by the second form of (4.13), |γ| = 1."""
        whole = axial(momentum_by_centre(self.turn, np.diag(self.J), self.gamma, self.D))
        return identity("𝒦 = hγ and |γ| = 1", [*whole, self.gamma @ self.gamma], [*(self.h * self.gamma), 1])

    def of_no_other_ball(self) -> Identity:
        """𝒦 = hγ, with 𝒦 by the first form of (4.13), is linear in J: solved by Cramer's rule."""
        rolling = axial(momentum(self.turn, 0 * self.turn, self.gamma, self.D))
        spinning = array([axial(momentum(self.turn, np.diag(row), self.gamma, 0 * self.D)) for row in unit(3)]).T
        return identity("no other J has 𝒦 = hγ", inverse(spinning) @ (self.h * self.gamma - rolling), self.J)


def vertical_step(unit_height: bool = False) -> VerticalStep:
    """A step with free Ω, |γ| = 1, D and h, and the unique ball with 𝒦 = hγ (`of_no_other_ball`).

    This reaches all states with q₀q₁q₂q₃ ≠ 0, which are dense among those with σ ≠ 0.
    """
    *u, a, b, D, height = parameters("u1 u2 u3 a b D h")
    h = 1 if unit_height else height
    gibbs, gamma = array(u), sphere(a, b)
    kappa = h * (1 + gibbs @ gibbs) + 2 * D * (gamma @ gibbs)  # σ/q₀²
    return VerticalStep(gibbs, gamma, kappa, D, h)


def quadratic_integral(power: int = -1, backwards: bool = False) -> list[Identity]:
    """Proposition 3; the arguments mutate the power of Λ and the transport of γ."""
    step = vertical_step()
    change, of_sum = step.following - step.gamma, step.inverse_of_sum
    if backwards or power != -1:
        following = step.turn @ step.gamma if backwards else step.following
        change, of_sum = following - step.gamma, step.lam**power * (following + step.gamma)
    text = f"⟨γ~ - γ, Λ^{power}(γ~ + γ)⟩ = 0: ⟨γ, Λ^{power} γ⟩ is the same for γ and γ~"
    return [step.is_vertical(), step.of_no_other_ball(), identity(text, change @ of_sum, 0)]


def symmetric_form(part: int = 4, under_root: int = 2, factor: int = 4) -> list[Identity]:
    """Proposition 4 as corrected; printed are part 8 (in σ) and under_root 0 (the power of σ under the root)."""
    step = vertical_step()
    sigma = step.sigma(part)
    root = 1 - sigma**under_root / 4 * step.second
    kappa = 2 * sigma / (1 + step.cosine)
    inner = (step.gamma @ step.u) / (1 + step.u @ step.u)  # q₀⟨γ, q⟩
    return [
        step.is_vertical(),
        step.of_no_other_ball(),
        identity("σ = h + 2D q₀⟨γ, q⟩ is h/(1 - (D/4)⟨s, Λ⁻¹s⟩)", step.h + 2 * step.D * inner, sigma),
        identity("cos²θ = 1 - (σ²/4)⟨s, Λ⁻²s⟩", step.cosine**2, root),
        identity("γ~ - γ = (ϰ/4)s×Λ⁻¹s with ϰ = 2σ/(1 + cos θ)", step.following - step.gamma,
                 kappa / factor * np.cross(step.sum, step.inverse_of_sum)),
    ]  # fmt: skip


def turn_of_a_pair() -> Identity:
    """4(γ~ - γ) = ϰ s×Λ⁻¹s is γ~ - γ = s×u with u = (ϰ/4)Λ⁻¹s, for any s and u."""
    free = parameters("s1 s2 s3 u1 u2 u3")
    s, u = array(free[:3]), array(free[3:])
    d = np.cross(s, u)
    return identity("u = (ϰ/4)Λ⁻¹s turns γ into γ~: γ~ = Ωᵀγ", (s + d) / 2, cayley(hat(u)).T @ ((s - d) / 2))


def steps_of_the_symmetric_form(part: int = 4) -> list[Identity]:
    """The converse: γ, γ~ with (5.10), σ and ϰ as corrected are one step; `part` mutates σ.

    Two unit vectors with ⟨γ, Λ⁻¹γ⟩ = ⟨γ~, Λ⁻¹γ~⟩ have a ϰ by (5.10), and u = (ϰ/4)Λ⁻¹s turns one into the other: so
    γ, u, ϰ and D are free, and Λ⁻¹s = (4/ϰ)u.  (2σ/ϰ - 1)² = 1 - (σ²/4)⟨s, Λ⁻²s⟩ is linear in σ; q₀² = σ/ϰ.
    """
    *u, a, b, kappa, D = parameters("u1 u2 u3 a b kappa D")
    step = VerticalStep(array(u), sphere(a, b), kappa, D, 0)
    sigma = (4 / kappa) / (4 / kappa**2 + step.second / 4)
    step = replace(step, h=sigma * (1 - D / part * (step.sum @ step.inverse_of_sum)))
    return [
        has_kappa(*pair_on_a_curve()[:3])[0],
        turn_of_a_pair(),
        identity("(2σ/ϰ - 1)² = 1 - (σ²/4)⟨s, Λ⁻²s⟩", (2 * sigma / kappa - 1) ** 2, 1 - sigma**2 / 4 * step.second),
        identity("2σ/ϰ - 1 is the cos θ of the turn", 2 * sigma / kappa - 1, step.cosine),
        step.is_vertical(),
    ]


class Lowest:
    """A reducer of numbers and vectors to lowest terms; it records each equality with the original as an identity."""

    def __init__(self) -> None:
        self.identities: list[Identity] = []

    def __call__(self, text: str, value: Any) -> Any:
        """A number or a vector, reduced to lowest terms."""
        lowest = np.vectorize(lambda x: x.lowest() if isinstance(x, Ratio) else x, otypes=[object])(array(value))
        self.identities.append(identity(f"{text} in lowest terms", value, lowest))
        return lowest if lowest.shape else lowest.item()


@dataclass(frozen=True)
class Parts:
    """The parts of (5.15): sn²δu, 𝒟, V w(δu), G and l - μ sn²δu."""

    y: Ratio
    scale: Ratio
    vw: Ratio
    G: Ratio
    level: Ratio

    def relation(self, D: Ratio, sign: int = 1) -> Ratio:
        """T = G𝒟 - 2Vw(𝒟 - D(l - μ sn²δu)): (5.15) as corrected is T = 0; `sign` mutates V."""
        return self.G * self.scale - 2 * sign * self.vw * (self.scale - D * self.level)


class Curve(NamedTuple):
    """l, C1², C2², C3² of (5.8) as corrected, k², the coefficients of 1/Λ1², 1/Λ2², 1/Λ3² in G, and the parts."""

    level: Ratio
    squares: Array
    modulus: Ratio
    coefficients: Array
    parts: Parts


def curve(gamma: Array, following: Array, inverse: Array, lowest: Lowest) -> Curve:
    """The parts of (5.15) for two points γ(u), γ(ũ) of a curve and 1/Λ, in which they are rational.

    By the addition theorem for ũ ± u.  Each part is reduced to lowest terms.
    """
    (L1, L2, L3), (g1, g2, g3), (h1, h2, h3) = 1 / inverse, gamma, following
    l = lowest("l", gamma @ (gamma * inverse))
    k2 = lowest("k²", (L1 - L2) * (1 - L3 * l) / ((L2 - L3) * (L1 * l - 1)))
    a, b, c = squares = lowest(
        "C1², C2², C3²", [L1 * (1 - L3 * l) / (L1 - L3), L2 * (1 - L3 * l) / (L2 - L3), L3 * (L1 * l - 1) / (L1 - L3)]
    )
    over = lowest("1/C1², 1/C2², 1/C3²", 1 / squares)
    above = lowest("1/(1 - k² sn²u sn²ũ)", 1 / (1 - k2 * (g2 * h2 * over[1]) ** 2))
    y = half_square(-1, gamma * following, k2, over, above, lowest)
    # V = -(C2 C3/C1)(Λ2-Λ3)/(Λ2Λ3); 2w = sn(ũ-u)(1 - k²y²); C1 C2 C3 sn(ũ-u) is rational in γ, γ~.
    sine = lowest("C1 C2 C3 sn(ũ - u)", (h2 * g1 * g3 - g2 * h1 * h3) * above)
    scale = lowest("𝒟", 1 - k2 * half_square(+1, gamma * following, k2, over, above, lowest) * y)
    vw = lowest("Vw(δu)", -(L2 - L3) / (L2 * L3) * sine * over[0] * (1 - k2 * y**2) / 2)
    in_g = [a / k2 * (1 - y), -b / k2 * (1 - y) * (1 - k2 * y), c * (1 - k2 * y)]
    coefficients = lowest("the coefficients of Λ⁻² in G", in_g)
    level = lowest("l - μ sn²δu", l - (1 - L3 * l) / (L2 - L3) * y)
    return Curve(l, squares, k2, coefficients, Parts(y, scale, vw, coefficients @ inverse**2, level))


def half_square(sign: int, products: Array, k2: Ratio, over: Array, above: Ratio, lowest: Lowest) -> Ratio:
    """sn² of (ũ + sign·u)/2, by sn²(x/2) = (1 - cn x)/(1 + dn x); above: 1/(1 - k² sn²u sn²ũ)."""
    (a, b, c), (x, y, z) = over, products
    name = f"(ũ {'+' if sign > 0 else '-'} u)"
    cn = lowest(f"cn{name}", (x * a - sign * y * z * b * c) * above)
    dn = lowest(f"dn{name}", (z * c - sign * k2 * x * y * a * b) * above)
    return lowest(f"sn²(½{name})", (1 - cn) / (1 + dn))


def pair_on_a_curve() -> tuple[Array, Array, Array, Lowest]:
    """Unit vectors γ, γ~ and 1/Λ with ⟨γ, Λ⁻¹γ⟩ = ⟨γ~, Λ⁻¹γ~⟩, solved for Λ1; γ, γ~, Λ2, Λ3 are free.

    Every such triple with finite Λ and γ~₁² ≠ γ₁² is reached, except those with a vector (0, 0, -1).
    """
    a, b, c, d, m2, m3, _ = parameters("a b c d m2 m3 D")  # m2 and m3 are 1/Λ2 and 1/Λ3
    gamma, following, lowest = sphere(a, b), sphere(c, d), Lowest()
    rise = following**2 - gamma**2
    lam = 1 / array([-(rise[1] * m2 + rise[2] * m3) / rise[0], m2, m3])
    return gamma, following, lowest("1/Λ1, 1/Λ2, 1/Λ3", 1 / lam), lowest


def has_kappa(gamma: Array, following: Array, inverse: Array) -> tuple[Identity, Ratio]:
    """The identity (5.10) for two points of a curve, and its ϰ."""
    s, d = gamma + following, following - gamma
    product = np.cross(s, s * inverse)
    kappa = 4 * d[0] / product[0]
    return identity("(5.10) defines ϰ: its three components agree", 4 * d, kappa * product), kappa


def increment() -> list[Identity]:
    """(5.15) as corrected, h = 1, for every two points of a curve."""
    gamma, following, inverse, lowest = pair_on_a_curve()
    l, squares, k2, coefficients, parts = curve(gamma, following, inverse, lowest)
    defines, kappa = has_kappa(gamma, following, inverse)
    on_curve = [
        entry
        for x in (gamma, following)
        for entry in (x[0] ** 2 / squares[0] + x[1] ** 2 / squares[1],
                      x[2] ** 2 / squares[2] + k2 * x[1] ** 2 / squares[1])
    ]  # fmt: skip
    s, (L1, L2, L3) = gamma + following, 1 / inverse
    printed_v = lowest("V² as printed", (L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3))
    rest = lowest(
        "the coefficients of Λ⁻² in Π2 𝒟² sn² - G𝒟", s**2 / 4 * parts.scale**2 * parts.y - parts.scale * coefficients
    )
    return [
        *lowest.identities,
        identity("γ and γ~ are (C1 cn, C2 sn, C3 dn) of one curve", on_curve, [1] * 4),
        defines,
        identity("2𝒟 sn²δu = ϰVw (5.13-V)", 2 * parts.scale * parts.y, kappa * parts.vw),
        identity("(Vw)² = V² sn² cn² dn²", parts.vw**2, printed_v * parts.y * (1 - parts.y) * (1 - k2 * parts.y)),
        identity("Π1 = (l - μ sn²)/𝒟", s @ (s * inverse) / 4, parts.level / parts.scale),
        identity("Π2 𝒟² sn² = G𝒟 - (Vw)²/sn²", rest @ inverse**2, -(parts.vw**2) / parts.y),
        relation_for_the_increment(),
    ]


def relation_for_the_increment(contact: int = 1, sign: int = 1) -> Identity:
    """The identity between T and σ = 1/(1 - DΠ1), ϰ, Π1, Π2 by these parts; the arguments mutate D and V in T."""
    y, scale, vw, G, level, D = parameters("y Dscr Vw G lam D")
    parts = Parts(y, scale, vw, G, level)
    sigma, kappa, second = 1 / (1 - D * level / scale), 2 * scale * y / vw, (G * scale - vw**2 / y) / (scale**2 * y)
    return identity(
        "(2σ/ϰ-1)² - (1-σ²Π2) = T·σ²/(𝒟² sn²δu)",
        (2 * sigma / kappa - 1) ** 2 - (1 - sigma**2 * second),
        parts.relation(contact * D, sign) * sigma**2 / (scale**2 * y),
    )


def increment_of_the_map(part: int = 4) -> list[Identity]:
    """T = 0 at every step of the map with vertical momentum and h = 1, from (4.13); `part` mutates σ."""
    step = vertical_step(unit_height=True)
    sigma = step.sigma(part)
    square = (2 * sigma / step.kappa - 1) ** 2
    return [
        step.is_vertical(),
        step.of_no_other_ball(),
        identity("(2σ/ϰ-1)² = 1-σ²Π2 at every step with 𝒦 = γ", square, 1 - sigma**2 * step.second / 4),
    ]
