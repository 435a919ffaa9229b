"""Closed polygon meshes: the record, shapes made by formula, reading files, testing, sizing."""
