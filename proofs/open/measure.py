"""The open question of Section 5: finite measures with a positive density, for D > 0, in six cases."""

import sympy as sp

from chapsym.checker.document import Data
from chapsym.derive.gibbs import I1, I2
from chapsym.derive.quotient import Quotient
from chapsym.proofs.map import gibbs, self_adjoint, symmetries
from chapsym.proofs.map.gibbs import FREE
from chapsym.proofs.map.symmetries import carried
from chapsym.proofs.open import certified, chord, generic, locking, readings, resonance, separatrix, splitting, terms
from chapsym.prove import Equation, Proof, Theorem, claim, judged, main, there_is
from chapsym.prove import no as no_such

KIND, HETEROCLINIC = "no-invariant-measure", "heteroclinic"
FILES, ENDS = certified.files(KIND), certified.files(HETEROCLINIC)
#: The lemmas that the argument uses, besides claims of the paper; they are proved again with it.
LEMMAS = {
    "small-branch": gibbs, "self-adjoint": self_adjoint, "symmetries": symmetries, "chord": chord,
    "resonance": resonance, "plateaus": resonance, "almost-every": generic,
    "locked-circle": locking,
    "reversible": self_adjoint, "separatrix-map": separatrix, "separatrix-limit": separatrix, "separatrix": splitting,
}  # fmt: skip

WITHIN = "for all J, D, h within the radii of the certificates measure-* without a branch"
WITHIN_BEYOND = "for all J, D, h within the radii of the certificates with a branch"
WITHIN_ENDS = "for all J, D, h within the radii of the certificates heteroclinic-*"
FLAT, ROUND = "D = 0", "two of I1, I2, I3 are equal"


def about_the_axis(swap: bool = False) -> list[Equation]:
    """For I1 = I2 every rotation about e₃ commutes with the step; the argument leaves I2 free."""
    c, s = sp.symbols("c s")
    turn = sp.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    ring = Quotient((c, s, *FREE.symbols), [c**2 + s**2 - 1])
    equal = {} if swap else {I2: I1}
    return [
        Equation(
            e.text, [sp.sympify(x).subs(equal) for x in e.left], [sp.sympify(x).subs(equal) for x in e.right], ring
        )
        for e in carried("I1 = I2, a rotation about e₃" if not swap else "the same with I2 free", turn, turn, turn)[:2]
    ]


def yes(p: Proof) -> None:
    """The cases with an invariant measure."""
    p.state(
        Theorem((), (FLAT, terms.THREE, terms.SMALL_BRANCH), (there_is(terms.PARAMETER), there_is(terms.MEASURE))),
        readings.FLAT,
    )
    p.say("Yes for D = 0: the increment of u is constant on every curve (5.15-euler), so s = u will do.")
    p.say(
        "That is for l > 1/Λ2; for l < 1/Λ2 exchange 1 and 3: the map is the inverse of the renamed ball's (symmetries)."
    )
    p.step(there_is(terms.PARAMETER), FLAT, terms.THREE, terms.SMALL_BRANCH, "5.15-euler", "symmetries")
    p.say("So du is invariant on every curve, and as dA = c(l)/2 dl du (5.9-liouville), so is the area dA.")
    p.step(there_is(terms.MEASURE), there_is(terms.PARAMETER), "5.9-liouville")
    p.state(Theorem((), (ROUND, terms.SMALL_BRANCH), (there_is(terms.MEASURE),)), readings.ROUND)
    p.say("Yes for two equal moments, say I1 = I2: G_h commutes with the rotations about e₃,")
    for statement in about_the_axis():
        p.lemma(statement)
    p.say("and keeps l = (1 - γ₃²)/Λ1 + γ₃²/Λ3, so the circles of latitude, each of which it turns: dA is invariant.")
    p.say("(If all three are equal it commutes with every rotation, those about γ among them: it fixes γ.)")
    p.step(there_is(terms.MEASURE), ROUND, terms.SMALL_BRANCH, "prop-3")
    p.control(about_the_axis(swap=True)[0])


def no(p: Proof) -> None:
    """The theorems on cases without an invariant measure."""
    p.say("No, for three different moments and the h and D of (1) to (5). What is used is proved anew:")
    for id in LEMMAS:
        p.lemma(judged(id))
    p.say(
        "(1) By plateaus, (2) by almost-every, (4) by separatrix there is an interval of levels with displacements of both signs. By",
        "locked-circle the finite invariant measures are carried there by periodic points: none has a density that is",
        "positive almost everywhere.",
    )
    p.state(Theorem((WITHIN,), (terms.SMALL_BRANCH,), (terms.BOTH_SIGNS,)), readings.BOXES)
    p.say("(3) For numbers at hand two orbits, in interval arithmetic, one beyond and one short of p half turns:")
    accepted = [data for data in certified.present(p, FILES, KIND) if "branch" not in data]
    p.say("The radius says how far J, D, h and l may be off: there is an interval of levels for every J, D, h of the")
    p.say("box, to which locked-circle applies.")
    p.step(
        terms.BOTH_SIGNS, WITHIN, terms.SMALL_BRANCH, *(file.name for file in FILES if not certified.has_branch(file))
    )
    ends(p)
    beyond(p)
    if accepted:
        tampered(p, accepted[0])


