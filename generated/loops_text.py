"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "e4c3f60c4bead8713a765cbe460be1a8b2b8ea3380ebf97b2da88de17f4a0889"
