"""The report: the page of all verdicts, and the short list of errata, from the records of the proofs."""

from collections.abc import Callable, Mapping, Sequence

from . import errata, page
from .records import Record, counts, unproved

__all__ = ["WRITERS", "counts", "unproved"]

#: suffix of a file: what turns records and versions into its text.
WRITERS: dict[str, Callable[[Sequence[Record], Mapping[str, str]], str]] = {
    ".html": page.html,
    ".md": lambda records, versions: errata.markdown(records, versions["chapsym"]),
    ".tex": lambda records, versions: errata.latex(records, versions["chapsym"]),
}
