"""The loops: plain text on floats that numba compiles, and that runs without it."""
