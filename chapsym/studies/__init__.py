"""Studies of the accuracy of the map, and of other engines."""
