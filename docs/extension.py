"""What the site needs besides Sphinx: formulas as MathML, the project's docstrings, the command's own help."""

import re
import runpy
import textwrap
from functools import reduce
from pathlib import Path

import typer
from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.util import logging

from chapsym.cli.app import app as typer_app
from chapsym.cli.app import plain
from chapsym.report import formulas

HERE = Path(__file__).parent
#: A line of a docstring that says what an argument is: "momentum, gamma: unit vectors, ...".
ARGUMENT = re.compile(r"(\w+(?:, \w+)*): +(?=\S)")
#: The head of a section of numpydoc's, which napoleon reads after this.
SECTION = re.compile(r"^(\w+)\n-{3,}\n", re.MULTILINE)


def setup(app):
    """What Sphinx calls."""
    app.add_html_math_renderer("mathml", (inline_formula, None), (shown_formula, None))
    app.connect("autodoc-process-docstring", docstring)
    app.add_directive("command-help", CommandHelp)
    app.connect("build-finished", in_browser)
    return {"parallel_read_safe": True}


def in_browser(app, failed):
    """What the page in the browser loads."""
    if not failed and app.builder.format == "html":
        runpy.run_path(str(HERE / "browser" / "make.py"))["write"](app.outdir / "browser")


def inline_formula(writer, node):
    """A formula in a line, as the page of the report has them."""
    writer.body.append(mathml(node))
    raise nodes.SkipNode


def shown_formula(writer, node):
    """A formula on a line of its own."""
    writer.body.append(f'<p class="shown-formula">{mathml(node)}</p>')
    raise nodes.SkipNode


def mathml(node):
    """The formula of a node; one that cannot be converted is a warning of the build."""
    html = formulas.html(node.astext())
    if "unconverted" in html:
        logging.getLogger(__name__).warning(f"no MathML: {html}", location=node)
    return html


def docstring(app, what, name, obj, options, lines):
    """A docstring of the project as reStructuredText: a list item for each argument, `code`, nothing else is a sign."""
    text, *sections = SECTION.split("\n".join(lines))
    lines[:] = [line for block in text.split("\n\n") for line in [*restructured(block), ""]]
    for name, body in zip(sections[::2], sections[1::2], strict=True):
        kept = body if name == "Examples" else "\n".join(map(escaped, body.splitlines()))
        lines += [name, "-" * len(name), *kept.splitlines(), ""]


def restructured(block):
    """The lines of a paragraph, or of an example."""
    block = block.strip("\n")
    if block.startswith((" ", ">>>")):
        return ["::", "", *textwrap.indent(textwrap.dedent(block), "   ").splitlines()]
    found = []
    for line in block.splitlines():
        clause = ARGUMENT.match(line)
        if clause:
            found += ["", f"- **{clause[1]}**: {escaped(line[clause.end() :])}"]
        else:
            found.append(("  " if any(one.startswith("- **") for one in found) else "") + escaped(line.strip()))
    return found


def escaped(text):
    """Code between single backquotes is code; other signs of reStructuredText mean themselves."""
    parts = re.split(r"`([^`]+)`", text)
    return "".join(f"``{part}``" if i % 2 else re.sub(r"([\\*|_])", r"\\\1", part) for i, part in enumerate(parts))


class CommandHelp(Directive):
    """The help of a command, as `--help` prints it: `{command-help} scene new`."""

    optional_arguments = 1
    final_argument_whitespace = True

    def run(self):
        """A block of text."""
        names = (self.arguments or [""])[0].split()
        command = reduce(lambda group, name: group.commands[name], names, plain(typer.main.get_command(typer_app)))
        context = command.make_context(" ".join(["chapsym", *names]), [], resilient_parsing=True, max_content_width=80)
        block = nodes.literal_block(text=command.get_help(context))
        block["language"] = "text"
        return [block]
