"""The page inside another one, a notebook's: an element that holds all of it, packed."""

import base64
import gzip
from html import escape

from xarray import Dataset

from .page import html

#: A notebook keeps what it shows: a page of more bytes than this, packed, is left out of it.
MOST = 2_000_000
#: Unpacks the page in its own frame, which no script of the notebook can reach, nor it them.
LOADER = (
    "<!doctype html><meta charset=utf-8><script>(async () => {"
    'const bytes = Uint8Array.from(atob("PAGE"), (letter) => letter.charCodeAt(0));'
    'const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));'
    "const text = await new Response(stream).text();"
    "document.open(); document.write(text); document.close();"
    "})();</script>"
)


def inline(dataset: Dataset) -> str:
    """The page of a result as one HTML element, an iframe that needs no network and no file.

    Raises ReportError as `html` does.  A result whose page is too large has a sentence in its place.
    """
    packed = gzip.compress(html(dataset).encode(), mtime=0)
    if len(packed) > MOST:
        return "<p>The page of this result is too large to stand here: write it with <code>page(path)</code>.</p>"
    source = escape(LOADER.replace("PAGE", base64.b64encode(packed).decode("ascii")))
    title = escape(str(dataset.attrs.get("title") or "A rolling ball"))
    return (
        f'<iframe title="{title}" sandbox="allow-scripts" loading="lazy" srcdoc="{source}" '
        'style="width: 100%; height: 40rem; border: 1px solid #888; border-radius: 6px"></iframe>'
    )
