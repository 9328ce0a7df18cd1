"""Reading the records of `chapsym prove --json`: their order in the paper, their verdicts, their dependences.

Evidence that a record does not have is empty, not an error.
"""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from chapsym import files

Record = files.Data

#: All verdicts, in the order in which they are counted, with their meanings.
VERDICTS = {
    "holds": "proved as printed",
    "corrected": "false as printed; the smallest correction is proved",
    "conditional": "false as printed; true under a hypothesis that the paper leaves out",
    "refuted": "false, and no small correction saves it",
    "settled": "left open in the paper; readings of it are decided here, machine-checked or by hand",
    "definition": "a definition, with nothing to prove",
    "open": "not decided",
}
ERRORS = ("corrected", "conditional", "refuted")

#: Kinds of errors, by our judgement: the singular and the plural.
SLIPS = {
    "serious": ("serious error", "serious errors"),
    "typo": ("typo", "typos"),
    "convention": ("slip of convention", "slips of convention"),
    "reading": ("that depends on the reading", "that depend on the reading"),
}

SECTIONS = {
    1: "Introduction",
    2: "The Chaplygin sphere and its multidimensional generalization",
    3: "Discrete mechanical systems with nonholonomic constraints",
    4: "A discretization of the Chaplygin sphere",
    5: "Discrete Chaplygin sphere on E(3) and its particular solutions",
    6: "Conclusive remarks",
}

#: The places of the numbered statements among the equations: just after the given one.
_STATEMENTS = {
    "remark-1": (3, 4), "remark-2": (3, 5), "prop-1": (4, 12), "prop-2": (4, 13), "remark-3": (4, 14),
    "prop-3": (5, 5), "remark-4": (5, 9), "prop-4": (5, 10),
}  # fmt: skip
_NAMES = {"prop": "Proposition", "remark": "Remark"}


class Section(NamedTuple):
    """A section of the paper and the records of its claims."""

    number: int
    title: str
    records: list[Record]


def place(id: str) -> tuple[int, int] | None:
    """Section and equation of a claim; None for an id without them."""
    name = re.match(r"(?:prop|remark)-\d+", id)
    if name and name.group() in _STATEMENTS:
        return _STATEMENTS[name.group()]
    number = re.match(r"(\d+)(?:\.(\d+))?(?!\d)", id)
    return (int(number.group(1)), int(number.group(2) or 0)) if number else None


def section(record: Record) -> tuple[int, str] | None:
    """The number and the title of the section of a claim: from its record, or else from its id."""
    if heading := record["evidence"].get("section"):
        return heading[0], heading[1]
    found = place(record["id"])
    return (found[0], SECTIONS.get(found[0], "Elsewhere")) if found else None


def in_paper_order(records: Iterable[Record]) -> list[Record]:
    """The records in the order of the paper; one without an equation stays after the record before it."""
    placed, last = [], (0, 0)
    for record in records:
        heading = record["evidence"].get("section")
        last = (heading[0], 0) if heading else place(record["id"]) or last
        placed.append((last, record))
    return [record for _, record in sorted(placed, key=lambda pair: pair[0])]


def sections(records: Iterable[Record]) -> list[Section]:
    """The records by section of the paper."""
    found: dict[tuple[int, str], list[Record]] = {}
    last = 0, "Elsewhere"
    for record in in_paper_order(records):
        last = section(record) or last
        found.setdefault(last, []).append(record)
    return [Section(number, title, those) for (number, title), those in found.items()]


def label(id: str) -> str:
    """The name of a claim for a reader: (5.12), q0 or Proposition 4."""
    if (found := re.fullmatch(r"(?:(prop|remark)-(\d+)|(\d+\.\d+))(?:-(.+))?", id)) is None:
        return id
    kind, number, equation, part = found.groups()
    return (f"({equation})" if equation else f"{_NAMES[kind]} {number}") + (f", {part}" if part else "")


def counts(records: Iterable[Record]) -> dict[str, int]:
    """The number of claims with each verdict, in the order of VERDICTS, without zeros."""
    found = Counter(record["verdict"] for record in records)
    return {verdict: found[verdict] for verdict in [*VERDICTS, *found] if verdict in found}


