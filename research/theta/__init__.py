"""The continuous ball in theta functions of genus two, in Arb's balls: a route of its own to proved digits."""
