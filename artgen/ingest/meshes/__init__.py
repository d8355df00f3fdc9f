"""Meshes of strangers: read with their materials, cleaned, split, weighed, made into pieces."""
