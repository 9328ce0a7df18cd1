"""The principal axes of a ball whose tensor is not diagonal, in balls: what is given, and told, is in other axes."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from flint import acb_mat

from chapsym import generated

from ..levels.balls import unit
from ..levels.proved_root import TooWide
from ..principal_axes import quaternions

Numbers = tuple[Any, ...]
#: What turns no axes.
NO_TURN = (1, 0, 0, 0)


class Principal(NamedTuple):
    """Principal moments of ∫xxᵀdm, and the unit quaternion that turns principal axes to the given ones."""

    moments: Numbers
    turn: Numbers = NO_TURN

    def inward(self, vector: Sequence[Any]) -> Numbers:
        """A vector in principal axes, from the given ones."""
        return tuple(vector) if self.turn == NO_TURN else tuple(generated.transport(*self.turn, *vector))

    def given(self, frame: dict[str, Numbers]) -> dict[str, Numbers]:
        """A frame in the given axes, from principal ones."""
        if self.turn == NO_TURN:
            return frame
        found = {name: generated.rotate(*self.turn, *frame[name]) for name in ("gamma", "angular_momentum", "omega")}
        back = self.turn[0], *(-x for x in self.turn[1:])
        return frame | found | {"attitude": unit(generated.compose(*(*frame["attitude"], *back)))}


def principal(tensor: Sequence[Sequence[Any]]) -> Principal:
    """Of a symmetric matrix of balls; raises TooWide where they do not tell three different moments apart.

    An eigenvector of a real eigenvalue that is simple is a real one times a complex number, so its components divided
    by one of them are real.  The third axis is normal to two others.
    """
    if all(tensor[i][j] == 0 for i in range(3) for j in range(3) if i != j):
        return Principal(tuple(tensor[i][i] for i in range(3)))
    try:
        moments, vectors = acb_mat([list(row) for row in tensor]).eig(right=True)
    except ValueError:
        raise TooWide("the principal moments are not told apart") from None
    columns = []
    for j in range(2):
        v = [vectors[i, j] for i in range(3)]
        largest = max(v, key=lambda x: float(abs(x).mid()))
        columns.append(unit([(x / largest).real for x in v]))
    (a1, a2, a3), (b1, b2, b3) = columns
    columns.append((a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1))
    turn = tuple(quaternions(np.array(columns, dtype=object).T))
    found = Principal(tuple(x.real for x in moments), turn)
    if not all(x.is_finite() for x in (*found.moments, *found.turn)):
        raise TooWide("the principal moments are not told apart")
    return found
