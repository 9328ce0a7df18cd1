"""Second routes for the claims that carry the others, each from the paper's definitions afresh.

Every constraint is solved by rational functions of free parameters, so that no ideal is needed and an
identity is one between rational functions: a turn is the Cayley transform of a free skew matrix (all turns but
those by π), a unit vector a point of the stereographic plane, and for a vertical momentum the ball is
solved for.  Nothing here comes from chapsym.derive.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from chapsym.prove import Identity
from chapsym.prove.polynomials import Ratio, parameters

Array = np.ndarray  # of Ratio: a vector or a matrix


def identity(text: str, left: Any, right: Any, large: bool = False) -> Identity:
    """Equality of numbers, vectors or matrices, entry by entry; a large one has no certificate."""
    return Identity(text, list(np.ravel(left)), list(np.ravel(right)), large)


def mutated(text: str, statement: Identity) -> Identity:
    """A control under a name of its own."""
    return replace(statement, text=f"in free parameters, {text}")


def array(entries: Any) -> Array:
    """A vector or a matrix with exact entries."""
    return np.array(entries, dtype=object)


def unit(n: int) -> Array:
    """The unit matrix."""
    return np.eye(n, dtype=int).astype(object)


def skew(above: list[Ratio], n: int) -> Array:
    """The skew matrix with the given entries above the diagonal, row by row."""
    matrix, rest = unit(n) * 0, iter(above)
    for i in range(n):
        for j in range(i + 1, n):
            matrix[i, j] = next(rest)
            matrix[j, i] = -matrix[i, j]
    return matrix


def hat(v: Any) -> Array:
    """The matrix of x ↦ v × x."""
    return skew([-v[2], v[1], -v[0]], 3)


def axial(matrix: Array) -> Array:
    """(A₃₂, A₁₃, A₂₁), as in Section 5."""
    return array([matrix[2, 1], matrix[0, 2], matrix[1, 0]])


def determinant(matrix: Array) -> Any:
    """By cofactors of the first row."""
    if len(matrix) == 1:
        return matrix[0, 0]
    return sum((-1) ** j * matrix[0, j] * determinant(minor(matrix, 0, j)) for j in range(len(matrix)))


def minor(matrix: Array, i: int, j: int) -> Array:
    """Without the row i and the column j."""
    return np.delete(np.delete(matrix, i, 0), j, 1)


def inverse(matrix: Array) -> Array:
    """By Cramer's rule."""
    n, whole = len(matrix), determinant(matrix)
    return array([[(-1) ** (i + j) * determinant(minor(matrix, j, i)) / whole for j in range(n)] for i in range(n)])


def cayley(generator: Array) -> Array:
    """(1 - A)⁻¹(1 + A): a rotation when A is skew."""
    one = unit(len(generator))
    return inverse(one - generator) @ (one + generator)


def sphere(a: Ratio, b: Ratio) -> Array:
    """A unit vector: every one but (0, 0, -1)."""
    below = 1 + a**2 + b**2
    return array([2 * a / below, 2 * b / below, (1 - a**2 - b**2) / below])


# Section 4: the momentum about the contact point


def momentum(turn: Array, J: Array, vertical: Array, D: Any, last: int = 1) -> Array:
    """𝒦 by the first form of (4.13); `last` mutates the factor of its last term."""
    contact = np.outer(vertical, vertical)
    shifted = J + D / 2 * contact
    return turn @ shifted - shifted @ turn.T + last * D / 2 * (contact @ turn - turn.T @ contact)


def momentum_by_centre(turn: Array, J: Array, vertical: Array, D: Any) -> Array:
    """𝒦 by the second form of (4.13)."""
    contact = np.outer(vertical, vertical)
    rolling = turn @ contact - contact @ turn.T + (contact @ turn - turn.T @ contact)
    return turn @ J - J @ turn.T + D / 2 * rolling


def centre_step(before: Array, after: Array, vertical: Array, rho: Any, naive: bool = False) -> Array:
    """Δr by the discrete constraint (4.9), or by the naive one before it."""
    turn = after @ before.T
    return -rho * (turn @ vertical - vertical) if naive else -rho / 2 * (turn - turn.T) @ vertical


