"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "0c5854e8d830f808579b494ef8ca22acdfecdbf0270acf52bfe73bfef82fd3ad"
