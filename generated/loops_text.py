"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "3617e0c26848ea3ba4ebf636d4e6a46dc17f66ce650711cb2da0b786115ebcd4"
