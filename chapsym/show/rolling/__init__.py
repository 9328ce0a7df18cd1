"""The balls of a result rolling in 3D: one HTML file that opens from disk, with no network."""

from .notebook import inline
from .page import html, write_page

__all__ = ["html", "inline", "write_page"]
