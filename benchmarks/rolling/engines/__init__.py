"""Engines run on the cases: each module writes a trajectory that `chapsym judge` reads."""
