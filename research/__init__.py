"""Code that is not in the wheel: studies for the note on the two open questions, and the matrix of the extremes."""
