"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "8dc12946c91a7699944a9db84fcfae69fa034f4ef33b0c0d25eefcb62489e134"
