"""The balls of a result rolling in 3D: one HTML file that opens from disk, with no network."""

from .page import html, inline, write_page

__all__ = ["html", "inline", "write_page"]
