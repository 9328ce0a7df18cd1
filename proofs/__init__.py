"""One script per group of claims, named by section and subject; each runs alone."""

#: The scripts, in the order of the paper.
SCRIPTS = (
    "paper.s2_continuous", "paper.s2_every_n", "paper.s2_classical", "paper.s2_inertia",
    "paper.s3_discrete_mechanics", "paper.s3_regularity",
    "paper.s4_principle", "paper.s4_constraint", "paper.s4_momentum", "paper.s4_intertwining", "paper.s4_limits",
    "paper.s5_rotation", "paper.s5_solutions", "paper.s5_vertical", "paper.s5_symmetric_form", "paper.s5_elliptic",
    "paper.s5_increment", "paper.s5_reduced_map",
    "paper.s6_remarks",
    "open.chord", "open.resonance", "open.generic", "open.locking", "open.measure", "open.energy",
    "map.chaplygin", "map.gibbs", "map.gyrostat", "map.gyrostat_map", "map.modified", "map.order", "map.rounding",
    "map.self_adjoint", "map.stable", "map.steady", "map.symmetries", "map.vertical",
    "open.orbits", "open.volume", "open.separatrix", "open.splitting", "open.melnikov",
)  # fmt: skip

#: The claims of the paper that need a verdict, in the order of the paper; each has a proof in one of the scripts.
CLAIMS = (
    "2.1", "2.2", "2.2-F", "2.3", "2.4", "2.4-kinetic", "2.5-inverse", "2.5", "2.6", "2.7-vertical", "2.7",
    "2.7-integrals", "2.9", "2.10", "2.11", "2.11-force", "2.11-eliminated", "2.12", "2.13", "2.14", "2.15",
    "2.15-measure", "2.15-so3", "3.3-energy", "3.4-principle", "3.5", "remark-1", "remark-2", "4.1", "4.2", "4.3",
    "4.4", "4.5", "4.6", "4.6-body", "4.6-limit", "4.6-frame", "4.7", "4.8", "4.9-naive", "4.9", "4.9-limit",
    "4.9-f", "4.9-F", "4.9-wedge", "4.10", "4.11", "prop-1", "prop-1-proof", "4.13-limit", "4.13-multivalued",
    "prop-2", "remark-3", "4.14", "5.1", "5.1-angle", "5.2", "5.2-expansion", "5.2-limit", "5.3", "5.3-at-most-4",
    "5.3-at-least-2", "5.3-small", "5.3-integrals", "5.3-energy", "5.4", "prop-3", "5.6-sigma", "5.6", "5.6-curve",
    "5.7", "5.8", "5.8-modulus", "5.9", "remark-4", "5.9-liouville", "5.9-circle", "5.9-open", "prop-4", "5.11",
    "5.12", "5.12-kappa", "5.12-q0", "5.12-sigma", "5.12-scaling", "5.13", "5.13-V", "5.14", "5.14-Pi1", "5.14-Pi2",
    "5.14-G", "5.14-alpha", "5.14-beta", "5.15", "5.15-euler", "5.16", "5.16-weierstrass-e", "5.16-weierstrass-w",
    "5.16-integral", "6-vertical-energy", "6-LR", "6-open",
)  # fmt: skip

#: Lemmas that the paper does not state and chapsym needs: judged like the claims, by name, outside the register.
LEMMAS = (
    "gibbs", "gibbs-newton", "gibbs-rotation", "small-branch", "straight-path", "state-error", "step-bound", "rounding",
    "self-adjoint", "reversible",
    "momentum-integrals-composed", "composition-order", "vertical-rotation", "vertical-level", "vertical-top", "top-commutes", "top-precession",
    "stable-momentum", "stable-determinant", "stable-inverse", "steady", "steady-branch", "steady-axis", "steady-roll",
    "isotropic-spin", "straight", "symmetries", "chord", "resonance", "plateaus", "almost-every", "locked-circle",
    "modified-field", "modified-energy", "energy-without-rolling", "modified-measure", "map-symmetries",
    "step-determinant", "steady-circles", "periodic-orbits", "measure-iff",
    "separatrix-map", "separatrix-limit", "separatrix", "melnikov", "energy-orbits",
    "gyrostat-rotor", "gyrostat-motion", "gyrostat-integrals", "gyrostat-measure",
    "gyrostat-map", "gyrostat-map-integrals", "gyrostat-self-adjoint", "gyrostat-energy", "gyrostat-map-measure",
    "chaplygin-reduction", "chaplygin-separation", "chaplygin-theta", "euler-top",
)  # fmt: skip
