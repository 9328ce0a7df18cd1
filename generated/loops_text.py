"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "cba4b6e529261b743b46de51f14848c9333270ee386b9577408fe4bae8f69d49"
