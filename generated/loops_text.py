"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "474bcebcb09d63c9de813ed287c56e6b6eaa177980111045379e793544c56d00"