def balance_in_space(
    R: list[Array], J: Array, vertical: Array, mass: Any, rho: Any, naive: bool = False
) -> tuple[Array, list[Array]]:
    """m_k - m_{k-1} - ρ(fγᵀ - γfᵀ) for three attitudes, f by (4.4) and (4.9); and the two steps Δr."""
    spins = [after @ J @ before.T - before @ J @ after.T for before, after in pairwise(R)]
    steps = [centre_step(before, after, vertical, rho, naive) for before, after in pairwise(R)]
    force = mass * steps[1] - mass * steps[0]
    return spins[1] - spins[0] - rho * (np.outer(force, vertical) - np.outer(vertical, force)), steps


def action(R: list[Array], r: list[Array], J: Array, mass: Any) -> Array:
    """𝕃(k-1, k) and 𝕃(k, k+1) with 𝕃 by (4.1) as corrected."""
    return array(
        [
            mass * (y - x) @ (y - x) / 2 - np.trace(before @ J @ after.T)
            for (before, after), (x, y) in zip(pairwise(R), pairwise(r), strict=True)
        ]
    )


def conservation(n: int, any_axes: bool, last: int = 1, naive: bool = False) -> list[Identity]:
    """Proposition 1 from the principle of Section 3; the axes of space are any, or those of the body at the time k."""
    count = n * (n - 1) // 2
    names = [f"{kind}{i}" for kind in ("a", "b", "p", "x") for i in range(count)]
    names += [f"{kind}{i}" for kind in ("g", "J") for i in range(n)]
    free = parameters(" ".join([*names, "mass", "rho", "e"]))
    a, b, frame, virtual = (skew(free[i * count : (i + 1) * count], n) for i in range(4))
    vertical, J = array(free[4 * count : 4 * count + n]), np.diag(array(free[4 * count + n : 4 * count + 2 * n]))
    mass, rho, e = free[-3:]
    previous, turn = cayley(a), cayley(b)
    first = cayley(frame) if any_axes else previous.T
    R = [first, first @ previous if any_axes else unit(n)]
    R.append(R[1] @ turn)

    balance, steps = balance_in_space(R, J, vertical, mass, rho, naive)
    r = [0 * steps[0], steps[0], steps[0] + steps[1]]

    def displaced(size: Any) -> Array:
        """The action when R_k turns by ξ and r_k follows by the constraint (4.2): δr = -ρξγ."""
        there = [R[0], R[1] + size * virtual @ R[1], R[2]]
        return action(there, [r[0], r[1] - size * rho * virtual @ vertical, r[2]], J, mass)

    D = mass * rho**2
    before, now = (momentum(x, J, R[i].T @ vertical, D, last) for i, x in enumerate((previous, turn)))
    other = momentum_by_centre(turn, J, R[1].T @ vertical, D)
    outer = [np.outer(R[i].T @ vertical, R[i].T @ vertical) for i in (0, 1)]
    work = sum((displaced(e) - displaced(-e)) / (2 * e))
    return [
        identity(f"n = {n}: the work along every virtual turn ξ is ½ tr(ξ·balance)", work, np.trace(virtual @ balance) / 2, large=True),
        identity(f"n = {n}: R_kᵀ·balance·R_k = 𝒦_k - Ωᵀ𝒦_(k-1)Ω", R[1].T @ balance @ R[1], now - previous.T @ before @ previous, large=True),
        identity(f"n = {n}: the two forms of (4.13) agree", now, other),
        identity(f"n = {n}: Γ_k = ΩᵀΓ_(k-1)Ω", outer[1], previous.T @ outer[0] @ previous),
    ]  # fmt: skip


