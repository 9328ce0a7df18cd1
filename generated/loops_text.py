"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "1212c2631f3b87204edcef7ba2e25855b39cb0b7a183b71b27298f5da6625772"
