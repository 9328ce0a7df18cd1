"""What the claims of a report are of: how the paper is called, and how a claim of it is proved again."""

from dataclasses import dataclass

EXACT = "Each counterexample is exact: all hypotheses hold at the point, and the two sides of what is printed differ."


@dataclass(frozen=True)
class Source:
    """The paper, and a note on how its list of errata is to be read; `register` is what --register names, if any."""

    paper: str
    note: str
    short: str
    title: str
    register: str = ""

    @property
    def option(self) -> str:
        """What a command needs to find the claims."""
        return f" --register {self.register}" if self.register else ""

    def cite(self, version: str) -> str:
        """How to cite the list of errata."""
        return f"Errata to {self.short}, computed by chapsym {version}"

    def reproduce(self, id: str) -> str:
        """The command that proves a claim again."""
        return f"chapsym prove {id} --explain{self.option}"


FEDOROV = Source(
    "Yu.N. Fedorov, A Discretization of the Nonholonomic Chaplygin Sphere Problem, SIGMA 3 (2007), 044",
    "Equations are named as in the paper, with a word for a display or a statement beside them. "
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
