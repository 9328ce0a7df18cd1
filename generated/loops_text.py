"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "d76b5669cc5334ad7cb91bfa8e46532e9e1598e79ae0208c3b34ab62138ec92b"
