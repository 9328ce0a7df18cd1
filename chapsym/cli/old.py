"""Old options of the command, which work for one more release."""

from collections.abc import Sequence

from chapsym.renamed import renamed

#: By subcommand: what an option was called, and what it is called now.
OLD = {
    "step": {"--rung": "--precision"},
    "branches": {"--rung": "--precision"},
    "no-invariant-measure": {"--height": "--vertical-momentum"},
    "periodic-orbit": {"--momentum-momentum": "--k-squared", "--momentum-gamma": "--vertical-momentum"},
}


def modernised(arguments: Sequence[str]) -> list[str]:
    """The arguments with the new names of options; each old one warns."""
    names = next((OLD[word] for word in arguments[:2] if word in OLD), {})
    return [_modernised(word, names) for word in arguments]


def _modernised(word: str, names: dict[str, str]) -> str:
    old, equals, value = word.partition("=")
    if old not in names:
        return word
    renamed(old, names[old])
    return names[old] + equals + value
