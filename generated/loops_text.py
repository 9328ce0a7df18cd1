"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "f391966fc1d92525305e866d06beb5d0963008c23cbf0ea5238387031fc6cb2d"
