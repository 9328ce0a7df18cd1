"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "ffdc3ae38a1215377c5adc49c39a058098a31c994eba3feaeb9226d84bd138f5"
