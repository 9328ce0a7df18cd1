"""The outputs of scenes: unit, size, columns and derivation of each, in one record of `OUTPUTS`."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import prod

from . import kernels
from .ball import Floats
from .n.ball_n import invariants_n

#: K = 𝒦/ε in kg m²/s.  An output depends on ε only through K, so an output derived from K needs a run with times.  K is
#: the same quantity for the motion and the map, 𝒦 is `discrete_momentum`; `momentum` is K or 𝒦.
K = "angular_momentum"
#: The suffixes of the companions of a column: its part beyond float64, and a bound of its error.
LOW, BOUND = "_low", "_bound"


@dataclass(frozen=True)
class Output:
    """long_name, units (in n dimensions): for the map, as in files; motion: both for the motion.

    dims: besides ball and frame; dims_n: the same in more than three dimensions, None if not available there.
    derive: its values from J, D and its `needs`, other outputs or `K`; `with_D` are those that enter only with D.
    Without `derive` it is a column of the models.  kernels: the generated kernels that `derive` evaluates.
    per_ball: one value per ball, not per frame.  radius: whether the ball must have a radius.
    """

    long_name: str
    units: str | Callable[[int], str]
    dims: tuple[str, ...] = ()
    dims_n: tuple[str, ...] | None = None
    needs: frozenset[str] = frozenset()
    with_D: frozenset[str] = frozenset()
    derive: Callable[[Floats, Floats, Mapping[str, Floats]], Floats] | None = None
    kernels: tuple[str, ...] = ()
    per_ball: bool = False
    radius: bool = False
    motion: tuple[str, str] | None = None

    def dims_in(self, n: int) -> tuple[str, ...]:
        """The dimensions, other than ball and frame, in n dimensions."""
        return self.dims if n == 3 or self.dims_n is None else self.dims_n

    def width(self, n: int) -> int:
        """The number of its values in one frame of one ball in n dimensions."""
        return prod(len(labels(n)[dim]) for dim in self.dims_in(n))

    def attrs(self, n: int, motion: bool, name: str = "") -> dict[str, str]:
        """The units and the name in a result, for the motion of the ball or for the map; or those of its low part or
        bound.

        name: its own name with the suffix `LOW` or `BOUND`.
        """
        found = {"units": self.units if isinstance(self.units, str) else self.units(n), "long_name": self.long_name}
        if motion and self.motion is not None:
            found = dict(zip(("long_name", "units"), self.motion, strict=True))
        both = "a proved bound of the length of its error (of the sum with what it has beyond float64, if that is here)"
        more = {LOW: "what it has beyond float64", BOUND: both}
        ends = [about for end, about in more.items() if name.endswith(end)]
        return found | {"long_name": ": ".join([found["long_name"], *ends])}


def labels(n: int) -> dict[str, list[str]]:
    """The names of the components along each dimension, in n dimensions; vectors count from 1, as in the paper."""
    numbered = [str(i) for i in range(1, n + 1)]
    plane = ["x", "y"] if n == 3 else numbered[:-1]
    return {
        "axis": numbered, "plane": plane, "quaternion": list("wxyz"), "integral": list(_integrals(n)),
        "row": numbered, "column": numbered,
    }  # fmt: skip


def _integrals(n: int) -> dict[str, str]:
    """The momentum integrals in the order of `invariants` and `invariants_n`, each with its units."""
    if n == 3:
        return {"K.gamma": "kg m2", "K.K": "kg2 m4", "gamma.gamma": "1"}
    found = {f"tr K^{2 * j}": f"kg{2 * j} m{4 * j}" for j in range(1, n // 2 + 1)}
    found |= {f"gamma.K^{2 * j}.gamma": f"kg{2 * j} m{4 * j}" for j in range(1, (n - 1) // 2 + 1)}
    return found | {"gamma.gamma": "1"}


def _invariants(J: Floats, D: Floats, given: Mapping[str, Floats]) -> Floats:
    """The momentum integrals, which the map keeps (Proposition 2)."""
    of = kernels.invariants if J.shape[-1] == 3 else invariants_n
    return of(given["momentum"], given["gamma"])


_MATRIX = ("row", "column")
_GAMMA = frozenset({"gamma"})
_STATE = _GAMMA | {"momentum"}

OUTPUTS: dict[str, Output] = {
    "momentum": Output(
        "discrete momentum 𝒦, body axes", "kg m2", ("axis",), _MATRIX,
        motion=("angular momentum K about the contact point, body axes", "kg m2 s-1"),
    ),
    "gamma": Output("vertical γ, upwards, body axes", "1", ("axis",), ("axis",)),
    "omega": Output(
        "angular velocity ω, body axes", "rad s-1", ("axis",),
        needs=_GAMMA | {K}, with_D=_GAMMA, kernels=("angular_velocity",),
        derive=lambda J, D, given: kernels.angular_velocity(given[K], given["gamma"], J, D),
    ),
    "attitude": Output("attitude, body axes to space", "1", ("quaternion",), _MATRIX),
    "contact": Output("contact point", "m", ("plane",), ("plane",), radius=True),
    "energy": Output(
        "kinetic energy", "J", needs=_GAMMA | {K}, with_D=_GAMMA, kernels=("energy",),
        derive=lambda J, D, given: kernels.kinetic_energy(given[K], given["gamma"], J, D),
    ),
    "angular_momentum": Output(
        "angular momentum K about the contact point, body axes", "kg m2 s-1", ("axis",), _MATRIX,
        needs=frozenset({K}), derive=lambda J, D, given: given[K],
    ),
    "discrete_momentum": Output(
        "discrete momentum 𝒦, body axes", "kg m2", ("axis",), _MATRIX,
        needs=frozenset({"momentum"}), derive=lambda J, D, given: given["momentum"],
    ),
    "integrals": Output(
        "momentum integrals", lambda n: ", ".join(_integrals(n).values()), ("integral",), ("integral",),
        needs=_STATE, derive=_invariants, kernels=("invariants",),
        motion=("momentum integrals", "kg m2 s-1, kg2 m4 s-2, 1"),
    ),
    "vertical_momentum": Output(
        "vertical momentum ⟨𝒦,γ⟩", "kg m2", needs=_STATE, kernels=("invariants",),
        derive=lambda J, D, given: _invariants(J, D, given)[..., 0],
        motion=("vertical angular momentum ⟨K,γ⟩", "kg m2 s-1"),
    ),
    "momentum_squared": Output(
        "momentum squared ⟨𝒦,𝒦⟩", "kg2 m4", needs=_STATE, kernels=("invariants",),
        derive=lambda J, D, given: _invariants(J, D, given)[..., 1],
        motion=("angular momentum squared ⟨K,K⟩", "kg2 m4 s-2"),
    ),
    "gamma_squared": Output(
        "vertical squared ⟨γ,γ⟩", "1", needs=_STATE, kernels=("invariants",),
        derive=lambda J, D, given: _invariants(J, D, given)[..., 2],
    ),
    "phase": Output("elliptic phase u", "1"),
    "rotation_number": Output("turns around the invariant curve, a step", "1", per_ball=True),
}  # fmt: skip


def whose(name: str) -> str:
    """The output of a column or of its companion."""
    return name.removesuffix(LOW).removesuffix(BOUND)


def kernels_for(name: str) -> set[str]:
    """The generated kernels that derive an output from the columns."""
    if name == K:
        return set()
    return set(OUTPUTS[name].kernels).union(*(kernels_for(part) for part in OUTPUTS[name].needs))


def timed(name: str) -> bool:
    """Whether an output needs a run with times, since it is derived from `K`."""
    return name == K or any(timed(part) for part in OUTPUTS[name].needs)


def columns_for(outputs: tuple[str, ...], top: bool) -> frozenset[str]:
    """The columns that a model must follow for these outputs; a `top` (D = 0) omits those that enter only with D."""
    found: set[str] = set()
    for name in outputs:
        if name == K:
            found |= {"momentum"}
        elif OUTPUTS[name].derive is None:
            found |= {name}
        else:
            one = OUTPUTS[name]
            found |= columns_for(tuple(one.needs - one.with_D if top else one.needs), top)
    return frozenset(found)
