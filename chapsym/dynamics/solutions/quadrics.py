"""(5.2) as three quadrics in P³: 𝒦(q, γ) - 𝒦(q0² + |q|²), their coefficients read off the momentum kernel.

A rotation is a real point (q0, q1, q2, q3) up to a factor.  The numbers are whatever the kernel takes: fmpq, arrays.
"""

import itertools
from collections.abc import Sequence
from typing import Any

from chapsym.generated import momentum

#: A quadratic form: the coefficient of x_a x_b under (a, b), a ≤ b.
Quadric = dict[tuple[int, int], Any]

PAIRS = tuple(itertools.combinations_with_replacement(range(4), 2))


def momentum_forms(gamma: Sequence[Any], mass_tensor: Sequence[Any], D: Any) -> list[Quadric]:
    """𝒦₁, 𝒦₂, 𝒦₃ as quadratic forms in (q0, q1, q2, q3), by polarisation."""

    def value(*indices: int) -> tuple[Any, ...]:
        return momentum(*(*(int(v in indices) for v in range(4)), *gamma, *mass_tensor, D))

    single = [value(a) for a in range(4)]
    forms: list[Quadric] = [{}, {}, {}]
    for a, b in PAIRS:
        both = value(a, b)
        for i, form in enumerate(forms):
            form[a, b] = single[a][i] if a == b else both[i] - single[a][i] - single[b][i]
    return forms


def quadrics(
    momentum: Sequence[Any], gamma: Sequence[Any], mass_tensor: Sequence[Any], D: Any
) -> tuple[Quadric, Quadric, Quadric]:
    """𝒦(q, γ) - 𝒦(q0² + |q|²), whose real zeros are the rotations with the momentum 𝒦."""
    first, second, third = (
        {(a, b): c - k if a == b else c for (a, b), c in form.items()}
        for form, k in zip(momentum_forms(gamma, mass_tensor, D), momentum, strict=True)
    )
    return first, second, third
