"""The report: the page of all verdicts, and the short list of errata, from the records of the proofs."""

from collections.abc import Callable, Mapping, Sequence

from chapsym import extras

extras.need("report")

from . import errata, errata_json, page  # noqa: E402
from .errata_json import Entry, NotErrata, entries  # noqa: E402
from .records import Record, counts, unproved  # noqa: E402

__all__ = ["WRITERS", "NotErrata", "counts", "entries", "unproved"]

#: suffix of a file: what turns records, versions and the entries that the file has now into its text.
WRITERS: dict[str, Callable[[Sequence[Record], Mapping[str, str], Mapping[str, Entry]], str]] = {
    ".html": lambda records, versions, _: page.html(records, versions),
    ".md": lambda records, versions, _: errata.markdown(records, versions["chapsym"]),
    ".tex": lambda records, versions, _: errata.latex(records, versions["chapsym"]),
    ".json": lambda records, versions, earlier: errata_json.text(records, versions["chapsym"], earlier),
}
