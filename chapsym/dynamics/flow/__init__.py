"""The motion of the continuous ball in Arb's balls: polynomials in time, and a proved bound of their error."""
