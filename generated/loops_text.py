"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "a91ab8f216e4c1b5a1c9649a06d24bb1460080cf7067297d8c8967b0d3c18976"
