"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "eb335027ef7f99ddd5855150db6fe5cf4466d5dba97df4c736a238ddc8039f9d"
