"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "d7ff13f2756cec8fcc34c270d9795b204785e0ede93c5cfb740f74d0a2b9795c"
