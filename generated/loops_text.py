"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "566104747ff2e09be63b011cca44638c14b1253e26aa5842425cc48653fc7d19"
