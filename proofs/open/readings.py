"""The paper's two questions, literally, and their readings: which are answered, by which lemmas, and which are open.

The table in the documentation, the table on the page and the answers of `prove` are made from these rows.
"""

from chapsym.proofs.open import terms
from chapsym.prove import Reading
from chapsym.prove.argument import NO, OPEN, TRIVIALLY, YES

#: The questions by id: the words of the paper, and their place.
QUESTIONS = {
    "5.9-open": (
        "“In this connection the following natural problem of the complete integrability of the map G_h arises: is there "
        "a (multi-valued) reparameterization u=f(s,l), s ∈ ℂ such that u_k=f(s_k), u_{k+1}= f(s_k+Δs) and the increment "
        "Δs does not depend on s_k? Note that this property is equivalent to that the one-dimensional map (5.9) preserves "
        "the invariant measure μ(u) du [...] Due to the existence of the integral (5.5), this is also equivalent to that "
        "the map G_h itself preserves an invariant measure on S².”",
        "Section 5, after Remark 4 and (5.9)",
    ),
    "6-open": (
        "“Although the energy (2.5) of the Chaplygin sphere expressed in terms of the momentum 𝒦 is not preserved in the "
        "discrete setting in general, this does not exclude the existence of another integral that transforms to the "
        "energy in the continuous limit.”",
        "Section 6, the fourth paragraph",
    ),
}

#: Parts of the proofs of the questions themselves.
BOXES, FLAT, ROUND = "5.9-open: certificates", "5.9-open: D = 0", "5.9-open: two equal moments"
BEYOND, ENDS = "5.9-open: certificates with a branch", "5.9-open: certificates of the ends"
DRIFTS, INTEGRALS, DENSITY = "6-open: certificates", "6-open: integrals", "6-open: densities"
CLOSED_ORBITS = "6-open: periodic orbits"
NO_ROLLING, VERTICAL = "6-open: D = 0", "6-open: vertical momentum"

READINGS = {
    "5.9-open": (
        Reading("finite measure; all small h and then all small D (nothing is said of tr J ≤ D)",
                terms.MEASURE, NO, ("plateaus", "locked-circle")),
        Reading("finite measure; almost all D > 0 and small h (tr J ≤ D among them: all mass inside)",
                terms.MEASURE, NO, ("almost-every", "locked-circle")),
        Reading("finite measure; one ball and one h, and all near them (measure-real-ball: tr J ≤ D)",
                terms.MEASURE, NO, (BOXES, "locked-circle")),
        Reading("finite measure; all h ≠ 0 below the bound, all D > 0 but a closed discrete set for each h (tr J ≤ D among them)",
                terms.MEASURE, NO, ("separatrix", "locked-circle")),
        Reading("finite measure; one ball and one h, and all near them, by the level l = 1/Λ2 (heteroclinic-real-ball: tr J ≤ D)",
                terms.MEASURE, NO, (ENDS, "separatrix-limit", "locked-circle")),
        Reading("finite measure; all h ≠ 0 below the bound, all D > 0 without exception", terms.MEASURE, OPEN),
        Reading("real s, single-valued f: a circle of s for each regular level; all h ≠ 0 below the bound, all D > 0 but a closed discrete set for each h",
                terms.PARAMETER, NO, ("separatrix", "locked-circle")),
        Reading("real s, a line of s, over a locked circle: f is real analytic, s as a function of u has infinitely many values",
                terms.LINE, TRIVIALLY, ("almost-every", "locked-circle")),
        Reading("complex s, multi-valued f, analytic beyond a neighbourhood of the real circle", terms.PARAMETER, OPEN),
        Reading("σ-finite measure, on a locked circle, C^∞ but at its periodic points",
                terms.INFINITE, TRIVIALLY, ("almost-every", "locked-circle")),
        Reading("σ-finite measure on the whole sphere", terms.INFINITE, OPEN),
        Reading("beyond the bound of small-branch: one ball and one h above the least moment, and all near them; the circles near "
                "one level, the branch over them (measure-beyond-bound: tr J ≤ D)", terms.NEAR_A_CIRCLE, NO, (BEYOND,)),
        Reading("other branches than these and the small one", terms.MEASURE, OPEN),
        Reading("D = 0: finite measure", terms.MEASURE, YES, (FLAT,)),
        Reading("D = 0: real s, a circle of s for each regular level", terms.PARAMETER, YES, (FLAT,)),
        Reading("two equal moments: finite measure", terms.MEASURE, YES, (ROUND,)),
    ),
    "6-open": (
        Reading("C¹ integrals that tend in C¹; two balls, and all near them (energy-drift-real-ball: tr J ≤ D)",
                terms.IN_C1, NO, (DRIFTS, INTEGRALS)),
        Reading("the same; all balls with three different moments and D > 0", terms.IN_C1, NO, ("energy-orbits", INTEGRALS)),
        Reading("integrals with an expansion in ε up to ε²; these balls", terms.EXPANDED, NO, ("energy-orbits", INTEGRALS)),
        Reading("a real analytic integral H + O(|𝒦|³); these balls", terms.ANALYTIC, NO, ("energy-orbits", INTEGRALS)),
        Reading("C⁰ integrals that tend uniformly: may well be yes, as invariant tori can separate levels", terms.IN_C0, OPEN),
        Reading("C¹ integrals that tend in C¹; two equal moments, D > 0", terms.IN_C1, OPEN),
        Reading("one ε: a further C¹ integral that is independent on the certified periodic orbits",
                terms.THIRD, NO, (CLOSED_ORBITS,)),
        Reading("one ε: a further analytic integral, independent anywhere", terms.THIRD, OPEN),
        Reading("other branches than the small one", terms.IN_C1, OPEN),
        Reading("D = 0", terms.KEPT, YES, (NO_ROLLING,)),
        Reading("𝒦 parallel to γ", terms.KEPT, YES, (VERTICAL,)),
        Reading("beside it: invariant densities that tend in C¹ to g(|K|², ⟨K,γ⟩)τ^(-1/2); two balls, and all near them",
                terms.DENSITIES, NO, (DRIFTS, DENSITY)),
        Reading("beside it: a measure of the whole map near 𝒦 = 0, density continuous and positive; all D > 0, two different moments",
                terms.WHOLE, NO, ("measure-iff",)),
    ),
}  # fmt: skip


def table(id: str) -> str:
    """The readings of a question as a table in Markdown."""
    rows = [(one.asked, f"**{one.answer}**", ", ".join(map(_name, one.by)) or "open") for one in READINGS[id]]
    lines = [("reading", "answer", "proved by"), ("---",) * 3, *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines) + "\n"


def _name(by: str) -> str:
    """The id of a lemma, or the name of a part of a question's own proof."""
    return f"`{by}`"
