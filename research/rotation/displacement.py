"""The displacement of G^q over the circle at a resonance, at many digits, and its Fourier coefficients."""

from collections.abc import Sequence

from flint import acb, arb, ctx

from chapsym.files import Data

from .circle import Given, Level, middle, number, solved
from .plateau import resonance, symmetric_starts, text
from .relation import Relation

#: Starts at which the two routes are compared.
COMPARED = 3


def middle_level(
    tensor: Sequence[Given], D: Given, height: Given, steps: int, turns: int, kick: Given, samples: int
) -> arb:
    """The level in the middle of the plateau, to the working digits.

    There the two symmetric orbits are displaced by opposite amounts; a perturbed top, which has no reversor, has the
    mean displacement 0.
    """
    near, _, _ = resonance(tensor, D, height, steps, turns, kick)
    phases = starts(Level(tensor, D, height, near, kick), samples)

    def off(l: arb) -> arb:
        level = Level(tensor, D, height, l, kick)
        of = phases if number(kick) != 0 else symmetric_starts(level, steps)
        return arb(sum(level.displacement(x, steps, turns) for x in of))

    return solved(off, near, number(near) * (1 + arb(10) ** -15))


def starts(level: Level, samples: int) -> list[arb]:
    """The phases of u = 2Ki/n."""
    return [level.amplitude(level.half * i / samples) for i in range(samples)]


def spectrum(values: Sequence[arb]) -> list[tuple[arb, arb]]:
    """(c_j, s_j), j = 0, ..., n/2 of Σ c_j cos 2πji/n + s_j sin 2πji/n."""
    n = len(values)
    sizes = [arb(1) / n if j in (0, n // 2) else arb(2) / n for j in range(n // 2 + 1)]
    whole = acb.dft([acb(x) for x in values])
    return [(middle(x.real * size), middle(-x.imag * size)) for x, size in zip(whole, sizes, strict=False)]


def displacement(
    tensor: Sequence[Given], D: Given, height: Given, steps: int, turns: int, digits: int, samples: int, kick: Given = 0
) -> Data:
    """(G^q(u) - u)/2K - p at u = 2Ki/n, in the middle of the plateau, and its Fourier coefficients in jπu/K.

    values, cosines, sines: decimal strings, in half turns; routes: the greatest difference from the displacement by
    (5.15), a second route without the sphere; chord: how far the chord form is from 0 along a step.
    kick: τ of a perturbed top; that has the first route only.
    """
    with ctx.workdps(digits):
        l = middle_level(tensor, D, height, steps, turns, kick, samples)
        level = Level(tensor, D, height, l, kick)
        phases = starts(level, samples)
        values = [level.displacement(x, steps, turns) for x in phases]
        coefficients = spectrum(values)
        found: Data = {
            "tensor": list(map(str, tensor)), "D": str(D), "height": str(height), "kick": str(kick), "steps": steps,
            "half_turns": turns, "digits": digits, "level": text(l, digits - 5), "values": [text(x) for x in values],
            "cosines": [text(c, 6) for c, _ in coefficients], "sines": [text(s, 6) for _, s in coefficients],
            "modulus": float(level.m.sqrt()), "half_period": text(level.half),
        }  # fmt: skip
        if number(kick) == 0:
            found |= second_route(level, phases, values, steps, turns)
        return found


def second_route(level: Level, phases: list[arb], values: list[arb], steps: int, turns: int) -> Data:
    """The distances of (5.15) and its chord form from the result on the sphere, in half turns."""
    relation = Relation(level)
    chosen = range(0, len(phases), max(1, len(phases) // COMPARED))
    routes = max(abs(values[i] - relation.displacement(phases[i], steps, turns)) for i in chosen)
    chords = []
    for i in chosen:
        u = level.argument(phases[i])
        after = level.argument(level.lift(phases[i], 1))
        chords.append(abs(relation.chord(u, after) / relation.momentum((after - u) / 2 + arb("0.1"))))
    return {"routes": text(routes, 3), "chord": text(max(chords), 3)}
