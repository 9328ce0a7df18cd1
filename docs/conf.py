"""How `make docs` builds the site: pages in Markdown (MyST), no network, formulas as MathML."""

import sys
from pathlib import Path

import chapsym

sys.path.insert(0, str(Path(__file__).parent))  # for extension.py

project = "chapsym"
author = copyright = "the chapsym developers"
release = version = chapsym.__version__

# `extension` escapes what means itself in docstrings, before napoleon reads their sections.
extensions = [
    "myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinxcontrib.bibtex", "extension",
    "sphinx.ext.napoleon",
]  # fmt: skip
napoleon_google_docstring = False
napoleon_custom_sections = [("Attributes", "params_style")]
exclude_patterns = ["_build"]
myst_enable_extensions = ["deflist", "dollarmath"]
smartquotes = False  # "..." is code more often than not
myst_heading_anchors = 3
bibtex_bibfiles = ["references.bib"]
bibtex_reference_style = "author_year"
autodoc_typehints = "none"
autosummary_generate = False
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True

html_theme = "furo"
html_title = "chapsym"
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_copy_source = False
html_math_renderer = "mathml"
