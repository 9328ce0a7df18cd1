"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "98ef845d331746b991a8cb841784485b6144e028d7bbb0898c0000a6007dd91d"
