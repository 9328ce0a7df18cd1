"""Results for the eye: figures and the rolling ball."""
