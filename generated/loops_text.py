"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "19f0776129f63f6a8dc2bbc14f427c00508895e65939e1f1b7cb72e3b0aa4733"
