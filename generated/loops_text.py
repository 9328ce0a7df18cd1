"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "f37ba8ff80f1dfb8c84bb05c42d0ede8de4fb422f89ff7169b60efae30477f8f"
