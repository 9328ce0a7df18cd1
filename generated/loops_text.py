"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "d665ed15b1446f979c09a327a396115a72040bdeece23253606f57a2a1a5a380"
