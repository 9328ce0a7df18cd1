"""Finds the proofs, runs them side by side, and prints what they found."""

import importlib.util
import multiprocessing
import os
import sys
import traceback
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

from chapsym import workers

from .certificates import write
from .claims import Claim, Judgement, TwoProofs, register
from .evidence import Proof, Verdict
from .records import fingerprint

PROOFS = "chapsym.proofs."


class BrokenScript(ImportError):
    """A proof script cannot even be loaded: what it derives at import fails."""


def load(lemmas: bool = False) -> dict[str, Claim]:
    """Imports every proof script and returns the paper's claims by id, in its order; then the lemmas, if asked.

    Raises BrokenScript if a script, or the derivation that it starts from, raises on import, or if a
    claim of the paper, or a lemma, has no proof.
    """
    proofs = importlib.import_module("chapsym.proofs")
    for name in _scripts():
        try:
            importlib.import_module(name)
        except (Exception, SystemExit) as error:
            raise BrokenScript(
                f"the proof script {name.removeprefix(PROOFS)} cannot be loaded: {type(error).__name__}: {error}"
            ) from error
    claims = register()
    listed = {*proofs.CLAIMS, *proofs.LEMMAS}
    if set(claims) != listed:
        missing = sorted(set(claims) ^ listed)
        raise BrokenScript(f"the proofs and the list of the paper's claims and lemmas differ: {', '.join(missing)}")
    return {id: claims[id] for id in (*proofs.CLAIMS, *(proofs.LEMMAS if lemmas else ()))}


def _scripts() -> list[str]:
    """The full names of the proof scripts."""
    return [PROOFS + name for name in importlib.import_module("chapsym.proofs").SCRIPTS]


def downstream(id: str, claims: dict[str, Claim]) -> list[str]:
    """The claims among `claims` that use `id`, directly or through others."""
    reached: list[str] = []
    frontier = [id]
    while frontier:
        source = frontier.pop()
        new = [other.id for other in claims.values() if source in other.uses and other.id not in reached]
        reached += new
        frontier += new
    return [other for other in claims if other in reached]


def prove_one(id: str, folder: Path | None = None) -> dict[str, Any]:
    """Judges one claim and returns its record; a proof that raises is an open claim with the reason.

    Its certificate is written to the folder, if one is named; raises CannotWrite if it cannot be.
    """
    judgement = judge(load(lemmas=True)[id])
    if folder and judgement.certificate:
        write(judgement.certificate, folder)
    return _record(judgement)


def _record(judgement: Judgement) -> dict[str, Any]:
    """With what is downstream of a claim of the paper in the paper, and of a lemma anywhere."""
    id, paper = judgement.claim.id, load()
    return _fingerprinted(judgement, downstream(id, paper if id in paper else load(lemmas=True)))


def _fingerprinted(judgement: Judgement, users: Sequence[str]) -> dict[str, Any]:
    record = judgement.record(users)
    record["evidence"]["fingerprint"] = fingerprint(judgement.claim)
    return record


def judge(claim: Claim) -> Judgement:
    """Judges a claim; an exception in the proof leaves it open, with the place where it arose."""
    try:
        return claim.judge().certified()
    except (Exception, SystemExit) as error:  # a proof that leaves is no proof
        place = traceback.extract_tb(error.__traceback__)[-1]
        reason = f"the proof raised {type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"
        return _open(claim, reason)


def _open(claim: Claim, reason: str) -> Judgement:
    return Judgement(claim, Verdict.OPEN, Proof(problems=[reason]), 0.0)


def prove_all(
    ids: Sequence[str],
    jobs: int | None = None,
    on_result: Callable[[dict[str, Any]], None] = lambda record: None,
    folder: Path | None = None,
) -> list[dict[str, Any]]:
    """Judges the claims in parallel processes; `on_result` sees each record as it arrives.

    Returns the records in the order of `ids`.  The certificates are written to the folder, if one is named; raises
    CannotWrite if they cannot be.
    """
    jobs = min(jobs or os.cpu_count() or 1, len(ids))
    records: dict[str, dict[str, Any]] = {}
    if jobs <= 1:
        for id in ids:
            records[id] = prove_one(id, folder)
            on_result(records[id])
        return [records[id] for id in ids]
    # An interrupt is for this process; the workers end with the claim that they are at.
    pool = ProcessPoolExecutor(jobs, multiprocessing.get_context("spawn"), initializer=workers.begin)
    try:
        for future in as_completed([pool.submit(prove_one, id, folder) for id in ids]):
            record = future.result()
            records[record["id"]] = record
            on_result(record)
    except BrokenProcessPool:
        for id in ids:
            if id not in records:
                # A claim that was not judged because a process was lost.
                reason = "not judged: a process that ran proofs ended, perhaps for lack of memory; try --jobs 1"
                records[id] = _record(_open(load(lemmas=True)[id], reason))
                on_result(records[id])
    finally:
        pool.shutdown(cancel_futures=True)
    return [records[id] for id in ids]


