"""The report: the page of all verdicts, and the short list of errata, from the records of the proofs."""

from collections.abc import Callable

from chapsym import extras

extras.need("report")

from . import errata, page  # noqa: E402
from .errata import NotErrata, entries  # noqa: E402
from .records import FEDOROV, Source, counts, own, unproved  # noqa: E402

__all__ = ["FEDOROV", "WRITERS", "NotErrata", "Source", "counts", "entries", "own", "unproved"]

#: suffix of a file: the function from records, versions, the present entries of the file and the source to its text.
WRITERS: dict[str, Callable[..., str]] = {
    ".html": lambda records, versions, _, source=FEDOROV: page.html(records, versions, source=source),
    ".md": lambda records, versions, _, source=FEDOROV: errata.markdown(records, versions["chapsym"], source),
    ".tex": lambda records, versions, _, source=FEDOROV: errata.latex(records, versions["chapsym"], source),
    ".json": lambda records, versions, earlier, source=FEDOROV: errata.data(
        records, versions["chapsym"], earlier, source
    ),
}
