"""Tools for the figures: readings of a result, the style, the sphere."""
