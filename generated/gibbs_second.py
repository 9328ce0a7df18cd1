"""The correction after a Newton correction d, by the same inverse: -(∂G/∂u)⁻¹(d × Id - |d|²k).

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: gibbs-newton.  Operations: 44.  SymPy 1.14.0.
Expression: sha256 f46c965958894d29fa1490770cf19e637cbde7afe4f383647a12ef96431d78f4.
"""


def gibbs_second(d1, d2, d3, k1, k2, k3, i11, i12, i13, i21, i22, i23, i31, i32, i33, I1, I2, I3):
    """The correction after a Newton correction d, by the same inverse: -(∂G/∂u)⁻¹(d × Id - |d|²k).

    correction: d1, d2, d3
    half_momentum: k1, k2, k3
    inverse: i11, i12, i13, i21, i22, i23, i31, i32, i33
    inertia: I1, I2, I3
    Returns e1, e2, e3.
    """
    # intermediate terms
    t0 = d1 * d1 + d2 * d2 + d3 * d3
    r1 = I3 * d2 * d3 - k1 * t0 - I2 * d2 * d3
    r2 = I1 * d1 * d3 - k2 * t0 - I3 * d1 * d3
    r3 = I2 * d1 * d2 - k3 * t0 - I1 * d1 * d2
    # outputs
    o_e1 = -i11 * r1 - i12 * r2 - i13 * r3
    o_e2 = -i21 * r1 - i22 * r2 - i23 * r3
    o_e3 = -i31 * r1 - i32 * r2 - i33 * r3
    return o_e1, o_e2, o_e3
