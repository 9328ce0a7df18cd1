"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "9262afaba65a9fe82a8c9da7d94989273ab834adb81bef6773a1efe9557b95b4"
