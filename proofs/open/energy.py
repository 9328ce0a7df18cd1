"""The open question of Section 6: no integrals of the steps tend to the energy in C¹ as ε tends to 0."""

import sympy as sp

from chapsym.derive import modified, three
from chapsym.derive.limits import omega
from chapsym.derive.three import placed
from chapsym.proofs.map import gibbs, self_adjoint, stable, symmetries, vertical
from chapsym.proofs.map import modified as map_modified
from chapsym.proofs.map.modified import FREE
from chapsym.proofs.open import certified, chord, locking, melnikov, orbits, readings, separatrix, terms, volume
from chapsym.prove import Equation, Fact, Proof, Theorem, claim, judged, main, no, there_is

FILES = certified.files("energy-drift")
ORBITS = certified.files("periodic-orbit")
#: The lemmas that the argument uses, besides claims of the paper; they are proved again with it.
LEMMAS = {
    "small-branch": gibbs, "reversible": self_adjoint, "modified-field": map_modified,
    "modified-energy": map_modified, "energy-without-rolling": map_modified, "modified-measure": map_modified,
    "map-symmetries": map_modified, "step-determinant": orbits, "steady-circles": orbits,
    "measure-iff": volume, "periodic-orbits": orbits, "top-precession": vertical,
    "stable-inverse": stable, "chord": chord, "symmetries": symmetries, "self-adjoint": self_adjoint,
    "locked-circle": locking, "separatrix-map": separatrix, "separatrix-limit": separatrix, "melnikov": melnikov,
    "energy-orbits": melnikov,
}  # fmt: skip

BALLS = "for the balls of the certificates energy-drift-*, and all balls near them"
ORBITS_OF = "for the orbits of the certificates periodic-orbit-*"
PERIOD = "x_ε → x lies on a closed orbit of the continuous ball of the period nε"
ONE_STEP = "f∘Φ_ε = f + ε³f_H X₃(H) + O(ε⁴)"
ONE_PERIOD = "after n steps x_ε is back up to O(ε²), and f has changed by ε²f_H ∮X₃(H)dt + o(ε²)"
DENSITY_STEP = "log(det DΦ_ε · μ∘Φ_ε/μ) = ε³div_μ X₃ + O(ε⁴)"


def scaling(p: Proof) -> None:
    """Step 1: the closed orbits come in families, one for every length of K."""
    s = sp.Symbol("t")
    ring = type(FREE)((s, *FREE.symbols), [])
    scaled = placed((omega, s * omega), (modified.rate, s**2 * modified.rate))
    torque, rate = modified.torque(), modified.energy_rate()
    p.say(
        "1. Every length of K.  ω(λK, γ) = λω(K, γ), so (K, γ) ↦ (λK, γ) takes solutions of the continuous ball to such,"
    )
    p.say("   λ times as fast; and Φ_ε(λK, γ) is λ times Φ_{λε}(K, γ), for both depend on 𝒦 = λεK.")
    p.lemma(Equation("B(γ)ω' = Iω × ω has the degree 2 in ω", torque.xreplace(scaled), s**2 * torque, ring))
    text = "X₃(H) has the degree 5 in ω: its integral over the orbit scales with λ⁴ > 0"
    p.lemma(Equation(text, rate.xreplace(scaled), s**5 * rate, ring))
    p.control(Equation("X₃(H) has the degree 4", rate.xreplace(scaled), s**4 * rate, ring))
    p.say(
        "   Let T be the period of the orbit of x. For ε < T take n = ⌊T/ε⌋ steps and λ = T/(nε), so 1 ≤ λ < 1 + ε/(T - ε):"
    )
    p.say("   the orbit of x_ε = (λK, γ) has the period nε exactly, and x_ε → x.")
    p.step(PERIOD, terms.DRIFT)


