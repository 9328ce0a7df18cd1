"""Steps of the map that turn a ball in steady rotation as far as the continuous ball turns.

By lemmas `steady` and `steady-branch` a step of length s turns it by θ with sin θ = s|ω|.  So the step for the time h
has the length s = sin(h|ω|)/|ω|.  That is h times an even function of h, so the rotation of n steps stays an even
series.  In lemma `modified-field` 12ω₃ loses its part 2|ω|²ω so, up to what |ω| changes in the long step.
"""

from .vectors import square

#: 1.5²: steps that would turn the ball by nearly a right angle, where the branch folds, are not fitted.
MOST_TURN = 2.25


def turn_square(h, first, w):
    """(h|ω|)² for a long step h, or 0 where its steps, the longest h/`first`, are not fitted."""
    turned = h * h * square(w)
    return turned if turned <= MOST_TURN * (first * first) else 0.0


def fitted(square):
    """(sin x)/x by its Taylor polynomial up to x¹²: off by 3e-10 at x = 1.5, and by roundings up to x = 0.5."""
    fourth = square * square
    last = (1.0 / 362880.0 - square * (1.0 / 39916800.0)) + fourth * (1.0 / 6227020800.0)
    return ((1.0 - square * (1.0 / 6.0)) + fourth * (1.0 / 120.0 - square * (1.0 / 5040.0))) + fourth * fourth * last


def half_angle(square):
    """cos²(x/2) by its Taylor polynomial up to x⁸: x (sin x)/x over twice this is tan(x/2)."""
    fourth = square * square
    return (1.0 - square * 0.25) + fourth * ((1.0 / 48.0 - square * (1.0 / 1440.0)) + fourth * (1.0 / 80640.0))
