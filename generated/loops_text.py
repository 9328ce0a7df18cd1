"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "85002382efd64120d21a81b6f4e4fbd6c3e725ff7692121c46d8ab17506dca91"
