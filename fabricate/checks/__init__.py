"""Proof: what finished parts are, measured, and what is wrong with them, with coordinates."""