def no_integral(p: Proof) -> None:
    """Steps 2 to 4: the theorem on the energy."""
    concluded = tuple(map(no, (terms.IN_C1, terms.EXPANDED, terms.ANALYTIC)))
    p.state(Theorem((terms.NEAR_IT,), (terms.SMALL_BRANCH, terms.DRIFT), concluded), readings.INTEGRALS)
    scaling(p)
    p.say(
        "2. One step.  On a compact neighbourhood V of the orbit, with V in U, by modified-field and modified-energy,",
        "   Φ_ε = φ_ε + O(ε³) and H∘Φ_ε = H + ε³X₃(H) + O(ε⁴), φ the flow of the continuous ball; uniformly, since u is",
        "   analytic in ε, K, γ. |K|², ⟨K,γ⟩ are integrals of the map, so f∘Φ_ε = f + ε³f_H X₃(H) + O(ε⁴), f = f(H, ..).",
    )
    p.step(ONE_STEP, terms.SMALL_BRANCH, terms.NEAR_IT, "modified-field", "modified-energy")
    p.say(
        "3. One period.  By Gronwall's lemma Φ_ε^i(x_ε) = φ_{iε}(x_ε) + O(ε²) for i ≤ n; the orbit stays in V. At i = n,",
        "   |Φ_ε^n(x_ε) - x_ε| ≤ Cε².  And summing 2., f(Φ_ε^n(x_ε)) - f(x_ε) = ε²f_H ∮X₃(H)dt + o(ε²), as the sum is a",
        "   Riemann sum, and f_H is constant on the orbit: it depends on integrals of the continuous ball.",
    )
    p.step(ONE_PERIOD, ONE_STEP, PERIOD)
    p.say(
        "4. The contradiction.  If F∘Φ_ε = F and r = F - f, then f(Φ_ε^n(x_ε)) - f(x_ε) = r(x_ε) - r(Φ_ε^n(x_ε)), which is",
        "   at most sup|dr|·2Cε², while the left side is at least ½|f_H ∮X₃(H)dt|ε² for small ε. So sup|dr| over U is at",
        "   least |f_H ∮X₃(H)dt|/(4C) for all small ε, and does not tend to 0.  (A short arc of V joins the two points.)",
    )
    p.step(no(terms.IN_C1), ONE_PERIOD, terms.DRIFT)
    p.say(
        "   And if r = εH₁ + ε²H₂ + o(ε²) uniformly, H₁ of class C¹, H₂ continuous, the right side is O(ε³) + o(ε²): too"
    )
    p.say("   little.")
    p.step(no(terms.EXPANDED), ONE_PERIOD, terms.DRIFT)
    p.say("   An analytic F = H + O(|𝒦|³) at 𝒦 = εK, over ε², is H + O(ε) in C¹: so it is no integral.")
    p.step(no(terms.ANALYTIC), no(terms.IN_C1))


def no_density(p: Proof) -> None:
    """The theorem on densities."""
    stated = Theorem((terms.NEAR_THE_OTHER,), (terms.SMALL_BRANCH, terms.DRIFT_OF_DENSITY), (no(terms.DENSITIES),))
    p.state(stated, readings.DENSITY)
    p.say(
        "Densities.  On R³ × S² with dK dγ the continuous ball keeps μ = τ^(-1/2) (modified-measure). By modified-field, in",
        "   C¹ as it is analytic, log(det DΦ_ε · μ∘Φ_ε/μ) = ε³div_μ X₃ + O(ε⁴).",
    )
    p.step(DENSITY_STEP, terms.SMALL_BRANCH, "modified-field", "modified-measure")
    p.say(
        "   If ϱ∘Φ_ε · det DΦ_ε = ϱ with ϱ = g μ exp(r),",
        "   g = g(|K|², ⟨K,γ⟩), the sum over one period is r(x_ε) - r(Φ_ε^n(x_ε)) = ε²∮div_μ X₃ dt + o(ε²): as in 4., |dr| does",
        "   not tend to 0.  div_μ X₃ has the degree 3 in ω, so that 1. holds for it.",
    )
    p.step(no(terms.DENSITIES), DENSITY_STEP, terms.DRIFT_OF_DENSITY, terms.NEAR_THE_OTHER)


def certificates(p: Proof) -> None:
    """The certificates of closed orbits with non-zero integrals, judged by the separate checker."""
    p.state(Theorem((BALLS,), (), (terms.DRIFT, terms.DRIFT_OF_DENSITY)), readings.DRIFTS)
    p.say(
        "The certificates: an orbit from the start, one component of K varied, back on a section up to S, a rotation by π;",
        "   what it misses in one more component has opposite signs at the two ends of the starts, and |γ|, |K|, ⟨K,γ⟩, H",
        "   and these two tell states apart: so for a start between, S·x(T) = x. S is a symmetry (map-symmetries), so the",
        "   orbit is closed after 2T (or T), and the integrals over it are 2 (or 1) times those over [0, T].",
        "   The checker encloses these orbits and integrals in integers, with formulas and bounds of its own.",
        "   What they prove are strict inequalities between continuous functions of J and D: so it holds for all balls near.",
    )
    accepted = certified.present(p, FILES, "energy-drift")
    for data in accepted:
        ball, enclosures = data["ball"], (data["energy"], data["density"])
        point = {"J": ", ".join(ball["J"]), "D": ball["D"], "X3(H)": data["energy"][0], "div X3": data["density"][0]}
        apart = all(abs(sp.Rational(centre)) > sp.Rational(radius) for centre, radius in enclosures)
        p.witness(f"J = ({point['J']})", point, Fact("0 is in neither enclosure", apart))
    p.step(terms.DRIFT, BALLS, "map-symmetries", *(file.name for file in FILES))
    p.say("   The integral of div_μ X₃ is in the same files.")
    p.step(terms.DRIFT_OF_DENSITY, BALLS, "map-symmetries", *(file.name for file in FILES))
    if accepted:
        early = str(sp.Rational(accepted[0]["time"]) / 8)
        p.control(certified.changed("the first certificate with another time", accepted[0], ("time",), early))


