"""A scene file is read: tables, ranges, units, and what is wrong with them."""
