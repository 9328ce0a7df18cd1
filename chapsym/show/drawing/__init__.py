"""What the figures are drawn with: readings of a result, the style, the sphere."""
