"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "d9417624f9ed07a31c69162dcc50d68a11973c069714c570a1de1eb7a8cfb0aa"
