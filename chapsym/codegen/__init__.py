"""From the proved expressions to straight-line kernels: the list, the printer, the manifest, the check."""
