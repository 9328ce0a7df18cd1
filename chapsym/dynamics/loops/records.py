"""The records that the marches share: what moves, how it steps, and what is written."""

from typing import NamedTuple

from .text import Cube, Doubles, Integers, Matrix, Vector


class Steps(NamedTuple):
    """The steps from `first` to `last`, of which every `every`-th state is stored."""

    first: int
    last: int
    every: int


class Stages(NamedTuple):
    """The coefficients of the stages of a step, (s,), and the weights of their guesses (`guess.stage_weights`)."""

    c: Vector
    weights: Cube


class Moving(NamedTuple):
    """A ball as it moves: its state, and the last Gibbs vectors of its stages, attitude and contact point.

    limits: radius² and enough of each stage, (2, s).  The attitude and the contact point are used only if followed.
    """

    state: Vector
    limits: Matrix
    past: Matrix
    attitude: Vector
    contact: Vector
    radius: float


class Track(NamedTuple):
    """Frames of one ball, (frames, ...); follows: whether there are attitudes and traces."""

    momenta: Matrix
    verticals: Matrix
    attitudes: Matrix
    traces: Matrix
    follows: bool


class Start(NamedTuple):
    """Balls before a step: 𝒦, γ and J, (balls, 3), and D, (balls,)."""

    momentum: Matrix
    gamma: Matrix
    tensor: Matrix
    contact: Vector


class Balls(NamedTuple):
    """The balls: J (balls, 3), D and the radius, (balls,)."""

    tensor: Matrix
    contact: Vector
    radius: Vector


class Frames(NamedTuple):
    """Frames of balls, (balls, frames, ...), with K for 𝒦; follows, traced: whether there are attitudes and traces."""

    momenta: Cube
    verticals: Cube
    attitudes: Cube
    traces: Cube
    follows: bool
    traced: bool


class Ends(NamedTuple):
    """The outcome of each ball, (balls,): the steps taken, or the last frame; why not all are; and the reach."""

    taken: Integers
    status: Integers
    reach: Doubles