def free_step(n: int) -> tuple[Array, Array, Array, Ratio]:
    """A turn, a vertical of any length, a diagonal J, and D, all free."""
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
    square = 1 / (1 + u @ u)  # q₀²; what is of degree 2 in (q₀, q) is q₀² times its value at (1, u)
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
    """One step with vertical momentum: u = q/q₀ and the turn, γ, γ~ = Ωᵀγ, the ball, and h."""

    u: Array
    turn: Array
    gamma: Array
    following: Array
    J: Array
    D: Any
    h: Any

    @property
    def lam(self) -> Array:
        """Λ."""
        return sum(self.J) - self.J + self.D

    @property
    def sum(self) -> Array:
        """s = γ~ + γ."""
        return self.gamma + self.following

    @property
    def cosine(self) -> Any:
        """cos θ of the turn."""
        return (np.trace(self.turn) - 1) / 2

    def sigma(self, part: int = 4) -> Any:
        """σ of (5.11) as corrected; `part` is 8 as printed."""
        return self.h / (1 - self.D / part * (self.sum @ (self.sum / self.lam)))

    def is_vertical(self) -> Identity:
        """𝒦 = hγ with 𝒦 by the second form of (4.13), |γ| = 1."""
        whole = axial(momentum_by_centre(self.turn, np.diag(self.J), self.gamma, self.D))
        return identity(
            "𝒦 = hγ and |γ| = 1", [*whole, self.gamma @ self.gamma], [*(self.h * self.gamma), 1], large=True
        )


def vertical_step(unit_height: bool = False) -> VerticalStep:
    """Ω, |γ| = 1, D and h are free, and 𝒦 = hγ, linear in J, is solved for the ball.

    The states with q₀q₁q₂q₃ ≠ 0 are reached, which are dense among those with σ ≠ 0.
    """
    *u, a, b, D, height = parameters("u1 u2 u3 a b D h")
    h: Any = 1 if unit_height else height
    turn, gamma = cayley(hat(u)), sphere(a, b)
    rolling = axial(momentum(turn, 0 * turn, gamma, D))
    spinning = array([axial(momentum(turn, np.diag(row), gamma, 0 * D)) for row in unit(3)]).T
    J = inverse(spinning) @ (h * gamma - rolling)
    return VerticalStep(array(u), turn, gamma, turn.T @ gamma, J, D, h)


def quadratic_integral(power: int = -1, backwards: bool = False) -> list[Identity]:
    """Proposition 3; the arguments mutate the power of Λ and the transport of γ."""
    step = vertical_step()
    following = step.turn @ step.gamma if backwards else step.following
    forms = [vertical @ (step.lam**power * vertical) for vertical in (step.gamma, following)]
    return [step.is_vertical(), identity(f"⟨γ, Λ^{power} γ⟩ is the same for γ and γ~", forms[0], forms[1], large=True)]


def symmetric_form(part: int = 4, under_root: int = 2, factor: int = 4) -> list[Identity]:
    """Proposition 4 as corrected; printed are part 8 (in σ) and under_root 0 (the power of σ under the root)."""
    step = vertical_step()
    sigma, s = step.sigma(part), step.sum
    root = 1 - sigma**under_root / 4 * (s @ (s / step.lam**2))
    kappa = 2 * sigma / (1 + step.cosine)
    inner = (step.gamma @ step.u) / (1 + step.u @ step.u)  # q₀⟨γ, q⟩
    return [
        step.is_vertical(),
        identity("σ = h + 2D q₀⟨γ, q⟩ is h/(1 - (D/4)⟨s, Λ⁻¹s⟩)", step.h + 2 * step.D * inner, sigma, large=True),
        identity("cos²θ = 1 - (σ²/4)⟨s, Λ⁻²s⟩", step.cosine**2, root, large=True),
        identity("γ~ - γ = (ϰ/4)s×Λ⁻¹s with ϰ = 2σ/(1 + cos θ)", step.following - step.gamma,
                 kappa / factor * np.cross(s, s / step.lam), large=True),
    ]  # fmt: skip


