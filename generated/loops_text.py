"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "c34953de05e0cc5da3f777124804ab57d4745d5828dffac09e219d5e83344846"
