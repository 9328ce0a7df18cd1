"""Section 4: the continuum limits, for every n, with the order and leading term of each remainder."""

import sympy as sp

from chapsym.derive import ball, limits
from chapsym.derive.ball import ALGEBRA, D, Gamma, J, omega
from chapsym.derive.motion import commutator
from chapsym.derive.words import unfolded
from chapsym.proofs.examples import EXAMPLES
from chapsym.proofs.glossary import Symbols
from chapsym.prove import Comparison, Proof, claim, equations, main

equation = equations(ALGEBRA)


def symbols() -> Symbols:
    """The symbols of the continuous ball, in the letters of one step."""
    return {
        "J": (J, "the mass tensor, diagonal (4.1)"),
        "D": (D, "mρ² (4.13)"),
        r"\omega": (omega, "the skew ω of the step exp(εω)"),
        r"\Gamma": (Gamma, "γγᵀ (2.12)"),
    }


def show(p: Proof, name: str, remainder: limits.Remainder) -> None:
    """Shows the limit, the order and the leading term in the evidence."""
    limit, leading = unfolded(remainder.limit), unfolded(remainder.leading)
    p.show(name, f"({limit}) + ε^{remainder.order}·({leading}) + ...")


def exact_order(name: str, remainder: limits.Remainder, order: int = 1, less: int = 0) -> Comparison:
    """The statement that a remainder, divided by ε^less, has this order: its leading term is not 0 at a point."""
    found, term = sp.Integer(remainder.order + less), remainder.leading
    vector = isinstance(term, sp.MatrixBase)
    term = term.applyfunc(unfolded) if vector else unfolded(term)
    vanishing = sp.Eq(term.dot(term), 0) if vector else sp.Eq(term, 0)
    return Comparison(
        f"{name} has the exact order {order}, here {found}, and its leading term is not 0",
        [sp.Eq(found, order, evaluate=False), sp.Not(vanishing)],
        EXAMPLES.of(term.free_symbols),
    )


@claim(
    "4.6-limit",
    r"\text{for } \Omega_k\mapsto I+\varepsilon\omega:\ M_k \text{ transforms to } M,\ M = J\omega+\omega J",
    uses=["4.7"],
)
def centre_limit(p: Proof) -> None:
    """M/ε → Jω + ωJ, with a remainder of the exact order 1."""
    p.assume("Ω_k = exp(ε ω) with ω skew: Ω = 1 + εω + O(ε²)")
    p.assume("read as M/ε, as the paper itself writes for 𝒦 after (4.13): M alone tends to 0")
    m = limits.centre_momentum()
    p.reads(symbols() | {"M": (m.limit, "what M_k/ε tends to, by the derivation")})
    show(p, "M/ε", m)
    p.lemma(equation("M has no part without ε", m.constant, 0))
    p.printed(equation("M/ε → Jω + ωJ", m.limit, J * omega + omega * J))
    p.lemma(equation("the leading remainder is ½[ω², J]", m.leading, commutator(omega**2, J) / 2))
    p.lemma(exact_order("the remainder", m))
    p.control(equation("M/ε → Jω - ωJ", m.limit, J * omega - omega * J))


@claim(
    "4.13-limit",
    r"\mathcal K/\varepsilon \to \mathbf K,\ \mathbf K = J\omega+\omega J+D(\Gamma\omega+\omega\Gamma),\ "
    r"\text{and (4.12) transforms to}:\ \dot{\mathbf K}+[\omega,\mathbf K]=0,\ \dot\Gamma+[\omega,\Gamma]=0",
    uses=["prop-1"],
)
def momentum_limit(p: Proof) -> None:
    """𝒦/ε → 2.13 and (4.12) → 2.12, for every n; each remainder has the exact order 1."""
    p.assume("Ω_k = exp(ε ω) with ω skew: Ω = 1 + εω + O(ε²)")
    momentum = limits.momentum()
    show(p, "𝒦/ε", momentum)
    p.lemma(equation("𝒦 has no part without ε", momentum.constant, 0))
    centre, contact = J * omega + omega * J, D * (Gamma * omega + omega * Gamma)
    p.printed(equation("𝒦/ε → Jω + ωJ + D(Γω + ωΓ)", momentum.limit, centre + contact))
    p.lemma(exact_order("the remainder of 𝒦/ε", momentum))
    p.lemma(equation("its leading term is ½[ω², J], without D", momentum.leading, commutator(omega**2, J) / 2))
    whole = centre + contact
    moving = {name: limits.transport(name, tensor) for name, tensor in (("K_contact", whole), ("Gamma", Gamma))}
    p.reads(
        symbols(),
        (r"\mathcal K/\varepsilon", momentum.limit, "what it tends to, by the derivation"),
        (r"\mathbf K", whole, "Jω + ωJ + D(Γω + ωΓ) (2.13)"),
        (r"\dot{\mathbf K}", moving["K_contact"].limit, "what (ΩᵀKΩ - K)/ε tends to (4.12), by the derivation"),
        (r"\dot\Gamma", moving["Gamma"].limit, "what (ΩᵀΓΩ - Γ)/ε tends to (4.12), by the derivation"),
    )
    for name, tensor, moved in (("K", whole, moving["K_contact"]), ("Γ", Gamma, moving["Gamma"])):
        show(p, f"(Ωᵀ{name}Ω - {name})/ε", moved)
        turned = commutator(omega, tensor)
        p.lemma(equation(f"Ωᵀ{name}Ω - {name} has no part without ε", moved.constant, 0))
        p.printed(equation(f"(Ωᵀ{name}Ω - {name})/ε + [ω, {name}] → 0", moved.limit + turned, 0))
        p.lemma(exact_order("its remainder", moved))
        p.lemma(equation(f"its leading term is ½[ω, [ω, {name}]]", moved.leading, commutator(omega, turned) / 2))
    p.control(
        equation("𝒦/ε → Jω + ωJ - D(Γω + ωΓ)", momentum.limit, centre - contact),
        equation("𝒦/ε → the same with D/2", momentum.limit, centre + contact / 2),
        equation("K̇ = +[ω, K]", moving["K_contact"].limit, commutator(omega, whole)),
        equation("the leading remainder is 0", ball.ALGEBRA.normal(momentum.leading), 0),
    )


if __name__ == "__main__":
    main(__file__)
