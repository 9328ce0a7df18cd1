"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "aca51a68a5c74cac256171622010bd40312c685dc14629eed4522ed84ce2071d"
