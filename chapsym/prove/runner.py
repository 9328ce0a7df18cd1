"""Runs proofs in parallel, and prints their findings."""

import contextlib
import os
import sys
import traceback
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

from chapsym import sources, workers

from .certificates import write
from .claims import Claim, Judgement, judgement_of, once
from .evidence import SAID, Proof, Verdict
from .records import fingerprint
from .registers import PROOFS, BrokenScript, NoRegister, Register, raised, reached, register_of
from .trees import Data


def downstream(id: str, claims: dict[str, Claim]) -> list[str]:
    """The claims among `claims` that use `id`, directly or through others."""
    return [other for other in claims if id in reached(other, claims)]


def prove_one(id: str, folder: Path | None = None, register: Register = PROOFS) -> Data:
    """Judges one claim of a register and returns its record; a proof that raises is an open claim with the reason.

    Its certificate is written to the folder, if one is given; raises CannotWrite if this fails.
    """
    judgement = judge(register.load(lemmas=True)[id])
    if folder and judgement.certificate:
        write(judgement.certificate, folder)
    return _record(judgement, register)


def _record(judgement: Judgement, register: Register) -> Data:
    """The record with its fingerprint and its users: for a claim of the paper those in the paper, for a lemma all."""
    id, paper = judgement.claim.id, register.load()
    record = judgement.record(downstream(id, paper if id in paper else register.load(lemmas=True)))
    record["evidence"]["fingerprint"] = fingerprint(judgement.claim)
    return record


def judge(claim: Claim) -> Judgement:
    """Judges a claim; an exception leaves it open, with its place, in the file of the proof if possible."""
    try:
        with contextlib.redirect_stdout(sys.stderr):  # the output of a proof is not a result
            return judgement_of(claim)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # a proof that exits has failed
        frames = traceback.extract_tb(error.__traceback__)
        place = ([frame for frame in frames if frame.filename == sources.file(claim.prove.__module__)] or frames)[-1]
        return _open(claim, f"the proof raised {raised(error)} ({Path(place.filename).name}:{place.lineno})")


def _open(claim: Claim, reason: str) -> Judgement:
    return Judgement(claim, Verdict.OPEN, Proof(problems=[reason]), 0.0)


def prove_all(
    ids: Sequence[str],
    jobs: int | None = None,
    on_result: Callable[[Data], None] = lambda record: None,
    folder: Path | None = None,
    register: Register = PROOFS,
) -> list[Data]:
    """Judges claims of a register in parallel processes.

    Parameters
    ----------
    ids : sequence of str
        The names of the claims.
    jobs : int, optional
        The number of processes; by default that of the processors.
    on_result : callable, optional
        Called with each record as it arrives.
    folder : Path, optional
        The folder for the certificates.
    register : Register, optional
        The register of the claims; by default that of chapsym.

    Returns
    -------
    list of dict
        The records in the order of `ids`.

    Raises
    ------
    CannotWrite
        If the certificates cannot be written.
    """
    jobs = min(jobs or os.cpu_count() or 1, len(ids))
    records: dict[str, Data] = {}
    if jobs <= 1:
        with once():
            for id in ids:
                records[id] = prove_one(id, folder, register)
                on_result(records[id])
        return [records[id] for id in ids]
    try:
        with workers.Processes(jobs, _begin) as pool:
            for future in as_completed([pool.submit(prove_one, id, folder, register) for id in ids]):
                record = future.result()
                records[record["id"]] = record
                on_result(record)
    except BrokenProcessPool:
        for id in ids:
            if id not in records:
                # A claim that was not judged, as a process was lost.
                reason = "not judged: a process that ran proofs ended, perhaps for lack of memory; try --jobs 1"
                records[id] = _record(_open(register.load(lemmas=True)[id], reason), register)
                on_result(records[id])
    return [records[id] for id in ids]


def _begin() -> None:
    """Initialises a worker, which judges each claim only once."""
    workers.begin()
    once().__enter__()


