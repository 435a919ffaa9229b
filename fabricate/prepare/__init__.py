"""From a mesh as it was read to closed cells of the right size: diagnosis, repair, components, remeshing."""
