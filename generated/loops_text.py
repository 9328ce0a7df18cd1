"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "8bc8a99c24c6523ceaa0821d74b95f970aa87791262b7171eaaeb4029b181c6b"
