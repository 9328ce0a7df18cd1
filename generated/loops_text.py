"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "2955d967aed8ec44d253185469ce21bf107e1fbe544e64021acc13bea1be8f76"
