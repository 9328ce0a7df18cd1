"""chapsym."""
