"""What is generated for other numbers than scalars: straight-line programs that call kernels."""

from dataclasses import dataclass

from .kernels import Group


@dataclass(frozen=True)
class Program:
    """Straight-line Python of kernel calls and + - * /: named inputs in groups, and the names that are its outputs."""

    name: str
    summary: str
    groups: tuple[Group, ...]
    outputs: tuple[str, ...]
    text: str
    #: Of the inputs, those that stay float64 where the others are pairs.
    floats: tuple[str, ...] = ()
    #: On pairs: whether every sum is normalised: the halves of one that cancels overlap, which costs a product digits.
    normal: bool = False

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of the arguments."""
        return tuple(symbol.name for _, symbols in self.groups for symbol in symbols)
