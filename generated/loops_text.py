"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "ef85a3a17a883a2543915f7162ac2c11a045197cbc4b7a338216d149858c565f"
