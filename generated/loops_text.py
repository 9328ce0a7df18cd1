"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "aeac4271190720c360c2e701d2c22a35761c4bed7e12ae15d2f118bd556fe466"