def fixed_step(p: Proof) -> None:
    """The results for a fixed 𝒦, without ε: measures and integrals near periodic orbits."""
    p.state(Theorem((ORBITS_OF,), (terms.SMALL_BRANCH,), (no(terms.THIRD),)), readings.CLOSED_ORBITS)
    p.say(
        "For a fixed 𝒦, by periodic-orbits, where an orbit is back and its derivative on the level of |γ|, |𝒦|, ⟨𝒦,γ⟩ has"
    )
    p.say("   no eigenvalue 1, dF is 0 on that level for every C¹ integral F:")
    accepted = certified.present(p, ORBITS, "periodic-orbit")
    p.step(no(terms.THIRD), ORBITS_OF, terms.SMALL_BRANCH, "periodic-orbits", *(file.name for file in ORBITS))
    if accepted:
        size = accepted[0]["integrals"]["momentum.momentum"]
        wrong = ("integrals", "momentum.momentum"), f"{sp.Rational(size) + 1}"
        p.control(certified.changed(f"the orbit of {accepted[0]['steps']} steps at another |𝒦|", accepted[0], *wrong))


@claim(
    "6-open",
    r"\text{is there another integral that tends to the energy, } \mathcal K\nparallel\gamma\text{? (open in the paper)}",
    ["5.3-energy", "6-vertical-energy", "2.5", "2.15-measure", *LEMMAS],
    files=(*FILES, *ORBITS),
)
def energy_question(p: Proof) -> None:
    """For three different moments and D > 0 no C¹ integrals of the steps tend to the energy in C¹ near certain orbits; in C⁰ that is open."""
    p.ask(*readings.QUESTIONS["6-open"])
    p.assume("the small branch; K = 𝒦/ε and γ near the orbit, ε small: then small-branch holds")
    flat, vertical = "D = 0", "𝒦 is parallel to γ"
    p.state(Theorem((), (flat,), (there_is(terms.KEPT),)), readings.NO_ROLLING)
    p.say("For D = 0 the energy is an integral of the map (energy-without-rolling).")
    p.step(there_is(terms.KEPT), flat, "energy-without-rolling")
    p.state(Theorem((), (vertical,), (there_is(terms.KEPT),)), readings.VERTICAL)
    p.say("For 𝒦 ∥ γ it is one, too (6-vertical-energy).")
    p.step(there_is(terms.KEPT), vertical, "6-vertical-energy")
    for id in LEMMAS:
        p.lemma(judged(id))
    p.say("For D > 0:")
    p.show("X₃(H)", modified.energy_rate())
    no_integral(p)
    no_density(p)
    certificates(p)
    fixed_step(p)
    odd = placed((omega, -omega))
    p.say(
        "On an orbit that a reversal of the map takes to itself both integrals are 0: the certificates' orbits are none."
    )
    p.lemma(Equation("X₃(H) is odd under K ↦ -K", modified.energy_rate().xreplace(odd), -modified.energy_rate(), FREE))
    p.control(Equation("X₃(H) is 0 for every D", modified.energy_rate(), 0, FREE))
    p.lemma(Equation("X₃(H) is 0 for D = 0", modified.energy_rate().subs(three.D, 0), 0, FREE))
    p.settle(readings.READINGS["6-open"])
    p.measure(*MEASURED)
    p.conjecture(
        "In every resonance of the continuous ball that is crossed with a twist some orbits have ∮X₃(H)dt ≠ 0.",
        "The small branch has, at a fixed small ε, no real analytic integral independent of |γ|, |𝒦|², ⟨𝒦,γ⟩; between the "
        "resonances there are invariant tori, on which the energy oscillates and does not drift (KAM, reversible).",
    )


MEASURED = (
    "The map itself, 160 bits, from the centres of the certificates, nε = 2T: (H(Φ^n x) - H(x))/ε² is -0.0053052, "
    "-0.0052390, -0.0052224 for n = 500, 1000, 2000 with J = (0, 1, 3), D = 4, against ∮X₃(H)dt = -0.0052169; and "
    "0.00178004, 0.00178030 for n = 500, 1000 with J = (1, 2, 4), D = 1, against 0.00178039.",
    "chapsym study energy, float64: H ranges by a part ∝ ε^2.00 of itself at generic starts (ε ≤ 0.1) and ∝ ε^(1.04 ± 0.03) "
    "in the widest resonances, where it swings as a pendulum does. Drift: (3 ± 5)e-13 of H in 1.6e7 steps at a generic start, "
    "(1.4 ± 25)e-5 in 5e6 steps in a resonance, ε = 0.1.",
    "chapsym study chaos, 128 orbits of 20000 steps: at random starts none is chaotic for ε ≤ 0.6; beside the unstable "
    "rotation 4% at ε = 0.3 and 90% at ε = 3 for J = (0, 1, 3), D = 1. D = 0, the control: none of 1233.",
)

if __name__ == "__main__":
    main(__file__)
