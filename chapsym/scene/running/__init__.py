"""A scene is run: in one piece, in units of work, on a cluster."""
