"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "7783d12e819cacc998ce1cdd1f156b1f3394f9af1a36a25ea0a5dd5d4030f424"
