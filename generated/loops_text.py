"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "e108bddc371c292627bfa08537bde71f6b32707fc211f96cbf33db293ece6b52"
