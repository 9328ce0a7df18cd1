"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "82b7aae3587608f72557fd8d9012a8732f81096903a534071a931448140c32de"
