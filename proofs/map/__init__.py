"""Lemmas on the map that chapsym runs."""
