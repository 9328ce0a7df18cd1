"""One script per group of claims, named by section and subject; each runs alone."""
