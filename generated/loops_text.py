"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "f2448bb9b33beb780123c1b58740b007b7ff8e2a2c073ee17a3598c8910ff615"
