"""One script per group of claims, named by section and subject; each runs alone."""

#: In the order of the paper.
SCRIPTS = (
    "s2_continuous",
    "s2_every_n",
    "s2_classical",
    "s2_inertia",
    "s3_discrete_mechanics",
    "s3_regularity",
    "s4_principle",
    "s4_constraint",
    "s4_momentum",
    "s4_intertwining",
    "s4_limits",
    "s5_rotation",
    "s5_solutions",
    "s5_vertical",
    "s5_symmetric_form",
    "s5_elliptic",
    "s5_increment",
    "s5_reduced_map",
    "s6_remarks",
)
