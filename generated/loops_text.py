"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "bf55020a9679d2c3efb99ce57daf1441baff7b4b0a5aad7fe16ab58487008e91"
