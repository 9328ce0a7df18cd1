"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "d55e4f73e400415a745d7ae07c658c798af02a8af0c1274e397ec4d9273cceab"