def steps_of_the_symmetric_form(part: int = 4) -> list[Identity]:
    """The converse: γ, γ~ with (5.10), σ and ϰ as corrected are one step; `part` mutates σ.

    Two unit vectors with ⟨γ, Λ⁻¹γ⟩ = ⟨γ~, Λ⁻¹γ~⟩ have a ϰ by (5.10), and (2σ/ϰ - 1)² = 1 - (σ²/4)⟨s, Λ⁻²s⟩
    is linear in σ.  Then q₀² = σ/ϰ, and q = (σ/4q₀)Λ⁻¹s is q₀u with u = (ϰ/4)Λ⁻¹s.
    """
    pair = pair_on_a_curve()
    s, d = pair.gamma + pair.following, pair.following - pair.gamma
    kappa = 4 * d[0] / np.cross(s, s / pair.lam)[0]
    sigma = (4 / kappa) / (4 / kappa**2 + s @ (s / pair.lam**2) / 4)
    h = sigma * (1 - pair.D / part * (s @ (s / pair.lam)))
    u = kappa / 4 * s / pair.lam
    J = (sum(pair.lam) - 2 * pair.lam - pair.D) / 2
    step = VerticalStep(u, cayley(hat(u)), pair.gamma, pair.following, J, pair.D, h)
    return [
        identity("(5.10)", 4 * d, kappa * np.cross(s, s / pair.lam)),
        identity("(2σ/ϰ - 1)² = 1 - (σ²/4)⟨s, Λ⁻²s⟩", (2 * sigma / kappa - 1) ** 2, 1 - sigma**2 / 4 * (s @ (s / pair.lam**2)), large=True),
        identity("2σ/ϰ - 1 is the cos θ of the turn", 2 * sigma / kappa - 1, step.cosine, large=True),
        identity("γ~ = Ωᵀγ", step.following, step.turn.T @ step.gamma, large=True),
        step.is_vertical(),
    ]  # fmt: skip


@dataclass(frozen=True)
class Increment:
    """What (5.15) is made of, for two points γ(u), γ(ũ) of one curve; all of it is rational in them.

    By the addition theorem for ũ ± u, the halves by sn²(x/2) = (1 - cn x)/(1 + dn x).
    """

    gamma: Array
    following: Array
    lam: Array
    D: Any

    @cached_property
    def level(self) -> Any:
        """l."""
        return self.gamma @ (self.gamma / self.lam)

    @cached_property
    def squares(self) -> tuple[Any, Any, Any]:
        """C1², C2², C3² of (5.8) as corrected."""
        (L1, L2, L3), l = self.lam, self.level
        return L1 * (1 - L3 * l) / (L1 - L3), L2 * (1 - L3 * l) / (L2 - L3), L3 * (L1 * l - 1) / (L1 - L3)

    @cached_property
    def modulus(self) -> Any:
        """k²."""
        (L1, L2, L3), l = self.lam, self.level
        return (L1 - L2) * (1 - L3 * l) / ((L2 - L3) * (L1 * l - 1))

    @cached_property
    def below(self) -> Any:
        """The denominator of the addition theorem, 1 - k² sn²u sn²ũ."""
        return 1 - self.modulus * (self.gamma[1] * self.following[1] / self.squares[1]) ** 2

    def half_square(self, sign: int) -> Any:
        """sn² of (ũ + sign·u)/2."""
        a, b, c = self.squares
        x, y, z = self.gamma * self.following
        cn = (x / a - sign * y * z / (b * c)) / self.below
        dn = (z / c - sign * self.modulus * x * y / (a * b)) / self.below
        return (1 - cn) / (1 + dn)

    def parts(self) -> "Parts":
        """sn²δu, 𝒟, V w(δu), G and l - μ sn²δu."""
        (a, b, c), k2, (L1, L2, L3), l = self.squares, self.modulus, self.lam, self.level
        y, mean = self.half_square(-1), self.half_square(+1)
        (g1, g2, g3), (h1, h2, h3) = self.gamma, self.following
        # V = -(C2 C3/C1)(Λ2-Λ3)/(Λ2Λ3); 2w = sn(ũ-u)(1 - k²y²); C1 C2 C3 sn(ũ-u) is rational in γ, γ~.
        sine = (h2 * g1 * g3 - g2 * h1 * h3) / self.below
        vw = -(L2 - L3) / (L2 * L3) * sine / a * (1 - k2 * y**2) / 2
        G = a / (k2 * L1**2) * (1 - y) - b / (k2 * L2**2) * (1 - y) * (1 - k2 * y) + c / L3**2 * (1 - k2 * y)
        return Parts(y, 1 - k2 * mean * y, vw, G, l - (1 - L3 * l) / (L2 - L3) * y)


