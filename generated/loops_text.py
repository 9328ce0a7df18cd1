"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "204aee7c418da61a1178bebb72f4e03af46b25f625c617e0e1c14a12eae55c4b"
