"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "0ffcf379ae7dcd62511943c679abeb59480f6e1a173c9d8f8230ed732df4e52b"
