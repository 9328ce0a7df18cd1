"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "b3d53c3282ced08d722287de601b8f933b36daaf44b576551c0924ec9aaf6ac0"
