"""A scene file is read: tables, quantities, units, and what is wrong with them."""
