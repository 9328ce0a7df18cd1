"""Where each precision breaks: a matrix of conditions and precisions, every cell computed and judged.

A cell is `within` (its error is within the promise), `refused` (with a sentence), or `failed`.  Errors are in ulps of
the precision, against the oracle's matrix equation in mpmath or another reference that shares no formula with it.
The promise of a step is that of `check`, 4κ ulps, with κ the condition number of the state; those with guard digits
promise as if κ were 1.
"""

from .cells import FAILED, REFUSED, WITHIN, Cell, Condition
from .levels import NAMES
from .matrix import CONDITIONS, GROUPS, as_json, extremes, rows

__all__ = [
    "CONDITIONS",
    "FAILED",
    "GROUPS",
    "NAMES",
    "REFUSED",
    "WITHIN",
    "Cell",
    "Condition",
    "as_json",
    "extremes",
    "rows",
]
