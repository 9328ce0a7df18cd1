"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "3da1071d234dc8a2006831eda8dd9cc344ab006a26ff72c2d823245d48f870b7"
