"""Certified motions of rolling balls, to judge engines by: the cases, and what makes them (`make`)."""
