"""Divide a closed surface by one closed curve, and make two interlocking printable solids of it."""
