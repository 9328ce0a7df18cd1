"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "4b0f4f2610925d0338aada04fa51a34f2c09d4b6598d7211355883bdb127a2b6"
