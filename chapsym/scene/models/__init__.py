"""The models that a scene may need: one file each, the least first."""
