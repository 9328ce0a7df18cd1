"""Whether a certified motion contains that of `motion_truth`; and motions to try."""

from fractions import Fraction as F

from flint import ctx
from motion_truth import BITS, Truth, matrix_of

from chapsym.dynamics.flow import start as exact

ORDINARY = (1, 2, 4), 3, ("1", "-1/2", "3/4"), (1, 2, -1, 3)
#: What the truth may be off by: a few hundred times what a step of it is.
TRUTH = 1e-30
VECTORS = ("angular_momentum", "gamma", "omega", "contact")


def started(mass_tensor, D, omega, quaternion, rotor=(0, 0, 0), radius=1):
    """A start with ω in the axes of the body, all exact."""
    J, D, w, q, a = [F(x) for x in mass_tensor], F(D), *([F(x) for x in v] for v in (omega, quaternion, rotor))
    a = tuple(map(exact.Turns, a))
    momentum = exact.turning(w, D, False, a)
    return exact.Start(J, D, lambda: exact.balls(q), momentum, None if radius is None else F(radius), rotor=a)


def worst(found, case, times):
    """The largest error, less what the truth may be off by, beside its radius."""
    truth = Truth(case[0], F(case[1]), *case[2:4], rotor=case[4] if len(case) > 4 else (0, 0, 0))
    largest = 0.0
    for i, time in enumerate(times):
        true = truth.at(F(time))
        with ctx.workprec(BITS):
            pairs = [pair for name in VECTORS for pair in zip(getattr(found, name)[i], true[name], strict=True)]
            for row, right in zip(matrix_of(found.attitude[i]), true["rows"], strict=True):
                pairs += zip(row, right, strict=True)
            for x, right in pairs:
                beyond, radius = abs((x - right).mid()) - TRUTH, x.rad()
                largest = max(largest, float(beyond / radius) if radius > 0 else float(beyond > 0))
    return largest


def random_case(rng):
    """Moments and D over some decades, any start."""
    J = [F(rng.randint(1, 999), 100) * F(10) ** rng.choice((-2, -1, 0, 0)) for _ in range(3)]
    D = F(rng.randint(0, 999), 100) * F(10) ** rng.choice((-3, 0, 0, 2))
    w = [F(rng.randint(-99, 99), 50) for _ in range(3)]
    return J, D, w, [rng.randint(-9, 9) for _ in range(3)] + [rng.randint(1, 9)]
