"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "337984ffe16d877d0be2653d7144584e963bac598f080ad533bf2723fb250b1b"
