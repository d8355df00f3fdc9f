"""Summaries of one asset a category, in text that a reviewer can read."""
