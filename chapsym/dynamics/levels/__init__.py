"""The precision levels: a run in each type of number."""
