"""Reading meshes: from a file of any supported format, or the name of a built-in shape, to polygons."""