def carried(records: Iterable[Record]) -> dict[str, int]:
    """The grounds of the verdicts, counted over all claims: statements that the checker accepted, and sentences."""
    counts = [record["evidence"].get("carried") or {} for record in records]
    names = "statements", "identical", "comparisons", "counts", "counterexamples", "steps"
    found = {name: sum(one.get(name, 0) for one in counts) for name in names}
    return found | {"sentences": sum(sum(one.get("sentences", {}).values()) for one in counts)}


def errors(records: Iterable[Record]) -> list[Record]:
    """The claims that are not true as printed, in the order of the paper."""
    return [record for record in in_paper_order(records) if record["verdict"] in ERRORS]


def truth(record: Record) -> tuple[str, str]:
    """The true statement in place of a printed error, as LaTeX, and in prose the condition or the whole statement."""
    name = "true_statement" if record["verdict"] == "refuted" else "condition"
    return record.get("corrected") or "", record["evidence"].get(name) or ""


def slip_of(record: Record) -> tuple[str, list[str]]:
    """The kind of error of a record, and the claims from whose errors it follows; an empty kind if none is given."""
    found = record["evidence"].get("slip") or {"kind": "", "follows": []}
    return found["kind"], found["follows"]


def slips(records: Iterable[Record]) -> dict[str, tuple[int, int]]:
    """The number of errors of each kind, and the number of these that follow from no other."""
    found = [slip_of(record) for record in errors(records)]
    count = {kind: [not follows for each, follows in found if each == kind] for kind in SLIPS}
    return {kind: (len(those), sum(those)) for kind, those in count.items() if those}


def kinds(records: Iterable[Record]) -> str:
    """The errors by kind, in words; empty if no kind is given.

    Examples
    --------
    >>> kinds([{"id": "2.1", "verdict": "corrected", "evidence": {"slip": {"kind": "typo", "follows": []}}}])
    '1 typo'
    """
    parts = []
    for kind, (number, independent) in slips(records).items():
        one, many = SLIPS[kind]
        rest = "" if independent == number else f" (from {independent} independent slips)"
        parts.append(f"{number} {one if number == 1 else many}{rest}")
    return ", ".join(parts)


def unproved(records: Iterable[Record]) -> list[str]:
    """The ids of the open claims, except the open questions of the paper."""
    return [r["id"] for r in records if r["verdict"] == "open" and not r["evidence"].get("open_in_paper")]


def uses(records: Sequence[Record]) -> dict[str, list[str]]:
    """The claims that each claim uses directly, among the given records."""
    known = {record["id"] for record in records}
    return {r["id"]: [id for id in r["evidence"].get("uses", []) if id in known] for r in records}


def users(records: Sequence[Record]) -> dict[str, list[str]]:
    """The claims that use each claim directly."""
    used = uses(records)
    return {record["id"]: [id for id in used if record["id"] in used[id]] for record in records}


# The register of a report: the name of its paper, and the command that proves a claim again.

EXACT = (
    "Each counterexample is exact: all hypotheses that are equations or inequalities hold at the point, and the two "
    "sides of what is printed differ."
)


@dataclass(frozen=True)
class Source:
    """The paper, and a note on how to read its list of errata; register: the value of --register, if any."""

    paper: str
    note: str
    short: str
    title: str
    register: str = ""

    @property
    def option(self) -> str:
        """The option of a command that finds the claims."""
        return f" --register {files.pasted(self.register)}" if self.register else ""

    def cite(self, version: str) -> str:
        """The citation of the list of errata."""
        return f"Errata to {self.short}, computed by chapsym {version}"

    def reproduce(self, id: str) -> str:
        """The command that proves a claim again."""
        return f"chapsym prove {files.pasted(id)} --explain{self.option}"


FEDOROV = Source(
    "Yu.N. Fedorov, A Discretization of the Nonholonomic Chaplygin Sphere Problem, SIGMA 3 (2007), 044",
    "Equations are named as in the paper, followed by a word for a display or a statement. "
    f"{EXACT} "
    "There J is always the mass tensor of Sections 4 and 5, so that Λ = diag(J2+J3+D, J1+J3+D, J1+J2+D), "
    "and an index k-1, k, k+1 is the time.",
    "SIGMA 3 (2007), 044",
    "The discrete Chaplygin ball, judged",
)


def own(register: str, paper: str, note: str) -> Source:
    """The source of a user's own claims; `paper` and `note` may be empty."""
    paper = paper or f"the claims in {register}"
    return Source(paper, f"{EXACT} {note}".strip(), paper, f"Judged: {paper}", register)
