"""The plan of a scene: its outputs, the model, and the cost."""
