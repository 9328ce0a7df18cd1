"""The balls of a scene: their bodies and their starts."""
