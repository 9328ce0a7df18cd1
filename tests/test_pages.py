"""The README and the documentation are true: their code runs and prints what they show, their links lead somewhere."""

import contextlib
import re
import sys
import tempfile
import tomllib
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pages
import pytest
import yaml
from pages import PAGES, ROOT, blocks, prose

import chapsym
from chapsym.prove import claims, runner

TEXTS = {name: path.read_text(encoding="utf-8") for name, path in PAGES.items()}
PLAYED = [name for name, text in TEXTS.items() if any(b.kind in ("console", "python") for b in blocks(text))]
#: A link or a picture; its target may be in angle brackets.
LINK = re.compile(r"\]\(<?([^()\s<>]+)>?\)")
KINDS = {"console", "python", "sh", "text", "toml", "bibtex"}


@pytest.mark.parametrize("name", PLAYED)
def test_what_a_page_shows_is_what_is_printed(name, tmp_path, monkeypatch, forgotten):
    monkeypatch.setattr("os.cpu_count", lambda: 1)  # proofs in this process: others would load all of them first
    monkeypatch.setattr(runner, "once", contextlib.nullcontext)  # a claim is judged once on a page, not in each command
    with claims.once():
        wrong = [said for _, said, _ in pages.played(TEXTS[name], pages.workspace(tmp_path)) if said]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", TEXTS)
def test_every_block_is_of_a_kind_that_is_run_or_read(name):
    for block in blocks(TEXTS[name]):
        assert block.kind in KINDS or block.kind.startswith("{"), block.kind
        if block.kind == "text":
            assert not block.text.startswith(("$", "chapsym ")), block.text
        if block.kind == "python":
            assert ">>>" in block.text


@pytest.mark.parametrize("name", TEXTS)
def test_commands_that_are_not_run_are_commands(name, tmp_path):
    lines = [line for block in blocks(TEXTS[name]) if block.kind == "sh" for line in block.text.splitlines()]
    folder = pages.workspace(tmp_path)
    spans = [re.sub(r"\s+", " ", span) for span in pages.SPAN.findall(prose(TEXTS[name]))]
    wrong = [pages.unknown(line, folder) for line in [*lines, *spans] if line.startswith("chapsym ")]
    assert not list(filter(None, wrong))
    for line in lines:
        if line.startswith("make "):
            assert re.search(rf"^{line.split()[1]}:", (ROOT / "Makefile").read_text(), re.MULTILINE), line


def test_extras_that_a_page_names_are_those_of_the_package():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    named = {name for text in TEXTS.values() for name in re.findall(r"pip install '(?:chapsym|\.)\[(\w+)\]'", text)}
    assert named <= set(extras)


def test_the_recipes_for_ci_are_yaml_and_their_commands_are_commands(tmp_path):
    page = TEXTS["docs/tutorials/own-system.md"]
    recipes = [yaml.safe_load(b.text.split("\n\n", 1)[1]) for b in blocks(page) if b.kind == "{code-block} yaml"]
    job, hooks = recipes
    lines = [step["run"] for step in job["jobs"]["check"]["steps"] if "run" in step]
    lines += [hook["entry"] for repository in hooks["repos"] for hook in repository["hooks"]]
    said = [command.line for b in blocks(page) if b.kind == "console" for command in pages.console(b)]
    assert {line for line in lines if line.startswith("chapsym ")} <= set(said)


def slugs(text):
    """The anchors of the headings of a page."""
    headings = re.findall(r"^#{1,3} (.+)$", prose(text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("name", TEXTS)
def test_every_link_of_a_page_leads_somewhere(name):
    for target in LINK.findall(prose(TEXTS[name])):
        url = urlsplit(target)
        if url.scheme:
            assert url.scheme == "https", target
            assert "." in url.netloc, target
            continue
        path = (PAGES[name].parent / unquote(url.path)).resolve() if url.path else PAGES[name]
        assert path.exists(), target
        assert path.is_relative_to(ROOT), target
        if url.fragment:
            assert unquote(url.fragment) in slugs(path.read_text(encoding="utf-8")), target


def test_every_public_name_and_every_command_has_its_place_in_the_reference():
    python, command = (TEXTS[f"docs/reference/{name}.md"] for name in ("python", "command"))
    described = re.findall(r"^\.\. auto\w+:: chapsym\.(\w+)$", python, re.MULTILINE)
    assert sorted(described) == sorted(chapsym.__all__)

    def commands(command, *path):
        yield " ".join(path)
        for name, one in getattr(command, "commands", {}).items():
            yield from commands(one, *path, name)

    named = re.findall(r"^```\{command-help\} ?(.*)$", command, re.MULTILINE)
    assert sorted(named) == sorted(commands(pages.typer.main.get_command(pages.app)))


def rewritten(name):
    """A page with what its commands print now; what is shown with `...` stays where it is right."""
    text, shift = TEXTS[name], 0
    with tempfile.TemporaryDirectory() as folder:
        for one, wrong, printed in pages.played(TEXTS[name], pages.workspace(Path(folder))):
            if wrong and isinstance(one, pages.Command):
                text = text[: one.start + shift] + printed + text[one.end + shift :]
                shift += len(printed) - (one.end - one.start)
            elif wrong:
                print(wrong, file=sys.stderr)
    return text


if __name__ == "__main__":  # python tests/test_pages.py PAGE ... writes the outputs of commands anew
    for name in sys.argv[1:]:
        PAGES[name].write_text(rewritten(name), encoding="utf-8")
