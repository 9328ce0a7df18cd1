"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "c62dc32453128945af05b19d661140c4daa3b6a0455f3bc4e8874a72bad5d9c2"
