"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "a8316035c759f0d5f22359161fd86df4e4284e36745d53d1b731dcd684f107fb"
