"""The picture of how the radii of a certified motion grow: `make pictures` runs this; some seconds."""

from fractions import Fraction
from pathlib import Path

import numpy as np

from chapsym import ExactBall, certified_motion, files, generated
from chapsym.show.drawing.style import legend, new, styled, write

PICTURE = Path(__file__).parent / "radii" / "growth.svg"
J, D, GAMMA = (1, 2, 4), 3, (Fraction(3, 5), 0, Fraction(4, 5))
#: The first ω, of about 1 rad/s.
MOTIONS = {
    "a generic motion": (Fraction(1, 2), Fraction(2, 5), Fraction(4, 5)),
    "near the separatrix": (Fraction(1, 10**4), 1, 0),
    "unstable rotation": (0, 1, 0),
}
TIMES = [Fraction(round(10 ** (2 + k / 15)), 1000) for k in range(46)]

with styled():
    figure, (axis,) = new("", height=3.8)
    for name, omega in MOTIONS.items():
        K = generated.contact_momentum(*omega, *GAMMA, *J, D)
        found = certified_motion(ExactBall(J, D, 1), K, GAMMA, TIMES, digits=20)
        radii = [max(float(x.rad()) for x in row) for row in found.gamma]
        axis.loglog(np.array(found.times, float), radii, label=f"{name}, {found.bits} bits")
    axis.axhline(1e-20, color="0.5", linestyle="--", linewidth=1)
    axis.set(xlabel="time, s", ylabel="greatest radius of γ", xlim=(0.1, 100))
    legend(figure, [axis])
PICTURE.parent.mkdir(exist_ok=True)
files.write_whole(PICTURE, lambda stream: write(figure, stream, "svg"))