def beyond(p: Proof) -> None:
    """The certificates that also prove the branch."""
    p.state(Theorem((WITHIN_BEYOND,), (terms.ON_BRANCH,), (no_such(terms.NEAR_A_CIRCLE),)), readings.BEYOND)
    p.say(
        "(6) Beyond the bound of small-branch a certificate also says into how many arcs a half circle is cut, and the",
        "checker proves one root in a box over each, joined to one branch whose map is a homeomorphism of the circle",
        "that keeps the direction and commutes with the rotation by π about its axis. As each root is simple, the map is",
        "analytic, and so for the levels, J, D and h within the radius. With the two orbits 2., 3. and 5. of",
        "locked-circle hold as they stand, for the half γ_c > 0: they use no more of the map.",
    )
    p.step(no_such(terms.NEAR_A_CIRCLE), WITHIN_BEYOND, terms.ON_BRANCH, "locked-circle",
           *(file.name for file in FILES if certified.has_branch(file)))  # fmt: skip


def ends(p: Proof) -> None:
    """The certificates of offsets at the ends of orbits on the level l = 1/Λ2."""
    p.state(Theorem((WITHIN_ENDS,), (terms.SMALL_BRANCH,), (terms.NOT_CONSTANT,)), readings.ENDS)
    p.say(
        "(5) For numbers at hand two orbits of the map of separatrix-map have different Δ(u), in interval arithmetic: Δ is",
        "not constant. There I1 > I2 > I3, so by separatrix-limit there are levels near 1/Λ2 with displacements of both",
        "signs. No small D is left out or assumed: it is one ball and one h, with all within the radius.",
    )
    accepted = certified.present(p, ENDS, HETEROCLINIC)
    p.step(terms.NOT_CONSTANT, WITHIN_ENDS, terms.SMALL_BRANCH, "separatrix-map", *(file.name for file in ENDS))
    if accepted:
        data = accepted[0]
        for text, place, value in (
            ("the last digit of an end", ("orbits", 1, "end"), certified.other_digit(data["orbits"][1]["end"])),
            ("fewer steps", ("orbits", 0, "steps"), data["orbits"][0]["steps"] // 2),
            ("D = 1/1000000", ("ball", "D"), "1/1000000"),
        ):
            p.control(certified.changed(f"the certificate of the ends with {text}", data, place, value))


def tampered(p: Proof, data: Data) -> None:
    """Controls: the certificate with one number changed and a new digest."""
    first = data["orbits"][0]
    middle = data["steps"] // 2
    sign = first["displacement"].removeprefix("-") if first["displacement"][0] == "-" else "-" + first["displacement"]
    level = data["ball"]["level"]
    for text, place, value in (
        ("the level in its 5th decimal", ("ball", "level"), certified.other_digit(level, level.index(".") + 5)),
        ("a half turn more", ("half_turns",), data["half_turns"] + 1),
        ("the other sign of a displacement", ("orbits", 0, "displacement"), sign),
        ("the last digit of a Gibbs vector", ("orbits", 1, "steps", middle, "u", 0),
         certified.other_digit(data["orbits"][1]["steps"][middle]["u"][0])),
        ("D = 0", ("ball", "D"), "0"),
    ):  # fmt: skip
        p.control(certified.changed(f"the certificate of {data['steps']} steps with {text}", data, place, value))


@claim(
    "5.9-open",
    r"\text{does } \mathcal G_h \text{ preserve an invariant measure? (open in the paper)}",
    ["5.9-liouville", "5.9", "5.9-circle", "5.15", "5.15-euler", "prop-3", *LEMMAS],
    files=(*FILES, *ENDS),
)
def invariant_measure_question(p: Proof) -> None:
    """No finite measure with a density that is positive almost everywhere is invariant, for D > 0, in six cases."""
    p.ask(*readings.QUESTIONS["5.9-open"])
    p.assume("the small branch, |h| below the bound of small-branch")
    p.assume(
        "a measure in the sense of the paper, with a density that is positive; finite, as one with a continuous density is"
    )
    yes(p)
    no(p)
    p.settle(readings.READINGS["5.9-open"])
    p.measure(
        "The second order of resonance against the map, 110 digits: Λ = (6, 5, 3), l = 1/4, q = 5, p = 1, h ≈ 3.839 such "
        "that the displacement is 0 at γ2 = 0 (beyond the bound of small-branch, on the root continued from h = 0): at "
        "γ1 = 0 it is 1.6545129995e-19 for D = 1e-6, where 2A''D²(f(0) - f(K/q)) is "
        "1.6545253392e-19; the ratio is 1 - 7.46 D.",
        "J = (1, 2, 4), h = 12/5: certificates were found, and accepted by the checker, for D = 1/1000, 1/100, 1/10, 1/2, "
        "1, 2, 5, 7, 10 and 20, with q = 9, 9, 9, 9, 9, 11, 15, 17, 21 and 33 and displacements between 9e-24 and 6e-134.",
        "With q = 11 the displacement at γ1 = 0 is positive at D = 1/10 and 1 (4e-24, 8e-27), negative at D = 3/2 and 2 "
        "(-1e-29, -1e-31), positive at D = 3 (8e-51): it vanishes at two D between, where 2q is to be looked at.",
    )
    p.conjecture(
        "With three different moments and D > 0 there is no h ≠ 0 at all, |h| below the bound of small-branch, for which "
        "G_h preserves a finite measure with a density that is positive almost everywhere.",
        "For D small the levels without such displacements have positive measure, as for families of circle maps near "
        "rotations (Arnold, Herman): then there are invariant densities that are positive on these levels only.",
    )


if __name__ == "__main__":
    main(__file__)
