"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "615d435d3159148cf23ff66fabcd357935667b5074f6bdc44393c1af5c7d7f31"
