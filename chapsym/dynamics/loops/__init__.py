"""The loops: one source, which runs as Python and is translated to C (`text`)."""
