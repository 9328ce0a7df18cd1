"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "cdddf79fd096584b68d0d4e1599a246f9bd59d7c24556bf6cf7201db7a697e87"
