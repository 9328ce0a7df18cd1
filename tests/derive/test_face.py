"""What `chapsym.derive` offers by itself: documented, and what the kernels of the same names compute."""

import pytest
import sympy as sp

from chapsym import derive, generated

#: q0, q1, ... and so on at rational numbers; a rational unit vector, as some forms use that it is one.
VALUES = {
    "q0": 4, "q1": 2, "q2": 1, "q3": 2, "g1": "2/7", "g2": "3/7", "g3": "6/7", "J1": 1, "J2": 2, "J3": 4, "D": 3,
    "K1": 1, "K2": "-1/2", "K3": "3/4",
}  # fmt: skip


def test_what_is_exported_is_there_and_documented():
    assert derive.__all__ == sorted(derive.__all__)
    for name in derive.__all__:
        assert getattr(derive, name).__doc__, name


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("momentum", "q0 q1 q2 q3 g1 g2 g3 J1 J2 J3 D"),
        ("rotation", "q0 q1 q2 q3"),
        ("angular_velocity", "K1 K2 K3 g1 g2 g3 J1 J2 J3 D"),
    ],
)
def test_it_is_what_the_kernel_computes(name, arguments):
    exact = {x: sp.Rational(value) for x, value in VALUES.items()}
    derived = sp.Matrix(getattr(derive, name)())
    assert {x.name for x in derived.free_symbols} == set(arguments.split())
    found = derived.xreplace({x: exact[x.name] for x in derived.free_symbols})
    assert [*found] == list(getattr(generated, name)(*(exact[x] for x in arguments.split())))
