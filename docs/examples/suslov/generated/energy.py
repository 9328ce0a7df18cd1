"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: S-energy.  Operations: 7.  SymPy 1.14.0.
Expression: sha256 898461e49c46a2816e77c741d4acc0be16f890857565be90e168da1cb8b9a965.
Certificate of S-energy: sha256 9d5ffbe240b2de0d673b42636233bc2e16606260410ffdaf55ad82b2776465bb.
"""


def energy(M1, M2, J1, J2, J3, J13, J23):
    """The energy of a momentum, which the map keeps.

    momentum: M1, M2
    mass_tensor: J1, J2, J3, J13, J23
    Returns e.
    """
    # outputs
    o_e = M1 * M1 / (J2 + J3) + M2 * M2 / (J1 + J3)
    return o_e
