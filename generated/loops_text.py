"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "bb02f40fcaa54c9664b357cb2b0000949210efd5cb5379920cc59b898f610f45"
