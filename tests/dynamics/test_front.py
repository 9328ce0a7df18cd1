"""The kernels on arrays: broadcasting, shapes, refusals."""

import numpy as np
import pytest

from chapsym import BadInput, generated
from chapsym.dynamics import kernels

Q = np.array([0.8, 0.4, 0.2, 0.4])
GAMMA = np.array([2, 3, 6]) / 7
J = np.array([1.0, 2.0, 4.0])


@pytest.mark.parametrize("name", generated.TABLE)
def test_every_kernel_has_a_front_of_its_shape(name):
    _, groups, shape = generated.TABLE[name]
    function = kernels.kernel(name)
    arrays = [np.ones(()) if g == "D" else np.linspace(0.1, 0.9, n) for g, n in groups]
    assert function(*arrays).shape == shape
    stacked = [np.broadcast_to(a, (5, 2, *a.shape)) for a in arrays]
    assert function(*stacked).shape == (5, 2, *shape)
    assert (function(*stacked)[3, 1] == function(*arrays)).all()


def test_leading_axes_broadcast():
    result = kernels.momentum(np.tile(Q, (4, 1, 1)), np.tile(GAMMA, (3, 1)), J, 3)
    assert result.shape == (4, 3, 3)
    assert (result[2, 1] == generated.momentum(*Q, *GAMMA, *J, 3.0)).all()


def test_long_arrays_have_the_bits_of_each_number_alone():
    """Three blocks, of which the last is not full; and a number that is the same for all."""
    rng = np.random.default_rng(7)
    q, gamma = rng.normal(size=(2 * kernels.BLOCK + 3, 4)), rng.normal(size=(2 * kernels.BLOCK + 3, 3))
    result = kernels.momentum(q, gamma, J, 3.0)
    for i in (0, kernels.BLOCK - 1, kernels.BLOCK, 2 * kernels.BLOCK + 2):
        assert (result[i] == generated.momentum(*q[i], *gamma[i], *J, 3.0)).all()
    assert kernels.energy(q[:, :3], gamma, J, 3.0).shape == (2 * kernels.BLOCK + 3,)


def test_a_group_of_one_number_stands_alone_where_nothing_else_is_said():
    spin = kernels.on_arrays(generated.TABLE["isotropic_spin"])
    assert spin(GAMMA, GAMMA, 2.0, np.array([1.0, 3.0])).shape == (2, 3)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((Q, GAMMA, J), r"momentum takes 4 arguments \(rotation, gamma, mass_tensor, D\), not 3"),
        ((Q[:3], GAMMA, J, 3), "rotation must have 4 components along its last axis, not the shape"),
        ((np.tile(Q, (2, 1)), np.tile(GAMMA, (3, 1)), J, 3), "do not broadcast: rotation"),
    ],
)
def test_wrong_shapes_are_one_sentence(arguments, sentence):
    with pytest.raises(BadInput, match=sentence):
        kernels.momentum(*arguments)
