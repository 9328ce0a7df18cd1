"""The displacement of a certificate by the relation (5.15) on the elliptic curve, to any digits: a second route."""

from flint import arb

from chapsym.dynamics.levels.start import fraction
from chapsym.studies.rotation.circle import Level
from chapsym.studies.rotation.relation import Relation


def displacement(top, level, zero, steps, half_turns):
    """δ: s(-1)^p(γ_a⁰γ_b^q - γ_b⁰γ_a^q) with γ by Jacobi's functions."""
    on = Level(top.J, top.D, abs(top.height), level)
    relation, start = Relation(on), on.K if zero == "a" else arb(0)
    u = start
    for _ in range(steps):
        u = (u + relation.increment(u)).mid()
    (sn0, cn0, _), (sn, cn, _) = on.jacobi(start), on.jacobi(u)
    return fraction((-1) ** half_turns * on.amplitudes[0] * abs(on.amplitudes[1]) * (cn0 * sn - sn0 * cn))
