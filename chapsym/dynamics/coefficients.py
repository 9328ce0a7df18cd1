"""Published coefficients of symmetric compositions of a self-adjoint step of order 2.

The map is self-adjoint (lemma `self-adjoint`), so Φ_{cₛε} ... Φ_{c₁ε} with c_{s+1-i} = c_i is self-adjoint, too, and
has the order 4, 6 or 8 (lemma `composition-order`).  Each set has 40 digits of a solution of the order conditions.
Suzuki's coefficients are algebraic numbers.  Kahan and Li's are published with 26 digits, and one parameter is free: c₁
is as published, and Newton's iteration refines the others from the published values.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from chapsym.numbers.precisions import is_whole

from .ball import Floats, brief
from .errors import BadInput


@dataclass(frozen=True)
class Composition:
    """A palindromic composition: its order, its source, and c₁ to the middle coefficient as decimal numbers."""

    order: int
    source: str
    half: tuple[str, ...]

    @property
    def exact(self) -> tuple[Fraction, ...]:
        """c₁, ..., cₛ as exact fractions of the decimal numbers."""
        half = tuple(map(Fraction, self.half))
        return half + half[-2::-1]

    @cached_property
    def stages(self) -> Floats:
        """c₁, ..., cₛ, each the nearest float64, shape (s,)."""
        stages = np.array([float(c) for c in self.exact])
        stages.flags.writeable = False
        return stages


COMPOSITIONS = {
    composition.order: composition
    for composition in (
        Composition(2, "the map itself", ("1",)),
        Composition(
            4,
            "M. Suzuki, Phys. Lett. A 146 (1990) 319: 1/(4 - 4^(1/3)) twice, and 1 - 4/(4 - 4^(1/3))",
            (
                "0.4144907717943757371423540628607614957118",
                "0.4144907717943757371423540628607614957118",
                "-0.6579630871775029485694162514430459828471",
            ),
        ),
        Composition(
            6,
            "W. Kahan and R.-C. Li, Math. Comp. 66 (1997) 1089: s9odr6a",
            (
                "0.3921614440073141392792505600000000000000",
                "0.3325991367893594385997486342572743557373",
                "-0.7062461725576393598099648196349103510393",
                "0.0822135962935508002314904488531569176963",
                "0.7985439909348299633989503530489581552114",
            ),
        ),
        Composition(
            8,
            "W. Kahan and R.-C. Li, Math. Comp. 66 (1997) 1089: s17odr8a",
            (
                "0.1302024830888900808788176300000000000000",
                "0.5611629817751083845619644076820001026499",
                "-0.3894749626448472864080785930431669971285",
                "0.1588419065551556008962107466776823932135",
                "-0.3959038941332375773362315434661316714524",
                "0.1845396409783157070918325433640865161750",
                "0.2583743876863220472939791116954259737026",
                "0.2950117236093102988709662367574629766213",
                "-0.6055085338300345116989210793347185875626",
            ),
        ),
    )
}


def substeps(order: int) -> Floats:
    """The stage coefficients cᵢ of a symmetric composition of the map.

    Parameters
    ----------
    order : int
        2, 4, 6 or 8.

    Returns
    -------
    numpy.ndarray
        c₁, ..., cₛ, shape (1,), (5,), (9,) or (17,); read-only.

    Raises
    ------
    BadInput
        For any other order.

    References
    ----------
    Order 4: M. Suzuki, Phys. Lett. A 146 (1990) 319.
    Orders 6 and 8: W. Kahan and R.-C. Li, Math. Comp. 66 (1997) 1089, s9odr6a and s17odr8a.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.substeps(4).round(6).tolist()
    [0.414491, 0.414491, -0.657963, 0.414491, 0.414491]
    """
    if not is_whole(order) or int(order) not in COMPOSITIONS:
        raise BadInput(f"order must be one of {', '.join(map(str, COMPOSITIONS))}, not {brief(order)}")
    return COMPOSITIONS[int(order)].stages
