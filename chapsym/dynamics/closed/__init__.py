"""Closed forms: steady rotations, tops, the elliptic curve, vertical momentum."""
