"""`chapsym trade`: what speed costs in accuracy, measured, and whether the chooser meets what is asked of it."""
