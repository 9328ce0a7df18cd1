"""What integrations in the tests take of two vectors: np.cross of three numbers takes twenty times as long."""

import numpy as np


def cross(a, b):
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
