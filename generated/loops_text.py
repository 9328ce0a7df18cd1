"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "2051b4feebdb2e0e8e196284a9ad8f881424efa7041c7fb63ad0403468a4d403"
