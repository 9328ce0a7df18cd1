"""The symmetries and reversors of the step, from the principal axes; the paper does not state them."""

import sympy as sp

from chapsym.derive import gibbs
from chapsym.derive.gibbs import I1, I2, I3, k, u
from chapsym.derive.three import gamma, placed
from chapsym.proofs.map.gibbs import NORM, equal
from chapsym.prove import Equation, Proof, Theorem, claim, main

HALF_TURNS = {f"S{i + 1}": sp.diag(*(1 if i == j else -1 for j in range(3))) for i in range(3)}
MIRRORS = {f"σ{i + 1}": sp.diag(*(-1 if i == j else 1 for j in range(3))) for i in range(3)}


def turned(x: sp.Matrix, axis: sp.Matrix = u) -> sp.Matrix:
    """(1 + |u|²)Ωᵀx (lemma `gibbs-rotation`)."""
    once = axis.cross(x)
    return (1 + axis.dot(axis)) * x + 2 * (axis.cross(once) - once)


def residual(to_u: sp.Matrix, to_gamma: sp.Matrix, to_k: sp.Matrix) -> sp.Matrix:
    """G with (u, γ, k) replaced."""
    return sp.Matrix(gibbs.residual()).xreplace(placed((u, to_u), (gamma, to_gamma), (k, to_k)))


def carried(name: str, on_u: sp.Matrix, on_gamma: sp.Matrix, on_k: sp.Matrix) -> list[Equation]:
    """The statements that (u, γ, k) ↦ (on_u u, on_gamma γ, on_k k) maps solutions to solutions, images to images."""
    here, there = sp.Matrix(gibbs.residual()), residual(on_u * u, on_gamma * gamma, on_k * k)
    return [
        equal(f"{name}: the equation of u goes into itself", there, on_k * here),
        equal(f"{name}: Ωᵀγ goes along with γ", turned(on_gamma * gamma, on_u * u), on_gamma * turned(gamma)),
        equal(f"{name}: Ωᵀ𝒦 goes along with 𝒦", turned(on_k * k, on_u * u), on_k * turned(k)),
    ]


#: Permutations of the body axes: cyclic, and the exchange of 1 and 3.
CIRCLE, SWAP = sp.Matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]]), sp.Matrix([[0, 0, 1], [0, 1, 0], [1, 0, 0]])


def renamed(names: sp.Matrix, axial: int = 1) -> list[Equation]:
    """The step with permuted body axes; the axial vectors u and 𝒦 change sign under a reflection."""
    moments = names * sp.Matrix([I1, I2, I3])
    other = dict(zip((I1, I2, I3), moments, strict=True))
    text = "1 → 2 → 3 → 1" if names == CIRCLE else "1 and 3 exchanged"
    on_axial = axial * names.det() * names
    return [
        equal(one.text, [sp.sympify(x).xreplace(other) for x in one.left], one.right)
        for one in carried(text, on_axial, names, on_axial)
    ]


BELOW = "|𝒦| is below the bound of small-branch"
COMMUTES = "S G_h = G_h S for the rotations S by π about the principal axes"
MIRRORED = "Φ(-σ𝒦, σγ) is (-σ, σ) of Φ(𝒦, γ), and G_{-h}(-γ) = -G_h(γ)"
RENAMED = "with the axes named in any other way G_h becomes G_h or G_h⁻¹ of the ball with its moments named so"
REVERSED = "σ G_h σ = G_h⁻¹ for the reflections σ across them, and G_h(-γ) = -G_h⁻¹(γ)"


