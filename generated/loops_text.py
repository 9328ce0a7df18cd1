"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "0b01823dbbcf68029d0f8f17e24c9539ba9fbbea1d803c33e0b9adb7bbabc4ec"