def explain(record: Data) -> str:
    """The whole argument of one claim, as text."""
    evidence = record["evidence"]
    lines = [f"[{record['id']}] {evidence['title']}", f"  printed: {record['printed']}"]
    if evidence["question"]:
        lines += [f"  asked, {evidence['question']['where']}: {evidence['question']['words']}"]
    lines += [f"  hypothesis: {h}" for h in evidence["hypotheses"]]
    lines += ["", *evidence["derivation"]]
    for example in evidence["counterexamples"]:
        lines += ["  exact counterexample: " + ", ".join(f"{k} = {v}" for k, v in example["point"].items())]
        for kind in ("printed", "corrected"):
            for sides in example[kind]:
                left, right = ", ".join(sides["left"]), ", ".join(sides["right"])
                claimed = right.startswith(tuple(filter(None, SAID.values())))  # in words, such as `at least 2`
                sign = " =" if left == right else ", claimed:" if claimed else " ≠"
                lines += [f"    {kind}: {sides['statement']}:  ({left}){sign} ({right})"]
    for seen in evidence["witnesses"][:1]:
        at = ", ".join(f"{k} = {v}" for k, v in seen["point"].items())
        cases = ", ".join(case["name"] for case in evidence["witnesses"][1:])
        lines += [f"  true at an exact point: {at}" + (f"; and for {cases}" if cases else "")]
    if evidence["carried"]:
        lines += [f"  carried by: {evidence['carried']['text']}"]
    lines += [f"  inferred in words: {text}" for text in evidence["inferences"]]
    lines += [f"  nothing to decide: {evidence['reason']}"] if evidence["reason"] else []
    lines += [f"  tried: {text}" for text in evidence["tried"]]
    for row in evidence["readings"]:
        answered = [f"  ANSWER to: {row['asked']}", f"    {row['text']}"]
        lines += answered if row["theorem"] else [f"  OPEN: {row['asked']}"]
    lines += [f"  settled {evidence['settled']['text']}"] if evidence["settled"] else []
    lines += [f"  measured, not proved: {text}" for text in evidence["measured"]]
    lines += [f"  conjecture: {text}" for text in evidence["conjectures"]]
    if record["corrected"]:
        lines += [f"  corrected: {record['corrected']}"]
    if evidence["slip"]:
        follows = ", follows from " + ", ".join(evidence["slip"]["follows"]) if evidence["slip"]["follows"] else ""
        lines += [f"  kind of error, by our judgement: {evidence['slip']['kind']}{follows}"]
    if evidence["downstream"]:
        lines += [f"  used by: {', '.join(evidence['downstream'])}"]
    lines += [f"  PROBLEM: {problem}" for problem in evidence["problems"]]
    lines += [f"  verdict: {record['verdict'].upper()}  ({record['seconds']:.2f} s)"]
    return "\n".join(lines)


def main(script: str) -> None:
    """Runs the claims of a proof script, prints their derivations, and exits with 1 if one is not proved.

    Parameters
    ----------
    script : str
        `__file__` of a script of `chapsym.proofs`, or of your own script anywhere, with its own ids.
    """
    register = register_of(script)
    try:
        claims = register.load(lemmas=True)
    except (BrokenScript, NoRegister) as error:
        sys.exit(str(error))
    own = [id for id, claim in claims.items() if Path(sources.file(claim.prove.__module__) or "").samefile(script)]
    sys.exit(report([prove_one(id, None, register) for id in own]))


def report(records: Iterable[Data]) -> int:
    """Prints every argument; returns the exit status."""
    records = list(records)
    print("\n\n".join(explain(record) for record in records))
    return 1 if unproved(records) else 0


def unproved(records: Iterable[Data]) -> list[str]:
    """The ids whose proof failed: `open`, and not an open question of the paper.

    Parameters
    ----------
    records : iterable of dict
        Records, as `prove_all` returns them.

    Returns
    -------
    list of str

    Examples
    --------
    >>> from chapsym.prove import unproved
    >>> unproved([{"id": "mine", "verdict": "open", "evidence": {"open_in_paper": False}}])
    ['mine']
    """
    return [r["id"] for r in records if r["verdict"] == Verdict.OPEN and not r["evidence"]["open_in_paper"]]
