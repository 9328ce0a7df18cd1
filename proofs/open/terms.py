"""The texts of hypotheses and conclusions of the lemmas on the open questions, each defined once.

A text acts as a name: a lemma applies where another concludes its hypothesis, letter for letter.
"""

# Hypotheses.
THREE = "I1, I2, I3 are different"
SMALL_BRANCH = "|𝒦| is below the bound of small-branch, and the map is that of the small branch"
MOMENTS = "J_i + J_j > 0 and D ≥ 0"
FOR_SMALL = "for each three moments there is h₀ > 0, and for every h with 0 < |h| < h₀ there is D₀(h) > 0, so that for every D with 0 < D < D₀(h)"
BUT_DISCRETE = "for each three moments and every h ≠ 0 there is a set without limit points in [0, ∞), and for every D > 0 that is not in it"
FOR_ALMOST_ALL = "for each three moments and every D̂ > 0 there is h₀ > 0, so that for almost every (D, h) with 0 < D < D̂ and 0 < |h| < h₀"

#: Links between the lemmas of 5.9-open.
BOTH_SIGNS = (
    "for some q and p ≥ 1 there is an interval of levels on which q steps turn by more than p half turns at one point of "
    "each circle, and by less at another"
)

NOT_CONSTANT = (
    "on the level l = 1/Λ2 Δ(u) = h₊(u) + h₊(-u) is not constant, h₊(u) = lim(u_n - nc), u_n the orbit of u, c the limit of "
    "its increments"
)

# The statements that question 5.9-open asks for, in its readings.
MEASURE = "finite measure on the sphere, invariant under G_h, with a density that is positive almost everywhere"
PARAMETER = "real u = f(s, l), for each l a homeomorphism from a circle of s to that of u, with a constant increment"
INFINITE = (
    "measure on the locked circle, infinite and invariant, with a density smooth and positive off finitely many points"
)
LINE = "real analytic u = f(s), from the line of s to that of u over the locked circle, with a constant increment"
CARRIED = "every finite invariant measure on a circle of these levels is carried by finitely many periodic points"

#: Beyond the bound: a ring of circles, and a branch over each.
ON_BRANCH = (
    "the map is that of the branch of a certificate with a branch, over the circles of the levels within its radius"
)
NEAR_A_CIRCLE = (
    "finite measure on these circles, invariant under this map, with a density that is positive almost everywhere"
)

# The statements that question 6-open asks for.
IN_C1 = (
    "family of C¹ integrals of the steps that tends in C¹ to H, or to a C² f(H, |K|², ⟨K,γ⟩) with ∂f/∂H ≠ 0, as ε → 0"
)
IN_C0 = "family of continuous integrals of the steps that tends uniformly to such a function"
EXPANDED = "family of integrals f + εH₁ + ε²H₂ + o(ε²) of the steps, uniformly, with H₁ of class C¹ and H₂ continuous"
ANALYTIC = "real analytic integral H + O(|𝒦|³) of the map near 𝒦 = 0"
KEPT = "conserved energy: H itself is an integral of the map"
DENSITIES = "family of invariant densities of the steps that tends in C¹ to g(|K|², ⟨K,γ⟩)τ^(-1/2), g > 0, τ as in modified-measure"
ROLLS, TWO_DIFFER = "D > 0", "two of I1, I2, I3 are different"
WHOLE = "number r > 0 with a measure on |𝒦| < r that the whole map preserves and that has a continuous positive density"
ALL_EQUAL = "I1 = I2 = I3"
THIRD = "C¹ integral of the map with a differential independent of those of |γ|, |𝒦|², ⟨𝒦,γ⟩ on these orbits"

#: Links between the parts of 6-open.
DRIFT = "the continuous ball has a closed orbit with ∮X₃(H)dt ≠ 0, X₃(H) = (D/4)⟨γ,ω'⟩⟨γ',ω'⟩"
DRIFT_OF_DENSITY = "the continuous ball has a closed orbit with ∮div_μ X₃ dt ≠ 0"
NEAR_IT, NEAR_THE_OTHER = (
    f"for every neighbourhood U in R³ × S² of a closed orbit of the continuous ball with ∮{of} ≠ 0 and every sequence "
    "ε_j → 0, ε_j > 0"
    for of in ("X₃(H)dt", "div_μ X₃ dt")
)
