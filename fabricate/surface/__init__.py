"""The smooth surface: tile templates, Catmull-Clark limit evaluation, the cut into regions."""
