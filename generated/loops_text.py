"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "607e09737f6a573da3099ff693a70be4ac521b546a35cee4f1562b3e5d01cffa"
