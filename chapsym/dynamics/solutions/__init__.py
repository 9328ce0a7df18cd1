"""All solutions of a step, and where two of them meet."""
