"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "c799bae63dc06183818beb05553fb8577cf64c8f1ef69903a927e4b0b051dbd2"
