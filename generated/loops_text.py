"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "6865ecaf539d251b0e2ee0a14dc09e1e55ef8f413ab9c32f229e5b8733845504"
