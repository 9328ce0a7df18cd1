"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "e3edee047b1b4bc11dbec6c5cbb12ece7908988e3f910ffeb272a6e5eb2b1ec6"
