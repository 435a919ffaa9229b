"""Regions made into solids: inner surface, walls, clearance, parts."""
