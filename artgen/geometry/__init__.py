"""Exact solids in float64: shapes, meshes, measures."""
