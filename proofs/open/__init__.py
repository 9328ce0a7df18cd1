"""The two questions that the paper left open."""
