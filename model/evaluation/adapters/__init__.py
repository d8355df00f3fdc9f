"""Readers of what other systems write: a folder or file of one object to its Layout."""
