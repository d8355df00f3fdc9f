"""Shapes and colors as fields on boxes: planes, distance, rays, volume rendering, meshes."""
