"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "00745e27714fd777dad5d6defdfea9e4d160f75b43577b8532206d5d9cdafde8"
