"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "055c5988ed07bc9b34fa92faf578bb33cdf22dd39d32c6d15c5ae5f4e207ed93"