def explain(record: dict[str, Any]) -> str:
    """The whole argument of one claim, as text."""
    evidence = record["evidence"]
    lines = [f"[{record['id']}] {evidence['title']}", f"  printed: {record['printed']}"]
    lines += [f"  hypothesis: {h}" for h in evidence["hypotheses"]]
    lines += ["", *evidence["derivation"]]
    for example in evidence["counterexamples"]:
        lines += ["  exact counterexample: " + ", ".join(f"{k} = {v}" for k, v in example["point"].items())]
        for kind in ("printed", "corrected"):
            for sides in example[kind]:
                left, right = ", ".join(sides["left"]), ", ".join(sides["right"])
                sign = "=" if left == right else "≠"
                lines += [f"    {kind}: {sides['statement']}:  ({left}) {sign} ({right})"]
    for seen in evidence["witnesses"][:1]:
        at = ", ".join(f"{k} = {v}" for k, v in seen["point"].items())
        cases = ", ".join(case["name"] for case in evidence["witnesses"][1:])
        lines += [f"  true at an exact point: {at}" + (f"; and for {cases}" if cases else "")]
    if evidence["carried"]:
        lines += [f"  carried by: {evidence['carried']['text']}"]
    lines += [f"  nothing to decide: {evidence['reason']}"] if evidence["reason"] else []
    lines += [f"  tried: {text}" for text in evidence["tried"]]
    lines += [f"  ANSWER: {evidence['answer']}"] if evidence["answer"] else []
    lines += [f"  measured, not proved: {text}" for text in evidence["measured"]]
    lines += [f"  conjecture: {text}" for text in evidence["conjectures"]]
    if record["corrected"]:
        lines += [f"  corrected: {record['corrected']}"]
    if evidence["downstream"]:
        lines += [f"  used by: {', '.join(evidence['downstream'])}"]
    lines += [f"  PROBLEM: {problem}" for problem in evidence["problems"]]
    lines += [f"  verdict: {record['verdict'].upper()}  ({record['seconds']:.2f} s)"]
    return "\n".join(lines)


def main(script: str) -> None:
    """Runs the claims of one proof script, prints their derivations, and exits 1 if one is not proved.

    script: `__file__` of a script of `chapsym.proofs`, or of one of your own, anywhere, with ids of its own.
    """
    claims = load(lemmas=True)
    name = next((name for name in _scripts() if Path(str(sys.modules[name].__file__)).samefile(script)), None)
    if name is None:
        own = _claims_of(Path(script), claims)
        sys.exit(report([_fingerprinted(judge(claim), downstream(id, own)) for id, claim in own.items()]))
    records = [prove_one(id) for id, claim in claims.items() if claim.prove.__module__ == name]
    sys.exit(report(records))


def _claims_of(script: Path, judged: dict[str, Claim]) -> dict[str, Claim]:
    """The claims of a user's own script, which is imported for them; exits with a sentence if it cannot be."""
    name = f"claims_of_{script.stem}"
    spec = importlib.util.spec_from_file_location(name, script)
    assert spec is not None
    assert spec.loader is not None
    sys.modules[name] = module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except TwoProofs as error:
        sys.exit(
            f"{script}: {error}; give yours an id of its own, "
            "or install this checkout first (pip install -e .) if it is a script of chapsym"
        )
    own = {id: claim for id, claim in register().items() if id not in judged}
    if not own:
        sys.exit(f"{script} has no claim: write @claim(id, formula) before a function of a Proof")
    for id, claim in own.items():
        if missing := [other for other in claim.uses if other not in own | judged]:
            sys.exit(f"{script}: {id} uses {missing[0]!r}, which no proof judges")
    return own


def report(records: Iterable[dict[str, Any]]) -> int:
    """Prints every argument; returns the exit status."""
    records = list(records)
    print("\n\n".join(explain(record) for record in records))
    return 1 if unproved(records) else 0


def unproved(records: Iterable[dict[str, Any]]) -> list[str]:
    """The ids whose proof failed: `open`, and not a question that the paper itself leaves open."""
    return [r["id"] for r in records if r["verdict"] == Verdict.OPEN and not r["evidence"]["open_in_paper"]]
