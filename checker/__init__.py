"""A small checker of certificates.  It uses only the standard library, and nothing from the rest of chapsym.

    from chapsym.checker import check, read        or        python checker FILE...  in the folder of the repository
    verdict = check(read("proofs/certificates/….json"))        `standing`: are its premises accepted, too?

Read the files in this order: interval.py (arithmetic), linear.py (elimination, Newton's test), step.py (the map); then
measure.py (with circle.py, branch.py), heteroclinic.py, orbit.py, run.py (the theorem of each kind and its proof);
taylor.py (functions of time), rolling.py (the continuous ball), drift.py, motion.py; document.py and form.py (the form
of a file).  For the statements of the register: trees.py, polynomial.py, words.py, algebra.py, matrices.py,
derivation.py (derived expressions), roots.py, register.py; shown.py prints the formulas of a certificate.
"""

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from . import drift, heteroclinic, measure, motion, orbit, register, run
from .document import FORMAT, Data, Unreadable, digest, file_name, read
from .interval import Rejected

__all__ = [
    "FORMAT",
    "Rejected",
    "Unreadable",
    "Verdict",
    "check",
    "claimed_twice",
    "digest",
    "file_name",
    "id_of",
    "lacks",
    "read",
    "standing",
    "statement",
]

KINDS = {
    "no-invariant-measure": measure,
    "heteroclinic": heteroclinic,
    "periodic-orbit": orbit,
    "energy-drift": drift,
    "motion": motion,
    "map-run": run,
    "register-claim": register,
}


@dataclass(frozen=True)
class Verdict:
    """The verdict on an accepted certificate: its kind, the theorem in one sentence, and the proved numbers.

    name: the digest; for a claim, the id and the digest.  rests: names of certificates that must be accepted, too.
    uses: ids of claims whose certificates must be accepted, too.  refuted: no other certificate may use this claim.
    """

    kind: str
    statement: str
    numbers: dict[str, str]
    name: str
    rests: tuple[str, ...] = ()
    uses: tuple[str, ...] = ()
    refuted: bool = False


def statement(data: Data) -> str:
    """The sentence that must be the "statement" of a certificate with these numbers."""
    return KINDS[data["kind"]].statement(data)


def check(data: Data) -> Verdict:
    """The verdict on a certificate; raises Rejected, with a reason in one sentence, unless its statement is proved."""
    kind = data.get("kind") if isinstance(data, dict) else None
    if not isinstance(kind, str) or data.get("format") != FORMAT:
        raise Rejected(f"not a certificate of format {FORMAT}")
    if kind not in KINDS:
        raise Rejected(f"this checker judges certificates of kind {' and '.join(KINDS)}, and none of kind {kind!a:.60}")
    try:
        KINDS[kind].check_form(data)
        sentence, seal = statement(data), digest(data)
        if data["statement"] != sentence:
            raise Rejected("the statement is not the one that the numbers make")
        if data["digest"] != seal:
            raise Rejected("the digest is not that of the file: something in it was changed")
        numbers = KINDS[kind].check(data)
    except RecursionError:
        raise Rejected("lists in lists too deep to be a certificate") from None
    if kind == "register-claim":
        rests = tuple(one["certificate"] for one in data["rests"])
        name = f"{data['claim']} {seal}"
        return Verdict(kind, sentence, numbers, name, rests, tuple(data["uses"]), data["verdict"] == "refuted")
    return Verdict(kind, sentence, numbers, seal)


def id_of(name: str) -> str:
    """The id of the claim in the name of a verdict; for other certificates, the name itself."""
    return name.partition(" ")[0]


def claimed_twice(verdicts: Sequence[Verdict]) -> set[str]:
    """The names of different certificates of the same claim, one of which may prove less than another."""
    names = {one.name for one in verdicts if one.kind == "register-claim"}
    claims = Counter(map(id_of, names))
    return {name for name in names if claims[id_of(name)] > 1}


def lacks(verdict: Verdict, accepted: Collection[str], refuted: Collection[str] = ()) -> list[str]:
    """The premises of a verdict that are not accepted: certificates by name; used claims, also refuted ones, by id."""
    ids = set(map(id_of, accepted)) - set(map(id_of, refuted))
    return sorted({*verdict.rests} - {*accepted} | {one for one in verdict.uses if one not in ids})


def standing(verdicts: Sequence[Verdict]) -> set[str]:
    """The names of the verdicts that stand: only one for its claim, and all its premises stand, too."""
    found: set[str] = set()
    alone = [one for one in verdicts if one.name not in claimed_twice(verdicts)]
    refuted = {one.name for one in verdicts if one.refuted}
    while new := {one.name for one in alone if not lacks(one, found, refuted)} - found:
        found |= new
    return found
