"""Stills of finished parts: rays and shading, no OpenGL."""
