"""The means of drawing the figures: readings of a result, the style, the sphere."""
