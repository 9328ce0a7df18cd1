"""All solutions of a step, and their folds."""
