"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "518a58aa3a02dfe7b801d4b6585f35cfec45203e00f7e20f4e0fdf24a2061f0f"
