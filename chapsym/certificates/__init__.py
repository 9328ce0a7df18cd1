"""Certificates: what is proved of the map, as files that a checker verifies without this code.

A module for each kind of certificate finds it; `balls` and `document` are what they share.
`chapsym.checker` imports nothing from here; here it says which sentence the numbers of a file make, how wide a box
its own intervals bear, and where a motion of the continuous ball is back.
"""
