"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "6f00753fd97a66ac45e563c23b57c775d63f367d77c34283ddef67b0f8bf5a1f"
