"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "094236c60ced566569490ff2b7784830909876d6829a066d4f7b71d38d8ed934"
