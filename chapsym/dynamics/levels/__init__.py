"""The levels of precision: how a run is done in each kind of number."""
