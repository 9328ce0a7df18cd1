"""The texts that Rocq judges: the theorem of a certificate, and a lemma for each step."""

from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

from chapsym.checker import Rejected
from chapsym.checker.document import Data
from chapsym.checker.linear import Vector
from chapsym.checker.measure import ZEROS
from chapsym.files import write_text

from .boxes import KAPPA, Box, Step, Walk

HERE = Path(__file__).resolve().parent


def real(x: Fraction) -> str:
    """A rational number: a decimal if it is one, else a quotient."""
    if (digits := next((n for n in range(400) if 10**n % x.denominator == 0), None)) is None:
        return f"({x.numerator} / {x.denominator})"
    whole = str(abs(x.numerator) * (10**digits // x.denominator))
    text = f"{whole}e-{digits}" if len(whole) + 8 < digits else f"{Decimal(f'{whole}e-{digits}'):f}"
    return f"(-{text})" if x < 0 else text


def vector(v: Sequence[Fraction]) -> str:
    """Three numbers."""
    return f"(V {' '.join(map(real, v))})"


def ends(box: Box) -> str:
    """The least and the greatest vector of a box."""
    return f"{vector(box.end(-1))} {vector(box.end(1))}"


class Theorem:
    """The theorem of an accepted certificate, as text by str(Theorem(…)); raises Rejected if there is none."""

    def __init__(self, name: str, data: Data):
        if "branch" in data or any(one["start"] not in ZEROS for one in data["orbits"]):
            raise Rejected("only certificates without a branch, with the starts a and b, are written for Rocq")
        self.name, self.data, self.walk = name, data, Walk(data)
        self.bits = f"{self.walk.digits * 10 // 3 + 40}%positive"
        self.axes = [f"x{i}" for i in data["axes"]]
        self.half = Fraction(1, 2 * 10 ** data["digits"])
        self.level = self._between(self.walk.level, "l")
        self.tame = " ".join(map(real, self.walk.tame))

    def _between(self, x: Fraction, name: str) -> str:
        return f"{real(x - self.walk.radius)} <= {name} <= {real(x + self.walk.radius)}"

    def __str__(self) -> str:
        walk, (a, b, c), r = self.walk, self.axes, real(self.walk.radius)
        weights, level, bits = walk.circle.weights, walk.circle.level, self.bits
        apart = "Rlt_not_eq" if weights[walk.circle.a] < weights[walk.circle.b] else "Rgt_not_eq"
        inner = "left" if weights[walk.circle.c] < level else "right"
        lemmas, says, proofs = zip(*map(self._orbit, self.data["orbits"]), strict=True)
        numbers = ((walk.D, "D"), (walk.height, "h"), (walk.level, "l"))
        within = " /\\ ".join(f"Rabs ({y} - {real(x)}) <= {r}" for x, y in numbers)
        both, conjunction = " /\\\n  ".join(says), "conj _ (" * (4 + len(says))
        return f"""(* Certificate {self.name}: what checker/measure.py finds out of it, over the real numbers. *)

From Coq Require Import Reals Lia Lra.
From Interval Require Import Tactic.
Require Import Steps.
Open Scope R_scope.

Definition inside J D h l := near {r} {vector(walk.J)} J /\\ {within}.
Definition plain J D h := within {ends(Box(walk.J, walk.radius))} J /\\
  {self._between(walk.D, "D")} /\\ {self._between(walk.height, "h")}.
Ltac constants := clear; by_intervals 60%positive.
Ltac computed bits :=
  unfold plain in *; intros; repeat match goal with v : vector |- _ => destruct v end; by_intervals bits.

Lemma is_plain J D h l : inside J D h l -> plain J D h /\\ {self.level}.
Proof.
  intros [[A1 [A2 A3]] [B [C E]]]. simpl in *. apply between in A1. apply between in A2. apply between in A3.
  apply between in B. apply between in C. apply between in E. unfold plain, within. simpl. lra.
Qed.

Lemma is_tame J D h : plain J D h -> tame J D h {self.tame}.
Proof. computed {bits}. Qed.

{"".join(lemmas)}Theorem {self.name} : forall (J : vector) (D h l : R), inside J D h l ->
  (0 <= x1 J /\\ 0 <= x2 J /\\ 0 <= x3 J) /\\ 0 < D /\\ h <> 0 /\\
  small_branch (Rabs h) (inertia J) /\\ circle {a} {b} {c} (weights J D) l /\\
  {both}.
Proof.
  intros J D h l I. apply is_plain in I. destruct I as [I L].
  refine ({conjunction}_{")" * (5 + len(says))}.
  - computed {bits}.
  - computed {bits}.
  - apply {"Rgt_not_eq" if walk.height > 0 else "Rlt_not_eq"}. computed {bits}.
  - computed {bits}.
  - split; [apply {apart} | {inner}]; computed {bits}.
{"".join(proofs)}Qed.

Print Assumptions {self.name}.
"""

    def _orbit(self, data: Data) -> tuple[str, str, str]:
        """The lemmas of an orbit, its conclusions, and the proof."""
        circle, q, name = self.walk.circle, self.data["steps"], data["start"]
        zero, other = (circle.a, circle.b) if name == "a" else (circle.b, circle.a)
        places = [f"x{i + 1}" for i in (zero, other, circle.c)]
        start, steps = self.walk.orbit(zero, data["steps"])
        boxes = [start, *(step.after for step in steps)]
        lemmas = [self._start(name, places, start)]
        lemmas += [self._step(f"step_{name}{k}", boxes[k - 1], step) for k, step in enumerate(steps, 1)]
        directions = list(map(self.walk.vector, boxes))
        facts = [*self._rounded(data["steps"], steps), *self._turns(directions, data["displacement"])]
        says = " /\\\n    ".join(text for text, _ in facts)
        proofs = "".join(f"    + {proof}.\n" for _, proof in facts)
        chain = "".join(
            f"    destruct (step_{name}{k} J D h (g {k - 1}%nat) (u {k}%nat) (g {k}%nat) I G{k - 1} U{k - 1} "
            f"(S {k - 1}%nat ltac:(lia))) as [R{k} [G{k} U{k}]].\n"
            for k in range(1, q + 1)
        )
        return (
            "".join(lemmas),
            f"(forall g u : nat -> vector, start {' '.join(places)} J D l (g 0%nat) -> orbit {q} J D h g u ->\n"
            f"    {says})",
            f"  - intros g u A S. assert (U0 : dot (g 0%nat) (g 0%nat) = 1) by apply A.\n"
            f"    assert (G0 := start_{name} J D h l (g 0%nat) I L A). clear A.\n{chain}"
            f"    repeat match goal with |- _ /\\ _ => split end.\n{proofs}",
        )

    def _rounded(self, steps: Sequence[Data], found: Sequence[Step]) -> list[tuple[str, str]]:
        """Statements that the numbers of the file are correctly rounded, with proofs; else raises Rejected."""
        facts = []
        for k, (given, step) in enumerate(zip(steps, found, strict=True), 1):
            for key, of, box in (("u", f"(u {k}%nat)", step.u), ("gamma", f"(g {k}%nat)", step.after)):
                numbers = [Fraction(x) for x in given[key]]
                if not all(abs(x - c) + box.radius < self.half for x, c in zip(numbers, box.centre, strict=True)):
                    raise Rejected(f"the box of {key} of step {k} is too wide for Rocq to prove how it is rounded")
                facts.append((f"rounded {real(self.half)} {vector(numbers)} {of}", f"by_box {self.bits} {of}"))
        return facts

    def _turns(self, gammas: Sequence[Vector], displacement: str) -> list[tuple[str, str]]:
        """Statements with proofs: the direction of the steps, the side on which each ends, the last displacement."""
        circle, (a, b, _), q = self.walk.circle, self.axes, self.data["steps"]

        def sine(v: int, w: int) -> str:
            return f"sine {a} {b} (g {v}%nat) (g {w}%nat)"

        def side(v: int, w: int) -> str:
            return f"0 < {sine(v, w)}" if circle.sine(gammas[v], gammas[w]).sign > 0 else f"{sine(v, w)} < 0"

        pairs = [*pairwise(range(q + 1)), *((0, k) for k in range(1, q + 1))]
        facts = [(side(v, w), f"by_boxes {self.bits} (g {v}%nat) (g {w}%nat)") for v, w in pairs]
        last = Fraction(displacement) * circle.direction(list(gammas)) * (-1) ** self.data["half_turns"]
        text = f"Rabs ({sine(0, q)} - {real(last)}) < {real(self.half)}"
        return [*facts, (text, f"by_boxes {self.bits} (g 0%nat) (g {q}%nat)")]

    def _start(self, name: str, places: Sequence[str], box: Box) -> str:
        a, b, c = places
        of_b, of_c = (self.walk.circle.weights[int(place[1]) - 1] for place in (b, c))
        return f"""Lemma start_{name} J D h l g : plain J D h -> {self.level} -> start {a} {b} {c} J D l g ->
  within {ends(box)} g.
Proof.
  intros I L S. assert (A := proj1 S).
  assert (P : {b} (weights J D) - {c} (weights J D) <> 0).
  {{ apply {"Rlt_not_eq" if of_b < of_c else "Rgt_not_eq"}. clear S A L. computed {self.bits}. }}
  destruct (start_roots {a} {b} {c} J D l g ltac:(intros; unfold dot; ring) ltac:(intros; split; reflexivity) P S)
    as [B C].
  clear S. unfold within. rewrite A, B, C. clear A B C P g. computed {self.bits}.
Qed.

"""

    def _step(self, name: str, before: Box, step: Step) -> str:
        centre = vector(step.u.centre)
        numbers = " ".join(map(real, (step.residual, step.distance, KAPPA, step.u.radius)))
        return f"""Lemma {name} J D h g u g' : plain J D h -> within {ends(before)} g ->
  dot g g = 1 -> step J D h g u g' -> near {real(step.u.radius)} {centre} u /\\
  within {ends(step.after)} g' /\\ dot g' g' = 1.
Proof.
  intros I N. apply (advance J D h {self.tame} {numbers} g u g' {centre}
    {ends(step.after)}
    {" ".join(map(vector, step.rows))});
    [exact (is_tame J D h I) | constants | computed {self.bits} | constants | computed 60%positive | lra | constants |
     computed {self.bits}].
Qed.

"""


def write(texts: Mapping[str, str], folder: Path) -> None:
    """Writes theorems, by name, with the files that Rocq needs; raises OSError or CannotWrite if this fails."""
    folder.mkdir(parents=True, exist_ok=True)
    library = folder / "Steps.v"
    content = (HERE / library.name).read_text(encoding="utf-8")
    if not library.exists() or library.read_bytes() != content.encode():  # unchanged files need not be judged again
        write_text(library, content)
    for name, text in texts.items():
        write_text(folder / f"{name}.v", text)
    write_text(folder / "Makefile", MAKEFILE.format(names=" ".join(texts)))


MAKEFILE = """# make: Rocq judges the certificates, and the axioms of each theorem are counted; X.out lists those of X.

COQC ?= coqc
NAMES := {names}
LISTED := sed '/^ /d; /^Axioms:/d'
BEGAN := $(shell date +%s)
.DELETE_ON_ERROR:
.PHONY: judged
judged: $(NAMES:%=%.out)
	@$(foreach name,$(NAMES),echo "axioms      of $(name): $$($(LISTED) $(name).out | wc -l):"\
$$($(LISTED) $(name).out | sed 's/[ :].*//; s/[.][^.]*$$//' | sort | uniq -c);)
	@echo "seconds     $$(($$(date +%s) - $(BEGAN)))"

$(NAMES:%=%.out): Steps.vo

Steps.vo: Steps.v
	$(COQC) -q -noglob $<

%.out: %.v
	$(COQC) -q -noglob $< > $@
"""
