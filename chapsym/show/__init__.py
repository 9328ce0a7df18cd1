"""The display of results: figures and the rolling ball."""

from pathlib import Path

from chapsym import extras

extras.need("figures")  # which installs those of scenes, too
extras.need("scenes")


def rendered(template: Path, **said: object) -> str:
    """An HTML page that needs no network: a template, of `document.html` where it has the colours of the reader."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    templates = Environment(
        loader=FileSystemLoader([template.parent, Path(__file__).parent]), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True,
    )  # fmt: skip
    return templates.get_template(template.name).render(**said)
