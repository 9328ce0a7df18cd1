"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "f643a499e841be0c53de03c70e970ccc5d5e9647df5530525b91b12ecfc8b050"
