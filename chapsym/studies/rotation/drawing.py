"""What the figures of the study share: colours, panels, and how its decimal numbers are read and told."""

from typing import Any

#: Okabe and Ito's colours, which the colour-blind tell apart.
BLUE, RED, GREEN, PINK, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
COLOURS = BLUE, RED, GREEN, PINK, ORANGE, SKY
GREY = "0.45"


def panels(rows: int, columns: int, width: float = 10.4, height: float = 3.7, **options: Any) -> tuple[Any, list[Any]]:
    """A matplotlib figure with axes, so many inches wide and, for each row, high."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height * rows), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)  # type: ignore[union-attr, call-arg]
    return figure, list(figure.subplots(rows, columns, squeeze=False, **options).flat)


def log10(text: str) -> float:
    """The decimal logarithm of |x|, which may be below the range of float64; -inf for 0."""
    from decimal import Decimal

    x = abs(Decimal(text))
    return float(x.log10()) if x else float("-inf")


def scaled(texts: list[str], power: int) -> list[float]:
    """Decimal numbers in units of 10^power."""
    from decimal import Decimal

    return [float(Decimal(x).scaleb(-power)) for x in texts]


def named(case: dict[str, Any], *names: str) -> str:
    """ "J = (1, 2, 4), D = 7, h = 12/5"."""
    told = {"J": "(" + ", ".join(map(str, case["tensor"])) + ")", "D": case["D"], "h": case["height"]}
    return ", ".join(f"{name} = {told[name]}" for name in names or ("J", "D", "h"))


def decimal(text: str) -> str:
    """ "9/20" as "0.45"."""
    from fractions import Fraction

    return f"{float(Fraction(text)):g}"
