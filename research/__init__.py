"""Studies for the note on the two open questions: rotation numbers, the energy, chaos.  They are not in the wheel."""
