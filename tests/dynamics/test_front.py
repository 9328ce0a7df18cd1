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


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((Q, GAMMA, J), r"momentum takes 4 arguments \(rotation, gamma, mass_tensor, D\), not 3"),
        ((Q[:3], GAMMA, J, 3), "rotation must have 4 components along its last axis, not the shape"),
        ((np.tile(Q, (2, 1)), np.tile(GAMMA, (3, 1)), J, 3), "do not broadcast: rotation"),
        ((Q, [1, np.nan, 0], J, 3), "gamma must be finite"),
    ],
)
def test_wrong_shapes_are_one_sentence(arguments, sentence):
    with pytest.raises(BadInput, match=sentence):
        kernels.momentum(*arguments)
