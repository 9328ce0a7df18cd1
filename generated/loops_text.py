"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "3b1793ccce28283a21bafd3a59106897966b5cf1fbafa0facc13cb0a5190e7fe"
