"""The findings of the study in sentences, measured, not proved; and its numbers and names, for the figures, too."""

import math
from decimal import Decimal
from fractions import Fraction

from chapsym.files import Data


def log10(text: str) -> float:
    """The decimal logarithm of |x|, which may be below the range of float64; -inf for 0."""
    x = abs(Decimal(text))
    return float(x.log10()) if x else float("-inf")


def scaled(texts: list[str], power: int) -> list[float]:
    """Decimal numbers in units of 10^power."""
    return [float(Decimal(x).scaleb(-power)) for x in texts]


def named(case: Data, *names: str) -> str:
    """ "J = (1, 2, 4), D = 7, h = 12/5"."""
    parts = {"J": "(" + ", ".join(map(str, case["tensor"])) + ")", "D": case["D"], "h": case["height"]}
    return ", ".join(f"{name} = {parts[name]}" for name in names or ("J", "D", "h"))


def decimal(text: str) -> str:
    """ "9/20" as "0.45"."""
    return f"{float(Fraction(text)):g}"


def sentences(found: Data) -> list[str]:
    """Terse sentences with their figures."""
    return [*_plateaus(found), *_law(found), *_displacements(found["displacement"]), *_averages(found["convergence"])]


def _averages(cases: list[Data]) -> list[str]:
    return [
        f"{named(case)}, l = {case['level']}: ρ = {case['rotation_number'][:24]}... half turns a step, "
        f"{-log10(case['errors'][-1]):.0f} digits from {case['steps'][-1]} steps"
        + (" against the exact increment (5.15-euler)" if case["exact"] else "")
        for case in cases
    ]


def _displacements(cases: list[Data]) -> list[str]:
    found = []
    for case in cases:
        size = max(log10(x) for x in case["values"])
        at = f"{named(case)}, {case['half_turns']}/{case['steps']} half turns, {case['digits']} digits"
        if case["D"] == "0" and case["kick"] == "0":
            found.append(f"{at}: the displacement is at most {power(size)}: zero but for rounding")
        elif case["kick"] != "0":
            found.append(f"{at}, kicked by {case['kick']} sin 2φ: the displacement reaches {power(size)}: it locks")
        else:
            found.append(
                f"{at}: the displacement reaches {power(size)}, its leading Fourier term is "
                f"{case['cosines'][case['steps']]} cos(qπu/K): it locks; "
                f"the sphere and (5.15) agree to {case['routes']}"
            )
    return found


def _plateaus(found: Data) -> list[str]:
    rows = [x for name in ("turns", "fifth", "small_D", "farey") for x in found[name]]
    widths = [log10(x["width"]) for x in rows]
    needed = [x["needed"] for x in rows]
    above = min((n for n in needed if n > 15), default=16)
    return [
        f"locked intervals (resonance tongues at fixed h) measured: {len(rows)}, each of positive width, in l from "
        f"{power(min(widths))} to {power(max(widths))}",
        f"seen with float64's 53 bits: {sum(n <= 15 for n in needed)} of them; the others need {above} to "
        f"{max(needed)} digits",
    ]


def power(exponent: float) -> str:
    """10 to this power, with two digits: 1.3e-28."""
    whole = math.floor(exponent)
    return f"{10 ** (exponent - whole):.1f}e{whole}"


def _law(found: Data) -> list[str]:
    rows = found["small_D"]
    least = min((x["D"] for x in rows), key=Fraction)
    parts = ", ".join(f"{x['ratio']:.6f} (q = {x['steps']})" for x in rows if x["D"] == least)
    return [f"measured width / law 2D²|A''|π²q²/(K³ sinh qη)/|dρq/dl| at D = {least}: {parts}"]
