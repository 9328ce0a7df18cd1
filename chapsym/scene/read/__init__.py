"""Reading of scene files: tables, ranges, units, and their errors."""
