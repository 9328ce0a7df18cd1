"""The loops: one text, which runs as Python and is printed as C (`text`)."""
