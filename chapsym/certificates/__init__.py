"""Certificates: files of statements on the map and their proofs, which a checker verifies without this code.

One module searches for each kind of certificate; `balls` and `document` are shared.  `chapsym.checker` imports nothing
from here.  The search uses it for the statement of a file, for the size of a box that its intervals can prove, and for
the returns of a motion of the continuous ball.
"""
