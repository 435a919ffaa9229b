"""Writers: meshes, pictures and curves as files, whole or not at all."""
