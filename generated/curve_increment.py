"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.8-modulus, 5.14-G, 5.14-Pi1.  Operations: 22.  SymPy 1.14.0.
Expression: sha256 f3b586d0fbf43c8ac702af5e26e704893ffb62928eda76c1c83ebf8e5dca4f1c.
Certificate of 5.8-modulus: sha256 c67c96f3fd821463ecb5f1742b20c27d050ba51c7b25bddeab3ef70b32c43161.
Certificate of 5.14-G: sha256 1d285e3130446acab46dab32e0c116687d9df67d4566c1b9ae01e8529f734f3e.
Certificate of 5.14-Pi1: sha256 a1af7a7ecf552ea863347187af4b704c0e6cefff08acb3405960ca011521aef1.
"""


def curve_increment(L1, L2, L3, l):
    """k², G = G0 + G1 sn² + G2 sn⁴ and μ of a curve: hG𝒟 = 2Vw(𝒟 - D(l - μ sn²)), V² = G0, at the half increment.

    ordered: L1, L2, L3
    inverse_square: l
    Returns k2, G0, G1, G2, mu.
    """
    # intermediate terms
    t0 = L1 * l
    t1 = t0 - 1
    t2 = L2 - L3
    t3 = (L3 * l - 1) / t2
    t4 = 1 / L2
    t5 = t4 / (L1 * L3)
    # outputs
    o_k2 = -t3 * (L1 - L2) / t1
    o_G0 = t1 * t2 * t5
    o_G1 = t5 * (t2 + 2 * L3 * t0 - L1)
    o_G2 = t3 * t4
    o_mu = -t3
    return o_k2, o_G0, o_G1, o_G2, o_mu
