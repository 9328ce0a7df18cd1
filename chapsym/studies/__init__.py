"""Studies of the map: what it gets right, and at which price."""
