"""Pieces that several categories share; each returns bodies with their convex collision pieces."""
