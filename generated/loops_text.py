"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "97cb71a7777feb7a236f649f221031b4b737317eaadddbf9f1a31982c873b665"
