"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "78c73e63be779e905a50fe30c41fd96b9835e046ad3a25a6e18692d78dc643f4"
