"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "bd35df7e1c1a32abc8d563f8f25b689bf62a23155defcacd6bcbbc3dfa1b676d"
