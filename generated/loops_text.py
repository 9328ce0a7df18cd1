"""The hash of the text in C that belongs to the loops; written by `chapsym codegen`: do not edit."""

TEXT = "8088bd23d6c038016718f3ad28882bccbbf5b92fa289f15dbcea294809790344"
