"""The ball in n dimensions."""
