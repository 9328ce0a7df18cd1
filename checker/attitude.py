"""The attitude of the continuous ball: a quaternion a = (q₀, q) whose rotation R takes the body's axes to space.

K and the vertical are fixed in space: K = Rᵀk and γ = Rᵀe₃.  Then ω = B⁻¹K as in rolling.py; with a rotor, whose
angular momentum r is constant in the body, Bω = K - r.  The equation of motion is
    a′ = f(a) = ½a∘ω,  a∘(s, v) = (q₀s - ⟨q, v⟩, sq + q₀v + q × v),
as R′u = R(ω × u), and the columns v of Rᵀ have v′ = v × ω.  The code uses |a|²R for R in K and γ, and divides B⁻¹K by
|a|²: then ω does not depend on |a|.

The derivative of f.  Let e = a∘(s, ξ).  Along e, K and γ change by 2K × ξ and 2γ × ξ, as under a rotation of the body's
axes.  From Bω = K - r, where Dγγᵀ turns, too, ω changes by 2ω × ξ + 2B⁻¹Cξ, Cξ = (Iω + r) × ξ - I(ω × ξ).  As ξ∘ω +
2ω × ξ = ω∘ξ, f′e = ½(a∘ω∘a⁻¹)∘e + a∘B⁻¹Cξ; the first term is antisymmetric in e.  So ⟨e, f′e⟩ = |a|²⟨ξ, B⁻¹Cξ⟩, and
|e|² = |a|²(s² + |ξ|²): max(μ, 0) is that of B⁻¹C.  For equal moments and no rotor C = 0: solutions keep their distance.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from .linear import cross, dot, plus
from .rolling import Rolling, newest
from .taylor import Model, Numbers


@dataclass(frozen=True)
class Turning(Rolling):
    """The continuous ball with quaternions for states.  half: ½k.  rotor: ½r, or empty."""

    half: Numbers
    rotor: Numbers = ()

    def vectors(self, a: Numbers) -> Numbers:
        """½K and γ, times |a|²."""
        rows = rotation(a)
        K = [dot(column, self.half) for column in zip(*rows, strict=True)]
        return [*K, *rows[2]]

    def spin(self, state: Numbers) -> Numbers:
        """½ω."""
        square, vectors = dot(state, state), self.vectors(state)
        if self.rotor:
            vectors = [*(x - square * y for x, y in zip(vectors[:3], self.rotor, strict=True)), *vectors[3:]]
        by = 1 / square
        return [x * by for x in super().spin(vectors)]

    def turned(self, state: Numbers, w: Numbers) -> Numbers:
        """a∘(0, w)."""
        q0, q = state[0], state[1:]
        return [-dot(q, w), *plus([x * q0 for x in w], cross(q, w))]

    def stretch(self, state: Numbers) -> list[Numbers]:
        """The columns of B⁻¹C."""
        vectors, w, I = self.vectors(state), self.spin(state), self.inertia
        gamma = vectors[3:]
        columns = [[w[0]._of(0)] * 3 for _ in range(3)]
        for i in range(3):
            for j, k, sign in ((i - 2, i - 1, 2), (i - 1, i - 2, -2)):
                bent = (I[j] - I[i]) * w[j]
                columns[k][i] = (bent + self.rotor[j] if self.rotor else bent) * sign
        return [self.solved(column, gamma, *self.inverse(gamma)) for column in columns]

    def series(self, start: Sequence[int], order: int) -> list[list[int]]:
        """The Taylor coefficients of a, computed from those of ω, which `Rolling` gives."""
        bits, a = self.D.bits, [[x] for x in start]
        half = [x.terms[0] for x in self.vectors([Model(x, 0, bits) for x in a])]
        rotor = [2 * x.terms[0] for x in self.rotor]
        _, w = self.series_with_spin([*(2 * x for x in half[:3]), *half[3:]], order, rotor)
        for k in range(order - 1):
            parts = [[newest(x, y[: k + 1]) for y in w] for x in a]
            q0, q = parts[0], parts[1:]
            rates = [-sum(q[i][i] for i in range(3)), *(q0[i] + q[i - 2][i - 1] - q[i - 1][i - 2] for i in range(3))]
            for x, rate in zip(a, rates, strict=True):
                x.append((rate >> bits) // (2 * (k + 1)))
        return a


def rotation(a: Numbers) -> Sequence[Numbers]:
    """The rows of |a|²R."""
    p = {(i, j): a[i] * a[j] for i in range(4) for j in range(i, 4)}
    rest = p[0, 0] - p[1, 1] - p[2, 2] - p[3, 3]
    rows = [[2 * p[min(i, j), max(i, j)] for j in (1, 2, 3)] for i in (1, 2, 3)]
    for i in range(3):
        turn = 2 * p[0, i + 1]
        rows[i][i] = rows[i][i] + rest
        rows[i - 2][i - 1] = rows[i - 2][i - 1] - turn
        rows[i - 1][i - 2] = rows[i - 1][i - 2] + turn
    return rows
