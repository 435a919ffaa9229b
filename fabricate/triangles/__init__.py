"""Triangle meshes of any kind: rays, nearest places, exact crossings, normals, neighbourhoods."""
