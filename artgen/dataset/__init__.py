"""Samples, shards and the catalog; no torch."""
