"""Runs of a scene: in one piece, in units of work, on a cluster."""
