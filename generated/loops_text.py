"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "076e520648c8334b26be315b1c360f1395afef98037f78f280fc84e2c5140374"