@dataclass(frozen=True)
class Parts:
    """sn²δu, 𝒟, V w(δu), G and l - μ sn²δu."""

    y: Any
    scale: Any
    vw: Any
    G: Any
    level: Any

    def relation(self, D: Any, sign: int = 1) -> Any:
        """T = G𝒟 - 2Vw(𝒟 - D(l - μ sn²δu)): (5.15) as corrected is T = 0; `sign` mutates V."""
        return self.G * self.scale - 2 * sign * self.vw * (self.scale - D * self.level)


def pair_on_a_curve() -> Increment:
    """Two unit vectors γ, γ~ and a Λ with ⟨γ, Λ⁻¹γ⟩ = ⟨γ~, Λ⁻¹γ~⟩, which is solved for Λ1; Λ2, Λ3, D are free.

    Every such triple with Λ finite and γ~₁² ≠ γ₁² is reached, but for a vector (0, 0, -1).
    """
    a, b, c, d, L2, L3, D = parameters("a b c d L2 L3 D")
    gamma, following = sphere(a, b), sphere(c, d)
    rise = following**2 - gamma**2
    return Increment(gamma, following, array([-rise[0] / (rise[1] / L2 + rise[2] / L3), L2, L3]), D)


def increment(contact: int = 1, sign: int = 1) -> list[Identity]:
    """(5.15) as corrected, h = 1, for every two points of a curve; the arguments mutate D and V in it."""
    pair = pair_on_a_curve()
    parts, k2, l = pair.parts(), pair.modulus, pair.level
    (L1, L2, L3), s, d = pair.lam, pair.gamma + pair.following, pair.following - pair.gamma
    product = np.cross(s, s / pair.lam)
    kappa = 4 * d[0] / product[0]
    first, second = s @ (s / pair.lam) / 4, s @ (s / pair.lam**2) / 4
    sigma = 1 / (1 - pair.D * first)
    on_curve = [
        entry
        for x in (pair.gamma, pair.following)
        for entry in (x[0] ** 2 / pair.squares[0] + x[1] ** 2 / pair.squares[1],
                      x[2] ** 2 / pair.squares[2] + k2 * x[1] ** 2 / pair.squares[1])
    ]  # fmt: skip
    y, printed_v = parts.y, (L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3)
    statement = (2 * sigma / kappa - 1) ** 2 - (1 - sigma**2 * second)
    relation = parts.relation(contact * pair.D, sign)
    return [
        identity("γ and γ~ are (C1 cn, C2 sn, C3 dn) of one curve", on_curve, [1] * 4, large=True),
        identity("(5.10) defines ϰ: its three components agree", 4 * d, kappa * product),
        identity("2𝒟 sn²δu = ϰVw (5.13-V)", 2 * parts.scale * y, kappa * parts.vw, large=True),
        identity(
            "(Vw)² = V² sn² cn² dn² with V² as printed", parts.vw**2, printed_v * y * (1 - y) * (1 - k2 * y), large=True
        ),
        identity(
            "(2σ/ϰ-1)² - (1-σ²Π2) = T·σ²/(𝒟² sn²δu)", statement, relation * sigma**2 / (parts.scale**2 * y), large=True
        ),
    ]


def increment_of_the_map(contact: int = 1) -> Identity:
    """T = 0 at every step of the map with vertical momentum and h = 1, from (4.13)."""
    step = vertical_step(unit_height=True)
    parts = Increment(step.gamma, step.following, step.lam, step.D).parts()
    return identity("T = 0 at every step with 𝒦 = γ", parts.relation(contact * step.D), 0, large=True)