@claim(
    "symmetries",
    r"S\,\mathcal G_h = \mathcal G_h S,\ \sigma\,\mathcal G_h\,\sigma = \mathcal G_h^{-1},\ "
    r"\mathcal G_h(-\gamma) = -\mathcal G_h^{-1}(\gamma)\ \text{ for rotations } S \text{ by } \pi "
    r"\text{ about, and reflections } \sigma \text{ across, the principal axes}",
    uses=["gibbs", "gibbs-rotation", "small-branch", "self-adjoint"],
)
def symmetries(p: Proof) -> None:
    """Rotations by π about the principal axes commute with the map, reflections of them reverse the reduced one."""
    p.assume("|𝒦| below the bound of small-branch; it and |u| are the same on both sides, so that the branch is, too")
    p.state(Theorem((), (BELOW,), (COMMUTES, REVERSED, RENAMED)))
    p.say("The step from (𝒦, γ): G(u; γ, k) = 0 with k = 𝒦/2, then 𝒦~ = Ωᵀ𝒦, γ~ = Ωᵀγ with (1 + |u|²)Ωᵀ from u.")
    for name, S in HALF_TURNS.items():
        p.printed(*carried(f"{name}: u, γ, 𝒦 ↦ Su, Sγ, S𝒦", S, S, S))
    p.say("So Φ(S𝒦, Sγ) = S Φ(𝒦, γ), and S G_h = G_h S where 𝒦 = hγ.")
    p.step(COMMUTES, BELOW, "gibbs", "gibbs-rotation", "small-branch")
    p.say("A reflection turns u and 𝒦, axial vectors, too:")
    for name, mirror in MIRRORS.items():
        p.printed(*carried(f"{name}: u, γ, 𝒦 ↦ -σu, σγ, -σ𝒦", -mirror, mirror, -mirror))
    p.say("So Φ(-σ𝒦, σγ) is (-σ, σ) of Φ(𝒦, γ), and with 𝒦 = hγ it is G_{-h}σ = σG_h.  The equation is even in γ:")
    one = sp.eye(3)
    p.printed(*carried("-1: u, γ, 𝒦 ↦ u, -γ, 𝒦", one, -one, one))
    p.say("So G_{-h}(-γ) = -G_h(γ).")
    p.step(MIRRORED, BELOW, "gibbs", "gibbs-rotation", "small-branch")
    p.say("The step with -h undoes that with h (self-adjoint): G_{-h} = G_h⁻¹.  Hence σ G_h σ = G_h⁻¹ and G_h(-γ) =")
    p.say("-G_h⁻¹(γ).")
    p.step(REVERSED, MIRRORED, "self-adjoint")
    p.say("Axes named anew, in the equation of the ball with its moments named so:")
    p.lemma(*renamed(CIRCLE), *renamed(SWAP))
    p.say(
        "The first commutes with G_h. The second is a reflection: with u and 𝒦 = hγ it changes the sign of h, and G_{-h} =",
        "G_h⁻¹. These two make all orders of the axes: what is proved for I1 > I2 > I3 holds for any three different moments,",
        "as a displacement of the inverse map is -δ∘F⁻¹.",
    )
    p.step(RENAMED, BELOW, "gibbs", "gibbs-rotation", "small-branch", "self-adjoint")
    p.say("The half γ_c < 0 of the sphere repeats the half γ_c > 0. On a level")
    p.say("circle around the axis c let F be a lift of R^p G_h^q, R the rotation by π about c, and δ = F - 1. With the")
    p.say("coordinate 0 where γ_a (or γ_b) is 0, σ gives F⁻¹(x) = -F(-x), that is δ(-x - δ(x)) = δ(x): where δ is")
    p.say("small it is almost even about these points, which is why they are the starts of a certificate.")
    S, mirror = HALF_TURNS["S1"], MIRRORS["σ1"]
    p.lemma(equal("S and σ are their own inverses", S * S * u + mirror * mirror * k, u + k))
    p.control(renamed(SWAP, -1)[0])
    p.control(carried("σ1 as if it were a rotation", mirror, mirror, mirror)[0])
    p.control(carried("S1 as if it were a reflection", -S, S, -S)[0])
    swap = sp.Matrix([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    p.control(carried("a rotation by π/2 about e₃", swap, swap, swap)[0])
    p.control(equal("Ωᵀγ with u ↦ σu", turned(mirror * gamma, mirror * u), mirror * turned(gamma)))
    p.control(equal("1 + |u|² = 1", NORM * u, u))


if __name__ == "__main__":
    main(__file__)
