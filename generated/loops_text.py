"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "7c516cf7d8d3e6a8f70137502afe712280b91048c5fdd1881e0e9d4506a3524c"
